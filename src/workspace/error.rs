//! Why settings, machine or dialect could not be used, with the place.
use std::{fmt, path::Path};
use trunnion_syntax::LineIndex;

/// A message with the file, line and column it belongs to.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LoadError {
    /// `path:line:column`, `path`, or empty where no file is concerned.
    pub place: String,
    /// What is wrong and what to do.
    pub message: String,
}

impl LoadError {
    /// Without a place.
    pub fn new(message: impl Into<String>) -> Self {
        Self {
            place: String::new(),
            message: message.into(),
        }
    }
    /// Of a file as a whole.
    pub fn file(path: &Path, message: impl fmt::Display) -> Self {
        Self {
            place: path.display().to_string(),
            message: message.to_string(),
        }
    }
    /// At a byte of a text file; without `span`, of the file as a whole.
    pub fn at(path: &Path, text: &str, span: Option<&std::ops::Range<usize>>, message: impl fmt::Display) -> Self {
        let Some(span) = span else {
            return Self::file(path, message);
        };
        let offset = span.start.min(text.len()) as u32;
        let (line, column) = LineIndex::new(text.as_bytes()).line_column(text.as_bytes(), offset);
        Self {
            place: format!("{}:{line}:{column}", path.display()),
            message: message.to_string(),
        }
    }
}

impl From<trunnion_files::FileError> for LoadError {
    fn from(error: trunnion_files::FileError) -> Self {
        Self::file(&error.path, error.message)
    }
}

impl fmt::Display for LoadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.place.is_empty() {
            f.write_str(&self.message)
        } else {
            write!(f, "{}: {}", self.place, self.message)
        }
    }
}

impl std::error::Error for LoadError {}
