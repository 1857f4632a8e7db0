//! A machine by name or file.
use crate::{LoadError, Texts, kept::Kept};
use std::path::{Path, PathBuf};
use trunnion_machine::{Machine, MachineError};

/// Machine files that were read last.
static MACHINES: Kept<Result<Machine, MachineError>> = Kept::new();

/// A machine and the file that describes it.
#[derive(Clone, Debug)]
pub struct FoundMachine {
    /// The machine.
    pub machine: Machine,
    /// Its file; `None` for an embedded one.
    pub file: Option<PathBuf>,
}

/// An embedded machine by its name, or a TOML file, relative to `folder` where one is given. The user or the user's settings name it, so
/// the file may be anywhere.
///
/// # Errors
/// No such machine or file; or the file is not a valid machine, with line and column.
pub fn find_machine(name: &str, folder: Option<&Path>) -> Result<FoundMachine, LoadError> {
    find_in(name, folder, &Texts::default())
}

/// [`find_machine`] where some texts take the place of files.
pub(crate) fn find_in(name: &str, folder: Option<&Path>, texts: &Texts) -> Result<FoundMachine, LoadError> {
    if let Some(machine) = trunnion_machine::builtin(name) {
        let machine = machine.clone();
        return Ok(FoundMachine { machine, file: None });
    }
    let path = folder.map_or_else(|| PathBuf::from(name), |folder| folder.join(name));
    if !is_toml(&path) && !path.is_file() {
        return Err(unknown(name));
    }
    load(&path, texts)
}

/// The machine that a comment of a program names: an embedded one, or a `.toml` file in the program's folder or below one of the folders of
/// `machine_path`. A program comes from anywhere, so its comment opens no other file; links count as what they lead to.
///
/// # Errors
/// No such machine or file, or a file that lies elsewhere; or it is not a valid machine, with line and column.
pub(crate) fn machine_of_comment(
    name: &str,
    program_folder: &Path,
    machine_path: &[PathBuf],
) -> Result<FoundMachine, LoadError> {
    if let Some(machine) = trunnion_machine::builtin(name) {
        let machine = machine.clone();
        return Ok(FoundMachine { machine, file: None });
    }
    if !is_toml(Path::new(name)) && !name.contains(['/', '\\']) {
        return Err(unknown(name));
    }
    let beside = std::fs::canonicalize(program_folder.join(name)).ok();
    let home = std::fs::canonicalize(program_folder).ok();
    if let Some(file) = beside.filter(|file| is_toml(file) && file.parent() == home.as_deref()) {
        return load(&file, &Texts::default());
    }
    for folder in machine_path {
        let file = std::fs::canonicalize(folder.join(name)).ok();
        let home = std::fs::canonicalize(folder).ok();
        let inside = |file: &PathBuf| is_toml(file) && home.as_ref().is_some_and(|home| file.starts_with(home));
        if let Some(file) = file.filter(inside) {
            return load(&file, &Texts::default());
        }
    }
    Err(LoadError::new(format!(
        "a comment of the program names the machine `{name}`, which was not opened: a comment may name a built-in machine, or a .toml file \
         in the folder of the program or below a folder of `machine_path` in trunnion.toml. Use --machine to name another file"
    )))
}

fn is_toml(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml"))
}

fn unknown(name: &str) -> LoadError {
    let hint = trunnion_check::or_known(name, trunnion_machine::BUILTIN_MACHINES, "machines");
    LoadError::new(format!("unknown machine `{name}`{hint}"))
}

fn load(path: &Path, texts: &Texts) -> Result<FoundMachine, LoadError> {
    let text = texts.read(path)?;
    let id = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or("machine");
    let machine = match &*MACHINES.of(id, &text, || trunnion_machine::load(id, &text)) {
        Ok(machine) => machine.clone(),
        Err(error) => return Err(LoadError::at(path, &text, error.span.as_ref(), &error.message)),
    };
    let file = Some(path.to_owned());
    Ok(FoundMachine { machine, file })
}

/// A machine that `trunnion.toml` names and that is not there, at the line that names it. What is wrong inside a machine file keeps its own place.
pub(crate) fn in_settings(error: LoadError, name: &str, config_file: Option<&(PathBuf, String)>) -> LoadError {
    let Some((file, text)) = config_file else {
        return error;
    };
    let path = file.parent().unwrap_or(Path::new("")).join(name);
    if path.is_file() {
        return error;
    }
    let mut span = None;
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let rest = line.trim_start().strip_prefix("machine");
        if rest.is_some_and(|rest| rest.trim_start().starts_with('=')) {
            span = Some(start..start);
            break;
        }
        start += line.len();
    }
    let message = if error.place.is_empty() {
        error.message
    } else {
        format!("`machine` names {}: {}", error.place, error.message)
    };
    LoadError::at(file, text, span.as_ref(), message)
}
