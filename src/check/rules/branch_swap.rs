//! The machine changes its posture within a block, with much more rotary travel than the same posture would need.
//!
//! # Why
//! Two postures of the rotary axes give the same tool direction. Changing from one to the other turns an axis by up
//! to half a turn while the tool should hardly move. In the cut that is a gouge or a mark; in the air it is lost
//! time.
//!
//! # Example
//! ```gcode sinumerik-840d mikron-ucp710
//! N10 TRAORI
//! N20 G0 X0 Y0 Z50 A20 C0
//! N30 G1 X10 A-20 C180 F300
//! ;          ^^^^^^^^^ branch-swap: the posture changes and costs 220 deg more rotary travel than needed
//! ;               ^^^^ pole-flip: C turns 180 deg
//! N40 M30
//! ```
//!
//! # Use instead
//! ```gcode sinumerik-840d mikron-ucp710
//! N10 TRAORI
//! N20 G0 X0 Y0 Z50 A20 C0
//! N30 G1 X10 A20 C0 F300
//! N40 M30
//! ```
//!
//! # Guarantee
//! Sound for blocks between known positions. The posture is the sign of e1 . (R1 e2 x u). The cheapest move without
//! a swap is found among all full turns, ignoring limits: a swap that a limit forces is still a swap. Feed motions
//! are judged; a rapid that swaps is an info.
//!
//! # Thresholds
//! `swap_excess`: 5 deg of rotary travel more than the cheapest move of the same posture.
//!
//! # Sources
//! * docs/kinematics.md#change-of-posture
//! * Guide-vane paper (2006), on posture swaps at an axis limit.
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Error, &[Wake::PostureSwap(check)]).causes_pole_event(1);

fn check(swap: &facts::PostureSwap<'_>, out: &mut Reporter<'_>) {
    let [first, second] = swap.rotary_letters();
    let [d1, d2] = swap.leg.rotary_change;
    out.event(|draft| {
        draft
            .at_orientation()
            .say(format!(
                "the posture changes and costs {} more rotary travel than needed",
                degrees(swap.excess)
            ))
            .note(format!("{first} turns {} and {second} {}", degrees(d1), degrees(d2)))
            .help("program the rotary positions of the previous posture, or retract and change the posture out of the cut")
            .value("rotary_change_second_deg", deg(d2))
            .value("rotary_excess_deg", deg(swap.excess))
            .value("rotary_change_deg", deg(d1))
            .value("pole_angle_deg", deg(swap.leg.pole_angle_min))
            .fix_posture(swap)
            .fix_retract(swap);
        if let Some(beyond) = swap.forced_swap() {
            let name = letter(swap.machine.axes[beyond.axis].letter);
            draft
                .note(format!(
                    "the previous posture would need {name} = {}, beyond its limit of {}",
                    degrees(beyond.value),
                    degrees(beyond.limit)
                ))
                .help("retract and change the posture out of the cut, or set up the part so that the limit is not reached")
                .value_text("axis", name)
                .value("value_deg", deg(beyond.value))
                .value("limit_deg", deg(beyond.limit));
        }
        if !swap.motion().is_feed() {
            draft.severity(Info);
        }
    });
}

#[cfg(test)]
mod tests {
    use crate::fixture::assert_drawn;

    #[test]
    fn a_rapid_that_swaps_is_an_info() {
        let report = assert_drawn(
            "gcode sinumerik-840d mikron-ucp710",
            "N10 TRAORI\nN20 G0 X0 Y0 Z50 A20 C0\nN30 G0 X1 A-20 C180\n;         ^^^^^^^^^ branch-swap: \nN40 M30\n",
        );
        assert_eq!(report.diagnostics[0].severity, crate::Severity::Info);
    }

    #[test]
    fn a_limit_that_forces_the_swap_is_named() {
        // A -20, then A -40 at the same C would be needed: A ends at -30
        let text = "N10 TRAORI\nN20 G0 X0 Y0 Z50 A-20 C0\nN30 G1 X50 A40 C180 F30\nN40 M30\n";
        let report = crate::fixture::Fixture::parse("gcode sinumerik-840d mikron-ucp710", text)
            .check()
            .unwrap();
        let found = report.findings().find(|d| d.rule == "branch-swap").unwrap();
        assert_eq!(
            found.notes[1],
            "the previous posture would need A = -40 deg, beyond its limit of -30 deg"
        );
        assert!(!found.help.as_deref().unwrap().contains("previous posture"));
        let flip = report.findings().find(|d| d.rule == "pole-flip").unwrap();
        assert!(flip.fixes == ["insert-retract"] && !flip.help.as_deref().unwrap().contains("smooth-pole"));
    }

    /// Tool vectors that tilt from 10 to 40 deg towards +Y (A runs to -30) or towards -Y (A runs to 40).
    fn tilting(towards: f64) -> Vec<crate::Diagnostic> {
        use std::fmt::Write;
        let mut text = String::from("MULTAX/ON\nFEDRAT/100,MMPM\n");
        for step in 0..7 {
            let (sin, cos) = trunnion_geometry::math::sin_cos(trunnion_geometry::rad(10.0 + 5.0 * f64::from(step)));
            let _ = writeln!(text, "GOTO/{},0,0,0,{:.7},{cos:.7}", 10 * step, towards * sin);
        }
        text.push_str("FINI\n");
        let report = crate::fixture::Fixture::parse("gcode apt mikron-ucp710", &text)
            .check()
            .unwrap();
        let own = |d: &crate::Diagnostic| d.rule == "branch-swap";
        report.findings().filter(|found| own(found)).cloned().collect()
    }

    /// The guide-vane paper, section 2: where A reaches its limit the other posture is taken and C turns by 180 deg.
    #[test]
    fn a_path_that_runs_an_axis_to_its_limit_swaps_there() {
        let found = tilting(1.0);
        assert_eq!(found.len(), 1, "{found:?}");
        let value = |key| {
            found[0].values.iter().find_map(|(known, value)| match value {
                crate::ValueKey::Number(value) if *known == key => Some(*value),
                _ => None,
            })
        };
        assert!((value("rotary_change_deg").unwrap() - 180.0).abs() < 1e-4, "{found:?}");
        // at 30 deg A is still at its limit; the block to 35 deg swaps
        assert!(
            (value("rotary_change_second_deg").unwrap() - 65.0).abs() < 1e-4,
            "{found:?}"
        );
        assert!((value("limit_deg").unwrap() + 30.0).abs() < 1e-9 && (value("value_deg").unwrap() + 35.0).abs() < 1e-4);
        assert_eq!(found[0].severity, crate::Severity::Error);
        assert_eq!(tilting(-1.0), []);
    }

    #[test]
    fn the_same_posture_is_silent_however_far_it_turns() {
        assert_drawn(
            "gcode sinumerik-840d mikron-ucp710",
            "N10 TRAORI\nN20 G0 X0 Y0 Z50 A20 C0\nN30 G0 A20 C180\nN40 M30\n",
        );
    }
}
