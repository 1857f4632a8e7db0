//! How a control names its zero points: one that names them otherwise cannot name the same one.

/// The names of a control.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ZeroNames {
    /// `G54`: every G-code target can write it.
    Codes,
    /// `preset 1`, of a HEIDENHAIN control.
    Presets,
    /// `G15 H1`, of an Okuma OSP.
    Systems,
}

impl ZeroNames {
    /// Whose name it is, as the interpreter spells it.
    pub fn of(name: &str) -> Self {
        if name.starts_with("preset ") {
            Self::Presets
        } else if name.starts_with("G15 ") {
            Self::Systems
        } else {
            Self::Codes
        }
    }
}
