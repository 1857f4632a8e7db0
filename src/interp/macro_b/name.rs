//! The name of a program: `O1000` by its number, `<SUB>` by its name.
use std::fmt;
use trunnion_flow::Key;

/// The name of a program for messages: `O1000`, `<SUB>`; on a Sinumerik the bare name.
pub(crate) struct ProgramName<'k>(pub(crate) &'k Key);

/// Endings of file names that are tried.
const ENDINGS: [&str; 7] = ["", ".nc", ".NC", ".cnc", ".tap", ".txt", ".prg"];

/// From `<SUB>`; `None` if it is not a name in brackets. `<O123>` is the program of the number 123. Upper and lower case are different
/// names.
pub(crate) fn bracketed(text: &[u8]) -> Option<Key> {
    let name = std::str::from_utf8(text).ok()?;
    let name = name.trim().strip_prefix('<')?.strip_suffix('>')?.trim();
    let number = name.strip_prefix('O').filter(|digits| !digits.is_empty());
    match number.and_then(|digits| digits.parse().ok()) {
        Some(number) => Some(Key::Number(number)),
        None if name.is_empty() => None,
        None => Some(Key::Name(name.into())),
    }
}

/// File names that a program may have.
pub(crate) fn files(name: &Key) -> Vec<String> {
    let stems = match name {
        Key::Number(number) => vec![
            format!("O{number:04}"),
            format!("O{number}"),
            format!("{number:04}"),
            format!("{number}"),
        ],
        Key::Name(name) => vec![name.to_string()],
    };
    let ended = |stem: &String| ENDINGS.map(|ending| format!("{stem}{ending}"));
    stems.iter().flat_map(ended).collect()
}

impl fmt::Display for ProgramName<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Key::Number(number) => write!(f, "O{number:04}"),
            Key::Name(name) => write!(f, "<{name}>"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Key, ProgramName, bracketed};

    #[test]
    fn names_and_numbers() {
        let of = |text: &str| bracketed(text.as_bytes());
        assert_eq!(of("<O0123>"), Some(Key::Number(123)));
        assert_eq!(of("<O>"), Some(Key::Name("O".into())));
        assert_eq!(of("<O12A>"), Some(Key::Name("O12A".into())));
        assert_eq!((of("<>"), of("SUB")), (None, None));
        assert_eq!(ProgramName(&Key::Number(7)).to_string(), "O0007");
    }
}
