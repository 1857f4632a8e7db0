//! A NURBS curve as chords: what the rest of Trunnion, which knows lines and arcs, can follow.
use core::cell::Cell;

/// Points on the curve, the start left out and the end exact, so that chords stay within `tolerance` of it (units of the points).
///
/// A part of a span is a rational Bezier curve, whose control points are values of the span's polar form (Ramshaw: Blossoming, 1987;
/// Piegl, Tiller: The NURBS Book, 2nd ed., 5.3). With positive weights it is inside the convex hull of its control points: a part whose
/// control points are within the tolerance of its chord is proved to be; all others are halved. `None` if the knots are invalid, a weight
/// is not positive, the curve is discontinuous, halving does not end, or takes more than `room`: parts that are looked at, those of a high
/// order for more. The second value is what it took.
pub(super) fn chords(
    order: usize,
    points: &[[f64; 3]],
    knots: &[f64],
    tolerance: f64,
    room: u64,
) -> (Option<Vec<[f64; 2]>>, u64) {
    let took = Cell::new(0);
    let found = within(order, points, knots, tolerance, (room, &took));
    (found, took.get())
}

fn within(
    order: usize,
    points: &[[f64; 3]],
    knots: &[f64],
    tolerance: f64,
    (room, took): (u64, &Cell<u64>),
) -> Option<Vec<[f64; 2]>> {
    if order < 2 || points.len() < order {
        return None;
    }
    let clamped;
    let knots = if knots.is_empty() {
        clamped = clamped_uniform(order, points.len());
        &clamped
    } else {
        knots
    };
    let sorted = knots.windows(2).all(|pair| pair[0] <= pair[1]);
    let finite = points.iter().flatten().chain(knots).all(|value| value.is_finite());
    let positive = points.iter().all(|[_, _, weight]| *weight > 0.0);
    if knots.len() != points.len() + order || !sorted || !finite || !positive {
        return None;
    }
    let curve = Curve {
        order,
        points,
        knots,
        room,
        took,
    };
    let mut out = Vec::new();
    for span in order - 1..points.len() {
        let (from, to) = (knots[span], knots[span + 1]);
        if to > from {
            let torn = |last: &[f64; 2]| distance(curve.at(span, from, from, 0), *last, *last) > tolerance;
            if out.last().is_some_and(torn) {
                return None;
            }
            curve.divide(span, from, to, tolerance, 0, &mut out)?;
        }
    }
    Some(out)
}

/// Knots 0 0 0 1 2 3 3 3 for order 3 and five points.
fn clamped_uniform(order: usize, count: usize) -> Vec<f64> {
    let inner = count - order + 1;
    (0..count + order)
        .map(|index| (index as f64 - (order - 1) as f64).clamp(0.0, inner as f64))
        .collect()
}

struct Curve<'a> {
    order: usize,
    points: &'a [[f64; 3]],
    knots: &'a [f64],
    room: u64,
    took: &'a Cell<u64>,
}

/// The steps for a part of a cubic, which count as one.
const CUBIC: u64 = 27;

/// No chord is halved more often.
const DEEPEST: u32 = 18;

impl Curve<'_> {
    /// Control point `index` (from 0) of the part of a span from `from` to `to`: the polar form at `index` times `to`, else `from`.
    fn at(&self, span: usize, from: f64, to: f64, index: usize) -> [f64; 2] {
        let degree = self.order - 1;
        let mut d: Vec<[f64; 3]> = (span - degree..=span)
            .map(|index| {
                let [x, y, weight] = self.points[index];
                [x * weight, y * weight, weight]
            })
            .collect();
        for level in 1..=degree {
            let u = if level <= index { to } else { from };
            for j in (level..=degree).rev() {
                let low = self.knots[span - degree + j];
                let high = self.knots[span + 1 + j - level];
                let part = if high > low { (u - low) / (high - low) } else { 0.0 };
                let before = d[j - 1];
                for (value, before) in d[j].iter_mut().zip(before) {
                    *value = (1.0 - part) * before + part * *value;
                }
            }
        }
        let [x, y, weight] = d[degree];
        [x / weight, y / weight]
    }

    /// Whether the control points come one after the other along the chord, and so the curve; or all are so near that the order does not matter.
    fn is_in_order((a, b): ([f64; 2], [f64; 2]), inner: impl Iterator<Item = [f64; 2]>, tolerance: f64) -> bool {
        let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
        let mut reached = 0.0;
        let (mut in_order, mut extent) = (true, (dx * dx + dy * dy).sqrt());
        let length = dx * dx + dy * dy;
        for [x, y] in inner {
            let (px, py) = (x - a[0], y - a[1]);
            let share = px * dx + py * dy;
            in_order &= share >= reached && share <= length;
            reached = share;
            extent = extent.max((px * px + py * py).sqrt());
        }
        in_order || extent <= 0.5 * tolerance
    }

    fn divide(
        &self,
        span: usize,
        from: f64,
        to: f64,
        tolerance: f64,
        depth: u32,
        out: &mut Vec<[f64; 2]>,
    ) -> Option<()> {
        let degree = self.order - 1;
        // each of its control points is a triangle of steps
        let steps = (degree as u64).saturating_pow(3) / CUBIC;
        self.took.set(self.took.get().saturating_add(steps.max(1)));
        if self.took.get() > self.room {
            return None;
        }
        let (a, b) = (self.at(span, from, to, 0), self.at(span, from, to, degree));
        let inner = |index: usize| self.at(span, from, to, index);
        let near = (1..degree).all(|index| distance(inner(index), a, b) <= tolerance);
        if near && Self::is_in_order((a, b), (1..degree).map(inner), tolerance) {
            out.push(b);
            return Some(());
        }
        if depth == DEEPEST {
            return None;
        }
        let middle = 0.5 * (from + to);
        self.divide(span, from, middle, tolerance, depth + 1, out)?;
        self.divide(span, middle, to, tolerance, depth + 1, out)
    }
}

/// Of a point from the segment `a` `b`.
fn distance(point: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let (dx, dy) = (b[0] - a[0], b[1] - a[1]);
    let length = dx * dx + dy * dy;
    let (px, py) = (point[0] - a[0], point[1] - a[1]);
    let part = if length > 0.0 {
        ((px * dx + py * dy) / length).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let (x, y) = (px - part * dx, py - part * dy);
    (x * x + y * y).sqrt()
}

#[cfg(test)]
mod tests {
    use super::chords as chords_within;
    use super::*;

    fn chords(order: usize, points: &[[f64; 3]], knots: &[f64], tolerance: f64) -> Option<Vec<[f64; 2]>> {
        chords_within(order, points, knots, tolerance, u64::MAX).0
    }

    /// What it takes is counted, whatever its order, and ends it.
    #[test]
    fn a_curve_takes_no_more_than_its_room() {
        let points: Vec<[f64; 3]> = (0..40).map(|i| [f64::from(i), f64::from(i % 9), 1.0]).collect();
        let took = |order, room| chords_within(order, &points, &[], 1e-3, room);
        let (found, cubic) = took(4, u64::MAX);
        let count = found.expect("a curve").len() as u64;
        assert!((count..=2 * count).contains(&cubic), "{cubic} for {count} chords");
        let (found, high) = took(40, u64::MAX);
        let count = found.expect("a curve").len() as u64;
        assert!(high > 1000 * count, "{high} for {count} chords");
        let (found, spent) = took(40, 10_000);
        assert_eq!(found, None);
        assert!((10_000..20_000).contains(&spent), "{spent}");
    }

    #[test]
    fn a_quarter_circle_as_rational_quadratic_stays_on_the_circle() {
        let weight = 0.5_f64.sqrt();
        let points = [[1.0, 0.0, 1.0], [1.0, 1.0, weight], [0.0, 1.0, 1.0]];
        let chords = chords(3, &points, &[], 1e-4).expect("a curve");
        assert!(chords.len() > 8, "{}", chords.len());
        for [x, y] in &chords {
            assert!((x * x + y * y - 1.0).abs() < 1e-12);
        }
        assert_eq!(chords.last(), Some(&[0.0, 1.0]));
    }

    #[test]
    fn a_line_of_control_points_is_a_line() {
        let points = [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [2.0, 0.0, 1.0], [3.0, 0.0, 1.0]];
        let chords = chords(4, &points, &[], 1e-6).expect("a curve");
        assert!(chords.iter().all(|[_, y]| *y == 0.0));
        assert_eq!(chords.last(), Some(&[3.0, 0.0]));
    }

    /// On a straight line from 0 to 1 that goes back in between: no chord may skip the turns.
    #[test]
    fn a_curve_that_turns_back_is_no_line() {
        let points = [0.0, 6.0, -5.0, 1.0].map(|x| [x, 0.0, 1.0]);
        let found = chords(4, &points, &[], 1e-3).expect("a curve");
        let turns: Vec<f64> = found
            .windows(3)
            .filter(|three| (three[1][0] - three[0][0]) * (three[2][0] - three[1][0]) < 0.0)
            .map(|three| three[1][0])
            .collect();
        // Bezier's definition as powers
        let at = |p: f64| 18.0 * p - 51.0 * p * p + 34.0 * p * p * p;
        let samples = (0..=10_000).map(|step| at(f64::from(step) / 10_000.0));
        let (low, high) = samples.fold((0.0_f64, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)));
        let near = |wanted: f64| turns.iter().any(|turn| (turn - wanted).abs() < 1e-3);
        assert!(near(low) && near(high), "{turns:?} {low} {high}");
    }

    /// An S whose quarters lie on the chord: samples there would take it for a line.
    #[test]
    fn a_wave_through_the_quarters_of_its_chord_is_no_line() {
        let points = [[0.0, 0.0, 1.0], [1.0, 3.0, 1.0], [3.0, -3.0, 1.0], [4.0, 0.0, 1.0]];
        let tolerance = 1e-3;
        let found = chords(4, &points, &[], tolerance).expect("a curve");
        let curve = |t: f64| {
            let s = 1.0 - t;
            let b = [s * s * s, 3.0 * s * s * t, 3.0 * s * t * t, t * t * t];
            [0, 1].map(|axis| (0..4).map(|i| b[i] * points[i][axis]).sum::<f64>())
        };
        let mut way = vec![[0.0, 0.0]];
        way.extend(found);
        for step in 0..=1000 {
            let point = curve(f64::from(step) / 1000.0);
            let nearest = way.windows(2).map(|pair| distance(point, pair[0], pair[1]));
            let nearest = nearest.fold(f64::INFINITY, f64::min);
            assert!(nearest <= tolerance, "{point:?}: {nearest}");
        }
    }

    #[test]
    fn what_is_no_curve_is_none() {
        assert_eq!(chords(3, &[[0.0; 3]; 2], &[], 1.0), None);
        assert_eq!(chords(3, &[[0.0, 0.0, 1.0]; 3], &[0.0; 3], 1.0), None);
        assert_eq!(chords(3, &[[f64::NAN, 0.0, 1.0]; 3], &[], 1.0), None);
        let negative = [[0.0, 0.0, 1.0], [1.0, 1.0, -0.4], [2.0, 0.0, 1.0]];
        assert_eq!(chords(3, &negative, &[], 1.0), None, "the hull says nothing");
        let torn = [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [5.0, 5.0, 1.0], [6.0, 5.0, 1.0]];
        assert_eq!(chords(2, &torn, &[0.0, 0.0, 1.0, 1.0, 2.0, 2.0], 0.1), None, "it jumps");
    }

    /// Basis function by the recursion of Cox and de Boor: nothing of the polar form above.
    fn basis(index: usize, degree: usize, u: f64, knots: &[f64], last: bool) -> f64 {
        if degree == 0 {
            let inside =
                knots[index] <= u && (u < knots[index + 1] || last && knots[index] < u && u <= knots[index + 1]);
            return f64::from(u8::from(inside));
        }
        let part = |over: f64, under: f64| if under > 0.0 { over / under } else { 0.0 };
        let rise = part(u - knots[index], knots[index + degree] - knots[index]);
        let fall = part(
            knots[index + degree + 1] - u,
            knots[index + degree + 1] - knots[index + 1],
        );
        rise * basis(index, degree - 1, u, knots, last) + fall * basis(index + 1, degree - 1, u, knots, last)
    }

    fn point(order: usize, points: &[[f64; 3]], knots: &[f64], u: f64) -> [f64; 2] {
        let end = knots[points.len()];
        let mut sum = [0.0; 3];
        for (index, [x, y, weight]) in points.iter().enumerate() {
            let share = basis(index, order - 1, u, knots, u >= end) * weight;
            for (sum, value) in sum.iter_mut().zip([*x, *y, 1.0]) {
                *sum += share * value;
            }
        }
        [sum[0] / sum[2], sum[1] / sum[2]]
    }

    proptest::proptest! {
        #![proptest_config(proptest::prelude::ProptestConfig { failure_persistence: None, ..proptest::prelude::ProptestConfig::with_cases(60) })]

        /// No point of a random curve is farther from its chords than the tolerance, and the chords end where the curve does.
        #[test]
        fn no_point_of_a_curve_is_beyond_the_tolerance(
            order in 2_usize..6,
            places in proptest::collection::vec(proptest::array::uniform3(0.0..1.0_f64), 6..10),
            tolerance in 0.002..0.5_f64,
        ) {
            let points: Vec<[f64; 3]> = places.iter().map(|[x, y, w]| [x * 40.0, y * 40.0, 0.3 + 2.0 * w]).collect();
            let knots = clamped_uniform(order, points.len());
            let Some(ends) = chords(order, &points, &[], tolerance) else {
                // halving may come to no end only for the finest tolerances
                proptest::prop_assert!(tolerance < 0.01, "{points:?}");
                return Ok(());
            };
            let mut all = vec![[points[0][0], points[0][1]]];
            all.extend(&ends);
            let end = knots[points.len()];
            for step in 0..=400 {
                let at = point(order, &points, &knots, end * f64::from(step) / 400.0);
                let off = all.windows(2).map(|two| distance(at, two[0], two[1])).fold(f64::INFINITY, f64::min);
                proptest::prop_assert!(off <= tolerance * (1.0 + 1e-9) + 1e-9, "{off} at {step}");
            }
            let last = points[points.len() - 1];
            proptest::prop_assert!(distance(all[all.len() - 1], [last[0], last[1]], [last[0], last[1]]) < 1e-9);
        }
    }
}
