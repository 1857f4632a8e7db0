//! Floor 6: proposes. A rewrite reads an analysed program and proposes edits with a claim; `certify` decides.
//!
//! It does no I/O and never vouches for itself.
mod propose;
mod rewrites;

pub use propose::{Attempt, Options, Proposal, Rewrite, attempt};
pub use rewrites::{rewrite, rewrites};
