//! A machine by name or file.
use crate::LoadError;
use std::path::{Path, PathBuf};
use trunnion_machine::Machine;

/// An embedded machine by its name, or a TOML file, relative to `folder` where one is given.
///
/// # Errors
/// No such machine or file; or the file is not a valid machine, with line and column.
pub fn find_machine(name: &str, folder: Option<&Path>) -> Result<Machine, LoadError> {
    if let Some(machine) = trunnion_machine::builtin(name) {
        return Ok(machine.clone());
    }
    let path = folder.map_or_else(|| PathBuf::from(name), |folder| folder.join(name));
    let is_file = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml")) || path.is_file();
    if !is_file {
        let hint = trunnion_check::or_known(name, trunnion_machine::BUILTIN_MACHINES, "machines");
        return Err(LoadError::new(format!("unknown machine `{name}`{hint}")));
    }
    let text = std::fs::read_to_string(&path)
        .map_err(|error| LoadError::file(&path, format!("cannot read the machine file: {error}")))?;
    let id = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or("machine");
    trunnion_machine::load(id, &text).map_err(|error| LoadError::at(&path, &text, error.span.as_ref(), &error.message))
}
