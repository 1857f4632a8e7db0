//! The machines that are built in (samples/machines, embedded).
use crate::Machine;

/// Names of the machines that are built in.
pub const BUILTIN_MACHINES: &[&str] = &["mikron-ucp710", "ferrari-bc", "maho-600e", "mill-3axis"];

/// A built-in machine by name; loaded once.
pub fn builtin(name: &str) -> Option<&'static Machine> {
    let _ = name;
    todo!()
}
