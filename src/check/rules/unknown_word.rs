//! A letter or name has no meaning in the dialect.
//!
//! # Why
//! A word that the control does not know stops it, or the control skips it together with its intended effect.
//!
//! # Example
//! ```gcode
//! N10 G0 X10 SPEED=3
//! ;          ^^^^^^^ unknown-word: `SPEED=3` has no meaning in iso-6983
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
//! * grammar/README.md, the dialect tables and their sources.
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
        out.report(fault.range, format!("`{text}` has no meaning in {dialect}"))
            .help("correct the word, or name the dialect of the program: --dialect NAME")
            .merge(hash(&text), 0.0);
    }
}
