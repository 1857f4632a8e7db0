//! A feed motion while the spindle is off.
//!
//! # Why
//! The tool is pushed through the material without turning: it breaks, or tears the part out of its fixture.
//! Typical causes are M5 instead of M3, and a spindle that is not switched on again after a tool change.
//!
//! # Example
//! ```gcode
//! N10 M5
//! N20 G0 X0 Y0 Z2
//! N30 G1 Z-5 F200
//! ;   ^^^^^^^^^^^ spindle-off-cut: this feed motion runs with the spindle off
//! ```
//!
//! # Use instead
//! ```gcode
//! N10 M3 S8000
//! N20 G0 X0 Y0 Z2
//! N30 G1 Z-5 F200
//! ```
//!
//! # Guarantee
//! Sound for programs that switch the spindle off by a code that is modelled. Before the first spindle code its
//! state is unknown, and nothing is reported. Feed motions in machine coordinates, and probing, are not judged.
//! Whether there is material is not known.
//!
//! # Sources
//! * docs/contract.md#what-counts-as-a-cut
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Error, &[Wake::CutSpindleOff(check)]);

fn check(_: &facts::CutSpindleOff<'_>, out: &mut Reporter<'_>) {
    out.report_block("this feed motion runs with the spindle off")
        .note("the program switched the spindle off earlier")
        .help("switch the spindle on (M3, M4), or use a rapid; if the tool does not turn (probe, drag knife), allow the rule and give that reason")
        .merge(Merge::run(0, 0.0));
}

#[cfg(test)]
mod tests {
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
}
