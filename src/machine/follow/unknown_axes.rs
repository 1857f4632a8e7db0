//! Which axes are unknown to a follower.
use crate::{Follower, Leg, NoStance};
use trunnion_interp::{Motion, MotionKind, Orientation, Swivel};

/// A, B and C of [`trunnion_interp::Position`].
const ROTARY_LETTERS: u16 = 0b11_1000;

impl Follower<'_> {
    /// The joints outside the mask are unknown.
    pub(crate) fn unknown(&self, known: u16) -> NoStance {
        NoStance::PositionUnknown(self.letters(!known))
    }

    /// The same where X Y Z are tip words.
    pub(crate) fn unknown_tip(&self, motion: &Motion, tip_known: bool, known: u16) -> NoStance {
        let mut letters = String::new();
        if !tip_known {
            letters.extend(
                "XYZ"
                    .chars()
                    .enumerate()
                    .filter(|(i, _)| motion.end.get(*i).is_none())
                    .map(|(_, c)| c),
            );
        }
        NoStance::PositionUnknown(letters + &self.letters(!known))
    }

    /// Rotary joints that are at an unknown position after a motion, and no longer where the machine was switched on: it was known before, or
    /// the motion has words that move it, or is itself unknown.
    pub(crate) fn lost_turns(&self, leg: &Leg) -> u16 {
        let state = &self.state;
        let (before, known) = (state.known_joints.1, leg.known_joints.1);
        let moved = leg.motion.says_way & !leg.motion.end.known;
        let rotary = self.machine.constants.rotary().iter().map(|rotary| rotary.joint);
        rotary.fold(0, |mask, joint| {
            let bit = 1 << joint;
            let moves = leg.motion.kind == MotionKind::Unknown || self.words.names(moved, joint);
            let is_lost = known & bit == 0 && (moves || (before | state.rotary_lost) & bit != 0);
            mask | if is_lost { bit } else { 0 }
        })
    }

    /// Whether the tool turns to an unknown direction: a vector led it before, and this guided motion has neither a vector nor a rotary coordinate. Its
    /// own vector is not known, or the program has lost its position.
    pub(crate) fn turns_away(&self, motion: &Motion) -> bool {
        let names_turns = (motion.end.known | motion.says_way) & ROTARY_LETTERS != 0;
        let plain = matches!(motion.orientation, Orientation::Words) && motion.tilt.swivel == Swivel::No;
        self.state.led && plain && motion.tcp && !names_turns
    }

    pub(crate) fn is_rotary(&self, joint: usize) -> bool {
        let mut rotary = self.machine.constants.rotary().iter();
        rotary.any(|rotary| rotary.joint == joint)
    }

    fn letters(&self, joints: u16) -> String {
        let axes = self.machine.axes.iter().enumerate();
        axes.filter(|(joint, _)| joints & (1 << joint) != 0)
            .map(|(_, axis)| char::from(axis.letter))
            .collect()
    }
}
