//! The types of DEF.
use super::field::rounded;

/// The type of a variable in DEF.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sort {
    Real,
    Int,
    Bool,
    /// The code of a character.
    Char,
    /// A string, frame, axis or array: no number.
    Other,
}

/// Whether a type of DEF or PROC holds texts: `STRING[20]`, CHAR.
pub(crate) fn is_of_text(kind: &str) -> bool {
    let stem = kind.split('[').next().unwrap_or_default().trim();
    ["STRING", "CHAR"].iter().any(|known| stem.eq_ignore_ascii_case(known))
}

impl Sort {
    /// From the name of a type.
    pub(crate) fn named(name: &str) -> Option<Self> {
        let known = [
            ("REAL", Self::Real),
            ("INT", Self::Int),
            ("BOOL", Self::Bool),
            ("CHAR", Self::Char),
            ("STRING", Self::Other),
            ("AXIS", Self::Other),
            ("FRAME", Self::Other),
        ];
        let stem = name.split('[').next().unwrap_or_default();
        let found = known.iter().find(|(known, _)| stem.eq_ignore_ascii_case(known))?;
        Some(found.1)
    }

    /// What a variable holds when a value is written to it; `None`: unknown.
    pub(super) fn takes(self, value: f64) -> Option<f64> {
        match self {
            Self::Real => Some(value),
            Self::Int => rounded(value).filter(|value| value.abs() < 2_147_483_648.0),
            Self::Bool => Some(f64::from(u8::from(value != 0.0))),
            Self::Char => Some(value).filter(|value| value.fract() == 0.0 && (0.0..=255.0).contains(value)),
            Self::Other => None,
        }
    }
}
