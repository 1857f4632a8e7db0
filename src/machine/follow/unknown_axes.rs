//! Which axes are unknown to a follower.
use crate::{Follower, NoStance};
use trunnion_interp::Motion;

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

    fn letters(&self, joints: u16) -> String {
        let axes = self.machine.axes.iter().enumerate();
        axes.filter(|(joint, _)| joints & (1 << joint) != 0)
            .map(|(_, axis)| char::from(axis.letter))
            .collect()
    }
}
