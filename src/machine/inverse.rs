//! Tool pose to joints: closed form for any pair of rotary axes.
use crate::{Joints, Machine};
use trunnion_geometry::Vec3;

/// One posture of the rotary axes for a tool axis, before windings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Solution {
    /// Rotary joint values q1 (nearest the workpiece), q2, rad, in (-pi, pi].
    pub q: [f64; 2],
    /// Posture sign: sign of S = e1 . (R1 e2 x u); 0 at the pole or at the edge of the reach.
    pub branch: i8,
}

/// All orientations that reach a tool axis.
#[derive(Clone, Debug, PartialEq)]
pub enum Orientations {
    /// No posture: the tool axis lies outside the cone the machine reaches; angle to it, rad.
    Unreachable(f64),
    /// One or two postures (one at the edge of the reach).
    Postures(Vec<Solution>),
    /// The tool axis is parallel to the first rotary axis: q1 is free, q2 is one of the given.
    Pole(Vec<f64>),
}

/// Exact orientation solver, kinematics notes 2.3. Windings and limits are not applied.
pub fn orientations(machine: &Machine, axis: &Vec3) -> Orientations {
    let _ = (machine, axis);
    todo!()
}

/// Linear joints for a tip with given rotary joints: `joints` holds the rotary values in and all values out.
/// `None` when the linear axes do not span space.
pub fn inverse(machine: &Machine, joints: &mut Joints, tip: &Vec3, tool_length: f64) -> Option<()> {
    let _ = (machine, joints, tip, tool_length);
    todo!()
}
