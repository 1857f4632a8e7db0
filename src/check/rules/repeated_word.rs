//! A block contains a word twice.
//!
//! # Why
//! The control stops (RS274/NGC), or the last word wins (Fanuc) and the first value is never used.
//!
//! # Example
//! ```gcode
//! N10 G0 X10 Y5 X20
//! ;             ^^^ repeated-word: `X20` repeats a word of this block
//! ```
//!
//! # Use instead
//! ```gcode
//! N10 G0 X10 Y5
//! N20 X20
//! ```
//!
//! # Guarantee
//! Sound for words that a block may contain only once; a warning on Fanuc, where the last one wins.
//!
//! # Sources
//! * NISTIR 6556 (2000), section 3.3.4 on item repeats.
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(
    Error,
    &[Wake::Fault(check), Wake::Refused(Refusal::RepeatedWord, plain)],
);

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    if fault.kind == FaultKind::RepeatedWord && !out.is_slip(fault.range) {
        let text = out.text(fault.range);
        let last_wins = out.dialect().advice.last_word_wins;
        let draft = out.report(fault.range, format!("`{text}` repeats a word of this block"));
        draft.help("remove the one that you do not need");
        if last_wins {
            draft.severity(Warning).note("on this control the last one wins");
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::Severity;
    use crate::fixture::assert_drawn;

    #[test]
    fn on_fanuc_it_is_a_warning() {
        let report = assert_drawn(
            "gcode fanuc-30i",
            "N10 G0 X10. Y5. X20.\n;               ^^^^ repeated-word: \n",
        );
        assert_eq!(report.diagnostics[0].severity, Severity::Warning);
    }
}
