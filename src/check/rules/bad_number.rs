//! A number cannot be read as one.
//!
//! # Why
//! Two decimal points, a sign without digits or more digits than can be held exactly: controls cut such a number where they
//! like, and the axis goes elsewhere.
//!
//! # Example
//! ```gcode
//! N10 G0 X1.2.3
//! ;       ^^^^^ bad-number: `1.2.3` is not a number
//! ```
//!
//! # Use instead
//! ```gcode
//! N10 G0 X1.23
//! ```
//!
//! # Guarantee
//! Sound: a number that is not reported here is held exactly as written.
//!
//! # Sources
//! The NIST RS274/NGC interpreter, version 3, on numbers.
use crate::prelude::*;

pub(super) const RULE: Body = Body {
    severity: Severity::Error,
    guarantee: Guarantee::Sound,
    level: Level::TextAndFault(check, check_run),
};

/// What only the run shows: a number that its word does not allow.
fn check_run(fault: &Fault, out: &mut Reporter<'_>) {
    refused(fault, out, &[Refusal::Number]);
}

fn check(error: &SyntaxError, out: &mut Reporter<'_>) {
    let text = out.text(error.range);
    match error.kind {
        SyntaxErrorKind::BadNumber => {
            out.report(error.range, format!("`{text}` is not a number"))
                .help("write digits with at most one decimal point and one sign in front, at most 18 digits in all");
        }
        SyntaxErrorKind::BlankInNumber => {
            out.report(error.range, format!("blanks stand inside the number `{text}`"))
                .note("some controls join the digits, others read two numbers")
                .help("remove the blanks");
        }
        _ => {}
    }
}
