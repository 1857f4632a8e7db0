//! What a program is called by: `O1000` by its number, `<SUB>` by its name.
use std::fmt;

/// Number or name of a program. `<O123>` is the program of the number 123.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum ProgramName {
    Number(u32),
    /// Without `<` and `>`. Upper and lower case are different names.
    Name(Box<str>),
}

/// Endings of file names that are tried.
pub(super) const ENDINGS: [&str; 7] = ["", ".nc", ".NC", ".cnc", ".tap", ".txt", ".prg"];

impl ProgramName {
    /// From `<SUB>`; `None` where it is no name in brackets.
    pub(crate) fn bracketed(text: &[u8]) -> Option<Self> {
        let name = std::str::from_utf8(text).ok()?;
        let name = name.trim().strip_prefix('<')?.strip_suffix('>')?.trim();
        let number = name.strip_prefix('O').filter(|digits| !digits.is_empty());
        match number.and_then(|digits| digits.parse().ok()) {
            Some(number) => Some(Self::Number(number)),
            None if name.is_empty() => None,
            None => Some(Self::Name(name.into())),
        }
    }

    /// File names that the program may have, without ending.
    pub(super) fn files(&self) -> Vec<String> {
        match self {
            Self::Number(number) => vec![
                format!("O{number:04}"),
                format!("O{number}"),
                format!("{number:04}"),
                format!("{number}"),
            ],
            Self::Name(name) => vec![name.to_string()],
        }
    }
}

impl fmt::Display for ProgramName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => write!(f, "O{number:04}"),
            Self::Name(name) => write!(f, "<{name}>"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::ProgramName;

    #[test]
    fn names_and_numbers() {
        let of = |text: &str| ProgramName::bracketed(text.as_bytes());
        assert_eq!(of("<O0123>"), Some(ProgramName::Number(123)));
        assert_eq!(of("<O>"), Some(ProgramName::Name("O".into())));
        assert_eq!(of("<O12A>"), Some(ProgramName::Name("O12A".into())));
        assert_eq!((of("<>"), of("SUB")), (None, None));
        assert_eq!(ProgramName::Number(7).to_string(), "O0007");
    }
}
