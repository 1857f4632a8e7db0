//! Straight motions one after the other, while lines are motions and nothing else: no offset changes, and each is told by what differs.
use super::bridge::Bridge;
use super::frames::Shift;
use super::modal;
use crate::{Feed, Motion, MotionKind, Position, Sink};
use trunnion_ngc::{At, Pose, State};

/// The offsets, and the motion told last.
#[derive(Clone, Debug)]
pub(super) struct Steady {
    shift: Shift,
    motion: Motion,
    /// That was the line in hand: what is in force behind it was taken over with the motion.
    pub(super) settled: bool,
}

impl<S: Sink> Bridge<'_, '_, '_, S> {
    /// A straight motion; `only`: its line is this motion and nothing else.
    #[inline]
    pub(super) fn line(&mut self, kind: MotionKind, pose: &Pose, only: bool, at: At, state: &State) {
        let steady = self.told.steady.take();
        let fresh;
        let shift = if let Some(steady) = &steady {
            &steady.shift
        } else {
            fresh = self.shift(state);
            &fresh
        };
        let end = shift.coordinates(pose);
        let machine = shift.machine(&end);
        let feed = if matches!(kind, MotionKind::Rapid) {
            Feed::Rapid
        } else {
            self.feed(&machine, at, state)
        };
        let steady = if let Some(mut steady) = steady {
            self.next_line(&mut steady.motion, kind, [end, machine], feed, at, state);
            steady.settled = true;
            Some(steady)
        } else {
            let motion = self.motion_to(kind, [end, machine], shift, feed, at, state);
            only.then(|| {
                let (shift, settled) = (*shift, true);
                Box::new(Steady { shift, motion, settled })
            })
        };
        // what comes next is told by what differs, unless an offset is not known
        self.told.steady = steady.filter(|_| machine.known == end.known);
    }

    /// The same where the line before it, which made `motion`, was one too.
    #[inline]
    fn next_line(
        &mut self,
        motion: &mut Motion,
        kind: MotionKind,
        [end, machine]: [Position; 2],
        feed: Feed,
        at: At,
        state: &State,
    ) {
        let block = self.block(at);
        let interpreter = &mut *self.interpreter;
        interpreter.state.position = end;
        interpreter.chain = self.told.places.chain(at);
        modal::refresh_motion(&mut interpreter.state, state);
        self.told.machine = machine;
        motion.block = block;
        motion.chain = interpreter.chain;
        motion.kind = kind;
        motion.start = motion.end;
        motion.end = end;
        motion.feed = feed;
        self.sink.next_line(motion, &interpreter.state);
    }
}
