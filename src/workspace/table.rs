//! A dialect table of your own (`dialect_table` in `trunnion.toml`): what the machine builder has added to a control.
use crate::{LoadError, Texts};
use std::path::Path;
use std::sync::{Mutex, PoisonError};
use trunnion_dialect::Dialect;

/// Tables read so far, by their text. Dialects live as long as the process, so each text is kept once, however often the
/// language server resolves.
static TABLES: Mutex<Vec<(String, &'static Dialect)>> = Mutex::new(Vec::new());

/// The dialect of a table's file.
///
/// # Errors
/// The file cannot be read, or is not a dialect table: with line and column.
pub(crate) fn table(path: &Path, texts: &Texts) -> Result<&'static Dialect, LoadError> {
    let text = texts.read(path)?;
    let mut tables = TABLES.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some((_, known)) = tables.iter().find(|(known, _)| *known == text) {
        return Ok(known);
    }
    let shown = path.display().to_string();
    let dialect = Dialect::from_table(&text, &shown)
        .map_err(|error| LoadError::at(path, &text, error.span.as_ref(), &error.message))?;
    let kept: &'static Dialect = Box::leak(Box::new(dialect));
    tables.push((text, kept));
    Ok(kept)
}
