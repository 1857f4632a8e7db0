//! Floor 6, below workspace: the one place that reads and writes the user's files. A file is read whole or refused; it is written whole or not at all.
//!
//! It knows no programs. Source of the promises: docs/files.md.
mod error;
mod identity;
mod output;
mod read;
mod temporary;

pub use error::FileError;
pub use output::{Outputs, Target};
pub use read::{Input, Seen, read, read_text};
pub use temporary::{sweep_beside, write_kept};
