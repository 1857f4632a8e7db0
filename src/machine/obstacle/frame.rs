//! The tool as seen from a body of the machine.
use crate::{AxisKind, Joints, Machine, Pose};
use trunnion_geometry::Vec3;
use trunnion_geometry::math::rotate;

/// Tip and axis of a tool of this length (mm) in the frame of the body that has `frame` axes between the workpiece and it: 0 is the workpiece,
/// where this is [`crate::forward`].
pub fn tool_in_frame(machine: &Machine, joints: &Joints, tool_length: f64, frame: usize) -> Pose {
    let mut tip = machine.home.gauge_point - machine.home.tool_axis * tool_length;
    let mut axis = machine.home.tool_axis;
    for (joint, own) in machine.axes.iter().enumerate().skip(frame).rev() {
        let value = own.sign * joints[joint];
        match own.kind {
            AxisKind::Linear => tip += own.direction * value,
            AxisKind::Rotary if value != 0.0 => {
                tip = rotate(&own.direction, value, &(tip - own.point)) + own.point;
                axis = rotate(&own.direction, value, &axis);
            }
            AxisKind::Rotary => {}
        }
    }
    Pose { tip, axis }
}

/// What each linear axis that moves adds to the position of the tip, in the frame of [`tool_in_frame`], mm. No rotary axis turns.
pub fn linear_steps(
    machine: &Machine,
    (from, to): (&Joints, &Joints),
    tool_length: f64,
    frame: usize,
) -> impl Iterator<Item = Vec3> {
    let start = tool_in_frame(machine, from, tool_length, frame).tip;
    let linear = (0..machine.axes.len()).filter(|&joint| machine.axes[joint].kind == AxisKind::Linear);
    let step = linear.map(move |joint| {
        let mut joints = *from;
        joints[joint] = to[joint];
        tool_in_frame(machine, &joints, tool_length, frame).tip - start
    });
    step.filter(|step| step.norm() > 0.0)
}

/// Distance of the point at `height` above the tip from each rotary axis between the frame and the tool, mm, with the joint.
pub(super) fn radii(
    machine: &Machine,
    joints: &Joints,
    (tool_length, height): (f64, f64),
    frame: usize,
) -> Vec<(usize, f64)> {
    let mut point = machine.home.gauge_point + machine.home.tool_axis * (height - tool_length);
    let mut found = Vec::new();
    for (joint, own) in machine.axes.iter().enumerate().skip(frame).rev() {
        let value = own.sign * joints[joint];
        match own.kind {
            AxisKind::Linear => point += own.direction * value,
            AxisKind::Rotary => {
                found.push((joint, own.direction.cross(&(point - own.point)).norm()));
                point = rotate(&own.direction, value, &(point - own.point)) + own.point;
            }
        }
    }
    found
}
