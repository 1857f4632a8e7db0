//! Straight motions one after the other, while lines are motions and nothing else: no offset changes, and each is told by what differs.
use super::bridge::Bridge;
use super::frames::Shift;
use super::modal;
use crate::{Feed, Motion, MotionKind, Sink};
use trunnion_ngc::{At, Pose, State};

/// The offsets, and the motion told last.
#[derive(Clone, Debug)]
pub(super) struct Steady {
    shift: Shift,
    motion: Motion,
}

impl Steady {
    pub(super) fn new(shift: &Shift, motion: &Motion) -> Self {
        Self {
            shift: *shift,
            motion: *motion,
        }
    }
}

impl<S: Sink> Bridge<'_, '_, '_, S> {
    /// A straight motion.
    #[inline]
    pub(super) fn line(&mut self, kind: MotionKind, pose: &Pose, at: At, state: &State) {
        let rapid = matches!(kind, MotionKind::Rapid);
        let (end, machine) = if let Some(steady) = &self.told.steady {
            let end = steady.shift.coordinates(pose);
            (end, steady.shift.machine(&end))
        } else {
            let shift = self.shift(state);
            let end = shift.coordinates(pose);
            let machine = shift.machine(&end);
            let feed = if rapid {
                Feed::Rapid
            } else {
                self.feed(&machine, at, state)
            };
            return self.motion_to(kind, [end, machine], &shift, feed, at, state);
        };
        let feed = if rapid {
            Feed::Rapid
        } else {
            self.feed(&machine, at, state)
        };
        let block = self.block(at);
        let interpreter = &mut *self.interpreter;
        interpreter.state.position = end;
        interpreter.chain = self.told.places.chain(at);
        modal::refresh_motion(&mut interpreter.state, state);
        self.told.machine = machine;
        if let Some(steady) = &mut self.told.steady {
            let motion = &mut steady.motion;
            motion.block = block;
            motion.chain = interpreter.chain;
            motion.kind = kind;
            motion.start = motion.end;
            motion.end = end;
            motion.feed = feed;
            self.sink.next_line(motion, &interpreter.state);
        }
        if machine.known != end.known {
            self.told.steady = None;
        }
    }
}
