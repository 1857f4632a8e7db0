//! Close to the pole the first rotary axis turns far while the tool axis hardly moves.
//!
//! # Why
//! At the pole the tool axis is parallel to the rotary axis nearest the workpiece, and that axis can be at any
//! angle. Near the pole a change of direction by a fraction of a degree can need half a turn: the tool slows down
//! or stops in the cut and leaves a mark, and without tool centre point control it leaves its path.
//!
//! # Example
//! ```gcode sinumerik-840d mikron-ucp710
//! N2900 TRAORI
//! N2910 G1 X-28.38197 Y-2.14469 Z59.86773 A2.042 C3.358 F1000
//! N2920 G1 X-28.38474 Y-1.84041 Z59.90263 A1.047 C4.822
//! N2930 G1 X-28.38709 Y-1.53565 Z59.93222 A0.081 C52.595 F40
//! ;                                              ^^^^^^^ pole-flip: C turns 47.773 deg while the tool axis passes 0.081 deg
//! ;                                              ^^^^^^^ excess-linear-travel: the linear axes travel 23.132 mm
//! ;                                              ^^^^^^^ fast-pole: at F40 the tool axis must stay
//! N2940 M30
//! ```
//!
//! # Use instead
//! Let `trunnion fix --rewrite smooth-pole` guide the tool axis around the pole, or tilt the path away from it:
//! ```gcode sinumerik-840d mikron-ucp710
//! N2900 TRAORI
//! N2910 G1 X-28.38197 Y-2.14469 Z59.86773 A12.042 C3.358 F2000
//! N2920 G1 X-28.38474 Y-1.84041 Z59.90263 A11.047 C4.822
//! N2940 M30
//! ```
//!
//! # Guarantee
//! Sound for feed motions between known positions: the angle to the pole is the smallest one inside the block.
//!
//! # Thresholds
//! `pole_cone`: 2 deg around the pole; `pole_angle`: 10 deg of the first rotary axis. An error where that axis
//! turns 175 to 185 deg. All findings of a block at the pole are merged into one, which has the level of its worst
//! part: together with `branch-swap` it is an error.
//!
//! # Sources
//! * docs/kinematics.md#the-pole
//! * Guide-vane paper (2006), on the C axis near the singularity.
use crate::prelude::*;
use trunnion_geometry::rad;
use trunnion_machine::feed_limit_tight;

pub(super) const RULE: Body = Body::sound(Warning, &[Wake::NearPole(check)]).causes_pole_event(2);

fn check(cut: &facts::NearPole<'_>, out: &mut Reporter<'_>) {
    let turn = cut.leg.rotary_change[0];
    let flips = turn > cut.machine.tolerances.pole_angle;
    if !flips {
        return;
    }
    let axis = &cut.machine.axes[cut.machine.rotary[0]];
    out.event(|draft| {
        let name = letter(axis.letter);
        draft
            .at_axis(axis.letter)
            .say(format!(
                "{name} turns {} while the tool axis passes {}",
                degrees(turn),
                past_pole(cut.leg.pole_angle_min)
            ))
            .note(format!(
                "at the pole the tool axis is parallel to {name}: near it a small change of direction turns {name} far"
            ))
            .value_text("axis", name.clone())
            .value("rotary_change_deg", deg(turn))
            .value("pole_angle_deg", deg(cut.leg.pole_angle_min));
        if cut.forced_swap().is_some() {
            draft.help("tilt the path away from the pole, or retract and change the posture out of the cut");
        } else {
            draft
                .help("tilt the path away from the pole, or try `trunnion fix --rewrite smooth-pole`")
                .fix_pole(cut)
                .fix_posture(cut);
        }
        // the number is printed: not the coarse bound that settles whether an axis is overrun
        if let Some(limit) = feed_limit_tight(cut.machine, cut.leg).or_else(|| cut.feed_limit())
            && limit.feed_mm_min.is_finite()
        {
            draft
                .note(format!(
                    "no axis exceeds its speed up to a feed of {} {}",
                    highest_rate(limit.feed_mm_min),
                    cut.feed_unit()
                ))
                .value(cut.feed_keys()[1], limit.feed_mm_min);
        }
        if (rad(175.0)..=rad(185.0)).contains(&turn) {
            draft
                .severity(Error)
                .note("half a turn: the tool axis passes straight over the pole, or the posture changes");
        }
    });
}

#[cfg(test)]
mod tests {
    use crate::Severity;
    use crate::fixture::assert_drawn;

    #[test]
    fn half_a_turn_is_an_error() {
        let text = "N10 TRAORI\nN20 G0 X0 Y0 Z50 A1 C0\nN30 G1 X20 A1 C180 F100\n;             ^^^^ pole-flip: C turns 180 deg\nN40 M30\n";
        let report = assert_drawn("gcode sinumerik-840d mikron-ucp710", text);
        assert_eq!(report.diagnostics[0].severity, Severity::Error);
    }

    #[test]
    fn rapids_and_large_tilts_may_turn() {
        assert_drawn(
            "gcode sinumerik-840d mikron-ucp710",
            "N10 TRAORI\nN20 G0 X0 Y0 Z50 A1 C0\nN30 G0 X1 C50\nN40 G0 A2.001\nN50 G1 X30 C61 F100\nN60 M30\n",
        );
    }

    #[test]
    fn ten_degrees_are_the_threshold() {
        assert_drawn(
            "gcode sinumerik-840d mikron-ucp710",
            "N10 TRAORI\nN20 G0 X0 Y0 Z50 A1 C0\nN30 G1 X20 C9.999 F100\nN50 M30\n",
        );
    }
}
