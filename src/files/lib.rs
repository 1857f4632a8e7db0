//! Floor 6, below workspace: the one place that reads and writes the user's files. A file is read whole or refused; it is written whole or not at all.
//!
//! It knows no programs. Source of the promises: docs/files.md.
mod error;
mod identity;
#[cfg(not(target_family = "wasm"))]
mod output;
#[cfg(not(target_family = "wasm"))]
mod patient;
mod read;
#[cfg(not(target_family = "wasm"))]
mod temporary;
#[cfg(not(target_family = "wasm"))]
mod used;

pub use error::FileError;
#[cfg(not(target_family = "wasm"))]
pub use output::{Outputs, Target, folder, unless_closed};
#[cfg(not(target_family = "wasm"))]
pub use patient::Patient;
pub use read::{Input, Seen, read, read_settings, read_text};
#[cfg(not(target_family = "wasm"))]
pub use temporary::{sweep_beside, write_kept};
