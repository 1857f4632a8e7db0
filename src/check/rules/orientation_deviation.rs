//! Between the ends of a feed motion the tool axis leaves the programmed plane by more than the tolerance.
//!
//! # Why
//! Two tool vectors define the great circle between them. A control that interpolates its rotary axes linearly
//! moves the tool axis along a different path; the closer to the pole, the larger the difference. The flank of the
//! tool gouges although both ends are right.
//!
//! # Example
//! ```gcode sinumerik-840d mikron-ucp710
//! N10 TRAORI
//! N20 G0 X0 Y0 Z50 A3=0 B3=-0.5 C3=0.866
//! N30 G1 X100 A3=0.25 B3=-0.433 C3=0.866 F500
//! ;           ^^^^^^^^^^^^^^^^^^^^^^^^^^ orientation-deviation: the tool axis leaves the great circle between the vectors by
//! ;           ^^^^^^^^^^^^^^^^^^^^^^^^^^ swept-deviation: it is not known whether the body of the tool keeps to its path
//! N40 M30
//! ```
//!
//! # Use instead
//! ```gcode sinumerik-840d mikron-ucp710
//! N10 TRAORI
//! N15 ORIVECT
//! N20 G0 X0 Y0 Z50 A3=0 B3=-0.5 C3=0.866
//! N30 G1 X100 A3=0.25 B3=-0.433 C3=0.866 F500
//! N40 M30
//! ```
//!
//! # Guarantee
//! Sound: silence rests on a proven bound, not on samples. The deviation is the angle to the great-circle arc
//! between the two vectors. There is none where the program gives rotary words and the control interpolates them
//! linearly, or where it gives vectors and the control follows the great circle. The rule says unknown, once,
//! where neither the program nor the machine file says which applies and linear interpolation would exceed the
//! tolerance. It also says unknown where samples are within the tolerance but the bound does not prove it, and
//! where the vectors at the ends are opposite. Up to 8 consecutive blocks are reported one by one; a longer run is
//! reported as one finding with its worst block.
//!
//! # Thresholds
//! `orientation`: 0.1 deg.
//!
//! # Sources
//! * docs/kinematics.md#deviation-of-the-tool-axis
use crate::prelude::*;
use trunnion_machine::orientation_deviation;

pub(super) const RULE: Body = Body::sound(Warning, &[Wake::VectorCut(check)]).follows_pole_event();

/// Keys for merging: a deviation, one that is not proven, a control that is unknown, ends that are opposite.
const FOUND: u64 = 1;
const BETWEEN: u64 = 2;
const ASSUMED: u64 = 3;
const OPPOSITE: u64 = 4;

fn check(cut: &facts::VectorCut<'_>, out: &mut Reporter<'_>) {
    let tolerance = cut.machine.tolerances.orientation;
    let Some(deviation) = orientation_deviation(cut.machine, cut.leg, tolerance) else {
        return opposite(cut, out);
    };
    let (sampled, bound) = (deviation.sampled, deviation.bound);
    let values = |draft: &mut Draft<'_>| {
        draft
            .value("deviation_deg", deg(sampled))
            .value("deviation_bound_deg", deg(bound))
            .value("limit_deg", deg(tolerance))
            .value("farthest_at_percent", deviation.at * 100.0);
    };
    if bound <= tolerance {
    } else if cut.orientation_is_assumed() {
        out.unknown(cut, Merge::once(ASSUMED), |draft| {
            draft
                .at_orientation()
                .say(format!(
                    "the tool axis leaves the great circle by {} if the control interpolates its rotary axes linearly: the machine file of {} does not say whether it does",
                    degrees(sampled),
                    cut.machine.id
                ))
                .help("declare it in the machine file: [control] tcp = { orientation = \"joint\" } or \"great-circle\"")
                .value("deviation_deg", deg(sampled));
        });
    } else if sampled > tolerance {
        out.finding(cut, Merge::runs(FOUND, sampled), |draft| {
            draft
                .at_orientation()
                .say(format!(
                    "the tool axis leaves the great circle between the vectors by {}",
                    degrees(sampled)
                ))
                .note(format!(
                    "largest after {} % of the block; proven to be at most {}; the tolerance is {}",
                    number((deviation.at * 100.0).round()),
                    bound_degrees(bound),
                    degrees(tolerance)
                ))
                .help("make the control keep to the great circle (ORIVECT, G43.5 with vectors), or divide the block into smaller steps");
            values(draft);
        });
    } else {
        out.unknown(cut, Merge::runs(BETWEEN, bound), |draft| {
            draft
                .at_orientation()
                .say(format!(
                    "the tool axis leaves the great circle by between {} and {}: the tolerance of {} is not proven",
                    degrees(sampled),
                    bound_degrees(bound),
                    degrees(tolerance)
                ))
                .help("divide the block into smaller steps, or allow a slightly larger tolerance");
            values(draft);
        });
    }
}

fn opposite(cut: &LegView<'_>, out: &mut Reporter<'_>) {
    // the fault that removed the centre of an arc reports it
    if matches!(cut.motion().kind, trunnion_interp::MotionKind::Arc(None)) {
        return;
    }
    out.unknown(cut, Merge::once(OPPOSITE), |draft| {
        draft
            .at_orientation()
            .say("the tool vectors at the two ends are opposite: it is not known which great circle is meant")
            .help("program an intermediate vector");
    });
}

#[cfg(test)]
mod tests {
    use crate::fixture::{Fixture, assert_drawn};
    use crate::{Diagnostic, Severity, Status};

    fn found(info: &str, text: &str) -> Vec<Diagnostic> {
        let report = Fixture::parse(info, text).check().unwrap();
        let own = |d: &Diagnostic| d.rule == "orientation-deviation";
        report.diagnostics.into_iter().filter(own).collect()
    }

    #[test]
    fn rotary_words_run_as_they_are_programmed() {
        assert_drawn(
            "gcode sinumerik-840d mikron-ucp710",
            "TRAORI\nG0 X0 Y0 Z50 A30 C0\nG1 X100 A30 C60 F500\nM30\n",
        );
    }

    #[test]
    fn a_tenth_of_a_degree_is_the_threshold() {
        // at a tilt of A the path around the cone is about dC^2 sin A cos A / 8 away from the great circle
        let text = |j: f64| {
            let (sin, cos) = trunnion_geometry::math::sin_cos(trunnion_geometry::rad(j));
            let (sin, cos) = (0.5 * sin, 0.5 * cos);
            format!("TRAORI\nG0 X0 Y0 Z50 A3=0 B3=-0.5 C3=0.866\nG1 X100 A3={sin} B3=-{cos} C3=0.866 F500\nM30\n")
        };
        assert_eq!(found("gcode sinumerik-840d mikron-ucp710", &text(10.6)).len(), 1);
        assert_eq!(
            found("gcode sinumerik-840d mikron-ucp710", &text(10.6))[0].severity,
            Severity::Warning
        );
        assert_eq!(found("gcode sinumerik-840d mikron-ucp710", &text(10.0)), []);
    }

    #[test]
    fn a_control_that_is_not_declared_is_not_judged() {
        let text = "MULTAX/ON\nFEDRAT/500,MMPM\nGOTO/0,0,50,0,-0.5,0.866\nGOTO/100,0,50,0.25,-0.433,0.866\nGOTO/0,0,50,0,-0.5,0.866\nFINI\n";
        let all = found("gcode apt ferrari-bc", text);
        assert_eq!(all.len(), 1, "{all:?}");
        assert_eq!((all[0].status, all[0].count), (Status::Unknown, 2));
        assert!(all[0].message.contains("the machine file of ferrari-bc does not say"));
    }
}
