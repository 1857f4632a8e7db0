//! What went wrong with a file.
use std::{fmt, io, path::Path};

/// A file that was not read or not written, and why. Nothing was changed.
#[derive(Debug)]
pub struct FileError {
    /// The path as the user gave it; empty for standard output.
    pub path: std::path::PathBuf,
    /// What is wrong and what to do, without the path.
    pub message: String,
    /// The other end of standard output or of a pipe is closed.
    pub closed: bool,
}

impl FileError {
    /// With a message that says what is wrong and what to do.
    pub(crate) fn new(path: &Path, message: impl Into<String>) -> Self {
        Self {
            path: path.to_owned(),
            message: message.into(),
            closed: false,
        }
    }

    /// An error of the operating system; `doing` completes "cannot".
    pub(crate) fn io(path: &Path, doing: &str, error: &io::Error) -> Self {
        Self {
            path: path.to_owned(),
            message: if error.kind() == io::ErrorKind::NotFound && doing.starts_with("read") {
                "there is no such file: check its name and folder".to_owned()
            } else {
                format!("cannot {doing}: {error}")
            },
            closed: error.kind() == io::ErrorKind::BrokenPipe,
        }
    }
}

impl fmt::Display for FileError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.path.display(), self.message)
    }
}

impl std::error::Error for FileError {}
