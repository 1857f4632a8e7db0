//! Floor 7, next to rewrite: finds on disk what a program is checked with. Settings (`trunnion.toml`, searched upward),
//! machine (embedded or a file), dialect; and the reason for each. The command line and the language server share it,
//! so that both give the same verdict.
//!
//! It reads files and never writes. It does not know terminals or LSP.
mod error;
mod kept;
mod listing;
mod machine;
mod obstacles;
mod resolve;
mod settings;
mod subprograms;
mod table;
mod texts;

pub use error::{LoadError, shortened};
pub use machine::{FoundMachine, find_machine};
pub use resolve::{Overrides, Resolved, resolve};
pub use subprograms::Subprograms;
pub use texts::Texts;
