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
//! point control the control keeps the tip on its path. Up to 8 consecutive blocks are reported one by one; a
//! longer run is reported as one finding with its worst block.
//!
//! # Thresholds
//! `tip`: 0.01 mm.
//!
//! # Sources
//! * docs/kinematics.md#between-the-ends-of-a-block
//! * docs/kinematics.md#deviation-of-the-tip
use crate::prelude::*;
use crate::runs::SHORT_RUN;
use trunnion_interp::MotionKind;

pub(super) const RULE: Body = Body {
    severity: Severity::Error,
    guarantee: Guarantee::Sound,
    level: Level::Leg(Needs::FEED.and(Needs::STRAYS), check),
};

fn check(view: &LegView<'_>, out: &mut Reporter<'_>) {
    // the fault that removed the centre of an arc reports it
    let lost = matches!(view.motion().kind, MotionKind::Arc(None));
    if !view.motion().is_feed() || lost || view.stances().is_none() {
        return;
    }
    let tolerance = view.machine.tolerances.tip_mm;
    let range = |out: &Reporter<'_>| code_range(out.program(), view.motion().block);
    let Some(deviation) = view.deviation() else {
        if out.repeats_unknown(view, 0, 0.0) {
            return;
        }
        let range = range(out);
        out.report(
            range,
            "the path of the tip is not modelled in this block: its deviation is not known",
        )
        .unknown()
        .merge_everywhere(0);
        return;
    };
    if deviation.bound_mm <= tolerance {
        return;
    }
    let repeats = if deviation.sampled_mm > tolerance {
        out.repeats(view, 1, deviation.sampled_mm)
    } else {
        out.repeats_unknown(view, 2, deviation.bound_mm)
    };
    if repeats {
        return;
    }
    let range = range(out);
    if deviation.sampled_mm > tolerance {
        let draft = out.report(
            range,
            format!("the tip leaves the programmed segment by {}", mm(deviation.sampled_mm)),
        );
        draft
            .note(format!(
                "largest after {} % of the block; proven to be at most {}; the tolerance is {}",
                number((deviation.at * 100.0).round()),
                bound_mm(deviation.bound_mm),
                mm(tolerance)
            ))
            .help("switch tool centre point control on, or insert points")
            .value("deviation_mm", deviation.sampled_mm)
            .value("deviation_bound_mm", deviation.bound_mm)
            .value("limit_mm", tolerance)
            .value("farthest_at_percent", deviation.at * 100.0)
            .merge_runs_over(SHORT_RUN, 1, deviation.sampled_mm);
        if view.turns_far() {
            draft.fix("unwind-rotary");
        }
    } else {
        let found = format!(
            "between {} and {}",
            mm(deviation.sampled_mm),
            bound_mm(deviation.bound_mm)
        );
        out.report(
            range,
            format!(
                "the deviation of the tip is {found}: the tolerance of {} is not proven",
                mm(tolerance)
            ),
        )
        .help("insert points, or allow a slightly larger tolerance")
        .value("deviation_mm", deviation.sampled_mm)
        .value("deviation_bound_mm", deviation.bound_mm)
        .value("limit_mm", tolerance)
        .unknown()
        .merge_runs_over(SHORT_RUN, 2, deviation.bound_mm);
    }
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
            report
                .diagnostics
                .iter()
                .find(|d| d.rule == "path-deviation")
                .map(|d| d.status)
        };
        assert_eq!(status(29.3), Some(crate::Status::Fail));
        assert_eq!(status(29.304_262), Some(crate::Status::Unknown));
        assert_eq!(status(29.31), None);
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
