//! Floor 7: what `check` found in one file, as data that is written as JSON (`trunnion-check/1`), with the fingerprints of the findings.
//! The command line and the checker for browsers share it, so that both write the same document.
//!
//! It opens no files and knows neither terminals nor the other formats.
mod file;
mod fingerprint;
mod words;

pub use file::{Coverage, File, GivenUp, Item, Marked, NotRun, Outcome, Related, Subject, Values, file, tidy};
pub use fingerprint::fingerprints;
pub use words::{severity, weight};

/// The name of the document's schema.
pub const SCHEMA: &str = "trunnion-check/1";
