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

pub(super) const RULE: Body = Body::sound(Error, &[Wake::LostEnd(check)]);

fn check(lost: &facts::LostEnd<'_>, out: &mut Reporter<'_>) {
    let NoStance::NoSuchAxis(axis) = *lost.why else { return };
    out.finding(lost, Merge::once(u64::from(axis)), |draft| {
        let name = letter(axis);
        let axes: Vec<String> = lost.machine.own_axes().map(|(_, axis)| letter(axis.letter)).collect();
        draft
            .at_axis(axis)
            .say(format!("{} has no axis {name}", lost.machine.id))
            .note(format!("its axes are {}", axes.join(" ")))
            .help("name the machine that the program was written for, or remove the word")
            .value_text("axis", name);
    });
}
