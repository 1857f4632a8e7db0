//! Outcome of a proof attempt.

/// Where two programs differ.
#[derive(Clone, Debug, PartialEq)]
pub struct Witness {
    /// Index of the motion (from 0).
    pub motion: usize,
    /// Line in the program after (from 1).
    pub line: u32,
    /// What differs, with numbers and units.
    pub message: String,
}

/// Why nothing could be decided.
#[derive(Clone, Debug, PartialEq)]
pub struct Gap {
    /// The reason, and what would settle it.
    pub message: String,
}

/// Proved, refuted or unknown.
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// Proved: the certificate.
    Proved(Box<crate::Certificate>),
    /// Refuted.
    Refuted(Witness),
    /// Unknown.
    Unknown(Gap),
}
