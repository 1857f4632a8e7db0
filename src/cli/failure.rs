//! Why a job could not be done: one message on standard error with file, line, column and what to do.
use std::{
    borrow::Cow,
    fmt::{Display, Write as _},
    io::{self, Write},
    path::Path,
};
use trunnion_workspace::{LoadError, shortened};

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
            message: shortened(&message.into()).into_owned(),
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
            message: shortened(&message.to_string()).into_owned(),
            broken_pipe: false,
        }
    }
    /// A failure of reading or writing a file.
    pub(crate) fn io(path: &Path, doing: &str, error: &io::Error) -> Self {
        Self::file(path, format!("cannot {doing}: {error}"))
    }
    /// Whether the reader of standard output went away, which is not our failure.
    pub(crate) fn is_broken_pipe(&self) -> bool {
        self.broken_pipe
    }
    /// The file, with the line where it is known; empty without a place.
    pub(crate) fn place(&self) -> &str {
        self.place.strip_suffix(": ").unwrap_or(&self.place)
    }
    /// What is wrong, and what to do.
    pub(crate) fn message(&self) -> &str {
        &self.message
    }
    /// Prints it.
    pub(crate) fn print(&self) {
        // a closed standard error must not stop the program
        let _ = writeln!(
            io::stderr(),
            "error: {}",
            shown(&format!("{}{}", self.place, self.message))
        );
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

impl From<trunnion_files::FileError> for Failure {
    fn from(error: trunnion_files::FileError) -> Self {
        Self {
            broken_pipe: error.closed,
            ..Self::file(&error.path, error.message)
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
pub(crate) fn remark(quiet: bool, text: &str) {
    if !quiet {
        let _ = writeln!(io::stderr(), "{}", shown(text));
    }
}

/// Text that a terminal shows as it is written: control characters of programs and file names, and marks that change the direction of
/// text, are shown as escapes (`\\x1b`). Line ends and tabs stay.
pub(crate) fn shown(text: &str) -> Cow<'_, str> {
    if !text.contains(is_hidden) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len() + 16);
    for c in text.chars() {
        if !is_hidden(c) {
            out.push(c);
        } else if (c as u32) < 0x100 {
            let _ = write!(out, "\\x{:02x}", c as u32);
        } else {
            let _ = write!(out, "\\u{{{:x}}}", c as u32);
        }
    }
    Cow::Owned(out)
}

/// Control characters but line end and tab, and marks that change the direction of text.
pub(crate) fn is_hidden(c: char) -> bool {
    let turns = matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{200e}' | '\u{200f}' | '\u{61c}');
    turns || c.is_control() && c != '\n' && c != '\t'
}
