//! Sines of the rotary axes, computed ahead: the most expensive part of following a line depends on the words of the line alone, and can be computed on
//! another thread.
//!
//! The follower takes a sine only if it is that of exactly the angle that it needs, so that no result depends on the prediction.
use crate::follow::words::{Added, Words};
use crate::{Machine, RotaryAxis};
use trunnion_geometry::math::sin_cos;
use trunnion_interp::{Motion, Position};

/// Sine and cosine of the predicted angle of a rotary axis.
#[derive(Clone, Copy, Debug)]
pub struct Sine {
    /// rad; NaN without a prediction.
    angle: f64,
    sin: f64,
    cos: f64,
}

impl Sine {
    /// Nothing was foreseen.
    pub(crate) const UNKNOWN: Self = Self {
        angle: f64::NAN,
        sin: f64::NAN,
        cos: f64::NAN,
    };

    /// Sine and cosine of an angle, rad.
    #[inline]
    pub(crate) fn of(&self, angle: f64) -> (f64, f64) {
        if self.angle.to_bits() == angle.to_bits() {
            debug_assert_eq!(format!("{:?}", (self.sin, self.cos)), format!("{:?}", sin_cos(angle)));
            return (self.sin, self.cos);
        }
        sin_cos(angle)
    }
}

/// Computes ahead the sines of lines in words of the axes on a machine with two rotary axes, as [`trunnion_interp::Sink`] passes them.
#[derive(Clone, Debug)]
pub struct Lookahead<'m> {
    rotary: &'m [RotaryAxis; 2],
    words: Words,
    /// What the last whole motion adds to words; `None` if nothing is predicted.
    added: Option<Added>,
    last: [Sine; 2],
}

impl<'m> Lookahead<'m> {
    /// For a machine; `None` if there is nothing to predict.
    pub fn new(machine: &'m Machine) -> Option<Self> {
        let words = Words::new(machine);
        (words.literal && machine.constants.pair.is_some()).then_some(Self {
            rotary: &machine.constants.rotary,
            words,
            added: None,
            last: [Sine::UNKNOWN; 2],
        })
    }

    /// A motion: lines that differ from it only slightly may follow.
    pub fn motion(&mut self, motion: &Motion) {
        self.added = Some(self.words.added(motion)).filter(|_| !motion.tcp);
    }

    /// A line: `told` receives the rotary axes that turn in it, workpiece side first, and their sines at its end.
    #[inline]
    pub fn line(&mut self, end: &Position, mut told: impl FnMut(usize, Sine)) {
        let Some(added) = &self.added else { return };
        for (index, (seen, rotary)) in self.last.iter_mut().zip(self.rotary).enumerate() {
            let angle = rotary.sign * self.words.literal_joint(rotary.joint, end, added);
            if angle.to_bits() != seen.angle.to_bits() {
                let (sin, cos) = sin_cos(angle);
                *seen = Sine { angle, sin, cos };
                told(index, *seen);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Lookahead;
    use crate::follow::joint_line::tests::{machines, motion};
    use crate::{Follower, Leg, builtin};
    use proptest::prelude::*;
    use trunnion_interp::{AXIS_LETTERS, MotionKind, Position};

    #[test]
    fn without_two_rotary_axes_that_words_lead_nothing_is_foreseen() {
        for (name, foresees) in [
            ("mikron-ucp710", true),
            ("head-table-bc", true),
            ("mill-3axis", false),
            ("mill-4axis-a", false),
        ] {
            let machine = builtin(name).expect("built in");
            assert_eq!(Lookahead::new(machine).is_some(), foresees, "{name}");
        }
    }

    proptest! {
        /// The angles are those of the joints to the last bit, so that the follower takes the prediction, and the result does not change by it.
        #[test]
        fn what_is_foreseen_is_what_the_follower_asks_for(
            machine in proptest::sample::select(machines()),
            offset in prop_oneof![Just(0.0), -50.0..50.0],
            places in proptest::collection::vec((proptest::array::uniform9(-120.0..120.0), 0..12_usize), 2..8),
        ) {
            let Some(mut foresight) = Lookahead::new(&machine) else { return Ok(()) };
            let (mut told, mut alone) = (Follower::new(&machine), Follower::new(&machine));
            let (mut told_leg, mut alone_leg): (Option<Box<Leg>>, _) = (None, None);
            let mut at = Position::default();
            for (index, (values, held)) in places.into_iter().enumerate() {
                let mut to = at;
                for (axis, value) in values.into_iter().enumerate() {
                    let own = machine.axes.iter().any(|own| own.letter == AXIS_LETTERS[axis]);
                    if own && (index == 0 || axis != held) {
                        to.set(axis, value);
                    }
                }
                let motion = motion(at, to, MotionKind::Linear, offset);
                if index == 0 {
                    foresight.motion(&motion);
                    told.follow_into(&motion, &mut told_leg);
                    alone.follow_into(&motion, &mut alone_leg);
                } else {
                    foresight.line(&to, |axis, sine| told.set_predicted_sine(axis, sine));
                    told.follow_line_into(&motion, &mut told_leg);
                    alone.follow_line_into(&motion, &mut alone_leg);
                    let end = told_leg.as_ref().and_then(|leg| leg.end.clone().ok()).expect("words of all joints");
                    for (seen, rotary) in told.sines.iter().zip(&machine.constants.rotary) {
                        prop_assert_eq!(seen.angle.to_bits(), (rotary.sign * end.joints[rotary.joint]).to_bits());
                    }
                }
                prop_assert_eq!(format!("{told_leg:?}"), format!("{alone_leg:?}"));
                at = to;
            }
        }
    }
}
