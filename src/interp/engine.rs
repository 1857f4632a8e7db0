//! What the engines of all languages have in common.
use crate::core::Core;
use crate::{Argument, ChainId, Frame, Sink};
use trunnion_syntax::{BlockId, Program};

/// A language engine between two blocks. Cloning it makes a check-point to continue from.
pub(crate) trait Engine<'d>: Clone {
    /// What every engine has.
    fn core(&self) -> &Core<'d>;
    /// The same, to be changed.
    fn core_mut(&mut self) -> &mut Core<'d>;
    /// Reads what the run needs of the whole text before its first block. The first [`Self::advance`] does it otherwise.
    fn read_whole(&mut self, program: &Program) {
        self.core_mut().declare(program);
    }
    /// Runs the next block in the control's order; see [`crate::Interpreter::advance`].
    fn advance(&mut self, program: &Program, sink: &mut impl Sink) -> Option<BlockId>;
    /// The calls that led to a motion.
    fn chain(&self, chain: ChainId) -> Vec<Frame> {
        let _ = chain;
        Vec::new()
    }
    /// Whether motions are held back until a later one is known.
    fn motions_wait(&self) -> bool {
        false
    }
    /// The value of a variable as it is written.
    fn variable(&self, text: &str) -> Option<f64> {
        let _ = text;
        None
    }
    /// Variables that keep their values after the program ends and whose value is known.
    fn outliving(&self) -> Vec<(String, f64)> {
        Vec::new()
    }
    /// The same for variables that hold texts.
    fn outliving_texts(&self) -> Vec<(String, String)> {
        Vec::new()
    }
    /// See [`crate::Interpreter::turned`].
    fn turned(&self) -> Vec<f64> {
        Vec::new()
    }
    /// What a cycle has kept and a program that is missing could use.
    fn cycle_data(&self) -> Vec<Argument> {
        Vec::new()
    }
    /// How many motions its cycles have made, and steps that they worked out in vain.
    fn cycle_work(&self) -> u64 {
        0
    }
    /// Whether drilling cycles return to the R level.
    fn returns_to_r(&self) -> bool {
        false
    }
    /// All variables that are known, or were known before something ran that is not followed, by name.
    fn known_variables(&self) -> Vec<Argument> {
        let known = self.outliving().into_iter();
        known.map(|(name, value)| Argument::number(name, value)).collect()
    }
    /// How many entries of lists that grow with the program a check-point copies, beside those of [`Core`].
    fn copied(&self) -> usize {
        0
    }
    /// The values of the variables that a text names.
    fn values_in(&self, text: &str) -> Vec<Argument> {
        crate::written::values(text, |name| self.variable(name))
    }
    /// The text of a block with the variables in it replaced by their values.
    fn resolved_text(&self, text: &str) -> String {
        text.to_owned()
    }
}
