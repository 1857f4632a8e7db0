//! A number cannot be read.
//!
//! # Why
//! The number has two decimal points, a sign without digits, or more digits than can be stored exactly. Controls
//! cut off such a number in different places, and the axis moves to a different position.
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
//! Sound: a number that is not reported here is stored exactly as written.
//!
//! # Sources
//! * NISTIR 6556 (2000), section 3.3.2.1 on numbers.
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Error, &[Wake::Text(check), Wake::Refused(Refusal::Number, plain)]);

fn check(error: &SyntaxError, out: &mut Reporter<'_>) {
    if error.kind == SyntaxErrorKind::BadNumber && out.is_slip(error.range) {
        return;
    }
    let text = out.text(error.range);
    match error.kind {
        SyntaxErrorKind::BadNumber => {
            out.report(error.range, format!("`{text}` is not a number"))
                .help("write at most 18 digits, with at most one decimal point and one leading sign");
        }
        SyntaxErrorKind::BlankInNumber => {
            out.report(error.range, format!("the number `{text}` contains blanks"))
                .note("some controls join the digits, others read two numbers")
                .help("remove the blanks");
        }
        _ => {}
    }
}
