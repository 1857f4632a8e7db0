//! The settings of a program: which file they are in, and what they say.
use crate::kept::Kept;
use crate::{LoadError, Overrides};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use trunnion_check::{Config, ConfigError};
use trunnion_machine::{MOST_OBSTACLES, Machine};

/// Settings that were read last.
static SETTINGS: Kept<Result<Arc<Config>, ConfigError>> = Kept::new();

/// The file of settings and its text; none where a program has no settings.
pub(crate) type ConfigFile = Option<(PathBuf, String)>;

/// The settings and their file with its text: `--config`, or `trunnion.toml` in the program's folder (standard input: the current one) or above.
pub(crate) fn config_for(path: Option<&Path>, overrides: &Overrides) -> Result<(Arc<Config>, ConfigFile), LoadError> {
    let found = match &overrides.config {
        Some(file) => Some(file.clone()),
        None => folder_of(path).and_then(|folder| {
            folder
                .ancestors()
                .map(|folder| folder.join("trunnion.toml"))
                .find(|file| file.is_file())
        }),
    };
    let Some(file) = found else {
        return Ok((Arc::default(), None));
    };
    let text = overrides.texts.read(&file)?;
    match &*SETTINGS.of("", &text, || Config::parse(&text).map(Arc::new)) {
        Ok(config) => Ok((Arc::clone(config), Some((file, text)))),
        Err(error) => Err(LoadError::at(&file, &text, error.span.as_ref(), &error.message)),
    }
}

/// The canonical folder of the program, links followed; of standard input the current folder; for a document that is not saved the folder
/// of its name.
pub(crate) fn folder_of(path: Option<&Path>) -> Option<PathBuf> {
    let Some(path) = path else {
        return std::env::current_dir().ok();
    };
    let file = std::fs::canonicalize(path)
        .or_else(|_| std::path::absolute(path))
        .ok()?;
    let folder = file.parent()?;
    Some(std::fs::canonicalize(folder).unwrap_or_else(|_| folder.to_owned()))
}

/// The machine with the tolerances and obstacles of the settings.
///
/// # Errors
/// More obstacles than are judged.
pub(crate) fn with_settings(
    machine: &Machine,
    config: &Config,
    config_file: Option<&(PathBuf, String)>,
) -> Result<Machine, LoadError> {
    let machine = config.machine_with_tolerances(machine);
    let count = machine.obstacles.0.len();
    if let (true, Some((file, _))) = (count > MOST_OBSTACLES, config_file) {
        let what = format!(
            "these settings and machine {} declare {count} obstacles, and {MOST_OBSTACLES} are the most for both together; put those that stand together in \
             one polygon",
            machine.id
        );
        return Err(LoadError::file(file, what));
    }
    Ok(machine)
}
