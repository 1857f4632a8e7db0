//! The calls that lead to a motion.

/// The chain of calls and loops that led to a motion; [`ChainId::MAIN`] in the main program outside of any call.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct ChainId(pub u32);

impl ChainId {
    /// The main program, outside of any call.
    pub const MAIN: Self = Self(0);
}

/// One call in a chain, outermost first; the last may be the block of another file that contains a motion.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Frame {
    /// The file with the call or block; empty for the main program.
    pub file: String,
    /// Line of the call or block, from 1.
    pub line: u32,
    /// What is called, as written: `o100 call [1]`, `M98 P1000`, `G65 P9010`; or the block of the motion.
    pub what: String,
    /// Not a call: the block that contains the motion, in a called file.
    pub is_place: bool,
}
