//! No posture of the machine gives the tool this direction.
//!
//! # Why
//! The rotary axes cannot turn the tool, or the part, that far: the control stops, or moves to a direction of its
//! own choice.
//!
//! # Example
//! ```gcode apt mikron-ucp710
//! MULTAX/ON
//! FEDRAT/500
//! GOTO/0,0,10,0,0,1
//! GOTO/0,0,10,0,0.6,-0.8
//! $$          ^^^^^^^^^^ unreachable-orientation: no posture
//! FINI
//! ```
//!
//! # Use instead
//! ```gcode apt mikron-ucp710
//! MULTAX/ON
//! FEDRAT/500
//! GOTO/0,0,10,0,0,1
//! GOTO/0,0,10,0,0.6,0.8
//! FINI
//! ```
//!
//! # Guarantee
//! Sound: the solver is exact and finds all postures; full turns are tried within the limits.
//!
//! # Thresholds
//! The limits of the machine file.
//!
//! # Sources
//! * docs/kinematics.md#two-postures
use crate::prelude::*;
use trunnion_machine::NoStance;

pub(super) const RULE: Body = Body::sound(Error, &[Wake::LostEnd(check)]);

fn check(lost: &facts::LostEnd<'_>, out: &mut Reporter<'_>) {
    match *lost.why {
        NoStance::Unreachable(angle) => out.finding(lost, Merge::run(0, angle), |draft| {
            draft
                .at_orientation()
                .say(format!(
                    "no posture reaches this tool axis: it is {} outside the reach",
                    degrees(angle)
                ))
                .note(format!("the rotary axes of {} cannot tilt that far", lost.machine.id))
                .help("tilt the tool path, or set up the part differently")
                .value("excess_deg", deg(angle));
        }),
        NoStance::OutsideLimits { axis, value, limit } => {
            let beyond = (value - limit).abs();
            out.finding(lost, Merge::run(u64::from(axis), beyond), |draft| {
                let name = letter(axis);
                draft
                    .at_orientation()
                    .say(format!(
                        "no posture within the limits reaches this tool axis: {name} would be {}, its limit is {}",
                        degrees(value),
                        degrees(limit)
                    ))
                    .note("every posture needs a rotary axis outside its travel; this is the nearest one")
                    .help("tilt the tool path, or set up the part differently")
                    .value_text("axis", name)
                    .value("value_deg", deg(value))
                    .value("limit_deg", deg(limit))
                    .value("excess_deg", deg(beyond));
            });
        }
        NoStance::PostureRefused { axis, value } => {
            out.finding(lost, Merge::run(256 + u64::from(axis), value.abs()), |draft| {
                let name = letter(axis);
                draft
                    .at_orientation()
                    .say(format!(
                        "no posture within the limits matches the program's choice: {name} would be {}",
                        degrees(value)
                    ))
                    .note("SEQ, STAT, TU or the solution number selects a sign of a rotary axis that the travel does not allow")
                    .help("leave the choice to the control, or select the other posture")
                    .value_text("axis", name)
                    .value("value_deg", deg(value));
            });
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use crate::fixture::assert_drawn;

    /// TU wants A below zero: A -18.4 deg is inside the travel from -30 deg, A -40 deg is not.
    #[test]
    fn a_posture_that_the_program_asks_for_may_not_exist() {
        let machine = "gcode sinumerik-840d mikron-ucp710+control.posture_words={turn={A=3,C=4}}";
        let text = |vector: &str| format!("N10 TRAORI\nN20 G0 X0 Y0 Z50 A20 C0\nN30 PTP\nN40 G0 X10 {vector} TU=8\n");
        assert_drawn(
            machine,
            &format!(
                "{};          ^^^^^^^^^^^^^^^^^^^^^^ branch-swap: the posture changes\nN50 M30\n",
                text("A3=0.1 B3=-0.3 C3=0.95")
            ),
        );
        assert_drawn(
            machine,
            &format!(
                "{};          ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^ unreachable-orientation: no posture within the limits matches the program's choice: A would be 40\nN50 M30\n",
                text("A3=0 B3=-0.6427876 C3=0.7660444")
            ),
        );
    }
}
