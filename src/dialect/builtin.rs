//! The dialects that are built in.
use crate::{Dialect, load};
use std::sync::OnceLock;

/// Names of the dialects that are built in.
pub const BUILTIN_NAMES: &[&str] = &[
    "iso-6983",
    "linuxcnc",
    "fanuc-30i",
    "haas-ngc",
    "fanuc-30i-lathe-a",
    "fanuc-30i-lathe-b",
    "fanuc-30i-lathe-c",
    "haas-lathe",
    "grbl",
    "sinumerik-840d",
    "apt",
    "heidenhain-klartext",
    "okuma-osp",
];

/// Texts of the tables, in the order of [`BUILTIN_NAMES`]. A table may extend only one that comes before it.
const TABLES: [&str; 13] = [
    include_str!("../../grammar/dialects/iso-6983.toml"),
    include_str!("../../grammar/dialects/linuxcnc.toml"),
    include_str!("../../grammar/dialects/fanuc-30i.toml"),
    include_str!("../../grammar/dialects/haas-ngc.toml"),
    include_str!("../../grammar/dialects/fanuc-30i-lathe-a.toml"),
    include_str!("../../grammar/dialects/fanuc-30i-lathe-b.toml"),
    include_str!("../../grammar/dialects/fanuc-30i-lathe-c.toml"),
    include_str!("../../grammar/dialects/haas-lathe.toml"),
    include_str!("../../grammar/dialects/grbl.toml"),
    include_str!("../../grammar/dialects/sinumerik-840d.toml"),
    include_str!("../../grammar/dialects/apt.toml"),
    include_str!("../../grammar/dialects/heidenhain-klartext.toml"),
    include_str!("../../grammar/dialects/okuma-osp.toml"),
];

static LOADED: [OnceLock<Dialect>; 13] = [const { OnceLock::new() }; 13];

/// A built-in dialect by name; loaded once. `None` when there is no such name.
pub fn builtin(name: &str) -> Option<&'static Dialect> {
    let i = BUILTIN_NAMES.iter().position(|&known| known == name)?;
    Some(
        LOADED[i]
            .get_or_init(|| load(TABLES[i]).expect("the tables in grammar/dialects load: a test loads each of them")),
    )
}
