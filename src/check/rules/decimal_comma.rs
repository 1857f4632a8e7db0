//! A comma is written in place of a decimal point.
//!
//! # Why
//! Only Klartext uses decimal commas. An ISO control stops, or reads `X1,5` as X1 and continues.
//!
//! # Example
//! ```gcode
//! N10 G0 X1,5
//! ;       ^^^ decimal-comma: `1,5` has a comma in place of the decimal point
//! ```
//!
//! # Use instead
//! ```gcode
//! N10 G0 X1.5
//! ```
//!
//! # Guarantee
//! Sound for dialects without decimal commas.
//!
//! # Sources
//! * ISO 6983-1:2009, which allows the point only.
//! * HEIDENHAIN TNC 640 34059x-05 (ISO programming): Klartext accepts both.
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Error, &[Wake::Text(check)]);

fn check(error: &SyntaxError, out: &mut Reporter<'_>) {
    if error.kind == SyntaxErrorKind::DecimalComma {
        let text = out.text(error.range);
        out.report(
            error.range,
            format!("`{text}` has a comma in place of the decimal point"),
        )
        .help(format!("write {}", text.replace(',', ".")));
    }
}
