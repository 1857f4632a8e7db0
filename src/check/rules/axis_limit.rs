//! An axis leaves its travel, at the end of a block or inside it.
//!
//! # Why
//! The control stops with an alarm in the middle of the cut, or an axis runs onto its end switch. With tool centre point
//! control a linear axis can leave its travel inside a block although both ends are legal.
//!
//! # Example
//! ```gcode mill-3axis
//! N10 G0 X0 Y0 Z0
//! N20 G0 X5000
//! ;      ^^^^^ axis-limit: X reaches 5000 mm
//! ```
//!
//! # Use instead
//! ```gcode mill-3axis
//! N10 G0 X0 Y0 Z0
//! N20 G0 X50
//! ```
//!
//! # Guarantee
//! Sound for axes whose position is known: inside a block by a bound on the joints' motion, not by samples.
//! An axis that was never positioned is not judged.
//!
//! # Thresholds
//! The limits of the machine file.
//!
//! # Sources
//! Trunnion's kinematics notes, sections 3 and 5 (LIM-END, LIM-MID).
use crate::prelude::*;
use trunnion_machine::{AxisKind, Excess, limit_excess};

pub(super) const RULE: Body = Body { severity: Severity::Error, guarantee: Guarantee::Sound, level: Level::Leg(check) };

fn check(view: &LegView<'_>, out: &mut Reporter<'_>) {
    let mut found: Vec<Excess> = Vec::new();
    limit_excess(view.machine, view.leg, &mut found);
    for excess in found {
        let axis = &view.machine.axes[excess.axis];
        let name = letter(axis.letter);
        let beyond = (excess.value - excess.limit).abs();
        let inside = if excess.inside { " inside the block, while both ends are legal" } else { "" };
        let message = format!(
            "{name} reaches {}{inside}, {} beyond its limit of {}",
            joint(axis, excess.value),
            joint(axis, beyond),
            joint(axis, excess.limit)
        );
        let range = axis_word(out.program(), view.motion().block, axis.letter);
        let draft = out.report(range, message);
        draft.note(format!("values are those of the joint, work offset and tool length included, on {}", view.machine.id));
        draft.help("move the part, choose another posture, or correct the program").value_text("axis", name);
        match axis.kind {
            AxisKind::Linear => {
                draft.value("value_mm", excess.value).value("limit_mm", excess.limit).value("excess_mm", beyond);
            }
            AxisKind::Rotary => {
                draft.value("value_deg", deg(excess.value)).value("limit_deg", deg(excess.limit)).value("excess_deg", deg(beyond));
            }
        }
        draft.merge(u64::from(axis.letter), beyond);
    }
}
