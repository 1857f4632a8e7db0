//! Which circles through the first and the last of some points in a plane are near all of them, and near the lines between them.
//!
//! In coordinates with the middle of the two ends as origin and the first axis along them, the centre is (0, t), and t is the only unknown.
//! With h half their distance, the radius is R = sqrt(h^2 + t^2), and the distance d of (a, b) from the centre satisfies
//! d^2 - R^2 = a^2 + b^2 - h^2 - 2 b t. So |d - R| <= e is a quadratic inequality in t, and so is R - foot <= e for the foot of the centre on a line.
//! The centres that serve all points are found exactly, by intersecting intervals; not only the circle through a point in the middle is tried.

/// A point in the plane, mm.
pub(crate) type Flat = [f64; 2];

/// Larger arcs are lines for every purpose, and controls have limits, mm.
const MOST_RADIUS: f64 = 10_000.0;

/// Half chord over radius of the longest arc that is written: 350 deg. What is nearly a whole circle is a whole circle or nothing after rounding.
const LEAST_OPENING: f64 = 0.087;

/// A circle that serves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Circle {
    /// Some centres that serve, the best guess first: mm.
    pub centres: [Flat; 3],
    /// Seen with the plane's first axis to the right and its second up.
    pub counter_clockwise: bool,
}

/// Values of t that serve.
#[derive(Clone, Copy)]
struct Range {
    low: f64,
    high: f64,
}

impl Range {
    fn intersect(&mut self, low: f64, high: f64) -> bool {
        self.low = self.low.max(low);
        self.high = self.high.min(high);
        self.low <= self.high
    }
    /// Without the open interval: the larger part that is left.
    fn remove(&mut self, low: f64, high: f64) -> bool {
        if high <= self.low || low >= self.high || low >= high {
            return true;
        }
        let (below, above) = (low - self.low, self.high - high);
        if below <= 0.0 && above <= 0.0 {
            return false;
        }
        if above >= below {
            self.low = self.low.max(high);
        } else {
            self.high = self.high.min(low);
        }
        self.low <= self.high
    }
}

/// Local coordinates of the ends.
struct Base {
    middle: Flat,
    along: Flat,
    half: f64,
    /// 1, or -1 where the arc turns clockwise: then everything is mirrored.
    side: f64,
}

impl Base {
    fn new([first, last]: [&Flat; 2], points: &[Flat]) -> Option<Self> {
        let (x, y) = (last[0] - first[0], last[1] - first[1]);
        let length = (x * x + y * y).sqrt();
        if length <= 1e-9 {
            return None;
        }
        let mut base = Self {
            middle: [0.5 * (first[0] + last[0]), 0.5 * (first[1] + last[1])],
            along: [x / length, y / length],
            half: 0.5 * length,
            side: 1.0,
        };
        // the points of a counter-clockwise arc lie to the right of its ends
        let middle = base.local(&points[points.len() / 2]);
        if middle[1] > 0.0 {
            base.side = -1.0;
        }
        Some(base)
    }

    fn local(&self, point: &Flat) -> Flat {
        let (x, y) = (point[0] - self.middle[0], point[1] - self.middle[1]);
        let [u, v] = self.along;
        [x * u + y * v, (y * u - x * v) * self.side]
    }

    fn centre(&self, t: f64) -> Flat {
        let [u, v] = self.along;
        let t = t * self.side;
        [self.middle[0] - v * t, self.middle[1] + u * t]
    }
}

/// The circles that pass both ends and come near all points within `tolerance`, in order; with `chords` also near the lines between them.
/// Of `points` (at least 3) the first and the last are the ends.
pub(crate) fn circle(points: &[Flat], tolerance: f64, chords: bool) -> Option<Circle> {
    let (first, last) = (points.first()?, points.last()?);
    circle_between([first, last], points, tolerance, chords)
}

/// The same where the circles pass two ends that are beside the first and the last point.
pub(crate) fn circle_between(ends: [&Flat; 2], points: &[Flat], tolerance: f64, chords: bool) -> Option<Circle> {
    let base = Base::new(ends, points)?;
    // a point that is an end itself allows every circle
    let inner = points;
    let mut range = Range {
        low: -MOST_RADIUS,
        high: MOST_RADIUS,
    };
    let mut gap = (f64::INFINITY, f64::NEG_INFINITY);
    let mut serves = |point: &Flat| -> bool {
        let [a, b] = base.local(point);
        let (h2, e2) = (base.half * base.half, tolerance * tolerance);
        let c = a * a + b * b - h2 - e2;
        let lead = b * b - e2;
        // inside between two roots, so between two values that are
        let inside = |t: f64| (lead * t - b * c) * t + 0.25 * c * c - e2 * h2 <= 0.0;
        if lead > 0.0 && inside(range.low) && inside(range.high) {
            return true;
        }
        let root = c * c + 4.0 * h2 * lead;
        if lead.abs() <= 1e-300 || root < 0.0 {
            return true;
        }
        let spread = tolerance * root.sqrt();
        let (one, other) = ((b * c - spread) / (2.0 * lead), (b * c + spread) / (2.0 * lead));
        if lead > 0.0 {
            return range.intersect(one, other);
        }
        gap = (gap.0.min(one.min(other)), gap.1.max(one.max(other)));
        true
    };
    // a few points spread over the arc decide most failures
    let step = inner.len() / 4 + 1;
    if !inner.iter().skip(step / 2).step_by(step).all(&mut serves) || !inner.iter().all(&mut serves) {
        return None;
    }
    if !range.remove(gap.0, gap.1) {
        return None;
    }
    if chords {
        for pair in points.windows(2) {
            if !chord_serves(&base, pair, tolerance, &mut range) {
                return None;
            }
        }
    }
    let middle = between(range.low, range.high);
    let circle = Circle {
        centres: [middle, between(range.low, middle), between(middle, range.high)].map(|t| base.centre(t)),
        counter_clockwise: base.side > 0.0,
    };
    in_order(&base, ends, points, middle).then_some(circle)
}

/// A value between two, even in 1/t where both are on one side: there the arc's bend is.
fn between(low: f64, high: f64) -> f64 {
    if low * high > 0.0 {
        2.0 * low * high / (low + high)
    } else {
        0.5 * (low + high)
    }
}

/// Narrows the range to centres whose circle is no farther from the line than `tolerance`.
fn chord_serves(base: &Base, pair: &[Flat], tolerance: f64, range: &mut Range) -> bool {
    let ([a, b], [to_a, to_b]) = (base.local(&pair[0]), base.local(&pair[1]));
    let (x, y) = (to_a - a, to_b - b);
    let length = (x * x + y * y).sqrt();
    if length <= 1e-12 {
        return true;
    }
    let (x, y) = (x / length, y / length);
    // R - (x t + w) <= e, so h^2 + t^2 <= (x t + w + e)^2; it holds between two values of t for which it does
    let e = y * a - x * b + tolerance;
    let h2 = base.half * base.half;
    let holds = |t: f64| x * t + e >= 0.0 && (y * y * t - 2.0 * x * e) * t + h2 - e * e <= 0.0;
    if holds(range.low) && holds(range.high) {
        return true;
    }
    // the foot of (0, t) on the line is inside it where its share is between 0 and the length
    let share = |t: f64| y * (t - b) - x * a;
    let (mut first, mut last) = (range.low, range.high);
    if y.abs() > 1e-15 {
        let ends = [b + x * a / y, b + (length + x * a) / y];
        first = first.max(ends[0].min(ends[1]));
        last = last.min(ends[0].max(ends[1]));
    } else if !(0.0..=length).contains(&share(0.0)) {
        return true;
    }
    if first > last {
        return true;
    }
    let lead = y * y;
    let (low, high) = if lead > 1e-12 {
        let root = e * e - lead * h2;
        if root < 0.0 {
            return range.remove(first, last);
        }
        let root = root.sqrt();
        ((x * e - root) / lead, (x * e + root) / lead)
    } else {
        let bound = (h2 - e * e) / (2.0 * x * e);
        if x * e > 0.0 {
            (bound, f64::INFINITY)
        } else {
            (f64::NEG_INFINITY, bound)
        }
    };
    range.remove(first, low.min(last)) && range.remove(high.max(first), last)
}

/// Whether the points go round the centre one way, less than 350 deg in all, on a circle of useful size.
fn in_order(base: &Base, [first, last]: [&Flat; 2], points: &[Flat], t: f64) -> bool {
    let radius = (base.half * base.half + t * t).sqrt();
    if radius > MOST_RADIUS || t < 0.0 && base.half < LEAST_OPENING * radius {
        return false;
    }
    let mut before = base.local(first);
    let mut goes_on = |point: &Flat| {
        let at = base.local(point);
        let turn = before[0] * (at[1] - t) - (before[1] - t) * at[0];
        // over the top, where no arc from end to end goes
        let over = before[0] > 0.0 && at[0] <= 0.0;
        before = at;
        turn > 0.0 && !over
    };
    points[1..points.len() - 1].iter().all(&mut goes_on) && goes_on(last)
}

#[cfg(test)]
mod tests {
    use super::*;
    use trunnion_geometry::math::{cos, sin};

    fn on(radius: f64, from: f64, to: f64, count: u32, wave: f64) -> Vec<Flat> {
        (0..=count)
            .map(|step| {
                let angle = (from + (to - from) * f64::from(step) / f64::from(count)).to_radians();
                let wobble = if step == 0 || step == count {
                    0.0
                } else {
                    wave * f64::from(step % 3) - wave
                };
                [
                    5.0 + (radius + wobble) * cos(angle),
                    -3.0 + (radius + wobble) * sin(angle),
                ]
            })
            .collect()
    }

    fn worst(points: &[Flat], circle: &Circle, index: usize) -> f64 {
        let [x, y] = circle.centres[index];
        let distance = |p: &Flat| ((p[0] - x).powi(2) + (p[1] - y).powi(2)).sqrt();
        let radius = distance(&points[0]);
        points.iter().map(|p| (distance(p) - radius).abs()).fold(0.0, f64::max)
    }

    #[test]
    fn arcs_up_to_350_degrees_both_ways() {
        for (to, count) in [(10.0, 4), (90.0, 9), (180.0, 20), (200.0, 21), (300.0, 40), (345.0, 60)] {
            for sign in [1.0, -1.0] {
                let points = on(20.0, 30.0, 30.0 + sign * to, count, 0.0);
                let found = circle(&points, 1e-6, false).unwrap_or_else(|| panic!("{to} {sign}"));
                assert_eq!(found.counter_clockwise, sign > 0.0);
                assert!((found.centres[0][0] - 5.0).abs() < 1e-3 && (found.centres[0][1] + 3.0).abs() < 1e-3);
            }
        }
        assert_eq!(
            circle(&on(20.0, 0.0, 359.0, 60, 0.0), 1e-3, false),
            None,
            "nearly a whole circle"
        );
        assert_eq!(
            circle(&on(20.0, 0.0, 400.0, 60, 0.0), 1e-3, false),
            None,
            "more than one turn"
        );
    }

    #[test]
    fn the_sag_of_lines_counts() {
        let points = on(20.0, 0.0, 90.0, 9, 0.0);
        let sag = 20.0 * (1.0 - cos(5f64.to_radians()));
        assert!(circle(&points, 0.4 * sag, true).is_none() && circle(&points, 1.001 * sag, true).is_some());
    }

    /// The circle through the middle point misses; another one serves.
    #[test]
    fn every_centre_is_considered() {
        let points = on(20.0, 0.0, 90.0, 9, 0.01);
        let found = circle(&points, 0.0101, false).expect("one serves");
        for index in 0..3 {
            assert!(worst(&points, &found, index) <= 0.0101 * (1.0 + 1e-9), "{index}");
        }
        assert!(circle(&points, 0.005, false).is_none());
    }

    #[test]
    fn flat_points_and_jagged_ones_give_no_arc() {
        let jagged: Vec<Flat> = (0..6).map(|i| [f64::from(i), f64::from(i % 2)]).collect();
        assert_eq!(circle(&jagged, 0.01, true), None);
        let back = [[0.0, 0.0], [2.0, -0.5], [1.0, -0.6], [3.0, 0.0]];
        assert_eq!(circle(&back, 0.3, true), None);
    }
}
