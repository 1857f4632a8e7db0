//! A machine that has moved without a motion of the program: a tool change has taken its linear axes elsewhere.
use crate::Follower;
use crate::follow::follower::has_tip_words;
use trunnion_interp::{Motion, Swivel};

impl Follower<'_> {
    /// Before a motion: if the machine has moved since the last one, its linear axes are where the start of the motion says. Those of which it does
    /// not say so are lost, and with them the stance; rotary axes stay.
    #[inline]
    pub(crate) fn relocate(&mut self, motion: &Motion) {
        if motion.relocations != self.state.relocations {
            self.state.relocations = motion.relocations;
            self.take_start(motion);
        }
    }

    #[cold]
    fn take_start(&mut self, motion: &Motion) {
        let says_axes = !has_tip_words(motion) && motion.tilt.swivel == Swivel::No && motion.tilt.normal.is_none();
        let (joints, known) = self.words.joints(motion, &motion.start, false);
        let known = if says_axes { known } else { 0 };
        let mut linear = 0;
        let before = self.state.known_joints;
        for axis in self.machine.constants.linear() {
            let bit = 1 << axis.joint;
            linear |= bit;
            if known & bit != 0 {
                self.state.known_joints.0[axis.joint] = joints[axis.joint];
            }
        }
        self.state.known_joints.1 = before.1 & !linear | known & linear;
        let stance = self.state.stance.take();
        let Some(stance) = stance else { return };
        self.state.taken_away = known & linear != linear;
        if !self.state.taken_away {
            let joints = self.state.known_joints.0;
            self.state.stance = Some(self.stand(motion, &joints, Some(&stance), None));
        }
    }
}
