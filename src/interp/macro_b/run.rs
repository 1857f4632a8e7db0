//! Runs the blocks of a program with macro statements in the control's order.
use super::through::Through;
use super::{Called, Pending};
use crate::run::{Interpreter, Sink};
use crate::{Fault, FaultKind, Frame};
use std::sync::Arc;
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

impl Interpreter<'_> {
    /// The next block of a program that has macro statements.
    #[cold]
    #[inline(never)]
    pub(crate) fn advance_deep(&mut self, main: &Program, sink: &mut impl Sink) -> Option<BlockId> {
        let next = self.flow.next;
        let limit = self.setup.limits.blocks.saturating_add(main.block_count() as u64);
        let deep = self.flow.deep.as_mut()?;
        let place = deep.place;
        let called = Self::called(deep, place.file);
        let block = if called.is_none() { BlockId(next) } else { place.main };
        deep.executed += 1;
        if deep.executed > limit || deep.endless.is_some() {
            self.out_of_fuel(main, sink);
            return Some(block);
        }
        let running = Running {
            main,
            called: called.as_deref(),
        };
        self.flow.next = next + 1;
        let content = self.memory.last_content;
        let mut through = Through {
            told: std::mem::take(&mut deep.told),
            again: called.is_none() && deep.ran.has(next),
            place,
            called: running.called,
            moved: false,
            sink,
        };
        let calls = self.chain;
        if let (Some(called), Some(deep)) = (running.called, &mut self.flow.deep) {
            let frame = || frame_of(called, next);
            self.chain = Arc::make_mut(&mut deep.chains).stand(calls, place.file, next, frame);
        }
        self.step_iso(&running.program().block(BlockId(next)), &mut through);
        self.chain = calls;
        let (told, moved) = (through.told, through.moved);
        if let Some(deep) = &mut self.flow.deep {
            deep.told = told;
        }
        if running.called.is_some() {
            self.memory.last_content = content;
            if self.state.ended && !self.memory.proper_end {
                // the % at the end of the other file
                self.state.ended = false;
                self.flow.next = u32::MAX;
            }
        }
        self.after_block(&running, next, moved, sink);
        Some(block)
    }

    /// Does what the first block with a macro statement asks for.
    #[cold]
    pub(crate) fn first_statement(&mut self, main: &Program, block: BlockId, sink: &mut impl Sink) {
        let running = Running { main, called: None };
        self.after_block(&running, block.0, false, sink);
    }

    /// The other file that runs.
    pub(crate) fn called(deep: &super::Deep, file: u16) -> Option<Arc<Called>> {
        deep.files.get(usize::from(file).checked_sub(1)?).map(Arc::clone)
    }

    /// Does what the block that has run asks for, and ends the run where nothing is left.
    pub(crate) fn after_block(&mut self, running: &Running<'_>, from: u32, moved: bool, sink: &mut impl Sink) {
        let Some(deep) = &mut self.flow.deep else { return };
        let pending = deep.pending.take();
        if self.state.ended {
            return self.end(running.main, sink);
        }
        let pending = pending.or_else(|| {
            let range = || running.program().block(BlockId(from)).range();
            if moved { deep.modal_call(range) } else { None }
        });
        if let Some(pending) = pending {
            self.transfer(pending, running, from, sink);
        }
        while !self.flow.finished && !self.state.ended && self.runs_out(running.main) {
            self.ran_out(running.main, sink);
        }
        if self.state.ended {
            self.end(running.main, sink);
        }
    }

    /// Whether the text of the program that runs is at its end.
    fn runs_out(&self, main: &Program) -> bool {
        let Some(deep) = &self.flow.deep else { return false };
        let end = match (deep.place.section, Self::called(deep, deep.place.file)) {
            (Some(section), _) => section.1,
            (None, Some(called)) => called.program.block_count() as u32,
            (None, None) => main.block_count() as u32,
        };
        self.flow.next >= end
    }

    /// The run cannot go on: nothing after it is followed.
    pub(crate) fn stop(&mut self) {
        self.state.ended = true;
        // what is missing is said already
        self.memory.proper_end = true;
    }

    /// Tells a fact about a block of the program that runs.
    pub(crate) fn tell_of_flow(
        &mut self,
        running: &Running<'_>,
        block: u32,
        (range, kind): (TextRange, FaultKind),
        sink: &mut impl Sink,
    ) {
        let Some(deep) = &mut self.flow.deep else { return };
        let mut through = Through {
            told: std::mem::take(&mut deep.told),
            again: false,
            place: deep.place,
            called: running.called,
            moved: false,
            sink,
        };
        through.fault(Fault {
            block: BlockId(block),
            range,
            kind,
        });
        deep.told = through.told;
    }

    /// A loop is proved to be endless, or the bounds of the run are reached: then the loop that began anew most often does not end.
    fn out_of_fuel(&mut self, main: &Program, sink: &mut impl Sink) {
        self.stop();
        if let Some(deep) = &self.flow.deep {
            #[expect(
                clippy::disallowed_methods,
                reason = "of loops that began anew equally often the first one wins, whatever the order"
            )]
            let most = deep.turns.iter();
            let most = most.max_by_key(|(place, turns)| (turns.count, std::cmp::Reverse(**place)));
            let block = match deep.endless.or(most.map(|most| *most.0)) {
                Some((0, block)) => BlockId(block),
                _ if deep.place.file != 0 => deep.place.main,
                _ => BlockId(self.flow.next),
            };
            let blocks = deep.executed - 1;
            sink.fault(Fault {
                block,
                range: main.block(block).range(),
                kind: FaultKind::EndlessLoop {
                    blocks,
                    proved: deep.endless.is_some(),
                },
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

impl super::Deep {
    /// The macro that is called after a motion, if one is.
    fn modal_call(&self, range: impl FnOnce() -> TextRange) -> Option<Pending> {
        let place = self.modal_active.checked_sub(1)?;
        let modal = self.modal.get(place)?;
        Some(Pending::Call(super::Calling {
            code: super::FlowCode::Macro,
            program: modal.program.clone(),
            times: modal.times,
            arguments: Some(modal.arguments.clone()),
            range: range(),
            modal: Some(place),
        }))
    }
}

impl super::Flow {
    /// The block of the main program to which a block of the program that runs belongs.
    #[inline]
    pub(crate) fn main_block(&self, block: BlockId) -> BlockId {
        self.called_at.unwrap_or(block)
    }
    /// The calls of a chain, outermost first.
    /// The value of a variable as it is written.
    pub(crate) fn variable(&self, text: &str) -> Option<f64> {
        self.deep.as_ref()?.variables.written(text)
    }

    pub(crate) fn chain(&self, chain: crate::ChainId) -> Vec<crate::Frame> {
        self.deep
            .as_ref()
            .map_or_else(Vec::new, |deep| deep.chains.frames(chain))
    }
}
