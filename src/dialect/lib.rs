//! Floor 2: what letters and codes mean on a control. One dialect is one TOML table in `grammar/dialects`.
//!
//! It does not know motions, machines or files.
mod action;
mod advice;
mod assemble;
mod builtin;
mod code;
mod control_names;
mod decisions;
mod detect;
mod dialect;
mod facts;
mod file_keys;
mod modeline;
mod nearest;
mod own_table;
mod path_mode;
mod pattern;
mod plain_toml;
mod power_on;
mod quirks;
mod schema;
mod textmate;
mod toml_place;
mod unsupported;

pub use action::Role;
pub use advice::{Advice, RotaryFeed};
pub use builtin::{BUILTIN_NAMES, builtin};
pub use code::{Code, CodeKind};
pub use control_names::dialect_hint;
pub use decisions::{Expressions, Language, LengthAfterReturn, LengthChange, Macros, ToolWord, WholeNumbers};
pub use detect::{
    Detected, Foreign, Surroundings, declared, detect, detect_on, is_program_file_name, looks_like_program, named,
    not_text, possible_lathe, program_extensions,
};
pub use dialect::{Alarm, ArcTolerance, Dialect, Quirks};
pub use facts::DialectFacts;
pub use file_keys::{Key, KeyFile};
pub use modeline::{Modeline, modeline};
pub use nearest::{did_you_mean, nearest, or_known};
pub use own_table::TableError;
pub use path_mode::PathMode;
pub use plain_toml::plain_toml;
pub use power_on::known_at_power_on;
pub use schema::{DialectError, Owner, load};
pub use textmate::textmate;
pub use toml_place::TomlPlace;
pub use trunnion_vocabulary::{Action, Plane};

pub use unsupported::{UNSUPPORTED, Unsupported, unsupported};

#[cfg(test)]
mod tests;
