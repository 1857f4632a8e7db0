//! Whole circles in a chain: lines that come back to where they began, near one circle.
use crate::circle::{Circle, Flat};
use crate::pieces::{Limits, Piece, Points};
use std::collections::BTreeMap;
use trunnion_certify::RefitSource;
use trunnion_geometry::Vec3;

/// Fewer lines are a polygon.
const LEAST_LINES: usize = 6;

/// So often the centre is corrected.
const CORRECTIONS: usize = 4;

/// The whole circles of a chain as they are written, in order, none overlapping another.
pub(crate) fn whole_circles(all: &[Vec3], limits: &Limits<'_>) -> Vec<Piece> {
    let mut found: Vec<Piece> = Vec::new();
    if limits.styles.is_none() || all.len() <= LEAST_LINES {
        return found;
    }
    let mut chain = None;
    // where the same point was before
    let mut before: BTreeMap<[u64; 3], usize> = BTreeMap::new();
    for (to, point) in all.iter().enumerate() {
        let key = [0, 1, 2].map(|axis| (point[axis] + 0.0).to_bits());
        let Some(from) = before.insert(key, to) else { continue };
        if to - from < LEAST_LINES || found.last().is_some_and(|last| from < last.to) {
            continue;
        }
        let chain = chain.get_or_insert_with(|| Points::new(all, limits));
        found.extend(chain.whole_circle(from, to));
    }
    found
}

impl Points<'_> {
    fn whole_circle(&self, from: usize, to: usize) -> Option<Piece> {
        let limits = self.limits;
        if limits.source == RefitSource::Points && self.corners[to - 1] != self.corners[from] {
            return None;
        }
        let ends = [self.all[from], self.all[to]];
        limits.planes.iter().zip(&self.flat).find_map(|(plane, flat)| {
            let circle = through_first(&flat[from..to], limits.tolerance_mm)?;
            let arc = Some(self.written((from, to), ends, *plane, &circle)?);
            let beside = None;
            Some(Piece { from, to, arc, beside })
        })
    }
}

/// A circle through the first point that is near all of them (least squares); `None` where it is farther than the tolerance from one.
fn through_first(points: &[Flat], tolerance: f64) -> Option<Circle> {
    let first = points.first()?;
    let count = points.len() as f64;
    let mut centre = [0, 1].map(|axis| points.iter().map(|point| point[axis]).sum::<f64>() / count);
    let arm = |centre: &Flat, point: &Flat| {
        let (x, y) = (point[0] - centre[0], point[1] - centre[1]);
        (x, y, (x * x + y * y).sqrt())
    };
    for _ in 0..CORRECTIONS {
        // the distance of a point less that of the first changes with the centre by the difference of their directions
        let (a, b, own) = arm(&centre, first);
        let (mut xx, mut xy, mut yy, mut x, mut y) = (0.0, 0.0, 0.0, 0.0, 0.0);
        for point in points {
            let (c, d, distance) = arm(&centre, point);
            let (p, q, off) = (a / own - c / distance, b / own - d / distance, distance - own);
            (xx, xy, yy, x, y) = (xx + p * p, xy + p * q, yy + q * q, x + p * off, y + q * off);
        }
        let determinant = xx * yy - xy * xy;
        if determinant.is_nan() || determinant <= 1e-12 {
            return None;
        }
        centre[0] -= (yy * x - xy * y) / determinant;
        centre[1] -= (xx * y - xy * x) / determinant;
    }
    let (_, _, radius) = arm(&centre, first);
    let near = |point: &Flat| (arm(&centre, point).2 - radius).abs() <= tolerance;
    let area: f64 = points
        .windows(2)
        .map(|pair| pair[0][0] * pair[1][1] - pair[1][0] * pair[0][1])
        .sum::<f64>()
        + points.last()?[0] * first[1]
        - first[0] * points.last()?[1];
    points.iter().all(near).then_some(Circle {
        centres: [centre; 3],
        counter_clockwise: area > 0.0,
    })
}

#[cfg(test)]
mod tests {
    use super::through_first;
    use trunnion_geometry::math::sin_cos;

    #[test]
    fn the_first_point_is_on_the_circle_and_all_are_near() {
        let at = |index: i32| {
            let (sin, cos) = sin_cos(f64::from(index * 10).to_radians());
            let radius = 20.0 + 0.004 * f64::from(index % 3 - 1);
            [3.0 + radius * cos, -7.0 + radius * sin]
        };
        let points: Vec<[f64; 2]> = (0..36).map(at).collect();
        let found = through_first(&points, 0.01).expect("a circle");
        assert!(found.counter_clockwise);
        assert!((found.centres[0][0] - 3.0).abs() < 0.006 && (found.centres[0][1] + 7.0).abs() < 0.006);
        let backwards: Vec<[f64; 2]> = points.iter().rev().copied().collect();
        assert!(!through_first(&backwards, 0.01).expect("a circle").counter_clockwise);
        assert!(through_first(&points, 0.002).is_none());
    }
}
