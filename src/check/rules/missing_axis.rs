//! The program moves an axis that the machine does not have.
//!
//! # Why
//! The control stops with an alarm. The program was probably written for another machine.
//!
//! # Example
//! ```gcode mill-3axis
//! N10 G0 X0 Y0 Z0
//! N20 G0 C90
//! ;      ^^^ missing-axis: mill-3axis has no axis C
//! ```
//!
//! # Use instead
//! ```gcode mill-3axis
//! N10 G0 X0 Y0 Z0
//! N20 G0 X90
//! ```
//!
//! # Guarantee
//! Sound; reported once per axis, with the number of blocks.
//!
//! # Sources
//! * docs/contract.md#machine-files
use crate::prelude::*;
use trunnion_machine::NoStance;

pub(super) const RULE: Body = Body {
    severity: Severity::Error,
    guarantee: Guarantee::Sound,
    level: Level::Leg(Needs::LOST, check),
};

fn check(view: &LegView<'_>, out: &mut Reporter<'_>) {
    if let Err(NoStance::NoSuchAxis(axis)) = view.leg.end {
        if out.repeats(view, u64::from(axis), 0.0) {
            return;
        }
        let range = axis_word(out.program(), view.motion().block, axis);
        let name = letter(axis);
        let axes: Vec<String> = view.machine.axes.iter().map(|axis| letter(axis.letter)).collect();
        out.report(range, format!("{} has no axis {name}", view.machine.id))
            .note(format!("its axes are {}", axes.join(" ")))
            .help("name the machine that the program was written for, or remove the word")
            .value_text("axis", name)
            .merge_everywhere(u64::from(axis));
    }
}
