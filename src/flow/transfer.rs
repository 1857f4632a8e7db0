//! What a block requests apart from its motion.
use crate::Search;

/// What a block requests. `L`: a label of the language with the place of the jump; `C`: a call with what is handed over; `R`: what a
/// return carries.
#[derive(Clone, Debug, PartialEq)]
pub enum Transfer<L, C, R> {
    /// The next block.
    Next,
    /// To a label.
    Jump(L, Search),
    /// The block opens a loop or branch: whether its body runs.
    Open(bool),
    /// The body of a branch ends at its `ELSE`: continue after the whole branch.
    Leave,
    /// The end of a loop: back to the block that opens it.
    Close,
    /// Another program.
    Call(C),
    /// Back to the caller.
    Return(R),
    /// The section from one block to another runs this many times, then the run continues here.
    Repeat {
        /// First block of the section.
        first: u32,
        /// Its last block.
        last: u32,
        /// How often; at least once.
        times: u32,
    },
    /// The run ends here: it cannot be followed, or the program stops itself with an alarm.
    End,
}
