//! Floor 5: proofs. Proves, refutes with a witness, or reports as unknown, that one program does the same as another; and re-checks
//! certificates from scratch.
//!
//! It knows neither rules nor rewrites nor any search: what it trusts is floors 0 to 3 and itself.
mod canonical;
mod certificate;
mod chain;
mod changed;
mod chosen;
mod claim;
mod clear;
mod compare;
pub mod conversion;
mod curve;
mod difference;
mod digest;
mod feed;
mod library;
mod path;
mod pieces;
pub mod postures;
mod proof;
mod rapids;
mod recheck;
mod retracts;
mod switch;
mod text;
mod unlike;
mod verdict;

pub use certificate::{
    Certificate, MotionChange, MotionCounts, NamedDigest, PostureCosts, RapidChanges, RotaryChange, SCHEMA, TextChange,
    TextDigest, Worst, WorstChanges,
};
pub use chain::{CHAIN_SCHEMA, Chain, ChainStep};
pub use changed::{Unproved, certify_change};
pub use claim::{Claim, RefitSource};
pub use digest::same_machine;
pub use recheck::{certify, certify_across, certify_with_libraries, recheck};
pub use trunnion_same::{Apart, Change, Part};
pub use verdict::{Gap, Outcome, Witness};
