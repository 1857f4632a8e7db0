//! Why a job could not be done: one message on standard error with file, line, column and what to do.
use std::{fmt::Display, io, path::Path};
use trunnion_workspace::LoadError;

/// The job could not be done (exit status 2).
#[derive(Debug)]
pub(crate) struct Failure {
    place: String,
    message: String,
    broken_pipe: bool,
}

impl Failure {
    /// A failure without a place.
    pub(crate) fn new(message: impl Into<String>) -> Self {
        Self {
            place: String::new(),
            message: message.into(),
            broken_pipe: false,
        }
    }
    /// A failure of a file as a whole.
    pub(crate) fn file(path: &Path, message: impl Display) -> Self {
        let place = if path == Path::new("-") {
            "<stdin>: ".to_owned()
        } else {
            format!("{}: ", path.display())
        };
        Self {
            place,
            message: message.to_string(),
            broken_pipe: false,
        }
    }
    /// A failure of reading or writing a file.
    pub(crate) fn io(path: &Path, doing: &str, error: &io::Error) -> Self {
        Self::file(path, format!("cannot {doing}: {error}"))
    }
    /// Whether the reader of standard output went away, which is no failure of ours.
    pub(crate) fn is_broken_pipe(&self) -> bool {
        self.broken_pipe
    }
    /// Prints it.
    #[expect(clippy::print_stderr, reason = "this is the one door to standard error for failures")]
    pub(crate) fn print(&self) {
        eprintln!("error: {}{}", self.place, self.message);
    }
}

impl From<LoadError> for Failure {
    fn from(error: LoadError) -> Self {
        let place = if error.place.is_empty() {
            String::new()
        } else {
            format!("{}: ", error.place)
        };
        Self {
            place,
            message: error.message,
            broken_pipe: false,
        }
    }
}

impl From<io::Error> for Failure {
    /// Errors of writing to standard output.
    fn from(error: io::Error) -> Self {
        Self {
            place: String::new(),
            message: format!("cannot write to standard output: {error}"),
            broken_pipe: error.kind() == io::ErrorKind::BrokenPipe,
        }
    }
}

/// A remark on standard error, unless `quiet`.
#[expect(
    clippy::print_stderr,
    reason = "remarks go to standard error so that standard output stays data"
)]
pub(crate) fn remark(quiet: bool, text: &str) {
    if !quiet {
        eprintln!("{text}");
    }
}
