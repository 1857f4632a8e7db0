//! From here on only one posture of the rotary axes is within their travel.
//!
//! # Why
//! While two postures are possible, the tool can be guided around a limit or the pole by changing from one to the
//! other. Beyond a limit of the tilting axis only one is left: the program cannot be unwound or swapped there, and
//! another machine may not reach the position at all.
//!
//! # Example
//! ```gcode sinumerik-840d mikron-ucp710
//! N10 TRAORI
//! N20 G0 X0 Y0 Z50 A25 C0
//! N30 G1 X10 A35 F500
//! ;          ^^^ only-one-posture: only one posture is left: the other would need A = -35 deg
//! N40 M30
//! ```
//!
//! # Use instead
//! ```gcode sinumerik-840d mikron-ucp710
//! N10 TRAORI
//! N20 G0 X0 Y0 Z50 A25 C0
//! N30 G1 X10 A29 F500
//! N40 M30
//! ```
//!
//! # Guarantee
//! Sound for feed motions under tool centre point control between known positions; reported where the second
//! posture is lost.
//!
//! # Sources
//! * docs/kinematics.md#two-postures
use crate::prelude::*;
use core::f64::consts::TAU;
use trunnion_machine::{Limits, Machine, Orientations, Stance, orientations, windings};

pub(super) const RULE: Body = Body {
    severity: Severity::Info,
    guarantee: Guarantee::Sound,
    level: Level::Leg(Needs::FEED.and(Needs::TURNS).and(Needs::LEADS_TIP), check),
};

fn check(view: &LegView<'_>, out: &mut Reporter<'_>) {
    let machine = view.machine;
    if machine.rotary.len() != 2 || !view.motion().is_feed() || !view.rotary_turns() || !view.leads_tip() {
        return;
    }
    let full = |axis: &usize| match machine.axes[*axis].limits {
        Limits::Unbounded => true,
        Limits::Range(low, high) => high - low >= TAU,
    };
    if machine.rotary.iter().all(full) {
        return;
    }
    let Some((start, end)) = view.stances() else { return };
    let Some((joint, value)) = missing_posture(machine, end) else {
        return;
    };
    if missing_posture(machine, start).is_some() {
        return;
    }
    let axis = &machine.axes[joint];
    let name = letter(axis.letter);
    let range = orientation_range(out.program(), view.motion().block);
    let draft = out.report(
        range,
        format!(
            "only one posture is left: the other would need {name} = {}, outside its travel",
            degrees(value)
        ),
    );
    draft.value_text("axis", name).value("value_deg", deg(value));
    if let Limits::Range(low, high) = axis.limits {
        let limit = if value < low { low } else { high };
        draft.value("limit_deg", deg(limit));
    }
}

/// The axis that keeps the other posture of a stance from being legal, and the value it would need, rad; `None` where two postures are
/// legal or there is only one anyway.
fn missing_posture(machine: &Machine, stance: &Stance) -> Option<(usize, f64)> {
    let Orientations::Postures(postures) = orientations(machine, &stance.axis) else {
        return None;
    };
    let other = postures.iter().find(|posture| posture.branch * stance.branch < 0)?;
    machine.rotary.iter().zip(other.q).find_map(|(&axis, q)| {
        windings(machine, axis, q, stance.joints[axis])
            .is_empty()
            .then_some((axis, q))
    })
}

#[cfg(test)]
mod tests {
    use crate::fixture::assert_drawn;

    #[test]
    fn it_is_told_once_and_not_for_rapids() {
        assert_drawn(
            "gcode sinumerik-840d mikron-ucp710",
            "N10 TRAORI\nN20 G0 X0 Y0 Z50 A45 C0\nN30 G1 X10 A35 F500\nN40 G1 X20 A25\nN50 G1 X30 A31\n;          ^^^ only-one-posture: only one posture is left: the other would need A = -31 deg\nN60 G1 X40 A33\nN70 M30\n",
        );
    }
}
