//! Clamps of rotary axes, as the M codes that have run leave them. The machine names these codes ([`ClampCodes`]).
use crate::{AXIS_LETTERS, AxisLetter};

/// The M codes of a clamp.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ClampCodes {
    /// Number of the one that clamps.
    pub on: u16,
    /// Number of the one that releases.
    pub off: u16,
}

/// The codes of the clamps of all axes, in the order of [`AXIS_LETTERS`]; `None`: none are known.
pub type AllClampCodes = [Option<ClampCodes>; AXIS_LETTERS.len()];

/// What is known about one clamp.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Clamp {
    /// No code has run yet.
    #[default]
    Unsaid,
    /// Clamped.
    Closed,
    /// Released.
    Open,
    /// It is unknown which code ran last: a code whose number is unknown, both codes in one block, or a call that is not followed.
    Unknown,
}

/// The clamps of all axes after a block.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Clamps {
    clamps: [Clamp; AXIS_LETTERS.len()],
    /// Bit per axis: the block itself has a code of its clamp.
    here: u16,
}

impl Clamps {
    /// The clamp of an axis.
    pub fn of(&self, axis: AxisLetter) -> Clamp {
        self.clamps.get(usize::from(axis.0)).copied().unwrap_or_default()
    }

    /// Whether a code of the axis's clamp is in the block itself. The machine builder decides whether it acts before or after
    /// the block's motion.
    pub fn named_here(&self, axis: AxisLetter) -> bool {
        self.here >> axis.0 & 1 == 1
    }

    /// A block begins.
    #[inline]
    pub fn begin_block(&mut self) {
        self.here = 0;
    }

    /// An M code runs, ten times its number; whether it is one of the codes.
    pub fn hear(&mut self, codes: &AllClampCodes, tenths: u32) -> bool {
        let mut any = false;
        for (axis, codes) in codes.iter().enumerate() {
            let Some(codes) = codes else { continue };
            let is = |code: u16| u32::from(code) * 10 == tenths;
            let now = match (is(codes.on), is(codes.off)) {
                (true, _) => Clamp::Closed,
                (_, true) => Clamp::Open,
                _ => continue,
            };
            any = true;
            let both = self.here >> axis & 1 == 1 && self.clamps[axis] != now;
            self.clamps[axis] = if both { Clamp::Unknown } else { now };
            self.here |= 1 << axis;
        }
        any
    }

    /// An M code runs whose number is unknown.
    pub fn hear_unread(&mut self, codes: &AllClampCodes) {
        for (axis, codes) in codes.iter().enumerate() {
            if codes.is_some() {
                self.clamps[axis] = Clamp::Unknown;
                self.here |= 1 << axis;
            }
        }
    }

    /// What has run is unknown.
    pub fn lose(&mut self) {
        self.clamps = [Clamp::Unknown; AXIS_LETTERS.len()];
    }
}
