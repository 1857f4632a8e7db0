//! A check on two threads: one runs the program, the other follows the machine and judges.
//!
//! The second is shown the same motions, faults and blocks in the same order as on one thread, so that the report is identical.
use crate::analysis::Read;
use crate::pass::Pass;
use crate::view::InForce;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use trunnion_interp::{AXIS_LETTERS, ChainId, Fault, Feed, Interpreter, ModalState, Motion, MotionKind, Placed, Sink};
use trunnion_machine::{Lookahead, Machine, Sine};
use trunnion_syntax::{BlockId, Program};

/// Programs of fewer blocks are not worth a second thread.
pub(crate) const WORTH: usize = 1 << 14;

/// This many steps are handed over at once.
const BATCH: usize = 2048;

/// At most this many batches are in flight. Together they are larger than the second-level cache of a core: writing where the other core has just
/// read costs more than fetching from memory that both have left.
const BATCHES: usize = 16;

/// What a run emitted, in order.
enum RunEvent {
    /// The next of [`Batch::motions`].
    Motion,
    /// The next item of [`Batch::courses`] belongs to the line after it.
    Course,
    /// A line: see [`Sink::next_line`].
    Line {
        block: BlockId,
        /// Axes, as in [`trunnion_interp::Position`], whose places differ from those before: they are the next of [`Batch::places`].
        moved: u16,
        /// Rotary axes with a predicted sine: it is the next of [`Batch::sines`].
        foreseen: u8,
        /// After it the block has run.
        last: bool,
    },
    /// The next of [`Batch::faults`].
    Fault,
    /// The next of [`Batch::effects`].
    Effect,
    /// A block has run.
    Ran(BlockId),
}

/// What a line contains apart from block and positions: mostly the same as the motion before it.
#[derive(Clone, Copy, PartialEq)]
struct Course {
    chain: ChainId,
    rapid: bool,
    feed: Feed,
    known: u16,
}

impl Course {
    fn of(motion: &Motion) -> Self {
        Self {
            chain: motion.chain,
            rapid: matches!(motion.kind, MotionKind::Rapid),
            feed: motion.feed,
            known: motion.end.known,
        }
    }
    /// Gives a motion that continues another one everything but its positions and block.
    fn set(&self, motion: &mut Motion) {
        motion.chain = self.chain;
        motion.kind = if self.rapid {
            MotionKind::Rapid
        } else {
            MotionKind::Linear
        };
        motion.feed = self.feed;
        motion.end.known = self.known;
    }
}

/// The bits of a mask, lowest first.
#[inline]
fn bits(mut mask: u16) -> impl Iterator<Item = usize> {
    core::iter::from_fn(move || {
        let bit = mask.trailing_zeros() as usize;
        let is_set = mask != 0;
        mask &= mask.wrapping_sub(1);
        is_set.then_some(bit)
    })
}

/// A piece of a run. Lines are most of it, and are handed over by what differs: what goes from core to core costs more than what is worked
/// out again.
#[derive(Default)]
struct Batch {
    order: Vec<RunEvent>,
    motions: Vec<(Motion, InForce)>,
    courses: Vec<Course>,
    places: Vec<f64>,
    sines: Vec<Sine>,
    faults: Vec<Fault>,
    effects: Vec<Placed>,
}

/// Records what a run emits, and hands it over.
struct EventRecorder<'m> {
    batch: Batch,
    full: &'m SyncSender<Batch>,
    emptied: &'m Receiver<Batch>,
    /// Nobody receives batches any more.
    closed: bool,
    /// The end of the last emitted motion, in this batch or before it, and the last emitted course.
    last: Option<([f64; AXIS_LETTERS.len()], Option<Course>)>,
    foresight: Option<Lookahead<'m>>,
}

impl EventRecorder<'_> {
    /// Hands the batch over if it is large enough, or if the run has `ended`.
    fn hand_over(&mut self, ended: bool) {
        if self.closed || self.batch.order.len() < BATCH && !ended {
            return;
        }
        self.closed = self.full.send(core::mem::take(&mut self.batch)).is_err();
        if self.closed || ended {
            return;
        }
        match self.emptied.recv() {
            Ok(next) => self.batch = next,
            Err(_) => self.closed = true,
        }
    }

    /// A block has run.
    #[inline]
    fn ran(&mut self, ran: BlockId) {
        match self.batch.order.last_mut() {
            Some(RunEvent::Line { block, last, .. }) if *block == ran && !*last => *last = true,
            _ => self.batch.order.push(RunEvent::Ran(ran)),
        }
    }
}

impl Sink for EventRecorder<'_> {
    fn motion(&mut self, motion: &Motion, state: &ModalState) {
        // a block may make very many motions: a cycle on a pattern of holes
        self.hand_over(false);
        if self.closed {
            return;
        }
        self.batch.order.push(RunEvent::Motion);
        self.batch.motions.push((*motion, InForce::of(state)));
        self.last = Some((motion.end.values, None));
        if let Some(foresight) = &mut self.foresight {
            foresight.motion(motion);
        }
    }
    #[inline]
    fn next_line(&mut self, motion: &Motion, state: &ModalState) {
        let Some((places, course)) = &mut self.last else {
            return self.motion(motion, state);
        };
        let batch = &mut self.batch;
        let own = Course::of(motion);
        if *course != Some(own) {
            *course = Some(own);
            batch.order.push(RunEvent::Course);
            batch.courses.push(own);
        }
        let mut moved = 0;
        for (axis, (before, place)) in places.iter_mut().zip(&motion.end.values).enumerate() {
            if before.to_bits() != place.to_bits() {
                *before = *place;
                moved |= 1 << axis;
                batch.places.push(*place);
            }
        }
        let mut foreseen = 0;
        if let Some(foresight) = &mut self.foresight {
            foresight.line(&motion.end, |index, sine| {
                foreseen |= 1 << index;
                batch.sines.push(sine);
            });
        }
        batch.order.push(RunEvent::Line {
            block: motion.block,
            moved,
            foreseen,
            last: false,
        });
    }
    fn fault(&mut self, fault: Fault) {
        self.batch.order.push(RunEvent::Fault);
        self.batch.faults.push(fault);
    }
    fn effect(&mut self, effect: Placed) {
        self.batch.order.push(RunEvent::Effect);
        self.batch.effects.push(effect);
    }
}

impl Batch {
    /// Shows the pass what was recorded; afterwards the batch is empty and keeps its storage. `last`: the last emitted motion.
    fn show(&mut self, pass: &mut Pass<'_>, last: &mut Option<Motion>) {
        let (mut motions, mut courses) = (self.motions.iter(), self.courses.iter());
        let (mut places, mut sines) = (self.places.iter(), self.sines.iter());
        let mut faults = self.faults.drain(..);
        let mut effects = self.effects.drain(..);
        let mut course = None;
        for told in self.order.drain(..) {
            match told {
                RunEvent::Motion => {
                    if let Some((motion, in_force)) = motions.next() {
                        pass.take_motion(motion, *in_force);
                        *last = Some(*motion);
                    }
                }
                RunEvent::Course => course = courses.next(),
                RunEvent::Line {
                    block,
                    moved,
                    foreseen,
                    last: ends,
                } => {
                    let Some(motion) = last.as_mut() else { continue };
                    motion.block = block;
                    motion.start = motion.end;
                    if let Some(course) = course.take() {
                        course.set(motion);
                    }
                    for (axis, place) in bits(moved).zip(&mut places) {
                        motion.end.values[axis] = *place;
                    }
                    for (index, sine) in bits(foreseen.into()).zip(&mut sines) {
                        pass.set_predicted_sine(index, *sine);
                    }
                    pass.take_line(motion);
                    if ends {
                        pass.ran(block);
                    }
                }
                RunEvent::Fault => faults.by_ref().take(1).for_each(|fault| pass.fault(fault)),
                RunEvent::Effect => effects.by_ref().take(1).for_each(|effect| pass.effect(effect)),
                RunEvent::Ran(block) => _ = pass.ran(block),
            }
        }
        drop(faults);
        drop(effects);
        self.motions.clear();
        self.courses.clear();
        self.places.clear();
        self.sines.clear();
    }
}

/// Runs a program on its own thread, lets the pass `read` meanwhile and shows it what the run emits; returns the interpreter at the end.
pub(crate) fn run(
    program: &Program,
    machine: Option<&Machine>,
    mut interpreter: Interpreter<'static>,
    read: Read<'_>,
    pass: &mut Pass<'_>,
) -> Interpreter<'static> {
    let (full, filled) = sync_channel(BATCHES);
    let (empty, emptied) = sync_channel::<Batch>(BATCHES);
    for _ in 0..BATCHES {
        // there is room for all of them
        _ = empty.send(Batch::default());
    }
    // both channel ends are dropped on a panic, so that neither thread waits forever
    std::thread::scope(move |scope| {
        let runner = scope.spawn(move || {
            let foresight = machine.and_then(Lookahead::new);
            tell(program, &mut interpreter, foresight, &full, &emptied);
            interpreter
        });
        read(pass);
        let mut last = None;
        for mut batch in filled {
            batch.show(pass, &mut last);
            // the thread that runs the program may have ended
            _ = empty.send(batch);
        }
        match runner.join() {
            Ok(interpreter) => interpreter,
            Err(panic) => std::panic::resume_unwind(panic),
        }
    })
}

/// Runs the program and hands over what it emits while the receiver exists.
fn tell(
    program: &Program,
    interpreter: &mut Interpreter<'static>,
    foresight: Option<Lookahead<'_>>,
    full: &SyncSender<Batch>,
    emptied: &Receiver<Batch>,
) {
    let mut recorder = EventRecorder {
        batch: Batch::default(),
        full,
        emptied,
        closed: false,
        last: None,
        foresight,
    };
    while let Some(block) = interpreter.advance(program, &mut recorder) {
        recorder.ran(block);
        recorder.hand_over(false);
        if recorder.closed {
            return;
        }
    }
    recorder.hand_over(true);
}

#[cfg(test)]
mod tests {
    use super::*;
    use trunnion_interp::Position;

    /// A cycle on a pattern of holes makes all of its motions in one block.
    #[test]
    fn a_block_of_many_motions_is_handed_over_in_parts() {
        let (full, filled) = sync_channel(BATCHES);
        let (empty, emptied) = sync_channel::<Batch>(BATCHES);
        for _ in 0..BATCHES {
            empty.send(Batch::default()).expect("room");
        }
        let mut recorder = EventRecorder {
            batch: Batch::default(),
            full: &full,
            emptied: &emptied,
            closed: false,
            last: None,
            foresight: None,
        };
        let motion = Motion::line(Position::default(), Position::default());
        let dialect = trunnion_dialect::builtin("iso-6983").expect("built in");
        let state = Interpreter::new(dialect, &trunnion_interp::Setup::default())
            .state()
            .clone();
        for _ in 0..=(BATCH * 3) {
            recorder.motion(&motion, &state);
        }
        recorder.hand_over(true);
        drop(full);
        let parts: Vec<usize> = filled.iter().map(|batch| batch.motions.len()).collect();
        assert_eq!(parts, [BATCH, BATCH, BATCH, 1]);
    }
}
