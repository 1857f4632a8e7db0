//! The fold: a program's blocks through the modal state.
use crate::{Fault, ModalState, Motion, Setup};
use trunnion_dialect::Dialect;
use trunnion_syntax::{BlockId, Program};

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
}

impl<'d> Interpreter<'d> {
    /// At the start of a program.
    pub fn new(dialect: &'d Dialect, setup: &Setup) -> Self {
        let _ = (dialect, setup);
        todo!()
    }
    /// Runs one block.
    pub fn step(&mut self, program: &Program, block: BlockId, sink: &mut impl Sink) {
        let _ = (program, block, sink);
        todo!()
    }
}

/// Runs a whole program.
pub fn run(program: &Program, dialect: &Dialect, setup: &Setup, sink: &mut impl Sink) {
    let mut interpreter = Interpreter::new(dialect, setup);
    for id in 0..program.block_count() as u32 {
        interpreter.step(program, BlockId(id), sink);
        sink.block_done(BlockId(id), &interpreter);
    }
}
