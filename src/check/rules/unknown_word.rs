//! The dialect gives a letter or a name no meaning.
//!
//! # Why
//! A word that the control does not know stops it, or is skipped together with what was meant by it.
//!
//! # Example
//! ```gcode
//! N10 G0 X10 SPEED=3
//! ;          ^^^^^^^ unknown-word: iso-6983 has no meaning for `SPEED=3`
//! ```
//!
//! # Use instead
//! ```gcode
//! N10 G0 X10
//! ```
//!
//! # Guarantee
//! Sound for the dialect's table of letters and names.
//!
//! # Sources
//! The dialect tables in `grammar/dialects`.
use crate::prelude::*;

pub(super) const RULE: Body = Body {
    severity: Severity::Error,
    guarantee: Guarantee::Sound,
    level: Level::Fault(check),
};

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    refused(fault, out, &[Refusal::UnknownWord]);
    if fault.kind == FaultKind::UnknownWord {
        let text = out.text(fault.range);
        let dialect = out.dialect();
        out.report(fault.range, format!("{dialect} has no meaning for `{text}`"))
            .help("correct the word, or name the dialect the program is written in: --dialect NAME")
            .merge(hash(&text), 0.0);
    }
}
