//! The tool cuts in a tilted working plane without being perpendicular to it.
//!
//! # Why
//! A tilted plane rotates the coordinates. The tool itself is turned by another code (G53.1), by the cycle's
//! direction, or by hand. Where that is missing, or the rotary axes are elsewhere, the tool cuts at an angle, and
//! its length acts along the wrong line.
//!
//! # Example
//! ```gcode fanuc-30i mikron-ucp710
//! N10 G0 X0. Y0. Z50. A0. C0.
//! N20 G68.2 X0. Y0. Z0. I0. J30. K0.
//! N40 G1 Z5. F500.
//! ;   ^^^^^^^^^^^^ tilted-plane-misaligned: the tool is 30 deg off the normal of the tilted plane
//! N50 G69
//! N60 M30
//! ```
//!
//! # Use instead
//! ```gcode fanuc-30i mikron-ucp710
//! N10 G0 X0. Y0. Z50. A0. C0.
//! N20 G68.2 X0. Y0. Z0. I0. J30. K0.
//! N25 G53.1
//! N30 G0 X0. Y0. Z20.
//! N40 G1 Z5. F500.
//! N50 G69
//! N60 M30
//! ```
//!
//! # Guarantee
//! Sound for feed motions in planes that are modelled (G68.2 and G68.4 by Euler angles, CYCLE800 axis by axis)
//! where the positions of the rotary axes are known. While the tool is not perpendicular, the linear axes are not
//! followed.
//!
//! # Thresholds
//! 0.01 deg between the tool axis and the normal.
//!
//! # Sources
//! * docs/kinematics.md#tilted-planes
use crate::prelude::*;
use trunnion_machine::NoStance;

pub(super) const RULE: Body = Body::sound(Error, &[Wake::LostEnd(check)]);

fn check(lost: &facts::LostEnd<'_>, out: &mut Reporter<'_>) {
    let NoStance::PlaneMisaligned(off) = *lost.why else {
        return;
    };
    if !lost.motion().is_feed() {
        return;
    }
    out.finding(lost, Merge::run(0, off), |draft| {
        draft
            .say(format!("the tool is {} off the normal of the tilted plane", degrees(off)))
            .note("X Y Z are coordinates of the tilted plane; while the tool is not perpendicular to it, the axes are not followed")
            .help(
                "turn the tool perpendicular to the plane first (G53.1, or CYCLE800 with a direction), or cancel the plane (G69, CYCLE800())",
            )
            .value("value_deg", deg(off))
            .value("limit_deg", 0.01);
    });
}

#[cfg(test)]
mod tests {
    use crate::fixture::{Fixture, assert_drawn};

    #[test]
    fn axes_that_stand_right_need_no_turn() {
        assert_drawn(
            "gcode fanuc-30i mikron-ucp710",
            "G0 X0. Y0. Z50. A30. C0.\nG68.2 X0. Y0. Z0. I0. J30. K0.\nG0 X0. Y0. Z20.\nG1 Z5. F500.\nG69\nM30\n",
        );
    }

    #[test]
    fn a_hundredth_of_a_degree_is_the_threshold() {
        for (angle, count) in [("30.009", 0), ("30.011", 1)] {
            let text = format!(
                "G0 X0. Y0. Z50. A{angle} C0.\nG68.2 X0. Y0. Z0. I0. J30. K0.\nG0 X0. Y0. Z20.\nG1 Z5. F500.\nX5.\nG69\nM30\n"
            );
            let report = Fixture::parse("gcode fanuc-30i mikron-ucp710", &text).check().unwrap();
            let found = report
                .diagnostics
                .iter()
                .filter(|d| d.rule == "tilted-plane-misaligned");
            assert_eq!(found.count(), count, "{angle}");
        }
    }

    #[test]
    fn a_swivel_cycle_without_direction_turns_nothing() {
        assert_drawn(
            "gcode sinumerik-840d mikron-ucp710",
            "G0 X0 Y0 Z50 A0 C0\nCYCLE800(0,\"\",0,57,0,0,0,30,0,0,0,0,0,0)\nG1 Z5 F500\n;^^^^^^^^^ tilted-plane-misaligned: the tool is 30 deg\nCYCLE800()\nM30\n",
        );
        assert_drawn(
            "gcode sinumerik-840d mikron-ucp710",
            "G0 X0 Y0 Z50 A0 C0\nCYCLE800(0,\"\",0,57,0,0,0,30,0,0,0,0,0,1)\nG0 X0 Y0 Z20\nG1 Z5 F500\nCYCLE800()\nM30\n",
        );
    }
}
