//! Floor 2: what letters and codes mean on a control. One dialect is one TOML table in `grammar/dialects`.
//!
//! It does not know motions, machines or files.
mod action;
mod advice;
mod assemble;
mod builtin;
mod code;
mod decisions;
mod detect;
mod dialect;
mod facts;
mod modeline;
mod own_table;
mod pattern;
mod quirks;
mod schema;
mod signs;
mod textmate;

pub use action::Role;
pub use advice::{Advice, RotaryFeed};
pub use builtin::{BUILTIN_NAMES, builtin};
pub use code::{Code, CodeKind};
pub use decisions::{Expressions, Language, Macros, ToolWord, WholeNumbers};
pub use detect::{Detected, detect, is_program_file_name, looks_like_program, program_extensions};
pub use dialect::{Alarm, ArcTolerance, Dialect, Quirks};
pub use facts::DialectFacts;
pub use modeline::{Modeline, modeline};
pub use own_table::TableError;
pub use schema::{DialectError, Owner, load};
pub use textmate::textmate;
pub use trunnion_vocabulary::{Action, Plane};

#[cfg(test)]
mod tests;
