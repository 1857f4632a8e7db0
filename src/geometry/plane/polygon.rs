//! Simple polygons and exact distances from them.
use super::{Point, cross};

/// Corners nearer to each other are one corner, mm.
const SAME: f64 = 1e-9;

/// A polygon, convex or not. One whose sides do not cross is counter-clockwise; of one whose sides cross, whatever they go round is inside.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    corners: Vec<Point>,
    crosses: bool,
    /// Lowest and highest coordinates.
    extent: [Point; 2],
}

/// Why corners are not a polygon.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PolygonFault {
    /// A coordinate is not a finite number; the index of its corner.
    NotFinite(usize),
    /// Fewer than three different corners, or all of them on one line.
    NoArea,
}

impl Polygon {
    /// From its corners in either direction. A corner that repeats the one before it, or lies on the line between its neighbours, is left out.
    ///
    /// # Errors
    /// Why the corners are not a simple polygon.
    pub fn new(corners: &[Point]) -> Result<Self, PolygonFault> {
        if let Some(index) = corners
            .iter()
            .position(|corner| !(corner.x.is_finite() && corner.y.is_finite()))
        {
            return Err(PolygonFault::NotFinite(index));
        }
        let mut kept: Vec<Point> = Vec::new();
        for corner in corners {
            if kept.last().is_none_or(|last| (corner - last).norm() > SAME) {
                kept.push(*corner);
            }
        }
        while kept.len() > 1 && (kept[0] - kept[kept.len() - 1]).norm() <= SAME {
            kept.pop();
        }
        straighten(&mut kept);
        if kept.len() < 3 {
            return Err(PolygonFault::NoArea);
        }
        let crosses = is_crossed(&kept);
        let area = doubled_area(&kept);
        if !crosses && area.abs() <= SAME * SAME {
            return Err(PolygonFault::NoArea);
        }
        if area < 0.0 {
            kept.reverse();
        }
        let low = kept.iter().fold(kept[0], |low, corner| low.inf(corner));
        let high = kept.iter().fold(kept[0], |high, corner| high.sup(corner));
        Ok(Self {
            corners: kept,
            crosses,
            extent: [low, high],
        })
    }

    /// Whether its sides cross or touch each other.
    pub fn is_crossed(&self) -> bool {
        self.crosses
    }

    /// Lowest and highest coordinates.
    pub fn extent(&self) -> [Point; 2] {
        self.extent
    }

    /// The corners, counter-clockwise.
    pub fn corners(&self) -> &[Point] {
        &self.corners
    }

    /// The sides, each from its beginning to its end.
    pub fn sides(&self) -> impl Iterator<Item = (Point, Point)> {
        sides(&self.corners)
    }

    /// Whether a point is inside. A point on a side may be counted either way.
    pub fn contains(&self, point: &Point) -> bool {
        inside(&self.corners, point)
    }

    /// Distance of a point from the polygon, mm; 0 inside.
    pub fn distance(&self, point: &Point) -> f64 {
        if self.contains(point) {
            return 0.0;
        }
        self.sides()
            .map(|(a, b)| point_distance(point, &a, &b))
            .fold(f64::INFINITY, f64::min)
    }

    /// The point of its sides nearest to a point.
    pub fn nearest_on_rim(&self, point: &Point) -> Point {
        let on_sides = self.sides().map(|(a, b)| nearest_on_segment(point, &a, &b));
        let distance = |other: &Point| (other - point).norm_squared();
        on_sides
            .min_by(|a, b| distance(a).total_cmp(&distance(b)))
            .unwrap_or(*point)
    }

    /// Distance of a line segment from the polygon, mm; 0 where they touch or cross.
    pub fn segment_distance(&self, from: &Point, to: &Point) -> f64 {
        if self.contains(from) || self.contains(to) {
            return 0.0;
        }
        self.sides()
            .map(|(a, b)| segment_distance((from, to), (&a, &b)))
            .fold(f64::INFINITY, f64::min)
    }
}

/// The sides of a closed ring.
pub(super) fn sides(ring: &[Point]) -> impl Iterator<Item = (Point, Point)> {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(a, b)| (*a, *b))
}

/// Twice the area of a ring, positive counter-clockwise.
pub(super) fn doubled_area(ring: &[Point]) -> f64 {
    // about a corner, so that a ring far from the origin loses no digits
    let origin = ring.first().copied().unwrap_or_default();
    sides(ring).map(|(a, b)| cross(&(a - origin), &(b - origin))).sum()
}

/// Whether a ring goes round a point.
pub(super) fn inside(ring: &[Point], point: &Point) -> bool {
    let mut turns = 0;
    for (a, b) in sides(ring) {
        if (a.y > point.y) != (b.y > point.y) {
            // upward and downward sides in the same order of their ends, so that two rings agree about a side that they share
            let (low, high, turn) = if a.y < b.y { (a, b, 1) } else { (b, a, -1) };
            if cross(&(high - low), &(point - low)) > 0.0 {
                turns += turn;
            }
        }
    }
    turns != 0
}

/// Distance of a point from a segment, mm.
pub fn point_distance(point: &Point, from: &Point, to: &Point) -> f64 {
    (point - nearest_on_segment(point, from, to)).norm()
}

/// The point of a segment nearest to a point.
fn nearest_on_segment(point: &Point, from: &Point, to: &Point) -> Point {
    let along = to - from;
    let square = along.norm_squared();
    let share = if square > 0.0 {
        ((point - from).dot(&along) / square).clamp(0.0, 1.0)
    } else {
        0.0
    };
    from + along * share
}

/// Distance between two segments, mm; 0 where they touch or cross.
pub fn segment_distance((a, b): (&Point, &Point), (c, d): (&Point, &Point)) -> f64 {
    let side = |from: &Point, to: &Point, point: &Point| cross(&(to - from), &(point - from));
    let (c_of, d_of) = (side(a, b, c), side(a, b, d));
    let (a_of, b_of) = (side(c, d, a), side(c, d, b));
    if c_of * d_of < 0.0 && a_of * b_of < 0.0 {
        return 0.0;
    }
    let ends = [
        point_distance(a, c, d),
        point_distance(b, c, d),
        point_distance(c, a, b),
        point_distance(d, a, b),
    ];
    ends.into_iter().fold(f64::INFINITY, f64::min)
}

/// Leaves out corners on the line between their neighbours, and spikes that run back on themselves.
fn straighten(kept: &mut Vec<Point>) {
    let mut at = 0;
    while kept.len() >= 3 && at < kept.len() {
        let count = kept.len();
        let (before, here, after) = (kept[(at + count - 1) % count], kept[at], kept[(at + 1) % count]);
        let (into, out) = (here - before, after - here);
        // the corner's distance from the line between its neighbours, or of a spike from its own side
        let off = cross(&into, &out).abs() / into.norm().max(out.norm()).max(SAME);
        if off <= SAME * 1e-3 || into.norm() <= SAME {
            kept.remove(at);
            at = at.saturating_sub(1);
        } else {
            at += 1;
        }
    }
}

/// Whether two sides that are not neighbours cross or touch.
fn is_crossed(corners: &[Point]) -> bool {
    let count = corners.len();
    let side = |index: usize| (&corners[index], &corners[(index + 1) % count]);
    (0..count).any(|first| {
        (first + 2..count).any(|second| {
            let neighbours = first == 0 && second == count - 1;
            !neighbours && segment_distance(side(first), side(second)) == 0.0
        })
    })
}
