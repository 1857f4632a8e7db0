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
use crate::InForce;
use crate::prelude::*;
use trunnion_interp::Motion;

pub(super) const RULE: Body = Body {
    severity: Severity::Error,
    guarantee: Guarantee::Sound,
    level: Level::Motion(Needs::FEED.and(Needs::SPINDLE_OFF), check),
};

fn check(motion: &Motion, _: InForce, out: &mut Reporter<'_>) {
    if !motion.is_feed() || motion.spindle_on != Some(false) || motion.machine_coordinates {
        return;
    }
    let range = code_range(out.program(), motion.block);
    out.report(range, "this feed motion runs with the spindle off")
        .note("the program switched the spindle off earlier")
        .help("switch the spindle on (M3, M4), or use a rapid; if the tool does not turn (probe, drag knife), allow the rule and give that reason")
        .merge(0, 0.0);
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
