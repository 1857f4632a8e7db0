//! Between the ends of a feed motion the tool tip leaves the programmed path by more than the tolerance.
//!
//! # Why
//! Without tool centre point control all axes move linearly. While a rotary axis turns, the tip moves on a curve
//! instead of the line: it gouges or leaves material although both ends are right.
//!
//! # Example
//! ```gcode mikron-ucp710
//! N10 G0 X30 Y0 Z0 A20 C0
//! N20 G1 Y5 C40 F500
//! ;   ^^^^^^^^^^^^^^ path-deviation: the tip leaves the programmed segment by
//! N30 M30
//! ```
//!
//! # Use instead
//! ```gcode sinumerik-840d mikron-ucp710
//! N5 TRAORI
//! N10 G0 X30 Y0 Z0 A20 C0
//! N20 G1 Y5 C40 F500
//! N30 M30
//! ```
//!
//! # Guarantee
//! Sound: silence rests on a proven bound, not on samples. The rule says unknown where samples are within the
//! tolerance but the bound does not prove it, and where a motion is not modelled. The deviation is the distance to
//! the programmed segment: the line between the tips at both ends in the workpiece, or the arc in its position in
//! the workpiece at the start of the block, with its end carried linearly to where the tip ends. With tool centre
//! point control the control keeps the tip on its path. A feed motion that runs point to point (PTP of a Sinumerik) has
//! no programmed path; it is named once as information. Up to 8 consecutive blocks are reported one by one; a
//! longer run is reported as one finding with its worst block.
//!
//! # Thresholds
//! `tip`: 0.01 mm.
//!
//! # Sources
//! * docs/kinematics.md#between-the-ends-of-a-block
//! * docs/kinematics.md#deviation-of-the-tip
use crate::prelude::*;
use trunnion_interp::Swivel;

pub(super) const RULE: Body = Body::sound(Error, &[Wake::StrayingCut(check)]);

/// Keys for merging: a path that is not modelled, a deviation, one that is not proven.
const NOT_MODELLED: u64 = 0;
const FOUND: u64 = 1;
const BETWEEN: u64 = 2;
const POINT_TO_POINT: u64 = 3;

fn check(cut: &facts::StrayingCut<'_>, out: &mut Reporter<'_>) {
    if cut.motion().tilt.swivel == Swivel::PointToPoint {
        return point_to_point(cut, out);
    }
    let tolerance = cut.machine.tolerances.tip_mm;
    let Some(deviation) = cut.deviation() else {
        return out.unknown(cut, Merge::once(NOT_MODELLED), |draft| {
            draft.say("the path of the tip is not modelled in this block: its deviation is unknown");
        });
    };
    let (sampled, bound) = (deviation.sampled_mm, deviation.bound_mm);
    let values = |draft: &mut Draft<'_>| {
        draft
            .value("deviation_mm", sampled)
            .value("deviation_bound_mm", bound)
            .value("limit_mm", tolerance);
    };
    if bound <= tolerance {
    } else if sampled > tolerance {
        out.finding(cut, Merge::runs(FOUND, sampled), |draft| {
            draft
                .say(format!("the tip leaves the programmed segment by {}", mm(sampled)))
                .note(format!(
                    "largest after {} % of the block; proven to be at most {}; the tolerance is {}",
                    number((deviation.at * 100.0).round()),
                    bound_mm(bound),
                    mm(tolerance)
                ))
                .help("switch tool centre point control on, or insert points");
            values(draft);
            draft
                .value("farthest_at_percent", deviation.at * 100.0)
                .fix_turns(cut)
                .fix_points(cut);
        });
    } else {
        out.unknown(cut, Merge::runs(BETWEEN, bound), |draft| {
            draft
                .say(format!(
                    "the deviation of the tip is between {} and {}: the tolerance of {} is not proven",
                    mm(sampled),
                    bound_mm(bound),
                    mm(tolerance)
                ))
                .help("insert points, or allow a slightly larger tolerance");
            values(draft);
        });
    }
}

/// Under PTP the program asks for no straight path of the tip.
fn point_to_point(cut: &facts::StrayingCut<'_>, out: &mut Reporter<'_>) {
    let Some(deviation) = cut
        .deviation()
        .filter(|deviation| deviation.bound_mm > cut.machine.tolerances.tip_mm)
    else {
        return;
    };
    out.finding(cut, Merge::run(POINT_TO_POINT, deviation.sampled_mm), |draft| {
        draft
            .severity(Info)
            .say("this feed motion runs point to point (PTP): the tip does not go straight to the end of the block")
            .note(format!(
                "the axes move linearly; the tip leaves the straight line by at most {}",
                bound_mm(deviation.bound_mm)
            ))
            .help("program CP before a cut that must be straight");
    });
}

#[cfg(test)]
mod tests {
    use crate::fixture::{assert_drawn, check_on};

    /// The tip runs 29.304259 mm off its line; a tolerance between that and the bound is not proven to be kept.
    #[test]
    fn a_tolerance_between_sample_and_bound_is_not_proven() {
        let machine = trunnion_machine::builtin("mikron-ucp710").expect("embedded");
        let text = "G0 X100.051 Y0 Z0 A0 C0\nG1 X100.051 C90 F1000\nM30\n";
        let status = |tolerance: f64| {
            let config = crate::Config::parse(&format!("[tolerances]\ntip = {tolerance}\n")).expect("valid");
            let machine = config.machine_with_tolerances(machine);
            let report = check_on(&machine, "linuxcnc", text);
            report.findings().find(|d| d.rule == "path-deviation").map(|d| d.status)
        };
        assert_eq!(status(29.3), Some(crate::Status::Fail));
        assert_eq!(status(29.304_262), Some(crate::Status::Unknown));
        assert_eq!(status(29.31), None);
    }

    /// PTP asks for no straight path: the cut is named, and is no mistake.
    #[test]
    fn a_cut_from_point_to_point_is_information() {
        let report = assert_drawn(
            "gcode sinumerik-840d mikron-ucp710",
            "TRAORI\nG0 X0 Y0 Z50 A-10 C20\nPTP\nG1 X10 Y5 Z20 A-20 C30 F1000\n;^^^^^^^^^^^^^^^^^^^^^^^^^^^ path-deviation: this feed motion runs point to point\nCP\nTRAFOOF\nM30\n",
        );
        assert_eq!(report.diagnostics[0].severity, crate::Severity::Info);
        assert_eq!(report.diagnostics[0].status, crate::Status::Fail);
    }

    #[test]
    fn arcs_are_judged_while_a_rotary_axis_turns() {
        assert_drawn(
            "gcode linuxcnc mikron-ucp710",
            "G0 X30 Y0 Z0 A0 C0\nG2 X-30 Y0 I-30 J0 C0 F500\nG3 X30 Y0 I30 J0 C10\n;^^^^^^^^^^^^^^^^^^^ path-deviation: the tip leaves the programmed segment by\nM2\n",
        );
    }

    #[test]
    fn lines_without_rotary_motion_are_exact() {
        assert_drawn(
            "gcode mikron-ucp710",
            "N10 G0 X30 Y0 Z0 A20 C0\nN20 G1 Y200 F500\nN30 Y0\n",
        );
    }

    #[test]
    fn the_bound_is_never_below_the_sample() {
        let report = assert_drawn(
            "gcode mikron-ucp710",
            "N10 G0 X30 Y0 Z0 A0 C0\nN20 G1 C10 F500\n;   ^^^^^^^^^^^ path-deviation: \n",
        );
        let value = |key| {
            report.diagnostics[0]
                .values
                .iter()
                .find_map(|(name, value)| match value {
                    crate::ValueKey::Number(value) if *name == key => Some(*value),
                    _ => None,
                })
        };
        assert!(value("deviation_bound_mm") >= value("deviation_mm"));
    }
}
