//! A comment allows a rule that finds nothing there.
//!
//! # Why
//! Its reason no longer applies, or the comment is at the wrong block: then it hides the next mistake instead of
//! the one it was written for.
//!
//! # Example
//! ```gcode
//! N10 G0 X10 (trunnion: allow repeated-word because this control takes the last)
//! ;          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ unused-suppression: `allow repeated-word` silences nothing here
//! ```
//!
//! # Use instead
//! ```gcode
//! N10 G0 X10
//! ```
//!
//! # Guarantee
//! Sound for rules that were checked: not for those that need a machine where none is named, nor for those that the
//! settings switch off.
//!
//! # Sources
//! * docs/contract.md#comments-that-trunnion-reads
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Info, &[Wake::End(check)]);

fn check(ending: &Ending<'_>, out: &mut Reporter<'_>) {
    for (range, rule) in &ending.unused {
        out.report(*range, format!("`allow {rule}` silences nothing here"))
            .help("remove the comment, or move it to the block that it is meant for");
    }
}

#[cfg(test)]
mod tests {
    use crate::fixture::assert_drawn;

    #[test]
    fn what_is_used_or_was_not_looked_for_is_not_told() {
        assert_drawn("gcode", "G0 X0 X1 (trunnion: allow repeated-word because of a test)\n");
        assert_drawn("gcode", "(trunnion: allow repeated-word because of a test)\nG0 X0 X1\n");
        assert_drawn(
            "gcode",
            "G0 X0 (trunnion: allow pole-flip because no machine is named)\n",
        );
        assert_drawn(
            "gcode",
            "G0 X0 (trunnion: allow porting because nobody carries it over)\n",
        );
    }

    #[test]
    fn with_a_machine_rules_of_machines_were_looked_for() {
        assert_drawn(
            "gcode mikron-ucp710",
            "G0 X0 (trunnion: allow pole-flip because of it)\n;     ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ unused-suppression: \n",
        );
    }
}
