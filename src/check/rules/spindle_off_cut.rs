//! A feed motion while the spindle does not turn.
//!
//! # Why
//! The tool is pushed through the material without turning: it breaks, or tears the part out of its fixture.
//! Typical causes are M5 instead of M3, a spindle that is not switched on again after a tool change and `S0 M3`.
//!
//! # Example
//! ```gcode
//! N10 M3 S8000
//! N20 G1 X0 Y0 Z2 F200
//! N30 M5
//! N40 G1 Z-5
//! ;   ^^^^^^ spindle-off-cut: this feed motion runs with the spindle off
//! ```
//!
//! # Use instead
//! ```gcode
//! N10 M3 S8000
//! N20 G1 X0 Y0 Z2 F200
//! N30 G1 Z-5
//! N40 M5
//! ```
//!
//! # Guarantee
//! Sound for programs that switch the spindle by codes that are modelled; one finding for each stretch of feed motions
//! between two changes of the spindle. Where nothing in the program starts a spindle, `spindle-unset` reports that once
//! instead: the tool may be one that does not turn. S0 is not reported in the dialect grbl, where S is the power of a
//! laser, and is a warning where other motions of the same tool have a speed. Before the first code of the spindle its
//! state is unknown, as it is in a subprogram and after a code of the machine builder. Feed motions in machine
//! coordinates, and probing, are not judged. Whether there is material is not known.
//!
//! # Sources
//! * docs/contract.md#what-counts-as-a-cut
use crate::cuts::{Still, StillCuts};
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Error, &[Wake::Still(check)]);

fn check(still: &StillCuts, out: &mut Reporter<'_>) {
    let grbl = out.dialect().name == "grbl";
    if still.why == Still::NoSpeed && (grbl || still.other_speed && !out.once(0)) {
        return;
    }
    match still.why {
        Still::Off => out
            .report_block("this feed motion runs with the spindle off")
            .note("the program switched the spindle off earlier, by M5 or by a tool change")
            .help("switch the spindle on (M3, M4), or use a rapid; if the tool does not turn (probe, drag knife), allow the rule and give that reason"),
        Still::NoSpeed => {
            let draft = out.report_block("this feed motion runs with S0: the spindle is on and does not turn");
            if still.other_speed {
                draft
                    .severity(Warning)
                    .note("other feed motions of the same tool have a speed: if S is the power of a laser, this is intended")
                    .help("program S above zero; for a laser, allow the rule and give that reason")
            } else {
                draft.help("program S above zero, for example S8000 M3")
            }
        }
        Still::SpeedUnsaid | Still::NeverStarted => return,
    }
    .spans(still.count, still.last);
}

#[cfg(test)]
mod tests {
    use crate::Severity;
    use crate::fixture::assert_drawn;

    #[test]
    fn an_unknown_spindle_is_no_finding() {
        assert_drawn("gcode", "G0 X0\nG1 X10 F100\nM3 S100\nX20\nM5\nG0 X30\n");
    }

    #[test]
    fn consecutive_blocks_are_told_once() {
        let report = assert_drawn(
            "gcode",
            "M3 S100\nG1 X10 F100\nM5\nX20\n;^^ spindle-off-cut: \nX30\nX40\nM3\nX50\n",
        );
        assert_eq!(report.diagnostics[0].count, 3);
    }

    #[test]
    fn each_stretch_between_two_changes_is_one_finding() {
        let report = assert_drawn(
            "gcode",
            "M3 S100\nG1 X10 F100\nM5\nX20\n;^^ spindle-off-cut: \nG0 X0\nG1 X40\nM3\nX50\nM5\nX60\n;^^ spindle-off-cut: \nG0 X0\nX61\n",
        );
        assert_eq!(report.diagnostics.iter().map(|d| d.count).collect::<Vec<_>>(), [2, 1]);
    }

    #[test]
    fn a_spindle_without_a_speed_does_not_turn() {
        let report = assert_drawn(
            "gcode",
            "S0 M3\nG1 X10 F100\n;^^^^^^^^^^ spindle-off-cut: this feed motion runs with S0\nX20\n",
        );
        assert_eq!(report.diagnostics[0].severity, Severity::Error);
    }

    #[test]
    fn s0_of_a_laser_is_a_warning_at_most() {
        let text = "G21 M3 S0\nG1 X10 F100\n;^^^^^^^^^^ spindle-off-cut: this feed motion runs with S0\nX20 S90\nX30 S0\nX40 S90\nX50 S0\n";
        let report = assert_drawn("gcode", text);
        assert_eq!(report.diagnostics[0].severity, Severity::Warning);
        assert_drawn("gcode grbl", "G21 M3 S0\nG1 X10 F100\nX20 S90\n");
    }

    #[test]
    fn a_spindle_that_stops_before_the_first_cut_is_off() {
        assert_drawn(
            "gcode",
            "M3 S100\nM5\nG1 X10 F100\n;^^^^^^^^^^ spindle-off-cut: \nM30\n",
        );
    }

    #[test]
    fn a_code_of_the_builder_may_start_the_spindle() {
        let text = "O1\nG21 M5\nM13\n;^^ unknown-code: fanuc-30i leaves M13\nG1 X10. F100.\nM133\n;^^^ unknown-code: fanuc-30i leaves M133\nX20.\nM30\n";
        assert_drawn("gcode fanuc-30i", text);
    }
}
