//! Floor 5: proofs. Proves, refutes with a witness, or reports as unknown, that one program does the same as another; and re-checks
//! certificates from scratch.
//!
//! It knows neither rules nor rewrites nor any search: what it trusts is floors 0 to 3 and itself.
mod canonical;
mod certificate;
mod chain;
mod chosen;
mod claim;
mod compare;
pub mod conversion;
mod curve;
mod difference;
mod digest;
mod library;
mod path;
pub mod postures;
mod proof;
mod recheck;
mod text;
mod unlike;
mod verdict;

pub use certificate::{
    Certificate, MotionChange, MotionCounts, NamedDigest, PostureCosts, RotaryChange, SCHEMA, TextChange, TextDigest,
    Worst, WorstChanges,
};
pub use chain::{CHAIN_SCHEMA, Chain, ChainStep};
pub use claim::Claim;
pub use recheck::{certify, certify_across, certify_with_libraries, recheck};
pub use verdict::{Gap, Outcome, Witness};
