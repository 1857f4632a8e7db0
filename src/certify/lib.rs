//! Floor 4: vouches. Proves, refutes with a witness, or admits unknown, that one program is as good as another; and re-checks
//! certificates from scratch.
//!
//! It knows neither rules nor rewrites nor any search: what it trusts is floors 0 to 3 and itself.
mod certificate;
mod claim;
mod recheck;
mod verdict;

pub use certificate::{Certificate, SCHEMA};
pub use claim::Claim;
pub use recheck::{certify, recheck};
pub use verdict::{Gap, Outcome, Witness};
