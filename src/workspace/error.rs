//! Why settings, machine or dialect could not be used, with the place.
use std::{borrow::Cow, fmt, path::Path};
use trunnion_syntax::LineIndex;

/// A quoted text of more characters than this is shortened.
const QUOTED: usize = 160;

/// So many of them are shown.
const SHOWN: usize = 80;

/// A word, such as a path, of more bytes than this is shortened: no system has longer paths.
const LONGEST_WORD: usize = 4096;

/// A message in which long texts between backquotes or quotation marks and endless words are cut: a value of a file may be as long as the file.
pub fn shortened(message: &str) -> Cow<'_, str> {
    if message.len() <= QUOTED {
        return Cow::Borrowed(message);
    }
    let mut out = String::new();
    let mut rest = message;
    while let Some(open) = rest.find(['`', '"']) {
        let quote = rest.as_bytes()[open];
        let (before, quoted) = rest.split_at(open + 1);
        plain(before, &mut out);
        let end = quoted.bytes().position(|byte| byte == quote).unwrap_or(quoted.len());
        let (inside, behind) = quoted.split_at(end);
        match inside.char_indices().nth(QUOTED) {
            None => out.push_str(inside),
            Some(_) => beginning(inside, &mut out),
        }
        let (mark, behind) = behind.split_at(behind.len().min(1));
        out.push_str(mark);
        rest = behind;
    }
    plain(rest, &mut out);
    Cow::Owned(out)
}

/// The beginning of a long text.
fn beginning(text: &str, out: &mut String) {
    let cut = text.char_indices().nth(SHOWN).map_or(text.len(), |(at, _)| at);
    out.push_str(&text[..cut]);
    out.push_str("...");
}

/// A text without quotes.
fn plain(text: &str, out: &mut String) {
    for word in text.split_inclusive(char::is_whitespace) {
        let own = word.trim_end();
        if own.len() > LONGEST_WORD {
            beginning(own, out);
            out.push_str(&word[own.len()..]);
        } else {
            out.push_str(word);
        }
    }
}

fn short(message: String) -> String {
    let cut = match shortened(&message) {
        Cow::Borrowed(_) => None,
        Cow::Owned(cut) => Some(cut),
    };
    cut.unwrap_or(message)
}

/// A path as it is shown.
fn named(path: &Path) -> String {
    let mut name = String::new();
    plain(&path.display().to_string(), &mut name);
    name
}

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
            message: short(message.into()),
        }
    }
    /// Of a file as a whole.
    pub fn file(path: &Path, message: impl fmt::Display) -> Self {
        Self {
            place: named(path),
            message: short(message.to_string()),
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
            place: format!("{}:{line}:{column}", named(path)),
            message: short(message.to_string()),
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_as_long_as_its_file_is_cut() {
        let long = "é".repeat(1_000_000);
        let shown = "é".repeat(SHOWN);
        for (text, wanted) in [
            (
                format!("unknown machine `{long}`: see `list`"),
                format!("unknown machine `{shown}...`: see `list`"),
            ),
            (
                format!("invalid type: string \"{long}\", expected a"),
                format!("invalid type: string \"{shown}...\", expected a"),
            ),
            (
                format!("folder /a/{long} does not exist"),
                format!("folder /a/{}... does not exist", &shown[..2 * (SHOWN - 3)]),
            ),
            (format!("never closed `{long}"), format!("never closed `{shown}...")),
        ] {
            assert_eq!(LoadError::new(text).message, wanted);
        }
        // what is not quoted, or is short, stays
        let plain = format!("{} `{}` x", "word ".repeat(200), "y".repeat(QUOTED));
        assert_eq!(shortened(&plain), plain);
        let path = Path::new(&long).join("m.toml");
        let error = LoadError::at(&path, "a", Some(&(0..1)), "is wrong");
        assert_eq!(error.to_string(), format!("{shown}...:1:1: is wrong"));
        let error = LoadError::file(Path::new("/a/b.toml"), "is wrong");
        assert_eq!(error.to_string(), "/a/b.toml: is wrong");
    }
}
