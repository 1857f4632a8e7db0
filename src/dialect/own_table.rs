//! A user's own table: one TOML file that extends a built-in dialect by what the machine builder has added.
use crate::{Dialect, load};

/// Why a user's own table could not be read, with its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TableError {
    /// The file, as it was named.
    pub path: String,
    /// Line from 1, where known.
    pub line: Option<u32>,
    /// Column from 1 in Unicode characters, where known.
    pub column: Option<u32>,
    /// What is wrong and what to do.
    pub message: String,
    /// Bytes in the text, where known.
    pub span: Option<core::ops::Range<usize>>,
}

impl core::fmt::Display for TableError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(&self.path)?;
        for place in [self.line, self.column].into_iter().flatten() {
            write!(f, ":{place}")?;
        }
        write!(f, ": {}", self.message)
    }
}

impl std::error::Error for TableError {}

/// Line and column, from 1, of a byte of a text.
fn place(text: &str, at: usize) -> (u32, u32) {
    let before = text.get(..at).unwrap_or(text);
    let line = before.bytes().filter(|&byte| byte == b'\n').count() as u32 + 1;
    let start = before.rfind('\n').map_or(0, |newline| newline + 1);
    (line, before[start..].chars().count() as u32 + 1)
}

impl Dialect {
    /// A dialect from a user's own table; `path` is only for messages. `extends` names the built-in dialect that it adds to; `title` and
    /// `source` may be left out.
    ///
    /// # Errors
    /// Unknown keys and values, codes that are not canonical, groups that are not there, no `extends`: with line and column.
    pub fn from_table(text: &str, path: &str) -> Result<Self, TableError> {
        load(text).map_err(|error| {
            let (line, column) = error.span.as_ref().map(|span| place(text, span.start)).unzip();
            TableError {
                path: path.to_owned(),
                line,
                column,
                message: error.message,
                span: error.span,
            }
        })
    }
}
