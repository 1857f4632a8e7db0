//! The union of rings, without computing it: whether a point or a segment enters its interior.
//!
//! A side that two rings share is inside the union, one that belongs to the boundary is not: a point beside each side decides. A route may
//! run along the boundary of the union, and through a single point at which two rings touch, and may not cross its interior.
use super::polygon::{inside, sides};
use super::{Point, cross};

/// Points are tested at this distance beside a line, per mm of the size of the coordinates: far above rounding, far below any tolerance.
const BESIDE: f64 = 1e-10;

/// A box around a ring.
#[derive(Clone, Copy, Debug)]
struct Extent {
    low: Point,
    high: Point,
}

impl Extent {
    fn of<'p>(points: impl Iterator<Item = &'p Point>) -> Self {
        let none = Self {
            low: Point::repeat(f64::INFINITY),
            high: Point::repeat(f64::NEG_INFINITY),
        };
        points.fold(none, |extent, point| Self {
            low: extent.low.inf(point),
            high: extent.high.sup(point),
        })
    }

    fn has(&self, point: &Point) -> bool {
        (0..2).all(|i| self.low[i] <= point[i] && point[i] <= self.high[i])
    }

    fn meets(&self, other: &Self, within: f64) -> bool {
        (0..2).all(|i| self.low[i] <= other.high[i] + within && other.low[i] <= self.high[i] + within)
    }
}

/// A union of rings.
#[derive(Clone, Debug, Default)]
pub struct Cover {
    rings: Vec<(Vec<Point>, Extent)>,
    sides: Vec<(Point, Point, Extent)>,
    /// Distance at which a point beside a line is tested, mm.
    beside: f64,
}

impl Cover {
    /// Of rings that do not cross themselves.
    pub fn new(rings: Vec<Vec<Point>>) -> Self {
        let size = rings.iter().flatten().map(Point::amax).fold(1.0, f64::max);
        let sides = rings.iter().flat_map(|ring| sides(ring));
        Self {
            sides: sides.map(|(a, b)| (a, b, Extent::of([a, b].iter()))).collect(),
            rings: rings
                .into_iter()
                .map(|ring| {
                    let extent = Extent::of(ring.iter());
                    (ring, extent)
                })
                .collect(),
            beside: size * BESIDE,
        }
    }

    /// Whether a point is inside one of the rings. A point on a side may be counted either way.
    fn has(&self, point: &Point) -> bool {
        self.rings
            .iter()
            .any(|(ring, extent)| extent.has(point) && inside(ring, point))
    }

    /// Whether a segment enters the interior of the union.
    pub fn is_entered(&self, from: &Point, to: &Point) -> bool {
        let way = to - from;
        let length = way.norm();
        if length <= self.beside {
            return self.encloses(from);
        }
        let along = way / length;
        let beside = Point::new(-along.y, along.x) * self.beside;
        let cuts = self.cuts(from, &along, length);
        cuts.windows(2).any(|pair| {
            let middle = from + along * f64::midpoint(pair[0], pair[1]);
            pair[1] - pair[0] > 4.0 * self.beside && self.has(&(middle + beside)) && self.has(&(middle - beside))
        })
    }

    /// Where a segment meets the sides of the rings, in mm from its start, sorted, with both its ends.
    fn cuts(&self, from: &Point, along: &Point, length: f64) -> Vec<f64> {
        let to = from + along * length;
        let extent = Extent::of([*from, to].iter());
        let mut cuts = vec![0.0, length];
        let mut add = |at: f64| {
            if at > 0.0 && at < length {
                cuts.push(at);
            }
        };
        for (a, b, side_extent) in &self.sides {
            if !extent.meets(side_extent, 2.0 * self.beside) {
                continue;
            }
            let (to_a, to_b) = (a - from, b - from);
            let (off_a, off_b) = (cross(along, &to_a), cross(along, &to_b));
            if off_a * off_b < 0.0 {
                let share = off_a / (off_a - off_b);
                add(along.dot(&(to_a + (to_b - to_a) * share)));
            }
            for (end, off) in [(to_a, off_a), (to_b, off_b)] {
                if off.abs() <= 2.0 * self.beside {
                    add(along.dot(&end));
                }
            }
        }
        cuts.sort_by(f64::total_cmp);
        cuts
    }

    /// Whether a point is in the interior of the union: there is no free direction at it.
    pub fn encloses(&self, point: &Point) -> bool {
        // the directions of all sides at the point; between two of them nothing changes
        let near = 16.0 * self.beside;
        let mut directions: Vec<f64> = Vec::new();
        for (a, b, extent) in &self.sides {
            if !extent.meets(&Extent::of([*point].iter()), near) || super::point_distance(point, a, b) > near {
                continue;
            }
            for end in [a, b] {
                let way = end - point;
                if way.norm() > near {
                    directions.push(crate::math::atan2(way.y, way.x));
                }
            }
        }
        if directions.is_empty() {
            return self.has(point);
        }
        directions.sort_by(f64::total_cmp);
        let first = directions[0];
        directions.push(first + core::f64::consts::TAU);
        directions.windows(2).all(|pair| {
            let (sin, cos) = crate::math::sin_cos(f64::midpoint(pair[0], pair[1]));
            let sector = pair[1] - pair[0];
            sector < 1e-9 || self.has(&(point + Point::new(cos, sin) * (4.0 * near)))
        })
    }

    /// The points at which a shortest route may turn: corners of the rings that are not inside the union, each once. Where sides of two rings
    /// cross, the union has an inner corner, at which no shortest route turns.
    pub fn turning_points(&self) -> Vec<Point> {
        let mut found: Vec<Point> = self.rings.iter().flat_map(|(ring, _)| ring.iter().copied()).collect();
        found.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
        let mut kept: Vec<Point> = Vec::new();
        for point in found {
            let known = kept
                .iter()
                .rev()
                .take_while(|other| point.x - other.x <= self.beside)
                .any(|other| (point - other).norm() <= self.beside);
            if !known && !self.encloses(&point) {
                kept.push(point);
            }
        }
        kept
    }
}
