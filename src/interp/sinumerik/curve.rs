//! Arcs through an intermediate point (CIP), and arcs that continue the direction of the motion before (CT).
use super::path::NO_LENGTH;
use crate::arc::plane_axes;
use crate::iso::Iso;
use crate::{MotionKind, Position};
use trunnion_geometry::Vec3;
use trunnion_geometry::arc::Arc;
use trunnion_geometry::math::{atan2, hypot};

impl Iso<'_> {
    /// CIP: the arc from the present point through I1 J1 K1, in the plane.
    pub(crate) fn arc_through(&self, from: Position, end: Position) -> Option<Arc> {
        let plane = self.core.state.coordinates.plane();
        let axes = plane_axes(plane);
        let unit = self.core.state.coordinates.unit_mm();
        let path = &self.memory.own.path;
        let (start, end) = (from.xyz()?, end.xyz()?);
        let mut through = start;
        for axis in 0..3 {
            let bit = 1 << axis;
            let given = path.through.get(axis).map(|value| value * unit);
            let incremental = self.core.state.coordinates.incremental() && path.through.absolute & bit == 0;
            match given {
                Some(value) if !incremental && path.through.incremental & bit == 0 => through[axis] = value,
                // what an incremental point starts from, and one that is left out in the plane, is not followed
                None if axis == axes[2] => {}
                _ => return None,
            }
        }
        let height = |point: &Vec3| point[axes[2]] - start[axes[2]];
        if path.unread || height(&through).abs() > NO_LENGTH || height(&end).abs() > NO_LENGTH {
            return None;
        }
        let flat = |point: &Vec3| (point[axes[0]] - start[axes[0]], point[axes[1]] - start[axes[1]]);
        let ((px, py), (qx, qy)) = (flat(&through), flat(&end));
        let turn = px * qy - py * qx;
        let size = hypot(px, py) * hypot(qx, qy);
        // three points of a line, or two that are one
        if size <= NO_LENGTH || turn.abs() <= 1e-9 * size || hypot(px - qx, py - qy) <= NO_LENGTH {
            return None;
        }
        let (p2, q2) = (px * px + py * py, qx * qx + qy * qy);
        let centre = [(p2 * qy - q2 * py) / (2.0 * turn), (q2 * px - p2 * qx) / (2.0 * turn)];
        Some(self.arc_about(start, end, centre, turn.signum()))
    }

    /// CT: the arc that leaves in the direction in which the motion before ended.
    pub(crate) fn arc_tangent(&self, from: Position, end: Position) -> Option<Arc> {
        let axes = plane_axes(self.core.state.coordinates.plane());
        let (place, direction) = self.memory.own.contour.heading.filter(|_| !self.memory.frames.active)?;
        if place != from || self.core.state.compensation != 0 || self.memory.corners.is_busy() {
            return None;
        }
        let (start, end) = (from.xyz()?, end.xyz()?);
        let way = end - start;
        if way[axes[2]].abs() > NO_LENGTH {
            return None;
        }
        let (dx, dy) = (direction[axes[0]], direction[axes[1]]);
        let (x, y) = (way[axes[0]], way[axes[1]]);
        let left = dx * y - dy * x;
        // straight on it is a line, straight back there is no arc
        if left.abs() <= 1e-9 * hypot(x, y) || hypot(x, y) <= NO_LENGTH {
            return None;
        }
        let radius = (x * x + y * y) / (2.0 * left);
        Some(self.arc_about(start, end, [-dy * radius, dx * radius], left.signum()))
    }

    /// The arc about a centre in the plane, given from its start; `sense` 1: counter-clockwise.
    fn arc_about(&self, start: Vec3, end: Vec3, centre: [f64; 2], sense: f64) -> Arc {
        let axes = plane_axes(self.core.state.coordinates.plane());
        let arm = [-centre[0], -centre[1]];
        let other = [
            end[axes[0]] - start[axes[0]] - centre[0],
            end[axes[1]] - start[axes[1]] - centre[1],
        ];
        let cross = arm[0] * other[1] - arm[1] * other[0];
        let angle = atan2(cross, arm[0] * other[0] + arm[1] * other[1]);
        let turn = if angle * sense > 0.0 {
            angle
        } else {
            angle + sense * core::f64::consts::TAU
        };
        let mut middle = start;
        middle[axes[0]] += centre[0];
        middle[axes[1]] += centre[1];
        let mut normal = Vec3::zeros();
        normal[axes[2]] = 1.0;
        Arc {
            start,
            end,
            centre: middle,
            normal,
            sweep: turn,
            radius_start: hypot(arm[0], arm[1]),
            radius_end: hypot(other[0], other[1]),
        }
    }

    /// Keeps the direction in which a motion ends, for CT.
    pub(crate) fn note_heading(&mut self, kind: &MotionKind, start: &Position, end: &Position) {
        let axes = plane_axes(self.core.state.coordinates.plane());
        let direction = match kind {
            MotionKind::Linear => start.xyz().zip(end.xyz()).map(|(start, end)| end - start),
            MotionKind::Arc(Some(arc)) => {
                let arm = arc.end - arc.centre;
                Some(arc.normal.cross(&arm) * arc.sweep.signum())
            }
            _ => None,
        };
        let direction = direction.filter(|way| way[axes[2]].abs() <= NO_LENGTH && way.norm() > NO_LENGTH);
        self.memory.own.contour.heading = direction.map(|direction| (*end, direction.normalize()));
    }
}
