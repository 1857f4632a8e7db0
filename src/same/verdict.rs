//! What a comparison finds.
use core::fmt;
use trunnion_syntax::BlockId;

/// The first place where two programs differ, or where nothing can be decided.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// Block of the original program, if it has one there.
    pub before: Option<BlockId>,
    /// Block of the changed program, if it has one there.
    pub after: Option<BlockId>,
    /// What differs or is missing, with numbers and units; one sentence.
    pub what: String,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.what)
    }
}

/// The outcome of a comparison.
#[derive(Clone, Debug, PartialEq)]
pub enum Verdict {
    /// The same, as far as the claim requires.
    Same,
    /// Not the same.
    Differs(Difference),
    /// Undecided, and why.
    Unknown(Difference),
}
