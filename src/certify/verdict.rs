//! Outcome of a proof attempt.
use core::fmt;

/// Where two programs differ, or where a certificate is wrong.
#[derive(Clone, Debug, PartialEq)]
pub struct Witness {
    /// Index of the motion (from 0); `None`: the texts or the certificate, not a motion.
    pub motion: Option<usize>,
    /// Line in the program after (from 1), where there is one.
    pub line: Option<u32>,
    /// What differs, with numbers and units.
    pub message: String,
}

impl fmt::Display for Witness {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            Some(line) => write!(f, "line {line}: {}", self.message),
            None => f.write_str(&self.message),
        }
    }
}

/// Why nothing could be decided.
#[derive(Clone, Debug, PartialEq)]
pub struct Gap {
    /// Line in the program after (from 1), where there is one.
    pub line: Option<u32>,
    /// The reason, and what would settle it.
    pub message: String,
}

impl fmt::Display for Gap {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
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

impl Outcome {
    /// Refuted by the texts or the certificate as a whole.
    pub(crate) fn refuted(message: impl Into<String>) -> Self {
        Self::Refuted(Witness {
            motion: None,
            line: None,
            message: message.into(),
        })
    }

    /// Refuted by one motion.
    pub(crate) fn refuted_at(motion: usize, line: u32, message: impl Into<String>) -> Self {
        Self::Refuted(Witness {
            motion: Some(motion),
            line: Some(line),
            message: message.into(),
        })
    }

    /// Undecided.
    pub(crate) fn unknown(message: impl Into<String>) -> Self {
        Self::Unknown(Gap {
            line: None,
            message: message.into(),
        })
    }

    /// Undecided because of one line of the program after.
    pub(crate) fn unknown_at(line: Option<u32>, message: impl Into<String>) -> Self {
        Self::Unknown(Gap {
            line,
            message: message.into(),
        })
    }
}
