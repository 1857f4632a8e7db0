//! Comments that speak to Trunnion: `(trunnion: tool 1 ball diameter 10)`, `; trunnion: allow pole-flip because ...`.
use crate::Tool;
use trunnion_syntax::{Program, TextRange};

/// One directive.
#[derive(Clone, Debug, PartialEq)]
pub enum Directive {
    /// Declares a tool.
    Tool(Tool),
    /// `allow RULE because REASON` (reason may be empty: the check floor says so). On a line of its own it holds for the
    /// whole program, beside words for its block.
    Allow {
        /// Rule's name.
        rule: String,
        /// Text after `because`.
        reason: String,
    },
    /// `dialect NAME` or `machine NAME`: read before parsing; here only so that it is no error.
    Mode {
        /// `dialect` or `machine`.
        key: String,
        /// The name.
        value: String,
    },
    /// Begins with `trunnion:` but cannot be read; the text says what is wrong.
    Broken(String),
}

/// All directives of a program with the range of their comment.
pub fn directives(program: &Program) -> Vec<(TextRange, Directive)> {
    let _ = program;
    todo!()
}
