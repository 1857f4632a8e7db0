//! The fold: a program's blocks through the modal state.
use crate::codes::Found;
use crate::memory::Memory;
use crate::{ChainId, Fault, FaultKind, Frame, ModalState, ProgramRun, Setup, Sink};
use trunnion_dialect::Dialect;
use trunnion_syntax::{BlockId, Format, Program, TextRange};

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
    pub(crate) flow: crate::flow::Flow,
    /// The run of a LinuxCNC program, once begun.
    pub(crate) rs274: Option<Box<crate::rs274::Rs274>>,
    /// The calls in which the block in hand runs.
    pub(crate) chain: ChainId,
    /// Motions of cycles so far: they have a bound as executed blocks have.
    pub(crate) cycle_motions: u64,
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
    /// A fact; an empty range means the whole block.
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
            state: crate::start::at_start(dialect),
            memory: Memory::default(),
            codes: Vec::new(),
            apt: crate::apt::AptState::default(),
            flow: crate::flow::Flow::default(),
            rs274: None,
            chain: ChainId::MAIN,
            cycle_motions: 0,
        };
        if let Some(unit) = setup.control.units {
            let mm = unit.mm();
            interpreter.state.units(mm, mm);
        }
        if dialect.quirks.first_offset_at_start {
            let first = setup
                .work_offsets
                .iter()
                .find(|offset| offset.name.eq_ignore_ascii_case("G54"));
            if let Some(offset) = first {
                interpreter.set_zero(Some("G54".into()), offset.values);
            }
        }
        if setup.control.tcp_codes.as_ref().is_some_and(|codes| codes.at_start) {
            (interpreter.state.tcp, interpreter.memory.tcp_used) = (true, true);
        }
        interpreter.merge_tool();
        interpreter
    }

    /// Runs one block, for callers that choose the blocks themselves: jumps, loops and calls are never followed, so that nothing is
    /// known of variables after the first of them. The first step also reads the program's own declarations of tools; the step of
    /// the last block reports a missing program end. Blocks after the program's end are not run.
    pub fn step(&mut self, program: &Program, block: BlockId, sink: &mut impl Sink) {
        self.flow.follows = false;
        self.run_one(program, block, sink);
        if block.0 as usize + 1 == program.block_count() {
            self.finish(program, sink);
        }
    }

    fn run_one(&mut self, program: &Program, block: BlockId, sink: &mut impl Sink) {
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
    }

    /// Runs the next block in the order in which the control runs them: jumps, loops and calls are followed. The block, or `None`
    /// when nothing is left to run. For a block of another file it is the block of the main program whose call led there.
    ///
    /// With the last block it also reports a missing program end, and what is wrong with the text of blocks that did not run. M99
    /// of the main program ends the run: one pass is run.
    pub fn advance(&mut self, program: &Program, sink: &mut impl Sink) -> Option<BlockId> {
        if self.dialect.quirks.rs274() {
            return self.advance_rs274(program, sink);
        }
        if self.flow.finished || program.block_count() == 0 {
            return None;
        }
        if self.flow.trail.is_some() {
            return self.advance_deep(program, sink);
        }
        let block = BlockId(self.flow.next);
        self.flow.next += 1;
        self.flow.follows = true;
        self.run_one(program, block, sink);
        if self.flow.deep.is_some() || self.memory.own.pending.is_some() {
            self.first_statement(program, block, sink);
        }
        if self.state.ended || self.flow.next as usize >= program.block_count() {
            self.end(program, sink);
        }
        Some(block)
    }

    pub(crate) fn finish(&mut self, program: &Program, sink: &mut impl Sink) {
        if let Some(block) = self.memory.last_content {
            self.put_out_rest(&program.block(block), sink);
        }
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

impl ProgramRun for Interpreter<'_> {
    fn state(&self) -> &ModalState {
        &self.state
    }

    fn chain(&self, chain: ChainId) -> Vec<Frame> {
        if let Some(run) = &self.rs274 {
            return run.chain(chain);
        }
        self.flow.chain(chain)
    }

    fn motions_wait(&self) -> bool {
        match &self.rs274 {
            Some(run) => run.motions_wait(),
            None => self.memory.compensation.is_busy() || self.memory.corners.is_busy(),
        }
    }

    fn variable(&self, text: &str) -> Option<f64> {
        if let Some(run) = &self.rs274 {
            return run.variable(text);
        }
        self.flow.variable(text)
    }

    fn outliving(&self) -> Vec<(String, f64)> {
        match &self.rs274 {
            Some(run) => run.outliving(),
            None => self.flow.outliving(),
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
