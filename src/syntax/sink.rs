//! Where the grammar reports problems: to a list while parsing, nowhere while reading.
use crate::{SyntaxError, SyntaxErrorKind, TextRange};

/// Takes problems.
pub(crate) trait Sink {
    /// Notes one problem.
    fn report(&mut self, kind: SyntaxErrorKind, range: TextRange);
}

impl Sink for Vec<SyntaxError> {
    fn report(&mut self, kind: SyntaxErrorKind, range: TextRange) {
        self.push(SyntaxError { kind, range });
    }
}

/// Forgets all problems: they were reported when the program was parsed.
pub(crate) struct Quiet;

impl Sink for Quiet {
    #[inline]
    fn report(&mut self, _: SyntaxErrorKind, _: TextRange) {}
}
