//! The machines that are built in (samples/machines, embedded).
use crate::{Machine, load};
use std::sync::OnceLock;

/// Names of the machines that are built in.
pub const BUILTIN_MACHINES: &[&str] = &["mikron-ucp710", "ferrari-bc", "maho-600e", "mill-3axis"];

/// The files, in the order of [`BUILTIN_MACHINES`].
const FILES: [&str; 4] = [
    include_str!("../../samples/machines/mikron-ucp710.toml"),
    include_str!("../../samples/machines/ferrari-bc.toml"),
    include_str!("../../samples/machines/maho-600e.toml"),
    include_str!("../../samples/machines/mill-3axis.toml"),
];

static LOADED: [OnceLock<Option<Machine>>; 4] = [const { OnceLock::new() }; 4];

/// A built-in machine by name; loaded once. `None`: no machine of that name (every embedded file loads; a test says so).
pub fn builtin(name: &str) -> Option<&'static Machine> {
    let index = BUILTIN_MACHINES.iter().position(|&known| known == name)?;
    LOADED[index].get_or_init(|| load(name, FILES[index]).ok()).as_ref()
}

/// The text of a built-in machine's file, as a start for a machine of one's own.
pub fn builtin_source(name: &str) -> Option<&'static str> {
    BUILTIN_MACHINES
        .iter()
        .position(|&known| known == name)
        .map(|index| FILES[index])
}
