//! The declared uncertainty of the rotary axes moves the tip by more than the tolerance.
//!
//! # Why
//! A control that guides the tip trusts the positions of the rotary axes in its machine data. If a position is
//! known to 0.01 mm only, the tip can be off by up to twice that after half a turn, and by more if the direction of
//! an axis is uncertain too and the tip is far from it. No program can be more accurate than that: measure the axes
//! again, or cut closer to the posture in which the zero point was set.
//!
//! # Example
//! The machine file says that the position of C is known to 0.02 mm.
//!
//! ```gcode sinumerik-840d mikron-ucp710+C.uncertainty={point=0.02}
//! N10 TRAORI
//! N20 G0 X0 Y0 Z50 A40 C130
//! N30 G1 X100 C180 F1000
//! ;   ^^^^^^^^^^^^^^^^^^ pivot-uncertainty: the tip may be off by 0.04 mm, because of the declared uncertainty of the rotary axes
//! N40 M30
//! ```
//!
//! # Use instead
//! ```gcode sinumerik-840d mikron-ucp710+C.uncertainty={point=0.02}
//! N10 TRAORI
//! N20 G0 X0 Y0 Z50 A40 C0
//! N30 G1 X100 C50 F1000
//! N40 M30
//! ```
//!
//! # Guarantee
//! First order, in the worst direction, with the errors of all axes added up, and with the zero point set while the
//! axes were at zero. The rule judges both ends of feed motions and, between them, the turn that moves the tip
//! most. Where the machine file declares no uncertainty, silence proves nothing; the coverage of the check says so.
//!
//! # Thresholds
//! `pivot`: 0.02 mm.
//!
//! # Sources
//! * docs/kinematics.md#uncertainty-of-the-rotary-axes
use crate::prelude::*;
use trunnion_machine::{Axis, AxisKind, pivot_sensitivity_between};

pub(super) const RULE: Body = Body::heuristic(Info, &[Wake::UncertainCut(check)]).needs(|machine| {
    let rotary = machine.axes.iter().filter(|axis| axis.kind == AxisKind::Rotary);
    let declared = |axis: &Axis| axis.extra.point_uncertainty.is_some() || axis.extra.direction_uncertainty.is_some();
    let missing = rotary.clone().next().is_some() && !rotary.clone().any(declared);
    missing.then_some("uncertainty of a rotary axis")
});

fn check(cut: &facts::UncertainCut<'_>, out: &mut Reporter<'_>) {
    let found = pivot_sensitivity_between(cut.machine, &cut.start.joints, &cut.end.joints, cut.end.tool_length);
    let sum: f64 = found.iter().map(|axis| axis.tip_mm).sum();
    let allowed = cut.machine.tolerances.pivot_mm;
    // a difference from rounding is not reported again
    if sum <= allowed * (1.0 + 1e-9) {
        return;
    }
    out.finding(cut, Merge::run(0, sum), |draft| {
        let each: Vec<String> = found
            .iter()
            .filter(|axis| axis.tip_mm > 0.0)
            .map(|axis| {
                format!(
                    "{} {}, of which {} from its position",
                    letter(axis.letter),
                    mm(axis.tip_mm),
                    mm(axis.of_point_mm)
                )
            })
            .collect();
        draft
            .say(format!(
                "the tip may be off by {}, because of the declared uncertainty of the rotary axes",
                mm(sum)
            ))
            .note(format!(
                "by axis: {}; the tolerance is {}",
                each.join("; "),
                mm(allowed)
            ))
            .help("measure the rotary axes again, or allow more with `pivot` in [tolerances]")
            .value("value_mm", sum)
            .value("limit_mm", allowed);
    });
}

#[cfg(test)]
mod tests {
    use crate::fixture::{Fixture, assert_drawn};

    fn found(text: &str) -> Vec<crate::Diagnostic> {
        let report = Fixture::parse("gcode sinumerik-840d mikron-ucp710+C.uncertainty={point=0.02}", text)
            .check()
            .unwrap();
        let own = |d: &crate::Diagnostic| d.rule == "pivot-uncertainty";
        report.diagnostics.into_iter().filter(own).collect()
    }

    /// 2 sin(C/2) 0.02 mm is 0.02 mm at 60 deg.
    #[test]
    fn sixty_degrees_are_the_threshold() {
        let text = |c: f64| format!("TRAORI\nG0 X0 Y0 Z50 A40 C0\nG1 X100 C{c} F1000\nM30\n");
        assert_eq!(found(&text(59.9)), []);
        let all = found(&text(60.1));
        assert_eq!(all.len(), 1, "{all:?}");
        let value = all[0].values.iter().find(|(key, _)| *key == "value_mm");
        let Some((_, crate::ValueKey::Number(value))) = value else {
            panic!("no value: {all:?}")
        };
        let wanted = 0.04 * trunnion_geometry::math::sin(trunnion_geometry::rad(30.05));
        assert!((value - wanted).abs() < 1e-12, "{value}");
        assert_eq!(all[0].severity, crate::Severity::Info);
    }

    /// From 30 to 330 deg the worst is at 180 deg, between the ends.
    #[test]
    fn the_worst_turn_may_lie_inside_the_block() {
        let all = found("TRAORI\nG0 X0 Y0 Z50 A0 C30\nG1 X10 C330 F1000\nM30\n");
        assert!(all[0].message.contains("off by 0.04 mm"), "{all:?}");
        assert_eq!(found("TRAORI\nG0 X0 Y0 Z50 A0 C330\nG1 X10 C390 F1000\nM30\n"), []);
    }

    #[test]
    fn without_a_declared_uncertainty_nothing_is_said() {
        assert_drawn(
            "gcode sinumerik-840d mikron-ucp710",
            "TRAORI\nG0 X0 Y0 Z50 A40 C0\nG1 X100 C30 F100\nX0 C60\nX100 C90\nM30\n",
        );
    }
}
