//! Storage of formulas that are not needed any more, for the next ones: reading a line needs no new memory.
use crate::code::{Code, Formula, Step};
use crate::{Cursor, FormulaError, Grammar, compile};

/// This many pieces are kept at most.
const KEPT: usize = 16;

/// Kept storage.
#[derive(Debug, Default)]
pub struct Pool(Vec<Vec<Step>>);

impl Pool {
    /// Takes a formula's storage.
    #[inline]
    pub fn take_back(&mut self, formula: Formula) {
        if let Code::Steps { mut steps, .. } = formula.code
            && self.0.len() < KEPT
        {
            steps.clear();
            self.0.push(steps);
        }
    }

    /// Like [`crate::value_or_error`], with storage from the pool.
    #[inline]
    pub fn value_or_error(&mut self, cursor: &mut Cursor<'_>, grammar: Grammar) -> (Formula, Option<FormulaError>) {
        compile::value_with(cursor, grammar, &mut self.0)
    }
}

/// A copy is empty.
impl Clone for Pool {
    fn clone(&self) -> Self {
        Self::default()
    }
}
