//! The dialects that are built in.
use crate::Dialect;

/// Names of the dialects that are built in.
pub const BUILTIN_NAMES: &[&str] = &["iso-6983", "linuxcnc", "fanuc-30i", "sinumerik-840d", "apt"];

/// A built-in dialect by name; loaded once. `None` when there is no such name.
pub fn builtin(name: &str) -> Option<&'static Dialect> {
    let _ = name;
    todo!()
}
