//! How far a chain of straight pieces lies from one line or arc, in order: both are walked from start to end, and neither goes back.
use crate::Vec3;
use crate::arc::Arc;
use crate::math::atan2;

/// A line or an arc that a chain of points is followed along.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Course {
    /// A straight line.
    Line {
        /// mm.
        start: Vec3,
        /// mm.
        end: Vec3,
    },
    /// An arc or helix.
    Arc(Arc),
}

/// Follows points along a [`Course`].
///
/// The bound is one of the Fréchet distance: there is a way to walk both from start to end, neither going back, such that the two are never
/// farther apart. A point is matched with the point of the course at the same angle about the centre (of a line: with its foot), or with the
/// farthest one reached so far where it falls back.
#[derive(Clone, Copy, Debug)]
pub struct Along {
    course: Course,
    at: Vec3,
    /// Angle of `at`, rad, or its share of a line's length, mm: may fall back.
    turned: f64,
    /// The farthest so far, between 0 and [`Along::whole`].
    reached: f64,
    /// Of points alone, mm.
    points: f64,
    /// Of everything between them too, mm.
    chords: f64,
}

/// Angle (rad) by which a point may lie beyond the end of an arc and still be the end: rounding.
const ROUNDING: f64 = 1e-9;

impl Along {
    /// Begins at `start`, which is matched with the start of the course.
    pub fn new(course: Course, start: Vec3) -> Self {
        let off = match &course {
            Course::Line { start: from, .. } => (start - from).norm(),
            Course::Arc(arc) => (start - arc.start).norm(),
        };
        Self {
            course,
            at: start,
            turned: 0.0,
            reached: 0.0,
            points: off,
            chords: off,
        }
    }

    /// Goes on straight to a point.
    pub fn to(&mut self, point: Vec3) {
        match self.course {
            Course::Line { start, end } => {
                let way = end - start;
                let length = way.norm();
                self.turned = if length > 0.0 {
                    (point - start).dot(&way) / length
                } else {
                    0.0
                };
                self.reached = self.reached.max(self.turned.clamp(0.0, length));
                let share = if length > 0.0 { self.reached / length } else { 1.0 };
                // the distance of two points that both move straight is largest at an end
                let off = (point - (start + way * share)).norm();
                self.points = self.points.max(off);
                self.chords = self.chords.max(off);
            }
            Course::Arc(arc) => self.turn(&arc, point),
        }
        self.at = point;
    }

    fn turn(&mut self, arc: &Arc, point: Vec3) {
        let normal = arc.normal;
        let arm = |point: &Vec3| {
            let from = point - arc.centre;
            from - normal * normal.dot(&from)
        };
        let (from, to) = (arm(&self.at), arm(&point));
        let side = arc.sweep.signum();
        let step = side * atan2(normal.dot(&from.cross(&to)), from.dot(&to));
        let whole = arc.sweep.abs();
        let (was, was_reached) = (self.turned, self.reached);
        self.turned += step;
        // the end itself, after rounding
        if (self.turned - whole).abs() <= ROUNDING {
            self.turned = whole;
        }
        self.reached = self.reached.max(self.turned.clamp(0.0, whole));
        let in_order = |turned: f64, reached: f64| (turned - reached).abs() <= ROUNDING;
        let advances = in_order(was, was_reached) && in_order(self.turned, self.reached) && step >= 0.0;
        let radius = |turned: f64| arc.radius_start + (arc.radius_end - arc.radius_start) * (turned / whole);
        let height = |point: &Vec3| normal.dot(&(point - arc.centre));
        let rise = |turned: f64| arc.height() * (turned / whole);
        if !advances {
            let off = (point - arc.point_at(self.reached / whole)).norm();
            self.points = self.points.max(off);
            // one moves straight, the other on an arc that leaves its chord by no more than r a^2 / 8 (and a spiral's share)
            let before = (self.at - arc.point_at(was_reached / whole)).norm();
            self.chords = self.chords.max(off.max(before) + bend(arc, self.reached - was_reached));
            return;
        }
        let (here, there) = (from.norm(), to.norm());
        let (radius_here, radius_there) = (radius(was), radius(self.turned));
        let heights = [height(&self.at) - rise(was), height(&point) - rise(self.turned)];
        let radial = (there - radius_there).abs();
        self.points = self.points.max(hypotenuse(radial, heights[1].abs()));
        let mut apart = radial.max((here - radius_here).abs());
        let chord = to - from;
        let length = chord.norm();
        // the nearest point to the centre; the distance seen from the centre is convex in the angle, the radius linear
        let (first, last) = (from.dot(&chord), to.dot(&chord));
        let nearest = if first < 0.0 && last > 0.0 {
            from.cross(&to).norm() / length
        } else {
            here.min(there)
        };
        // of a spiral both ends of its radius count: between them the difference may be larger than at the ends
        apart = apart.max(radius_here.max(radius_there) - nearest);
        let mut high = heights[0].abs().max(heights[1].abs());
        let climb = (height(&point) - height(&self.at)).abs();
        if climb > 0.0 && length > 0.0 {
            // the height is linear along the chord and not in the angle: with x the distance from the foot, share'' = 2 x (1 + x^2 / foot^2) / length
            let foot = from.cross(&to).norm() / length;
            let x = first.abs().max(last.abs()) / length;
            high += climb * step * step / 8.0 * 2.0 * x * (1.0 + (x / foot) * (x / foot)) / length;
        } else if climb > 0.0 {
            high += climb;
        }
        self.chords = self.chords.max(hypotenuse(apart, high));
    }

    /// The same once the rest of the course was walked while the chain stands where it is: then [`Self::is_through`].
    #[must_use]
    pub fn ended(mut self) -> Self {
        let (end, whole, bend) = match &self.course {
            Course::Line { start, end } => (*end, (end - start).norm(), 0.0),
            Course::Arc(arc) => {
                let (whole, rest) = (arc.sweep.abs(), arc.sweep.abs() - self.reached);
                (arc.end, whole, bend(arc, rest))
            }
        };
        let before = match &self.course {
            Course::Line { start, end } if whole > 0.0 => self.at - (start + (end - start) * (self.reached / whole)),
            Course::Line { end, .. } => self.at - end,
            Course::Arc(arc) => self.at - arc.point_at(self.reached / whole),
        };
        let off = (self.at - end).norm();
        self.points = self.points.max(off);
        // the distance from a point is largest at an end of a line, and an arc leaves its chord by its bend
        self.chords = self.chords.max(off.max(before.norm()) + bend);
        self.reached = whole;
        self
    }

    /// Where the chain is, and where the course ends: so far apart, mm.
    pub fn from_end(&self) -> f64 {
        match &self.course {
            Course::Line { end, .. } => (self.at - end).norm(),
            Course::Arc(arc) => (self.at - arc.end).norm(),
        }
    }

    /// Whether the course was walked to its end.
    pub fn is_through(&self) -> bool {
        match &self.course {
            Course::Line { start, end } => (end - start).norm() - self.reached <= 1e-6,
            Course::Arc(arc) => (arc.sweep.abs() - self.reached) * arc.radius_end <= 1e-6,
        }
    }

    /// No point of the chain was farther from its match, mm.
    pub fn points_apart(&self) -> f64 {
        self.points
    }

    /// No point of the chain or between two of them was farther from its match, mm.
    pub fn apart(&self) -> f64 {
        self.chords
    }
}

/// An arc leaves the chord of an angle, rad, by no more than r a^2 / 8 (and a spiral's share), mm.
fn bend(arc: &Arc, angle: f64) -> f64 {
    let most = arc.radius_start.max(arc.radius_end);
    let slope = (arc.radius_end - arc.radius_start).abs() / arc.sweep.abs();
    angle * angle * (most + 2.0 * slope) / 8.0
}

fn hypotenuse(a: f64, b: f64) -> f64 {
    if b == 0.0 { a } else { (a * a + b * b).sqrt() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::arc::Turning;
    use crate::math::{cos, sin_cos};

    const NORMAL: Vec3 = Vec3::new(0.0, 0.0, 1.0);

    fn quarter(radius: f64, rise: f64) -> Arc {
        let end = Vec3::new(0.0, radius, rise);
        Arc::from_centre(
            Vec3::new(radius, 0.0, 0.0),
            end,
            Vec3::zeros(),
            NORMAL,
            Turning::CounterClockwise,
            0,
        )
        .expect("an arc")
    }

    fn follow(course: Course, points: &[Vec3]) -> Along {
        let mut along = Along::new(course, points[0]);
        points[1..].iter().for_each(|point| along.to(*point));
        along
    }

    #[test]
    fn chords_of_an_arc_sag() {
        let points: Vec<Vec3> = (0..=9)
            .map(|step| {
                let (sin, cos) = sin_cos((f64::from(step) * 10.0).to_radians());
                Vec3::new(20.0 * cos, 20.0 * sin, 0.0)
            })
            .collect();
        let along = follow(Course::Arc(quarter(20.0, 0.0)), &points);
        assert!(along.is_through());
        assert!(along.points_apart() < 1e-12, "{along:?}");
        let sag = 20.0 * (1.0 - cos(5f64.to_radians()));
        assert!((along.apart() - sag).abs() < 1e-12, "{} {sag}", along.apart());
    }

    #[test]
    fn order_counts_and_not_only_the_sets() {
        let at = |degrees: f64| {
            let (sin, cos) = sin_cos(degrees.to_radians());
            Vec3::new(20.0 * cos, 20.0 * sin, 0.0)
        };
        let there_and_back = [at(0.0), at(30.0), at(60.0), at(20.0), at(90.0)];
        let along = follow(Course::Arc(quarter(20.0, 0.0)), &there_and_back);
        // it falls back from 60 to 20 degrees
        assert!(along.points_apart() > 13.0, "{along:?}");
        let line = Course::Line {
            start: Vec3::zeros(),
            end: Vec3::new(10.0, 0.0, 0.0),
        };
        let back = [0.0, 6.0, 4.0, 10.0].map(|x| Vec3::new(x, 0.0, 0.0));
        let along = follow(line, &back);
        assert!((along.apart() - 2.0).abs() < 1e-12 && along.is_through());
        assert!(!follow(line, &back[..3]).is_through());
    }

    /// The chain stands before, beside or beyond the end of the course.
    #[test]
    fn the_rest_is_walked_where_the_chain_stands() {
        let arc = quarter(20.0, 0.0);
        let at = |degrees: f64, radius: f64| {
            let (sin, cos) = sin_cos(degrees.to_radians());
            Vec3::new(radius * cos, radius * sin, 0.0)
        };
        for (degrees, radius) in [(89.0, 20.0), (90.0, 20.03), (89.9, 19.98), (90.2, 20.01)] {
            let mut points: Vec<Vec3> = (0..44).map(|step| at(f64::from(step) * 2.0, 20.0)).collect();
            points.push(at(degrees, radius));
            let along = follow(Course::Arc(arc), &points);
            let ended = along.ended();
            assert!(
                ended.is_through() && (ended.from_end() - (at(90.0, 20.0) - at(degrees, radius)).norm()).abs() < 1e-12
            );
            assert!(ended.apart() >= along.from_end() && ended.points_apart() >= along.from_end());
            assert!(ended.apart() <= along.apart().max(along.from_end()) + 20.0 * 0.02f64.powi(2));
        }
        let line = Course::Line {
            start: Vec3::zeros(),
            end: Vec3::new(10.0, 0.0, 0.0),
        };
        let along = follow(line, &[Vec3::zeros(), Vec3::new(9.0, 0.1, 0.0)]);
        assert!(!along.is_through() && along.apart() < 0.101);
        assert!(along.ended().is_through() && (along.ended().apart() - 1.01f64.sqrt()).abs() < 1e-12);
    }

    /// The bound is never below what samples show, and not far above it.
    #[test]
    fn a_helix_is_bounded() {
        let arc = quarter(20.0, 3.0);
        for count in [3u32, 7, 30] {
            let points: Vec<Vec3> = (0..=count)
                .map(|step| {
                    let share = f64::from(step) / f64::from(count);
                    let bump = 0.01 * f64::from(step % 2);
                    arc.point_at(share) * (1.0 + bump / 20.0) + NORMAL * bump
                })
                .collect();
            let along = follow(Course::Arc(arc), &points);
            let mut most = 0.0f64;
            for pair in points.windows(2) {
                for step in 0..=50 {
                    let at = pair[0] + (pair[1] - pair[0]) * (f64::from(step) / 50.0);
                    let nearest = (0..=20_000).map(|i| (arc.point_at(f64::from(i) / 20_000.0) - at).norm());
                    most = most.max(nearest.fold(f64::INFINITY, f64::min));
                }
                if count == 30 {
                    break;
                }
            }
            assert!(along.apart() >= most - 1e-9, "{count}: {} {most}", along.apart());
            assert!(
                count == 30 || along.apart() <= 1.2 * most + 0.006,
                "{count}: {} {most}",
                along.apart()
            );
        }
    }
}
