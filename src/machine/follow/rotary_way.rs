//! Rotary words that the control does not take literally: which way, and how far, they turn an axis.
use crate::follow::words::Words;
use crate::{Joints, Machine, Open, OpenCause, Wrap};
use core::f64::consts::{PI, TAU};
use trunnion_interp::{AXIS_LETTERS, Motion};

/// Turns that differ by less are the same, rad: sums of turns are rounded.
const SAME: f64 = 1e-9;

/// The turn forward to an angle, less than a full turn.
fn forward(turn: f64) -> f64 {
    let turn = turn.rem_euclid(TAU);
    if TAU - turn < SAME { turn - TAU } else { turn }
}

/// The value at an angle that is nearest to a position.
fn nearest(before: f64, target: f64) -> f64 {
    target + TAU * ((before - target) / TAU).round()
}

impl Words {
    /// The turns that a control adds to rotary words that it does not take literally, from the present position: the shortest turn (M126), or
    /// the direction of the word's sign to the word's amount (LinuxCNC wrapped rotary axes). A word that stays the same moves nothing, and an
    /// incremental one turns by its full amount: the shorter way is for absolute words (trade knowledge of WRAPPED_ROTARY and of Fanuc's
    /// roll-over, not read in a manual). A direction in the program (DC, ACP, ACN, M126) counts from the angle at which the axis stands.
    /// Half a turn in either direction is equally long: it is undecided which one is taken. `from`: the axis positions, where known; how many times
    /// they have turned is then unknown, and the first word gives the position.
    pub(crate) fn wrap(
        &self,
        machine: &Machine,
        motion: &Motion,
        from: Option<&Joints>,
        (joints, known): &mut (Joints, u16),
    ) -> Option<Open> {
        let mut open = None;
        for rotary in machine.constants.rotary() {
            let joint = rotary.joint;
            let letter = usize::from(self.letter[joint]);
            let wrap = machine.axes[joint].extra.wrap;
            let word = (letter < AXIS_LETTERS.len()).then(|| motion.end.get(letter)).flatten();
            let Some(word) = word else { continue };
            let target = joints[joint];
            // where the word's sign is the direction, its amount is the place
            let amount = target + (word.abs() - word) * self.scale[joint];
            let Some(before) = from.map(|from| from[joint]) else {
                if wrap == Wrap::ModuloSign && !self.names(motion.says_way, joint) {
                    joints[joint] = amount;
                }
                continue;
            };
            if wrap == Wrap::Literal {
                let zero = target - word * self.scale[joint];
                if self.names(motion.ways.carried, joint)
                    && let Some(other) = carried(before - zero, target - zero)
                {
                    open = Some((OpenCause::TurnsCarried, joint, zero + other));
                    *known &= !(1 << joint);
                }
                continue;
            }
            let ways = &motion.ways;
            let start = motion.start.get(letter);
            let shorter = self.names(ways.shortest, joint);
            joints[joint] = if self.names(ways.forward, joint) {
                before + forward(target - before)
            } else if self.names(ways.back, joint) {
                before - forward(before - target)
            } else if start == Some(word) && !shorter {
                before
            } else if let (Some(start), true) = (start, self.names(motion.says_way, joint) && !shorter) {
                // the words may be whole turns off the joint
                before + (word - start) * self.scale[joint]
            } else if wrap == Wrap::Shortest || shorter {
                let turned = nearest(before, target);
                if ((turned - before).abs() - PI).abs() < SAME {
                    open = Some((OpenCause::HalfTurn, joint, 2.0 * before - turned));
                }
                turned
            } else if word.is_sign_negative() {
                before - forward(before - amount)
            } else {
                before + forward(amount - before)
            };
        }
        let (cause, joint, other) = open?;
        let mut found = Open {
            cause,
            taken: [0.0; 2],
            other: [0.0; 2],
        };
        for (index, rotary) in machine.constants.rotary().iter().enumerate().take(2) {
            found.taken[index] = joints[rotary.joint];
            found.other[index] = if rotary.joint == joint {
                other
            } else {
                joints[rotary.joint]
            };
        }
        Some(found)
    }
}

/// Where, in the program's coordinate, a plain word turns an axis that a word with a direction has carried beyond a full turn, if the control
/// counts from the angle that it displays (0 to 360 deg) and that gives another place than the word itself. M126 acts on axes with such a
/// display (TNC 620 34056x-04, p. 338).
fn carried(before: f64, target: f64) -> Option<f64> {
    let other = before + (target - before.rem_euclid(TAU));
    ((other - target).abs() > SAME).then_some(other)
}
