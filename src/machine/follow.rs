//! Motions to joints, block by block along one posture: the machine re-runs the program.
use crate::{Joints, Machine};
use trunnion_geometry::Vec3;
use trunnion_interp::Motion;

/// Where the machine stands between two blocks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stance {
    /// Joint values, mm or rad.
    pub joints: Joints,
    /// Tip in the workpiece frame without work offset, i.e. in programmed coordinates, mm.
    pub tip: Vec3,
    /// Unit tool axis in the workpiece frame.
    pub axis: Vec3,
    /// S of the posture (see `Solution::branch`), signed.
    pub s: f64,
    /// +1, -1, 0 at the pole; 0 also for machines with fewer than two rotary axes.
    pub branch: i8,
    /// Angle between tool axis and first rotary axis (0..pi/2, the nearer end of the axis), rad; pi/2 for machines without two rotaries.
    pub pole_angle: f64,
    /// Tool length used, mm.
    pub tool_length: f64,
}

/// Why there is no stance.
#[derive(Clone, Debug, PartialEq)]
pub enum NoStance {
    /// Some axis was never positioned (the letters).
    PositionUnknown(String),
    /// No posture reaches the tool axis; nearest reachable cone is this far, rad.
    Unreachable(f64),
    /// Postures exist, but none inside the limits of the rotary axes: the axis letter, the value nearest to legal and the limit it breaks, rad.
    OutsideLimits {
        /// Letter.
        axis: u8,
        /// rad.
        value: f64,
        /// rad.
        limit: f64,
    },
    /// A motion that is not modelled.
    NotModelled,
    /// The program names an axis that the machine does not have.
    NoSuchAxis(u8),
}

/// What the machine does in one motion.
#[derive(Clone, Debug)]
pub struct Leg {
    /// The motion.
    pub motion: Motion,
    /// Before; `None`: unknown.
    pub start: Option<Stance>,
    /// After.
    pub end: Result<Stance, NoStance>,
    /// Joint values that are known even where the stance is not: value and bit mask (machine words without TCP).
    pub known_joints: (Joints, u16),
    /// Absolute increments of the rotary joints, rad (0 for missing).
    pub rotary_change: [f64; 2],
    /// Smallest pole angle within the block, rad.
    pub pole_angle_min: f64,
    /// Rotary excess over the cheapest move of the start's posture, rad, when the posture sign changes; else 0.
    pub rotary_excess: f64,
    /// Length of the programmed tip path, mm (programmed X Y Z path without TCP).
    pub length: f64,
}

/// Follows motions; cloning it makes a check-point.
#[derive(Clone)]
pub struct Follower<'m> {
    pub(crate) machine: &'m Machine,
    pub(crate) stance: Option<Stance>,
    pub(crate) known_joints: (Joints, u16),
}

impl<'m> Follower<'m> {
    /// At an unknown position.
    pub fn new(machine: &'m Machine) -> Self {
        Self { machine, stance: None, known_joints: ([0.0; crate::MAX_AXES], 0) }
    }
    /// The machine.
    pub fn machine(&self) -> &'m Machine {
        self.machine
    }
    /// Moves the machine.
    pub fn follow(&mut self, motion: &Motion) -> Leg {
        let _ = (motion, &self.stance, &self.known_joints);
        todo!()
    }
}
