//! How far a point between two places of the machine can bend, and the great circle between two tool axes.
use trunnion_geometry::Vec3;
use trunnion_geometry::math::{angle_between, rotate, sin_cos};
use trunnion_machine::{AxisKind, Joints, Machine};

/// |W''| of the tip while all joints run linearly. The chain is walked from the tool to the workpiece: a linear axis of speed v adds v
/// to the bound V of the speed; a rotary axis of speed w at a distance of at most d adds 2 w V + w^2 d to that of the bend, and
/// w d to V (docs/kinematics.md#between-the-ends-of-a-block).
pub fn joint_bend(machine: &Machine, ends: &[Joints; 2], tool_length: f64) -> f64 {
    let mut points = [machine.home.gauge_point - machine.home.tool_axis * tool_length; 2];
    let (mut speed, mut bend) = (0.0, 0.0);
    for (joint, axis) in machine.axes.iter().enumerate().rev() {
        let values = [ends[0][joint], ends[1][joint]];
        let change = (values[1] - values[0]).abs();
        match axis.kind {
            AxisKind::Linear => {
                for (point, value) in points.iter_mut().zip(values) {
                    *point += axis.direction * (axis.sign * value);
                }
                speed += change;
            }
            AxisKind::Rotary => {
                let distance = |point: &Vec3| axis.direction.cross(&(point - axis.point)).norm();
                // between the ends the point is farther out than their mean by at most half its travel
                let reach = 0.5 * (distance(&points[0]) + distance(&points[1]) + speed);
                for (point, value) in points.iter_mut().zip(values) {
                    *point = rotate(&axis.direction, axis.sign * value, &(*point - axis.point)) + axis.point;
                }
                bend += 2.0 * change * speed + change * change * reach;
                speed += change * reach;
            }
        }
    }
    bend
}

/// The unit vector at the share `t` of the shorter great circle from `a` to `b` (unit vectors, not opposite).
pub fn great_circle(a: &Vec3, b: &Vec3, t: f64) -> Vec3 {
    let angle = angle_between(a, b);
    let across = b - a * a.dot(b);
    let length = across.norm();
    if length <= 0.0 {
        return *a;
    }
    let (sin, cos) = sin_cos(angle * t);
    a * cos + across * (sin / length)
}
