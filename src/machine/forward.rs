//! Joints to tool pose.
use crate::{Joints, Machine};
use trunnion_geometry::Vec3;

/// Where the tool is, in the workpiece frame (the frame of the part, which at home is the machine frame).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Tool tip, mm.
    pub tip: Vec3,
    /// Unit tool axis, tip -> spindle.
    pub axis: Vec3,
}

/// Forward kinematics: kinematics notes 2.1 (product of the chain's motions, workpiece to tool). `tool_length` in mm.
pub fn forward(machine: &Machine, joints: &Joints, tool_length: f64) -> Pose {
    let _ = (machine, joints, tool_length);
    todo!()
}
