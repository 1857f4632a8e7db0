//! Which dialect a program is written in, and why.
use crate::Dialect;

/// A detected dialect with the reason for people.
#[derive(Clone, Debug)]
pub struct Detected {
    /// The dialect.
    pub dialect: &'static Dialect,
    /// Why: "file extension .mpf", "modeline in line 1", "the machine's control family" ...
    pub reason: String,
}

/// Modeline comment `(trunnion: dialect NAME)` in the first 10 lines, then file extension, then the machine's control family, then content (first 64 KiB).
pub fn detect(file_name: Option<&str>, source: &[u8], family: Option<&str>) -> Detected {
    let _ = (file_name, source, family);
    todo!()
}

/// File name extensions (lower case, no dot) that name programs, of all built-in dialects.
pub fn program_extensions() -> Vec<&'static str> {
    todo!()
}
