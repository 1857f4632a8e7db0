//! The TOML shape of a dialect table, `extends`, validation with spans.
use crate::Dialect;

/// Why a table could not be loaded.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DialectError {
    /// What is wrong and what to do.
    pub message: String,
    /// Bytes in the table's text, where known.
    pub span: Option<core::ops::Range<usize>>,
}

impl core::fmt::Display for DialectError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for DialectError {}

/// Loads a table; `extends` may name a built-in dialect.
pub fn load(toml: &str) -> Result<Dialect, DialectError> {
    let _ = toml;
    todo!()
}
