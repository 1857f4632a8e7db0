//! The fold: a program's blocks through the modal state.
use crate::codes::Found;
use crate::memory::Memory;
use crate::{ChainId, Fault, FaultKind, Frame, ModalState, Motion, Setup};
use trunnion_dialect::Dialect;
use trunnion_syntax::{BlockId, Format, Program, TextRange};

/// Receives what a run finds, in order.
pub trait Sink {
    /// A motion; `state` is the modal state after its block.
    fn motion(&mut self, motion: &Motion, state: &ModalState);
    /// A fact about what is wrong.
    fn fault(&mut self, fault: Fault);
    /// Called after each block (also those without motion).
    fn block_done(&mut self, block: BlockId, interpreter: &Interpreter<'_>) {
        let _ = (block, interpreter);
    }
}

/// An interpreter between two blocks. Cloning it makes a check-point to go on from.
#[derive(Clone)]
pub struct Interpreter<'d> {
    pub(crate) dialect: &'d Dialect,
    pub(crate) setup: std::sync::Arc<Setup>,
    /// What is in force.
    pub state: ModalState,
    pub(crate) memory: Memory<'d>,
    /// Codes of the block in hand: kept only for its storage.
    pub(crate) codes: Vec<Found<'d>>,
    pub(crate) apt: crate::apt::AptState,
    /// The block that [`Self::advance`] runs next.
    next_block: u32,
    /// The calls in which the block in hand runs.
    pub(crate) chain: ChainId,
}

/// Where facts about the block in hand go.
pub(crate) struct Report<'a> {
    pub(crate) program: &'a Program,
    pub(crate) block: BlockId,
    /// Bytes of the record, in APT.
    pub(crate) record: Option<TextRange>,
    pub(crate) faults: &'a mut dyn FnMut(Fault),
}

impl Report<'_> {
    /// Bytes of the record or block in hand.
    #[cold]
    pub(crate) fn whole(&self) -> TextRange {
        self.record.unwrap_or_else(|| self.program.block(self.block).range())
    }
    /// A fact; an empty range stands for the whole block.
    #[cold]
    pub(crate) fn fault(&mut self, range: TextRange, kind: FaultKind) {
        let range = if range == TextRange::default() {
            self.whole()
        } else {
            range
        };
        (self.faults)(Fault {
            block: self.block,
            range,
            kind,
        });
    }
}

impl<'d> Interpreter<'d> {
    /// At the start of a program.
    pub fn new(dialect: &'d Dialect, setup: &Setup) -> Self {
        let mut interpreter = Self {
            dialect,
            setup: std::sync::Arc::new(setup.clone()),
            state: ModalState::at_start(dialect),
            memory: Memory::default(),
            codes: Vec::new(),
            apt: crate::apt::AptState::default(),
            next_block: 0,
            chain: ChainId::MAIN,
        };
        if dialect.quirks.first_offset_at_start {
            let first = setup
                .work_offsets
                .iter()
                .find(|offset| offset.name.eq_ignore_ascii_case("G54"));
            if let Some(offset) = first {
                interpreter.set_zero(Some("G54".into()), offset.values);
            }
        }
        interpreter.merge_tool();
        interpreter
    }

    /// Runs one block. The first step also reads the program's own declarations of tools; the step of the last block reports a
    /// missing program end. Blocks after the program's end are not run.
    pub fn step(&mut self, program: &Program, block: BlockId, sink: &mut impl Sink) {
        if !self.memory.directives_read {
            self.declare(program);
        }
        if block.0 as usize >= program.block_count() {
            return;
        }
        if !self.state.ended {
            let view = program.block(block);
            match program.options().format {
                Format::Iso => self.step_iso(&view, sink),
                Format::Apt => self.step_apt(&view, sink),
            }
        }
        if block.0 as usize + 1 == program.block_count() {
            self.finish(program, sink);
        }
    }

    /// Runs the next block in the order in which the control runs them; the block, or `None` when nothing is left to run.
    pub fn advance(&mut self, program: &Program, sink: &mut impl Sink) -> Option<BlockId> {
        let block = BlockId(self.next_block);
        if self.next_block as usize >= program.block_count() {
            return None;
        }
        self.next_block += 1;
        self.step(program, block, sink);
        Some(block)
    }

    /// The calls that led to a motion, outermost first; empty in the main program.
    pub fn chain(&self, chain: ChainId) -> Vec<Frame> {
        let _ = chain;
        Vec::new()
    }

    fn finish(&mut self, program: &Program, sink: &mut impl Sink) {
        if let Some(block) = self.memory.last_content.filter(|_| !self.memory.proper_end) {
            let range = program.block(block).range();
            sink.fault(Fault {
                block,
                range,
                kind: FaultKind::MissingProgramEnd,
            });
        }
    }
}

/// Runs a whole program.
pub fn run(program: &Program, dialect: &Dialect, setup: &Setup, sink: &mut impl Sink) {
    let mut interpreter = Interpreter::new(dialect, setup);
    while let Some(block) = interpreter.advance(program, sink) {
        sink.block_done(block, &interpreter);
    }
}
