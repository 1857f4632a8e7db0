//! Floor 1: what letters and codes mean on a control. One dialect is one TOML table in `grammar/dialects`.
//!
//! It does not know motions, machines or files.
mod action;
mod builtin;
mod detect;
mod dialect;
mod schema;

pub use action::{Action, Plane, Role};
pub use builtin::{BUILTIN_NAMES, builtin};
pub use detect::{Detected, detect, program_extensions};
pub use dialect::{Code, CodeKind, Dialect};
pub use schema::{DialectError, load};
