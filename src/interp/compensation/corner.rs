//! Corners between two motions of a contour.
use super::element::{Element, Point, SAME, add, cross, distance, dot, left, sub};
use crate::OuterCorner;

/// A motion at a corner.
#[derive(Clone, Copy, Debug)]
pub(super) struct Link {
    pub(super) to: Point,
    /// Centre of an arc, and its direction of rotation; otherwise a line.
    pub(super) about: Option<(Point, f64)>,
}

/// Between which points the tool goes at a corner.
#[derive(Clone, Debug)]
pub(super) struct Join {
    /// Where the first motion ends.
    pub(super) end: Point,
    /// Motions between the two.
    pub(super) links: Vec<Link>,
    /// Where the second motion begins.
    pub(super) start: Point,
}

/// Why there is no compensated path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Trouble {
    /// The tool would cut into the contour.
    Interference,
    /// The two paths beside the contour do not meet.
    NoIntersection,
}

impl Trouble {
    /// For people, with the mistake's key in the dialect.
    pub(super) fn words(self) -> (&'static str, &'static str) {
        match self {
            Self::Interference => (
                "the tool is too large for the contour: its compensated path would run backwards, or it does not fit into an arc",
                "interference",
            ),
            Self::NoIntersection => (
                "the compensated paths on both sides of a corner do not meet: the tool is too large, or the contour is too short",
                "no-intersection",
            ),
        }
    }
}

/// The corner where `first` ends and `second` begins; the tool runs `offset` to the left of the path.
pub(super) fn join(first: &Element, second: &Element, offset: f64, outer: OuterCorner) -> Result<Join, Trouble> {
    let fits = |element: &Element| element.radius(offset).is_none_or(|radius| radius > SAME);
    if !fits(first) || !fits(second) {
        return Err(Trouble::Interference);
    }
    let (d1, d2) = (first.arrives(), second.departs());
    let (turn, straight) = (cross(d1, d2), dot(d1, d2));
    let (end, start) = (first.beside_end(offset), second.beside_start(offset));
    if turn.abs() < 1e-9 && straight > 0.0 {
        return Ok(Join {
            end,
            links: Vec::new(),
            start,
        });
    }
    if turn * offset > 0.0 && turn.abs() >= 1e-9 {
        let point = meeting(first, second, offset).ok_or(Trouble::NoIntersection)?;
        return Ok(Join {
            end: point,
            links: Vec::new(),
            start: point,
        });
    }
    let corner = first.end;
    if outer == OuterCorner::Arc {
        let about = Some((corner, -offset.signum()));
        let links = vec![Link { to: start, about }];
        return Ok(Join { end, links, start });
    }
    let mut tips = Vec::new();
    if straight >= -1e-12 {
        // both sides extended until they meet
        let sum = add(left(d1), left(d2), 1.0);
        tips.push(add(corner, sum, offset / (1.0 + straight)));
    } else {
        // a sharp corner: each side extended by the radius
        tips.push(add(end, d1, offset.abs()));
        tips.push(add(start, d2, -offset.abs()));
    }
    Ok(outer_join(first, second, end, start, &tips))
}

/// Lines run on to the tips themselves, arcs end beside the corner and are linked by lines.
fn outer_join(first: &Element, second: &Element, end: Point, start: Point, tips: &[Point]) -> Join {
    let mut way: Vec<Point> = Vec::new();
    if first.is_arc() {
        way.push(end);
    }
    way.extend_from_slice(tips);
    if second.is_arc() {
        way.push(start);
    }
    let links = way.iter().skip(1).map(|&to| Link { to, about: None }).collect();
    Join {
        end: way.first().copied().unwrap_or(end),
        start: way.last().copied().unwrap_or(start),
        links,
    }
}

/// Where the paths beside two motions meet at an inner corner: of several points the one nearest to the corner.
fn meeting(first: &Element, second: &Element, offset: f64) -> Option<Point> {
    let corner = first.end;
    let points = match (&first.circle, &second.circle) {
        (None, None) => {
            let (d1, d2) = (first.arrives(), second.departs());
            let (p, q) = (first.beside_end(offset), second.beside_start(offset));
            let along = cross(sub(q, p), d2) / cross(d1, d2);
            vec![add(p, d1, along)]
        }
        (None, Some(circle)) => line_circle(
            first.beside_end(offset),
            first.arrives(),
            circle.centre,
            second.radius(offset)?,
        ),
        (Some(circle), None) => line_circle(
            second.beside_start(offset),
            second.departs(),
            circle.centre,
            first.radius(offset)?,
        ),
        (Some(one), Some(other)) => circles(one.centre, first.radius(offset)?, other.centre, second.radius(offset)?),
    };
    points
        .into_iter()
        .filter(|point| point[0].is_finite() && point[1].is_finite())
        .min_by(|a, b| distance(*a, corner).total_cmp(&distance(*b, corner)))
}

fn line_circle(point: Point, way: Point, centre: Point, radius: f64) -> Vec<Point> {
    let to = sub(centre, point);
    let along = dot(to, way);
    let off = cross(way, to);
    let height = radius * radius - off * off;
    if height < 0.0 {
        return Vec::new();
    }
    let half = height.sqrt();
    vec![add(point, way, along - half), add(point, way, along + half)]
}

fn circles(a: Point, radius_a: f64, b: Point, radius_b: f64) -> Vec<Point> {
    let apart = distance(a, b);
    if apart <= SAME {
        return Vec::new();
    }
    let way = sub(b, a);
    let way = [way[0] / apart, way[1] / apart];
    let along = (apart * apart + radius_a * radius_a - radius_b * radius_b) / (2.0 * apart);
    let height = radius_a * radius_a - along * along;
    if height < 0.0 {
        return Vec::new();
    }
    let foot = add(a, way, along);
    vec![
        add(foot, left(way), height.sqrt()),
        add(foot, left(way), -height.sqrt()),
    ]
}
