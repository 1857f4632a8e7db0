//! The output of a run, and its state between two blocks.
use crate::{ChainId, Fault, Frame, ModalState, Motion, Placed};
use trunnion_syntax::BlockId;

/// Receives what a run finds, in order.
pub trait Sink {
    /// A motion; `state` is the modal state after its block.
    fn motion(&mut self, motion: &Motion, state: &ModalState);
    /// A rapid or linear motion that begins where the motion before it ended and differs from it in block, chain, kind, places and feed
    /// only: what is in effect is the same but for the motion code and F.
    fn next_line(&mut self, motion: &Motion, state: &ModalState) {
        self.motion(motion, state);
    }
    /// A fault.
    fn fault(&mut self, fault: Fault);
    /// Whether faults are read. Where they are not, a run may leave them out: the text of each costs more than the rest of its block.
    fn reads_faults(&self) -> bool {
        true
    }
    /// What the program does apart from its motions, in order; only if requested. Motions may be held back by cutter
    /// compensation and come later: [`Motion::effects`] says which effects come before them.
    fn effect(&mut self, effect: Placed) {
        let _ = effect;
    }
    /// Called after each block (also those without motion).
    fn block_done(&mut self, block: BlockId, run: &dyn ProgramRun) {
        let _ = (block, run);
    }
}

/// A run of a program between two blocks.
pub trait ProgramRun {
    /// What is in effect.
    fn state(&self) -> &ModalState;
    /// The calls that led to a motion, outermost first; empty in the main program.
    fn chain(&self, chain: ChainId) -> Vec<Frame>;
    /// Whether motions are held back until a later one is known: cutter compensation, rounded corners.
    fn motions_wait(&self) -> bool;
    /// The value of a variable as it is written (`#1`, `#<name>`, `#_NAME`); NaN where it is unknown, `None` where there is none or it is
    /// vacant.
    fn variable(&self, text: &str) -> Option<f64>;
    /// Variables that keep their values after the program ends and whose value is known: Fanuc and Haas `#500` to `#999`, LinuxCNC `#31` to `#5000`, its
    /// parameter file and global names. Those of a Sinumerik come as [`crate::Effect::Store`].
    fn outliving(&self) -> Vec<(String, f64)>;
}
