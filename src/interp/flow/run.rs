//! Runs the blocks of a program with jumps, loops and calls in the control's order.
use super::through::Through;
use super::{Label, Trail, Transfer};
use crate::Sink;
use crate::iso::Iso;
use crate::{Fault, FaultKind, Frame};
use std::sync::Arc;
use trunnion_flow::{BlockBudget, Called};
use trunnion_syntax::{BlockId, Program, TextRange};

/// The program that runs: the main one, or one that it calls from another file.
pub(crate) struct Running<'p> {
    pub(crate) main: &'p Program,
    pub(crate) called: Option<&'p Called>,
}

impl<'p> Running<'p> {
    /// Its text.
    pub(crate) fn program(&self) -> &'p Program {
        self.called.map_or(self.main, |called| &called.program)
    }
}

impl Trail {
    /// The other file that runs.
    pub(crate) fn called(&self) -> Option<Arc<Called>> {
        self.library.file(self.course.place().file)
    }
}

impl Iso<'_> {
    /// The next block of a program that has jumps, loops or calls.
    #[cold]
    #[inline(never)]
    pub(crate) fn advance_deep(&mut self, main: &Program, sink: &mut impl Sink) -> Option<BlockId> {
        let next = self.flow.next;
        let trail = self.flow.trail.as_mut()?;
        let place = trail.course.place();
        let called = trail.called();
        let block = if called.is_none() { BlockId(next) } else { place.main };
        let running = Running {
            main,
            called: called.as_deref(),
        };
        let bytes = running.program().block(BlockId(next)).range().as_usize().len() as u64;
        let most = self
            .core
            .setup
            .limits
            .work(main.block_count() as u64, main.source().len() as u64);
        let fuel = trail.course.count(bytes, most);
        if fuel != BlockBudget::Left {
            self.out_of_fuel(fuel, main, sink);
            return Some(block);
        }
        self.flow.next = next + 1;
        let content = self.core.last_content;
        let mut through = Through {
            reported: std::mem::take(&mut trail.reported),
            again: called.is_none() && trail.course.has_run(next),
            place,
            called: running.called,
            moved: false,
            sink,
        };
        let calls = self.core.chain;
        if let Some(called) = running.called {
            self.core.chain = trail.course.stand(calls, next, || frame_of(called, next));
        }
        self.step_iso(&running.program().block(BlockId(next)), &mut through);
        self.core.chain = calls;
        let (reported, moved) = (through.reported, through.moved);
        if let Some(trail) = &mut self.flow.trail {
            trail.reported = reported;
        }
        if running.called.is_some() {
            self.core.last_content = content;
            if self.core.state.ended && !self.core.proper_end {
                // the % at the end of the other file
                self.core.state.ended = false;
                self.flow.next = u32::MAX;
            }
        }
        self.after_block(&running, next, moved, sink);
        Some(block)
    }

    /// Does what the first block with a jump, loop, call or macro statement requests.
    #[cold]
    pub(crate) fn first_statement(&mut self, main: &Program, block: BlockId, sink: &mut impl Sink) {
        self.flow.trail();
        let running = Running { main, called: None };
        self.after_block(&running, block.0, false, sink);
    }

    /// Does what the block that has run requests, and ends the run if nothing is left.
    pub(crate) fn after_block(&mut self, running: &Running<'_>, from: u32, moved: bool, sink: &mut impl Sink) {
        if self.flow.trail.is_none() {
            return;
        }
        let pending = self.asked_for();
        if self.core.state.ended {
            return self.end(running.main, sink);
        }
        let pending = pending.or_else(|| self.modal_of_task(running, from, moved, sink));
        let pending = pending.or_else(|| {
            let range = || running.program().block(BlockId(from)).range();
            let deep = self.flow.deep.as_ref().filter(|_| moved)?;
            deep.modal_call(range).map(Transfer::Call)
        });
        if let Some(pending) = pending {
            self.transfer(pending, running, from, sink);
        }
        self.section_ends();
        while !self.flow.finished && !self.core.state.ended && self.runs_out(running.main) {
            self.ran_out(running.main, sink);
        }
        if self.core.state.ended {
            self.end(running.main, sink);
        }
    }

    /// The call of MODIN after a block that has moved.
    fn modal_of_task(
        &mut self,
        running: &Running<'_>,
        from: u32,
        moved: bool,
        sink: &mut impl Sink,
    ) -> Option<Transfer> {
        let again = std::mem::take(&mut self.memory.own.acts_again);
        match self.modal_task().filter(|_| moved || again)? {
            Ok(calling) => Some(Transfer::Call(calling)),
            Err(what) => {
                let range = running.program().block(BlockId(from)).range();
                self.tell_of_flow(running, from, (range, FaultKind::NotDecided { what }), sink);
                Some(Transfer::End)
            }
        }
    }

    /// What the current block requests, in any language.
    fn asked_for(&mut self) -> Option<Transfer> {
        let deep = self.flow.deep.as_mut().and_then(|deep| deep.pending.take());
        deep.or_else(|| self.memory.own.pending.take())
    }

    /// Everything that may change the outcome of a decision has been counted.
    pub(crate) fn changes(&self) -> u64 {
        let deep = self.flow.deep.as_ref().map_or(0, |deep| deep.variables.changes);
        deep + self.memory.own.changes
    }

    /// Whether the text of the program that runs is at its end.
    fn runs_out(&self, main: &Program) -> bool {
        let Some(trail) = &self.flow.trail else { return false };
        let end = match (trail.course.place().section, trail.called()) {
            (Some(section), _) => section.1,
            (None, Some(called)) => called.program.block_count() as u32,
            (None, None) => main.block_count() as u32,
        };
        self.flow.next >= end
    }

    /// The run cannot continue: nothing after it is followed.
    pub(crate) fn stop(&mut self) {
        self.core.state.ended = true;
        // what is missing is reported already
        self.core.proper_end = true;
    }

    /// Reports a fact about a block of the program that runs.
    pub(crate) fn tell_of_flow(
        &mut self,
        running: &Running<'_>,
        block: u32,
        (range, kind): (TextRange, FaultKind),
        sink: &mut impl Sink,
    ) {
        let Some(trail) = &mut self.flow.trail else { return };
        let mut through = Through {
            reported: std::mem::take(&mut trail.reported),
            again: false,
            place: trail.course.place(),
            called: running.called,
            moved: false,
            sink,
        };
        through.fault(Fault {
            place: None,
            block: BlockId(block),
            range,
            kind,
        });
        trail.reported = through.reported;
    }

    /// A loop is proved to be endless, or the bounds of the run are reached: then the loop that was repeated most often does not end.
    fn out_of_fuel(&mut self, fuel: BlockBudget, main: &Program, sink: &mut impl Sink) {
        self.stop();
        if let (Some(trail), BlockBudget::Out { most, proved, blocks }) = (&self.flow.trail, fuel) {
            let place = trail.course.place();
            let block = match most {
                Some((0, block)) => BlockId(block),
                _ if place.file != 0 => place.main,
                _ => BlockId(self.flow.next),
            };
            let kind = if trail.called_unread {
                let what = "whether this loop ends depends on a called program that is missing".to_owned();
                FaultKind::NotDecided { what }
            } else {
                FaultKind::EndlessLoop { blocks, proved }
            };
            sink.fault(Fault {
                place: None,
                block,
                range: main.block(block).range(),
                kind,
            });
        }
        self.end(main, sink);
    }
}

/// The block of another file as the place of a motion.
fn frame_of(called: &Called, block: u32) -> Frame {
    let program = &called.program;
    Frame {
        file: called.path.clone(),
        line: block + 1,
        what: program.text(program.block(BlockId(block)).range()).trim().to_owned(),
        is_place: true,
    }
}

impl Label {
    /// A sequence number.
    pub(crate) fn number(number: u32, range: TextRange) -> Self {
        let key = trunnion_flow::Key::Number(number);
        Self {
            key,
            range,
            may_miss: false,
        }
    }
}
