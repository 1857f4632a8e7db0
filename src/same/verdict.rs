//! What a comparison finds.
use core::fmt;
use trunnion_syntax::BlockId;

/// The first place at which two programs part, or at which nothing can be said.
#[derive(Clone, Debug, PartialEq)]
pub struct Difference {
    /// Block of the program before, if it has one there.
    pub before: Option<BlockId>,
    /// Block of the program after, if it has one there.
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
    /// The same, as far as the claim asks.
    Same,
    /// Not the same.
    Differs(Difference),
    /// Undecided, and why.
    Unknown(Difference),
}
