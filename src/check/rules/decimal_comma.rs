//! A comma stands where a decimal point is meant.
//!
//! # Why
//! Only Klartext writes decimal commas. An ISO control stops, or reads `X1,5` as X1 and goes on.
//!
//! # Example
//! ```gcode
//! N10 G0 X1,5
//! ;       ^^^ decimal-comma: `1,5` has a comma for a decimal point
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
//! ISO 6983-1 knows the point only; HEIDENHAIN Klartext writes both.
use crate::prelude::*;

pub(super) const RULE: Body = Body {
    severity: Severity::Error,
    guarantee: Guarantee::Sound,
    level: Level::Text(check),
};

fn check(error: &SyntaxError, out: &mut Reporter<'_>) {
    if error.kind == SyntaxErrorKind::DecimalComma {
        let text = out.text(error.range);
        out.report(error.range, format!("`{text}` has a comma for a decimal point"))
            .help(format!("write {}", text.replace(',', ".")));
    }
}
