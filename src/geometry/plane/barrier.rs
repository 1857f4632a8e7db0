//! The control barrier of the paper: the sides of a polygon moved outward by the clearance, with mitred corners.
use super::polygon::Polygon;
use super::{Point, cross};

/// The tip of a mitred corner is at most this many times the clearance from its corner; a sharper corner is cut off. At 2 that is a
/// corner of less than 60 degrees.
pub const MITRE_LIMIT: f64 = 2.0;

/// The rings whose union is the polygon with everything nearer to it than `by` (mm), and mitred corners. Each ring is counter-clockwise.
///
/// Each point within `by` of the polygon is in one of them: its nearest point of the boundary is on a side, and then it is in the strip of
/// that side, or a convex corner, and then it is in the corner's piece. A corner sharper than [`MITRE_LIMIT`] is cut off at right angles to its
/// bisector, at the distance `by` from the corner.
pub fn barrier(polygon: &Polygon, by: f64) -> Vec<Vec<Point>> {
    let corners = polygon.corners();
    if by <= 0.0 {
        return vec![corners.to_vec()];
    }
    let count = corners.len();
    let normal = |index: usize| {
        let along = corners[(index + 1) % count] - corners[index];
        let unit = along / along.norm();
        Point::new(unit.y, -unit.x) * by
    };
    let normals: Vec<Point> = (0..count).map(normal).collect();
    let bends = |index: usize| {
        let (into, out) = (
            corners[index] - corners[(index + count - 1) % count],
            corners[(index + 1) % count] - corners[index],
        );
        cross(&into, &out)
    };
    let tips: Vec<Vec<Point>> = (0..count)
        .map(|index| {
            let (before, after) = (normals[(index + count - 1) % count], normals[index]);
            if bends(index) > 0.0 {
                tip(&corners[index], &before, &after, by)
            } else if polygon.is_crossed() {
                // which side is outside may change along the outline: both are moved
                tip(&corners[index], &-before, &-after, by)
            } else {
                Vec::new()
            }
        })
        .collect();
    if !polygon.is_crossed() && tips.iter().all(|tip| !tip.is_empty()) {
        // convex: the tips are the barrier
        return vec![tips.concat()];
    }
    let mut rings = vec![corners.to_vec()];
    for index in 0..count {
        let (a, b, out) = (corners[index], corners[(index + 1) % count], normals[index]);
        rings.push(vec![a, a + out, b + out, b]);
        if polygon.is_crossed() {
            rings.push(vec![a, b, b - out, a - out]);
        }
        if !tips[index].is_empty() {
            let sign = if bends(index) > 0.0 { 1.0 } else { -1.0 };
            let before = normals[(index + count - 1) % count];
            let mut ring = vec![a, a + before * sign];
            ring.extend(&tips[index]);
            ring.push(a + out * sign);
            rings.push(ring);
        }
    }
    rings
}

/// The outer corners at a corner between sides with these normals of length `by` towards the outside of the bend: the mitre, or two where it is
/// cut off.
fn tip(corner: &Point, before: &Point, after: &Point, by: f64) -> Vec<Point> {
    let sum = before + after;
    let square = sum.norm_squared();
    // the mitre is at by / cos(half the turn) from the corner, and |sum| = 2 by cos(half the turn)
    let mitre = sum * (2.0 * by * by / square.max(f64::MIN_POSITIVE));
    if square > 0.0 && mitre.norm() <= MITRE_LIMIT * by {
        return vec![corner + mitre];
    }
    // cut off at right angles to the bisector, which is undefined only where the sides run back on each other
    let outward = if square > 0.0 {
        sum / sum.norm()
    } else {
        Point::new(-before.y, before.x) / by
    };
    let across = Point::new(-outward.y, outward.x);
    // from the end of a normal along its side to the line at the distance `by`
    let reach = |normal: &Point| {
        let side = Point::new(-normal.y, normal.x) / by;
        let side = if side.dot(&outward) < 0.0 { -side } else { side };
        let missing = by - normal.dot(&outward);
        let rate = side.dot(&outward);
        if rate > 0.0 {
            corner + normal + side * (missing / rate)
        } else {
            corner + outward * by + across * across.dot(normal)
        }
    };
    vec![reach(before), reach(after)]
}
