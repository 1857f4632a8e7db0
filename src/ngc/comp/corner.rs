//! The corner between two moves: which kind it is and where the centre's paths meet.
use super::plane::{self, Point};
use crate::{Engine, Side};
use std::f64::consts::{PI, TAU};

/// Corners flatter than this, rad, are not treated: observed from `rs274` by bisection.
const FLAT: f64 = 0.05;

/// A corner seen from the cutter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Corner {
    /// Both paths are joined as they are.
    Flat,
    /// The cutter goes around the corner.
    Outside,
    /// The paths are cut where they meet.
    Inside,
}

/// The corner between two directions from the contour to the cutter. `bulging`: the cutter runs around the outside of an arc at this
/// corner, so that the paths meet even where the contour turns back.
pub(super) fn corner(side: Side, before: Point, behind: Point, bulging: bool) -> Corner {
    let angle = if side == Side::Left {
        plane::turn(before, behind)
    } else {
        plane::turn(behind, before)
    };
    let reversal = if bulging { PI + FLAT } else { PI - FLAT };
    // what is unknown is joined unchanged
    if angle > FLAT && angle < reversal {
        Corner::Inside
    } else if angle >= reversal && angle < TAU - FLAT {
        Corner::Outside
    } else {
        Corner::Flat
    }
}

/// +1 or -1: from the direction of motion to the cutter, along [`plane::left_of`].
pub(super) fn sign(side: Side) -> f64 {
    if side == Side::Left { 1.0 } else { -1.0 }
}

/// A path of the centre near a corner.
#[derive(Clone, Copy, Debug)]
pub(super) enum Way {
    /// Through a point along a direction.
    Line(Point, Point),
    /// Middle, radius, and whether it runs counter-clockwise.
    Circle(Point, f64, bool),
}

impl Way {
    /// Direction of motion at a point of the path; not of length 1.
    fn along(self, at: Point) -> Point {
        match self {
            Self::Line(_, along) => along,
            Self::Circle(middle, _, ccw) => {
                plane::scaled(plane::left_of(plane::sub(at, middle)), if ccw { 1.0 } else { -1.0 })
            }
        }
    }
}

/// The last path of the centre, an arc or the line perpendicular to the direction to the cutter.
pub(super) fn last_way(engine: &Engine, centre: Point, normal: Point) -> Way {
    match engine.queue.last_arc() {
        Some((middle, turns)) => Way::Circle(middle, plane::length(plane::sub(centre, middle)), turns > 0),
        None => Way::Line(centre, plane::scaled(plane::left_of(normal), -sign(engine.state.side))),
    }
}

/// Where the path `a` turns inward onto the path `b`; `None`: nowhere.
pub(super) fn meeting(side: Side, a: Way, b: Way) -> Option<Point> {
    let (foot, step) = match (a, b) {
        (Way::Line(start, along), Way::Line(other, other_along)) => {
            let across = plane::left_of(other_along);
            let step = plane::dot(plane::sub(other, start), across) / plane::dot(along, across);
            return Some(plane::add(start, plane::scaled(along, step)));
        }
        (Way::Line(start, along), Way::Circle(middle, radius, _))
        | (Way::Circle(middle, radius, _), Way::Line(start, along)) => {
            let along = plane::unit(along);
            let step = plane::dot(plane::sub(middle, start), along);
            let foot = plane::add(start, plane::scaled(along, step));
            let half = chord(radius, plane::length(plane::sub(middle, foot)))?;
            (foot, plane::scaled(along, half))
        }
        (Way::Circle(first, radius, _), Way::Circle(second, other, _)) => {
            let between = plane::sub(second, first);
            let distance = plane::length(between);
            let along = (distance * distance + radius * radius - other * other) / (2.0 * distance);
            let half = chord(radius, along)?;
            let between = plane::unit(between);
            let foot = plane::add(first, plane::scaled(between, along));
            (foot, plane::scaled(plane::left_of(between), half))
        }
    };
    let (one, other) = (plane::add(foot, step), plane::sub(foot, step));
    let inward = |at: Point| {
        let (before, behind) = (a.along(at), b.along(at));
        sign(side) * (before[0] * behind[1] - before[1] * behind[0])
    };
    Some(if inward(other) > inward(one) { other } else { one })
}

/// Half of the chord at a distance from the middle; `None` outside the circle. What is unknown stays unknown.
fn chord(radius: f64, away: f64) -> Option<f64> {
    let square = radius * radius - away * away;
    if square < 0.0 { None } else { Some(square.sqrt()) }
}
