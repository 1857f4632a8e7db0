//! A check on two threads: one runs the program, the other follows the machine and judges.
//!
//! The second is shown the same motions, faults and blocks in the same order as on one thread, so that it finds the same to the letter.
use crate::pass::Pass;
use crate::rule::InForce;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use trunnion_interp::{ChainId, Fault, Feed, Interpreter, ModalState, Motion, MotionKind, Position, Sink};
use trunnion_syntax::{BlockId, Program};

/// Programs of fewer blocks are not worth a second thread.
pub(crate) const WORTH: usize = 1 << 14;

/// So many steps are handed over at once: they fit into the cache of a core.
const BATCH: usize = 512;

/// So many batches are under way at most.
const BATCHES: usize = 4;

/// What a run told, in order.
enum Told {
    /// The next of [`Batch::motions`].
    Motion,
    /// The next of [`Batch::lines`].
    Line,
    /// The next of [`Batch::faults`].
    Fault,
    /// A block has run.
    Ran(BlockId),
}

/// What a line tells that the motion before it does not tell: see [`Sink::next_line`].
struct Line {
    block: BlockId,
    chain: ChainId,
    rapid: bool,
    feed: Feed,
    end: Position,
}

impl Line {
    /// The motion that follows another.
    fn follow(&self, motion: &mut Motion) {
        motion.block = self.block;
        motion.chain = self.chain;
        motion.kind = if self.rapid {
            MotionKind::Rapid
        } else {
            MotionKind::Linear
        };
        motion.feed = self.feed;
        motion.start = motion.end;
        motion.end = self.end;
    }
}

/// A piece of a run. Lines are most of it, and what goes from core to core costs more than what is worked out again.
#[derive(Default)]
struct Batch {
    order: Vec<Told>,
    motions: Vec<(Motion, InForce)>,
    lines: Vec<Line>,
    faults: Vec<Fault>,
    /// A motion was told, in this batch or before it.
    begun: bool,
}

impl Sink for Batch {
    fn motion(&mut self, motion: &Motion, state: &ModalState) {
        self.order.push(Told::Motion);
        self.motions.push((*motion, InForce::of(state)));
        self.begun = true;
    }
    fn next_line(&mut self, motion: &Motion, state: &ModalState) {
        if !self.begun {
            return self.motion(motion, state);
        }
        self.order.push(Told::Line);
        self.lines.push(Line {
            block: motion.block,
            chain: motion.chain,
            rapid: matches!(motion.kind, MotionKind::Rapid),
            feed: motion.feed,
            end: motion.end,
        });
    }
    fn fault(&mut self, fault: Fault) {
        self.order.push(Told::Fault);
        self.faults.push(fault);
    }
}

impl Batch {
    /// Shows the pass what was told; the batch is empty then and keeps its storage. `last`: the motion told last.
    fn show(&mut self, pass: &mut Pass<'_>, last: &mut Option<Motion>) {
        let (mut motions, mut lines) = (self.motions.iter(), self.lines.iter());
        let mut faults = self.faults.drain(..);
        for told in self.order.drain(..) {
            match told {
                Told::Motion => {
                    if let Some((motion, in_force)) = motions.next() {
                        pass.take_motion(motion, *in_force);
                        *last = Some(*motion);
                    }
                }
                Told::Line => {
                    if let (Some(line), Some(motion)) = (lines.next(), last.as_mut()) {
                        line.follow(motion);
                        pass.take_line(motion);
                    }
                }
                Told::Fault => faults.by_ref().take(1).for_each(|fault| pass.fault(fault)),
                Told::Ran(block) => _ = pass.ran(block),
            }
        }
        drop(faults);
        self.motions.clear();
        self.lines.clear();
    }
}

/// Runs a program on a thread of its own and shows the pass what it tells; the interpreter as it is at the end.
pub(crate) fn run(
    program: &Program,
    mut interpreter: Interpreter<'static>,
    pass: &mut Pass<'_>,
) -> Interpreter<'static> {
    let (full, filled) = sync_channel(BATCHES);
    let (empty, emptied) = sync_channel::<Batch>(BATCHES);
    for _ in 0..BATCHES {
        // there is room for all of them
        _ = empty.send(Batch::default());
    }
    std::thread::scope(|scope| {
        let runner = scope.spawn(move || {
            tell(program, &mut interpreter, &full, &emptied);
            interpreter
        });
        let mut last = None;
        for mut batch in filled {
            batch.show(pass, &mut last);
            // whoever runs the program may have come to its end
            _ = empty.send(batch);
        }
        match runner.join() {
            Ok(interpreter) => interpreter,
            Err(panic) => std::panic::resume_unwind(panic),
        }
    })
}

/// Runs the program and hands over what it tells, as long as anybody listens.
fn tell(
    program: &Program,
    interpreter: &mut Interpreter<'static>,
    full: &SyncSender<Batch>,
    emptied: &Receiver<Batch>,
) {
    let mut batch = Batch::default();
    loop {
        let ran = interpreter.advance(program, &mut batch);
        if let Some(block) = ran {
            batch.order.push(Told::Ran(block));
            if batch.order.len() < BATCH {
                continue;
            }
        }
        let begun = batch.begun;
        if full.send(batch).is_err() || ran.is_none() {
            return;
        }
        let Ok(next) = emptied.recv() else { return };
        batch = next;
        batch.begun = begun;
    }
}
