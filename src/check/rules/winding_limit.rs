//! An axis that winds up a cable or hose comes close to the end of its travel.
//!
//! # Why
//! Such an axis must turn back before its cable is taut. Close to the end of its travel no reserve is left for the
//! next operation, and the control stops in the cut or turns the axis back through it.
//!
//! # Example
//! The machine file says `cable = true` for A, whose travel is -30 to 120 deg.
//!
//! ```gcode sinumerik-840d mikron-ucp710+A.cable
//! N10 TRAORI
//! N20 G0 X0 Y0 Z50 A20 C0
//! N30 G1 X99 A100 F500
//! ;          ^^^^ winding-limit: A has 20 deg left to its limit of 120 deg
//! ;          ^^^^ only-one-posture: only one posture is left
//! N40 M30
//! ```
//!
//! # Use instead
//! ```gcode sinumerik-840d mikron-ucp710+A.cable
//! N10 TRAORI
//! N20 G0 X0 Y0 Z50 A20 C0
//! N30 G1 X10 A29 F500
//! N40 M30
//! ```
//!
//! # Guarantee
//! Sound at the ends of motions whose axis positions are known. An axis with a cable and without limits cannot be
//! judged, and is reported once.
//!
//! # Thresholds
//! 30 deg of reserve.
//!
//! # Sources
//! * docs/kinematics.md#rotary-words-and-full-turns
use crate::prelude::*;
use trunnion_geometry::rad;
use trunnion_machine::Limits;

pub(super) const RULE: Body = Body::sound(Warning, &[Wake::CableAxis(check)]);

/// Least reserve, deg.
const RESERVE_DEG: f64 = 30.0;

fn check(cables: &facts::CableAxis<'_>, out: &mut Reporter<'_>) {
    for (joint, value) in cables.joints() {
        let axis = &cables.machine.axes[joint];
        let (name, key) = (letter(axis.letter), u64::from(axis.letter));
        let Limits::Range(low, high) = axis.limits else {
            if out.once(key) {
                out.event(|draft| {
                    draft
                        .at_axis(axis.letter)
                        .say(format!("it is not declared how far {name} may wind up its cable"))
                        .help(format!("declare limits for {name} in the machine file"))
                        .unknown();
                });
            }
            continue;
        };
        let (reserve, limit) = if value - low < high - value {
            (value - low, low)
        } else {
            (high - value, high)
        };
        // beyond the limit it is axis-limit
        if reserve >= rad(RESERVE_DEG) - 1e-9 || reserve < 0.0 {
            continue;
        }
        // the lower end after the upper one is a separate finding, however close the blocks
        let merge = Merge::run(key + 256 * u64::from(limit == high), rad(RESERVE_DEG) - reserve);
        out.finding(cables, merge, |draft| {
            draft
                .at_axis(axis.letter)
                .say(format!(
                    "{name} has {} left to its limit of {}",
                    degrees(reserve),
                    degrees(limit)
                ))
                .note(format!(
                    "{name} winds up a cable: {RESERVE_DEG} deg of reserve are required"
                ))
                .help(format!("unwind {name} first, or set up the part rotated"))
                .value_text("axis", name.clone())
                .value("reserve_deg", deg(reserve))
                .value("value_deg", deg(value))
                .value("limit_deg", deg(limit));
        });
    }
}

#[cfg(test)]
mod tests {
    use crate::fixture::{Fixture, assert_drawn};

    #[test]
    fn a_cable_without_limits_is_unknown_once() {
        let text = "G0 X0 Y0 Z50 A0 C0\nG0 C100\nM30\n";
        let report = Fixture::parse("gcode sinumerik-840d mikron-ucp710+C.cable", text)
            .check()
            .unwrap();
        let found: Vec<_> = report
            .diagnostics
            .iter()
            .filter(|d| d.rule == "winding-limit")
            .collect();
        assert_eq!((found.len(), found[0].status), (1, crate::Status::Unknown));
    }

    #[test]
    fn thirty_degrees_are_the_reserve_and_runs_are_told_once() {
        let report = assert_drawn(
            "gcode sinumerik-840d mikron-ucp710+A.cable",
            "G0 X0 Y0 Z50 A0 C0\nG0 A90\nG0 A91\n;  ^^^ winding-limit: A has 25 deg left to\nG0 A95\nG0 A94\nG0 A-0.5\n;  ^^^^^ winding-limit: A has 29.5 deg left to its limit of -30 deg\nM30\n",
        );
        assert_eq!(report.diagnostics[0].count, 3);
    }
}
