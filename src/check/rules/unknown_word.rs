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

pub(super) const RULE: Body = Body::sound(Error, &[Wake::Fault(check), Wake::Refused(Refusal::UnknownWord, plain)]);

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    if fault.kind == FaultKind::UnknownWord && !out.is_slip(fault.range) {
        let text = out.text(fault.range);
        let dialect = &out.dialect().name;
        out.report(fault.range, format!("`{text}` has no meaning in {dialect}"))
            .help("correct the word, or name the dialect of the program: --dialect NAME")
            .merge(Merge::run(hash(&text), 0.0));
    }
}
