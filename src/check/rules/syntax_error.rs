//! A piece of text belongs to no word, record or comment.
//!
//! # Why
//! A control stops at such a place, skips it, or reads something else than was meant. What stands there cannot be checked.
//!
//! # Example
//! ```gcode
//! N10 G1 X F500
//! ;      ^ syntax-error: `X` has no value
//! N20 G1 X10 ?
//! ;          ^ syntax-error: `?` belongs to no word
//! ```
//!
//! # Use instead
//! ```gcode
//! N10 G1 X0 F500
//! N20 G1 X10
//! ```
//!
//! # Guarantee
//! Sound: every byte of the file belongs to a word, a record, a comment or a blank, or is reported here, by `bad-number`,
//! by `decimal-comma` or by `unclosed-comment`.
//!
//! # Sources
//! The NIST RS274/NGC interpreter, version 3, on the format of a line; ISO 6983-1 on the format of a block.
use crate::prelude::*;

pub(super) const RULE: Body = Body {
    severity: Severity::Error,
    guarantee: Guarantee::Sound,
    level: Level::Text(check),
};

fn check(error: &SyntaxError, out: &mut Reporter<'_>) {
    let text = out.text(error.range);
    let (message, help) = match error.kind {
        SyntaxErrorKind::NestedComment => (
            "a comment opens inside a comment".to_owned(),
            "close the first comment before it, or leave the inner opening mark out",
        ),
        SyntaxErrorKind::UnexpectedCharacter => (
            format!("`{text}` belongs to no word"),
            "remove it, or put it into a comment",
        ),
        SyntaxErrorKind::WordWithoutValue => (
            format!("`{text}` has no value"),
            "write its value, or remove the letter",
        ),
        SyntaxErrorKind::NumberWithoutLetter => (
            format!("no letter owns the number `{text}`"),
            "write the letter it belongs to",
        ),
        SyntaxErrorKind::MissingValue => (
            format!("nothing stands behind `{text}`"),
            "write the value that is meant",
        ),
        SyntaxErrorKind::UnbalancedBracket => (format!("`{text}` has no partner"), "close or open the bracket"),
        SyntaxErrorKind::UnclosedText => (
            "a quoted text is not closed on its line".to_owned(),
            "write the closing quote",
        ),
        SyntaxErrorKind::DanglingContinuation => (
            "`$` continues a statement, but the file ends".to_owned(),
            "remove the `$`, or write the rest of the statement",
        ),
        SyntaxErrorKind::BadRecord => (
            format!("`{text}` stands where an APT statement cannot have it"),
            "a statement is a major word, then `/` and arguments with commas between them",
        ),
        SyntaxErrorKind::TooLarge => (
            "the file is larger than 4 GiB and is read only to here".to_owned(),
            "split the program",
        ),
        SyntaxErrorKind::UnclosedComment
        | SyntaxErrorKind::BadNumber
        | SyntaxErrorKind::DecimalComma
        | SyntaxErrorKind::BlankInNumber => return,
    };
    out.report(error.range, message).help(help);
}
