//! The machines that are built in (samples/machines, embedded).
use crate::{Machine, load};
use std::sync::OnceLock;

/// Names of the machines that are built in.
pub const BUILTIN_MACHINES: &[&str] = &[
    "mikron-ucp710",
    "ferrari-bc",
    "maho-600e",
    "mill-3axis",
    "boring-mill-w",
    "fork-head-ca",
    "gantry-mill",
    "head-table-bc",
    "lathe-2axis",
    "linuxcnc-bridge-mill",
    "linuxcnc-max5",
    "linuxcnc-xyzab-tdr",
    "linuxcnc-xyzac-trt",
    "linuxcnc-xyzac-trt-conventional",
    "linuxcnc-xyzacb-trsrn",
    "linuxcnc-xyzbc-trt",
    "linuxcnc-xyzbc-trt-conventional",
    "linuxcnc-xyzbca-trsrn",
    "mill-4axis-a",
    "mill-turn-bc",
    "nutating-head-b45",
    "nutating-head-b50",
    "nutating-table-b45",
    "pocketnc-v2revp",
    "trunnion-3plus2",
];

/// The files, in the order of [`BUILTIN_MACHINES`].
const FILES: [&str; COUNT] = [
    include_str!("../../../samples/machines/mikron-ucp710.toml"),
    include_str!("../../../samples/machines/ferrari-bc.toml"),
    include_str!("../../../samples/machines/maho-600e.toml"),
    include_str!("../../../samples/machines/mill-3axis.toml"),
    include_str!("../../../samples/machines/boring-mill-w.toml"),
    include_str!("../../../samples/machines/fork-head-ca.toml"),
    include_str!("../../../samples/machines/gantry-mill.toml"),
    include_str!("../../../samples/machines/head-table-bc.toml"),
    include_str!("../../../samples/machines/lathe-2axis.toml"),
    include_str!("../../../samples/machines/linuxcnc-bridge-mill.toml"),
    include_str!("../../../samples/machines/linuxcnc-max5.toml"),
    include_str!("../../../samples/machines/linuxcnc-xyzab-tdr.toml"),
    include_str!("../../../samples/machines/linuxcnc-xyzac-trt.toml"),
    include_str!("../../../samples/machines/linuxcnc-xyzac-trt-conventional.toml"),
    include_str!("../../../samples/machines/linuxcnc-xyzacb-trsrn.toml"),
    include_str!("../../../samples/machines/linuxcnc-xyzbc-trt.toml"),
    include_str!("../../../samples/machines/linuxcnc-xyzbc-trt-conventional.toml"),
    include_str!("../../../samples/machines/linuxcnc-xyzbca-trsrn.toml"),
    include_str!("../../../samples/machines/mill-4axis-a.toml"),
    include_str!("../../../samples/machines/mill-turn-bc.toml"),
    include_str!("../../../samples/machines/nutating-head-b45.toml"),
    include_str!("../../../samples/machines/nutating-head-b50.toml"),
    include_str!("../../../samples/machines/nutating-table-b45.toml"),
    include_str!("../../../samples/machines/pocketnc-v2revp.toml"),
    include_str!("../../../samples/machines/trunnion-3plus2.toml"),
];

/// How many there are.
const COUNT: usize = BUILTIN_MACHINES.len();

static LOADED: [OnceLock<Option<Machine>>; COUNT] = [const { OnceLock::new() }; COUNT];

/// A built-in machine by name; loaded once. `None`: no machine of that name (a test checks that every embedded file loads).
pub fn builtin(name: &str) -> Option<&'static Machine> {
    let index = BUILTIN_MACHINES.iter().position(|&known| known == name)?;
    LOADED[index].get_or_init(|| load(name, FILES[index]).ok()).as_ref()
}

/// The text of a built-in machine's file, as a start for a machine of your own.
pub fn builtin_source(name: &str) -> Option<&'static str> {
    BUILTIN_MACHINES
        .iter()
        .position(|&known| known == name)
        .map(|index| FILES[index])
}
