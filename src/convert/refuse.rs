//! Why a conversion is refused, and where.
use core::fmt;
use trunnion_syntax::{BlockId, LineIndex, Program, TextRange};

/// A refusal: nothing was converted.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Refused {
    /// Line and column in the program that was to be converted, both from 1.
    pub place: Option<(u32, u32)>,
    /// What is wrong and what to do.
    pub message: String,
    /// There is nothing to do.
    pub is_nothing: bool,
}

impl Refused {
    /// Without a place.
    pub(crate) fn new(message: impl Into<String>) -> Self {
        Self {
            place: None,
            message: message.into(),
            is_nothing: false,
        }
    }
    /// There is nothing to do, and why.
    pub(crate) fn nothing(message: impl Into<String>) -> Self {
        Self {
            is_nothing: true,
            ..Self::new(format!("nothing to do: {}", message.into()))
        }
    }
    /// At a block.
    pub(crate) fn at(program: &Program, block: BlockId, message: impl Into<String>) -> Self {
        Self::range(program, program.block(block).range(), message)
    }
    /// At bytes of the program.
    pub(crate) fn range(program: &Program, range: TextRange, message: impl Into<String>) -> Self {
        let source = program.source();
        Self {
            place: Some(LineIndex::new(source).line_column(source, range.start)),
            message: message.into(),
            is_nothing: false,
        }
    }
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.place {
            Some((line, column)) => write!(f, "{line}:{column}: {}", self.message),
            None => f.write_str(&self.message),
        }
    }
}

impl std::error::Error for Refused {}
