//! Floor 6: what a program is made of: blocks, motions, tools, distances, times, extents, calls. Nothing is judged.
//!
//! It does not know rules, terminals, JSON or files.
mod calls;
mod stop;
mod tally;

pub use calls::Call;
pub use tally::{MOST_LINES, Range, Tally, ToolUse};
