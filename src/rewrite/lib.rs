//! Floor 7: proposes. A rewrite reads an analysed program and proposes edits with a claim; `certify` decides.
//!
//! It does no I/O and never vouches for itself.
mod posed_words;
mod propose;
mod reposition;
mod rewrites;
mod shortest_path;
mod slots;
mod smooth;
mod style;
mod survey;
mod taut_string;
mod unwrap;

pub use propose::{Attempt, Options, ProgrammedPoint, Proposal, Rewrite, attempt};
pub use rewrites::{rewrite, rewrites};
