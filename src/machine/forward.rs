//! Joints to tool pose.
use crate::{Constants, Joints, Machine};
use trunnion_geometry::Vec3;
use trunnion_geometry::math::sin_cos;

/// Where the tool is, in the workpiece frame (the frame of the part, which at home is the machine frame).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Tool tip, mm.
    pub tip: Vec3,
    /// Unit tool axis, tip -> spindle.
    pub axis: Vec3,
}

/// A rotation about a fixed unit vector whose sine and cosine are known.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Turn {
    pub(crate) axis: Vec3,
    pub(crate) sin: f64,
    pub(crate) cos: f64,
}

impl Turn {
    /// No turn.
    pub(crate) const NONE: Self = Self {
        axis: Vec3::new(0.0, 0.0, 1.0),
        sin: 0.0,
        cos: 1.0,
    };

    /// Turn of rotary axis `index` (0 = nearest the workpiece) at joint value `q`, rad.
    #[inline]
    pub(crate) fn new(constants: &Constants, index: usize, q: f64) -> Self {
        let rotary = &constants.rotary[index];
        let (sin, cos) = sin_cos(rotary.sign * q);
        Self {
            axis: rotary.direction,
            sin,
            cos,
        }
    }
    /// The turned vector (Rodrigues' formula).
    #[inline]
    pub(crate) fn apply(&self, v: &Vec3) -> Vec3 {
        v * self.cos + self.axis.cross(v) * self.sin + self.axis * (self.axis.dot(v) * (1.0 - self.cos))
    }
    /// The vector turned back.
    #[inline]
    pub(crate) fn undo(&self, v: &Vec3) -> Vec3 {
        v * self.cos - self.axis.cross(v) * self.sin + self.axis * (self.axis.dot(v) * (1.0 - self.cos))
    }
}

/// Sum of the linear motions in each of the three segments of the chain: before, between and after the rotary axes.
#[inline]
pub(crate) fn segment_shifts(constants: &Constants, joints: &Joints) -> [Vec3; 3] {
    let mut shifts = [Vec3::zeros(); 3];
    for linear in constants.linear() {
        shifts[linear.segment] += linear.motion * joints[linear.joint];
    }
    shifts
}

/// Forward kinematics: kinematics notes 2.1 (product of the chain's motions, workpiece to tool). `tool_length` in mm. A held axis counts
/// with its value in `joints`.
pub fn forward(machine: &Machine, joints: &Joints, tool_length: f64) -> Pose {
    if let Some(other) = machine.held_elsewhere(joints) {
        return forward(&other, joints, tool_length);
    }
    let constants = &machine.constants;
    let shifts = segment_shifts(constants, joints);
    let mut tip = machine.gauge_point - machine.tool_axis * tool_length + shifts[constants.rotary_count];
    let mut axis = machine.tool_axis;
    for index in (0..constants.rotary_count).rev() {
        let rotary = &constants.rotary[index];
        let turn = Turn::new(constants, index, joints[rotary.joint]);
        tip = turn.apply(&(tip - rotary.point)) + rotary.point + shifts[index];
        axis = turn.apply(&axis);
    }
    Pose { tip, axis }
}

/// Tool axis in the workpiece frame for two rotary joint values, rad (a missing one is ignored): u = R1 R2 k0, kinematics notes 2.1.
pub fn tool_axis_at(machine: &Machine, q: [f64; 2]) -> Vec3 {
    let constants = &machine.constants;
    let mut axis = machine.tool_axis;
    for index in (0..constants.rotary_count).rev() {
        axis = Turn::new(constants, index, q[index]).apply(&axis);
    }
    axis
}
