//! Rotary axes beyond the two that inverse kinematics solves for. The machine file holds each of them at a value; it then only moves
//! what follows it in the chain: with H its motion, A H B = (A)(H B H^-1)(H), so that directions and points after it are turned
//! and moved by H once, and the solver sees two rotary axes.
use crate::{Axis, Constants, Joints, Machine, NoStance};
use core::f64::consts::TAU;
use trunnion_geometry::math::rotate;
use trunnion_geometry::{Mat3, Vec3};

/// Joint values this near to the held one are equal to it, rad: rounding of degrees.
const SAME: f64 = 1e-9;

/// The motion of all held axes met so far, from workpiece to tool; nothing at first.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Carried {
    /// Rotation and shift; `None`: nothing moves, to the last bit.
    motion: Option<(Mat3, Vec3)>,
}

impl Carried {
    /// Of all held axes of a chain.
    pub(crate) fn by(axes: &[Axis]) -> Self {
        let mut carried = Self::default();
        for axis in axes {
            carried.hold(axis);
        }
        carried
    }
    /// One more held axis; one that moves, or is held at zero, changes nothing.
    pub(crate) fn hold(&mut self, axis: &Axis) {
        let angle = axis.extra.hold.unwrap_or(0.0) * axis.sign;
        if angle == 0.0 {
            return;
        }
        let turn = |v: &Vec3| rotate(&axis.direction, angle, v);
        let matrix = Mat3::from_columns(&[turn(&Vec3::x()), turn(&Vec3::y()), turn(&Vec3::z())]);
        let shift = axis.point - turn(&axis.point);
        let (before, moved) = self.motion.unwrap_or((Mat3::identity(), Vec3::zeros()));
        self.motion = Some((before * matrix, before * shift + moved));
    }
    /// A direction, carried.
    pub(crate) fn turn(&self, direction: &Vec3) -> Vec3 {
        self.motion.map_or(*direction, |(matrix, _)| matrix * direction)
    }
    /// A point, carried, mm.
    pub(crate) fn place(&self, point: &Vec3) -> Vec3 {
        self.motion.map_or(*point, |(matrix, shift)| matrix * point + shift)
    }
}

impl Machine {
    /// The axes that are held, with the joint values they are held at, rad.
    pub fn held(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        let axes = self.axes.iter().enumerate();
        axes.filter_map(|(joint, axis)| Some((joint, axis.extra.hold?)))
    }

    /// Whether no axis is held, as on nearly every machine.
    pub(crate) fn all_move(&self) -> bool {
        self.constants.rotary_count + self.constants.linear_count == self.axes.len()
    }

    /// The same machine with its held axes at their values in `joints`, where one of them differs; else `None`.
    pub(crate) fn held_elsewhere(&self, joints: &Joints) -> Option<Self> {
        if self.all_move() {
            return None;
        }
        if self.held().all(|(joint, value)| joints[joint] == value) {
            return None;
        }
        let mut other = self.clone();
        for (joint, axis) in other.axes.iter_mut().enumerate() {
            if let Some(value) = &mut axis.extra.hold {
                *value = joints[joint];
            }
        }
        let carried = Carried::by(&other.axes);
        other.constants = Constants::new(&other.axes, &self.home.tool_axis)?;
        other.tool_axis = carried.turn(&self.home.tool_axis);
        other.gauge_point = carried.place(&self.home.gauge_point);
        Some(other)
    }
}

/// Held axes that no word names are where the machine file holds them; one that a word moves away makes the rest unknown.
pub(crate) fn settle_held(machine: &Machine, known: &mut (Joints, u16)) -> Result<(), NoStance> {
    if machine.all_move() {
        return Ok(());
    }
    for (joint, held) in machine.held() {
        let bit = 1_u16 << joint;
        let value = known.0[joint];
        if known.1 & bit != 0 && (value - held - TAU * ((value - held) / TAU).round()).abs() > SAME {
            let axis = machine.axes[joint].letter;
            return Err(NoStance::HeldElsewhere { axis, value, held });
        }
        if known.1 & bit == 0 {
            known.0[joint] = held;
            known.1 |= bit;
        }
    }
    Ok(())
}
