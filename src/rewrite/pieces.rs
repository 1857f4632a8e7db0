//! The fewest lines and arcs for a chain of lines, with numbers that the program can write.
use crate::circle::{Circle, Flat, circle, circle_between};
use crate::fewest::fewest;
use crate::style::NumberStyle;
use std::collections::BTreeSet;
use trunnion_certify::RefitSource;
use trunnion_dialect::{Dialect, Plane};
use trunnion_geometry::Vec3;
use trunnion_geometry::along::{Along, Course};
use trunnion_geometry::arc::{Arc, Turning};
use trunnion_syntax::Decimal;

/// Axes of a plane: first, second, normal; seen from the normal the second is a quarter turn counter-clockwise from the first.
pub(crate) fn axes(plane: Plane) -> [usize; 3] {
    match plane {
        Plane::Xy => [0, 1, 2],
        Plane::Zx => [2, 0, 1],
        Plane::Yz => [1, 2, 0],
    }
}

/// What may be written.
pub(crate) struct Limits<'a> {
    /// mm.
    pub tolerance_mm: f64,
    /// Points, or the lines between them too.
    pub source: RefitSource,
    /// Arcs at all, and in which planes.
    pub planes: &'a [Plane],
    /// How I, J and K are written; none where no arcs are.
    pub styles: Option<[NumberStyle; 3]>,
    /// How X, Y and Z are written, if arcs may meet beside the points of a chain.
    pub ends: Option<NumberStyle>,
    /// mm per programmed length unit.
    pub unit_mm: f64,
    /// How far the two radii of an arc may differ.
    pub dialect: &'a Dialect,
}

/// An arc as it is written.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct WrittenArc {
    pub plane: Plane,
    pub turning: Turning,
    /// From the start to the centre: the axis (0 X, 1 Y, 2 Z), and the number of I, J or K.
    pub centre: [(usize, String); 2],
}

/// A part of a chain.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Piece {
    /// Index of its first point; it begins there.
    pub from: usize,
    /// Index of its last point.
    pub to: usize,
    /// None: a line.
    pub arc: Option<WrittenArc>,
    /// Where it ends, if it ends or begins beside a point.
    pub beside: Option<Beside>,
}

/// An end whose words are not in the program.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Beside {
    /// mm.
    pub at: Vec3,
    /// It is a point of the chain: then its words may be in the program.
    pub is_point: bool,
    /// The axes that differ (0 X, 1 Y, 2 Z), and their numbers.
    pub words: [(usize, String); 2],
}

/// A chain divided.
pub(crate) struct Pieces {
    /// In order.
    pub pieces: Vec<Piece>,
    /// How many there are before numbers are rounded.
    pub unrounded: usize,
}

/// Turns in a point sharper than this are corners: no arc goes through them where only points count, cos.
const CORNER_COS: f64 = 0.866;

/// The lines of one chain as points.
pub(crate) struct Points<'a> {
    pub(crate) all: &'a [Vec3],
    pub(crate) limits: &'a Limits<'a>,
    /// For each axis and point the last point up to which the coordinate is the same.
    pub(crate) level_until: [Vec<usize>; 3],
    /// How many corners come before a point.
    pub(crate) corners: Vec<u32>,
    /// The points in each plane that may be written, in that order.
    pub(crate) flat: Vec<Vec<Flat>>,
}

impl<'a> Points<'a> {
    pub(crate) fn new(all: &'a [Vec3], limits: &'a Limits<'a>) -> Self {
        let level_until = [0, 1, 2].map(|axis| {
            let mut until: Vec<usize> = (0..all.len()).collect();
            for index in (0..all.len() - 1).rev() {
                if all[index][axis] == all[index + 1][axis] {
                    until[index] = until[index + 1];
                }
            }
            until
        });
        let mut corners = vec![0; all.len()];
        for index in 1..all.len() {
            let corner = all.get(index + 1).is_some_and(|next| {
                let (was, is) = (all[index] - all[index - 1], next - all[index]);
                was.dot(&is) < CORNER_COS * was.norm() * is.norm()
            });
            corners[index] = corners[index - 1] + u32::from(corner);
        }
        Self {
            all,
            limits,
            level_until,
            corners,
            flat: limits
                .planes
                .iter()
                .map(|plane| {
                    let [first, second, _] = axes(*plane);
                    all.iter().map(|point| [point[first], point[second]]).collect()
                })
                .collect(),
        }
    }

    /// The fewest pieces that can be written, without those that are refused.
    pub(crate) fn fewest(&self, refused: &mut BTreeSet<(usize, usize)>, unrounded: &mut Option<usize>) -> Vec<Piece> {
        loop {
            let joints = fewest(self.all.len() - 1, &mut |from, to| {
                to == from + 1
                    || (refused.is_empty() || !refused.contains(&(from, to)))
                        && (self.is_line(from, to) || self.planes(from, to).is_some())
            });
            unrounded.get_or_insert(joints.len() - 1);
            let refusals = refused.len();
            let mut pieces = Vec::with_capacity(joints.len());
            for pair in joints.windows(2) {
                let (from, to) = (pair[0], pair[1]);
                let is_line = to == from + 1 || self.is_line(from, to);
                let ends = [self.all[from], self.all[to]];
                let arc = match self.planes(from, to) {
                    Some((plane, circle)) if !is_line => self.written((from, to), ends, plane, &circle),
                    _ => None,
                };
                if !is_line && arc.is_none() {
                    refused.insert((from, to));
                }
                pieces.push(Piece {
                    from,
                    to,
                    arc,
                    beside: None,
                });
            }
            if refused.len() == refusals {
                return pieces;
            }
        }
    }

    /// Whether all points of a part are near the line between its ends, in order.
    pub(crate) fn is_line(&self, from: usize, to: usize) -> bool {
        let (start, end) = (self.all[from], self.all[to]);
        let way = end - start;
        let length = way.norm();
        if length <= 0.0 {
            // several blocks at one place
            return self.all[from..to].iter().all(|point| *point == end);
        }
        let tolerance = self.limits.tolerance_mm;
        let near = |point: &Vec3| (point - start).cross(&way).norm() <= tolerance * length;
        if !near(&self.all[usize::midpoint(from, to)]) || !self.all[from + 1..to].iter().all(near) {
            return false;
        }
        let mut along = Along::new(Course::Line { start, end }, start);
        self.all[from + 1..=to].iter().for_each(|point| along.to(*point));
        along.apart() <= tolerance && along.is_through()
    }

    /// The first plane in which some arc or helix serves, with its circle.
    fn planes(&self, from: usize, to: usize) -> Option<(Plane, Circle)> {
        if to < from + 2 || self.limits.planes.is_empty() {
            return None;
        }
        let points_only = self.limits.source == RefitSource::Points;
        if points_only && self.corners[to - 1] != self.corners[from] {
            return None;
        }
        let level = |axis: usize| self.level_until[axis][from] >= to;
        let levels = (0..3).filter(|axis| level(*axis)).count();
        if levels > 1 {
            return None;
        }
        for (&plane, flat) in self.limits.planes.iter().zip(&self.flat) {
            let [_, _, normal] = axes(plane);
            let is_level = self.level_until[normal][from] >= to;
            if levels == 1 && !is_level || levels == 0 && !self.climbs_evenly(from, to, plane) {
                continue;
            }
            let Some(circle) = circle(&flat[from..=to], self.limits.tolerance_mm, !points_only) else {
                continue;
            };
            let ends = [self.all[from], self.all[to]];
            let serves = |centre: &Flat| {
                self.apart((from, to), ends, (plane, circle.counter_clockwise, *centre))
                    .is_some()
            };
            if is_level || circle.centres.iter().any(serves) {
                return Some((plane, circle));
            }
        }
        None
    }

    /// Whether the height may grow with the length in the plane, as on a helix; false only where it surely does not.
    fn climbs_evenly(&self, from: usize, to: usize, plane: Plane) -> bool {
        let [first, second, normal] = axes(plane);
        let length = |range: core::ops::Range<usize>| {
            range
                .map(|index| {
                    let way = self.all[index + 1] - self.all[index];
                    (way[first] * way[first] + way[second] * way[second]).sqrt()
                })
                .sum::<f64>()
        };
        let middle = usize::midpoint(from, to);
        let (part, rest) = (length(from..middle), length(middle..to));
        let climb = self.all[to][normal] - self.all[from][normal];
        let expected = self.all[from][normal] + climb * part / (part + rest);
        // lengths of chords are not those of arcs: one in a hundred of the climb
        (self.all[middle][normal] - expected).abs() <= 1.5 * self.limits.tolerance_mm + 0.01 * climb.abs()
    }

    /// The arc between two ends about a centre, and how far the part is from it; `None` above the tolerance.
    fn apart(
        &self,
        (from, to): (usize, usize),
        [start, end]: [Vec3; 2],
        (plane, counter_clockwise, centre): (Plane, bool, Flat),
    ) -> Option<(Arc, f64)> {
        let [first, second, normal] = axes(plane);
        let (mut up, mut middle) = (Vec3::zeros(), Vec3::zeros());
        up[normal] = 1.0;
        middle[first] = centre[0];
        middle[second] = centre[1];
        let turning = if counter_clockwise {
            Turning::CounterClockwise
        } else {
            Turning::Clockwise
        };
        let arc = Arc::from_centre(start, end, middle, up, turning, 0)?;
        let mut along = Along::new(Course::Arc(arc), self.all[from]);
        self.all[from + 1..=to].iter().for_each(|point| along.to(*point));
        if end != self.all[to] {
            along = along.ended();
        }
        let off = if self.limits.source == RefitSource::Points {
            along.points_apart()
        } else {
            along.apart()
        };
        (off <= self.limits.tolerance_mm && along.is_through()).then_some((arc, off))
    }

    /// The centre of the circle through two ends that comes nearest to the points of a part, to a thousandth of the tolerance.
    fn nearest(&self, (from, to): (usize, usize), [start, end]: [Vec3; 2], plane: Plane) -> Option<Flat> {
        let index = self.limits.planes.iter().position(|other| *other == plane)?;
        let points = &self.flat[index][from..=to];
        let [first, second, _] = axes(plane);
        let ends = [[start[first], start[second]], [end[first], end[second]]];
        let (mut low, mut high) = (0.0, self.limits.tolerance_mm);
        let mut found = None;
        for _ in 0..10 {
            let middle = 0.5 * (low + high);
            match circle_between([&ends[0], &ends[1]], points, middle, false) {
                Some(circle) => (high, found) = (middle, Some(circle.centres[0])),
                None => low = middle,
            }
        }
        found
    }

    /// The arc of a part between two ends with numbers as the program writes them; `None` where no rounding serves.
    pub(crate) fn written(
        &self,
        part: (usize, usize),
        ends: [Vec3; 2],
        plane: Plane,
        circle: &Circle,
    ) -> Option<WrittenArc> {
        let styles = self.limits.styles?;
        let [first, second, _] = axes(plane);
        let unit = self.limits.unit_mm;
        let start = ends[0];
        // the circle nearest to the points first: others serve, but look arbitrary
        for centre in self.nearest(part, ends, plane).into_iter().chain(circle.centres) {
            let numbers = |axis: usize, value: f64| {
                let distance = (value - start[axis]) / unit;
                let style = &styles[axis];
                // the nearest first
                let mut texts = style.neighbours(distance, false);
                if style.write(distance, false) == texts[1] {
                    texts.swap(0, 1);
                }
                texts
            };
            let (ones, others) = (numbers(first, centre[0]), numbers(second, centre[1]));
            for (one, other) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                let (one, other) = (&ones[one], &others[other]);
                let (Some(x), Some(y)) = (parsed(one), parsed(other)) else {
                    continue;
                };
                // I0 J0 is no centre
                if x == 0.0 && y == 0.0 {
                    continue;
                }
                let rounded = [start[first] + x * unit, start[second] + y * unit];
                let Some((arc, _)) = self.apart(part, ends, (plane, circle.counter_clockwise, rounded)) else {
                    continue;
                };
                let limit = self.limits.dialect.arc_limit_mm(arc.radius_end, unit != 1.0);
                if (arc.radius_start - arc.radius_end).abs() <= limit {
                    let turning = if circle.counter_clockwise {
                        Turning::CounterClockwise
                    } else {
                        Turning::Clockwise
                    };
                    let mut centre = [(first, one.clone()), (second, other.clone())];
                    centre.sort();
                    return Some(WrittenArc { plane, turning, centre });
                }
            }
        }
        None
    }
}

/// The value of a number as a control reads it.
pub(crate) fn parsed(text: &str) -> Option<f64> {
    Decimal::parse(text.as_bytes()).map(Decimal::to_f64)
}
