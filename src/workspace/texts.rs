//! Texts that take the place of files: the checker for browsers has no disk.
use crate::LoadError;
use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
};

/// Texts by the paths of the files whose place they take.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Texts(pub BTreeMap<PathBuf, String>);

impl Texts {
    /// Whether one takes the place of this file.
    pub(crate) fn has(&self, path: &Path) -> bool {
        self.0.contains_key(path)
    }

    /// The text of a file: given, or read from the disk.
    ///
    /// # Errors
    /// It is not given and cannot be read.
    pub(crate) fn read(&self, path: &Path) -> Result<String, LoadError> {
        match self.0.get(path) {
            Some(text) => Ok(text.clone()),
            None => Ok(trunnion_files::read_settings(path)?),
        }
    }
}
