//! Straight motions one after the other, while lines are motions and nothing else: no offset changes, and each is emitted as a difference.
use super::bridge::Bridge;
use super::frames::Shift;
use super::modal;
use crate::{Feed, Motion, MotionKind, Position, Sink};
use trunnion_ngc::{At, Pose, State};

/// The offsets, and the last emitted motion.
#[derive(Clone, Debug)]
pub(super) struct Steady {
    shift: Shift,
    motion: Motion,
    /// That was the present line: what is active after it was taken over with the motion.
    pub(super) settled: bool,
}

impl<S: Sink> Bridge<'_, '_, '_, S> {
    /// A straight motion; `only`: its line is this motion and nothing else.
    #[inline]
    pub(super) fn line(&mut self, rapid: bool, pose: &Pose, only: bool, at: At, state: &State) {
        if let Some(mut steady) = self.calls.steady.take() {
            let on = self.next_line(&mut steady, rapid, pose, at, state);
            steady.settled = true;
            // what follows is emitted as differences, unless an offset is not known
            self.calls.steady = Some(steady).filter(|_| on);
            return;
        }
        let shift = self.shift(state);
        let end = shift.coordinates(pose);
        let machine = shift.machine(&end);
        let feed = self.line_feed(rapid, &machine, at, state);
        let kind = if rapid { MotionKind::Rapid } else { MotionKind::Linear };
        let motion = self.motion_to(kind, [end, machine], &shift, feed, at, state);
        self.calls.steady = (only && goes_on(&motion, &machine)).then(|| {
            Box::new(Steady {
                shift,
                motion,
                settled: true,
            })
        });
    }

    #[inline]
    fn line_feed(&mut self, rapid: bool, machine: &Position, at: At, state: &State) -> Feed {
        if rapid {
            Feed::Rapid
        } else {
            self.feed(machine, false, at, state)
        }
    }

    /// The same where the line before it was one too; whether the next may go on so.
    #[inline]
    fn next_line(&mut self, steady: &mut Steady, rapid: bool, pose: &Pose, at: At, state: &State) -> bool {
        let Steady { shift, motion, .. } = steady;
        let mut machine = self.calls.machine;
        motion.start = motion.end;
        // axes without a word stay where the line before it moved them
        if !shift.reach(pose, state.named_axes, &mut motion.end, &mut machine) {
            motion.end = shift.coordinates(pose);
            machine = shift.machine(&motion.end);
        }
        if cfg!(debug_assertions) {
            let full = shift.coordinates(pose);
            let full = format!("{:?}", (full, shift.machine(&full)));
            debug_assert_eq!(
                format!("{:?}", (motion.end, machine)),
                full,
                "an axis without a word has moved"
            );
        }
        let feed = self.line_feed(rapid, &machine, at, state);
        let block = self.block(at);
        let core = &mut *self.core;
        core.state.position = motion.end;
        core.chain = self.calls.places.chain(at);
        modal::refresh_motion(&mut core.state, state);
        self.calls.machine = machine;
        motion.block = block;
        motion.chain = core.chain;
        // the larger kinds need not be written
        if rapid {
            motion.kind = MotionKind::Rapid;
        } else {
            motion.kind = MotionKind::Linear;
        }
        motion.feed = feed;
        self.sink.next_line(motion, &core.state);
        goes_on(motion, &machine)
    }
}

/// Whether a line after a motion may be emitted as a difference: not where an offset is not known, nor where increments start from an unknown
/// position, since only whole motions carry which letters a line names.
#[inline]
fn goes_on(motion: &Motion, machine: &Position) -> bool {
    machine.known == motion.end.known && (motion.says_way == 0 || motion.end.xyz().is_some())
}
