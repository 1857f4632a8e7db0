//! Between the ends of a feed motion the body of the tool leaves its path by more than the tolerance.
//!
//! # Why
//! The tip may be guided exactly while the tool axis takes a different path from the one the vectors define. The
//! part of the tool above the tip then swings out; the longer the tool, the farther. Where the flank cuts, that
//! changes the surface of the part.
//!
//! # Example
//! ```gcode apt mikron-ucp710
//! LOADTL/1,LENGTH,80
//! MULTAX/ON
//! FEDRAT/500,MMPM
//! GOTO/0,0,50,0,-0.5,0.8660254
//! GOTO/100,0,50,0.08,-0.4935585,0.8660254
//! $$            ^^^^^^^^^^^^^^^^^^^^^^^^^ swept-deviation: 80 mm above its tip the tool leaves its path by
//! FINI
//! ```
//!
//! # Use instead
//! ```gcode apt mikron-ucp710
//! LOADTL/1,LENGTH,80
//! MULTAX/ON
//! FEDRAT/500,MMPM
//! GOTO/0,0,50,0,-0.5,0.8660254
//! GOTO/50,0,50,0.04,-0.4983974,0.8660254
//! GOTO/100,0,50,0.08,-0.4935585,0.8660254
//! FINI
//! ```
//!
//! # Guarantee
//! Sound: silence rests on a proven bound, not on samples. The rule judges the point on the tool axis at the tool's
//! length above the tip, against the path that it has when the tip moves along its segment and the tool axis turns
//! at a constant rate on the great circle. Without tool centre point control the tip itself deviates, and
//! `path-deviation` judges it. Where the length of the tool is not known, silence holds for tools up to 1 m long;
//! where a 1 m tool would exceed the tolerance, the rule says unknown (tool length not known), once, with the
//! amount. It also says unknown where it is uncertain how the control turns the axes between vectors.
//!
//! # Thresholds
//! `swept`: 0.05 mm.
//!
//! # Sources
//! * docs/kinematics.md#deviation-of-the-tool-body
use crate::prelude::*;
use trunnion_machine::{Deviation, swept_deviation};

pub(super) const RULE: Body = Body::sound(Warning, &[Wake::VectorCut(check)]).follows_pole_event();

/// No tool is longer, mm.
const LONGEST_MM: f64 = 1000.0;

/// Keys for merging: a deviation, one that is not proven, what is unknown.
const FOUND: u64 = 1;
const BETWEEN: u64 = 2;
const NOT_KNOWN: u64 = 3;

fn check(cut: &facts::VectorCut<'_>, out: &mut Reporter<'_>) {
    let tolerance = cut.machine.tolerances.swept_mm;
    let declared = cut.end.tool_length > 0.0;
    let length = if declared { cut.end.tool_length } else { LONGEST_MM };
    // opposite tool axes are reported by orientation-deviation, a deviating tip by path-deviation
    let Some(deviation) = swept_deviation(cut.machine, cut.leg, length, tolerance) else {
        return;
    };
    if deviation.bound_mm <= tolerance {
    } else if !declared {
        not_known(
            cut,
            out,
            &deviation,
            length,
            "the tool length is unknown, and a 1 m tool would exceed the tolerance",
            "declare the tool's length in trunnion.toml: [[tool]] number = ..., length = ...",
        );
    } else if cut.orientation_is_assumed() {
        not_known(
            cut,
            out,
            &deviation,
            length,
            "the machine file does not say how the control turns the axes between vectors",
            "declare it in the machine file: [control] tcp = { orientation = \"joint\" } or \"great-circle\"",
        );
    } else {
        found(cut, out, &deviation, length);
    }
}

fn found(cut: &LegView<'_>, out: &mut Reporter<'_>, deviation: &Deviation, length: f64) {
    let tolerance = cut.machine.tolerances.swept_mm;
    let (sampled, bound) = (deviation.sampled_mm, deviation.bound_mm);
    let values = |draft: &mut Draft<'_>| {
        draft
            .value("deviation_mm", sampled)
            .value("deviation_bound_mm", bound)
            .value("limit_mm", tolerance)
            .value("above_tip_mm", length)
            .value("farthest_at_percent", deviation.at * 100.0);
    };
    if sampled > tolerance {
        out.finding(cut, Merge::runs(FOUND, sampled), |draft| {
            draft
                .at_orientation()
                .say(format!(
                    "{} above its tip the tool leaves its path by {}",
                    mm(length),
                    mm(sampled)
                ))
                .note(format!(
                    "largest after {} % of the block; proven to be at most {}; the tolerance is {}",
                    number((deviation.at * 100.0).round()),
                    bound_mm(bound),
                    mm(tolerance)
                ))
                .help("make the control keep to the great circle (ORIVECT, G43.5 with vectors), or divide the block into smaller steps");
            values(draft);
        });
    } else {
        out.unknown(cut, Merge::runs(BETWEEN, bound), |draft| {
            draft
                .at_orientation()
                .say(format!(
                    "{} above its tip the tool leaves its path by between {} and {}: the tolerance of {} is not proven",
                    mm(length),
                    mm(sampled),
                    bound_mm(bound),
                    mm(tolerance)
                ))
                .help("divide the block into smaller steps, or allow a slightly larger tolerance");
            values(draft);
        });
    }
}

fn not_known(cut: &LegView<'_>, out: &mut Reporter<'_>, deviation: &Deviation, length: f64, why: &str, help: &str) {
    let tolerance = cut.machine.tolerances.swept_mm;
    out.unknown(cut, Merge::once(NOT_KNOWN), |draft| {
        draft
            .at_orientation()
            .say(format!("it is not known whether the body of the tool keeps to its path: {why}"))
            .note(format!(
                "linearly interpolated rotary axes leave the great circle between these tool vectors: by at most {1} at {0} above the tip; the tolerance is {2}",
                mm(length),
                bound_mm(deviation.bound_mm),
                mm(tolerance)
            ))
            .help(help)
            .value("deviation_bound_mm", deviation.bound_mm)
            .value("limit_mm", tolerance)
            .value("above_tip_mm", length);
    });
}

#[cfg(test)]
mod tests {
    use crate::fixture::Fixture;
    use crate::{Diagnostic, Status};

    fn found(text: &str) -> Vec<Diagnostic> {
        let report = Fixture::parse("gcode apt mikron-ucp710", text).check().unwrap();
        let own = |d: &Diagnostic| d.rule == "swept-deviation";
        report.diagnostics.into_iter().filter(own).collect()
    }

    fn program(length: &str) -> String {
        format!(
            "LOADTL/1{length}\nMULTAX/ON\nFEDRAT/500,MMPM\nGOTO/0,0,50,0,-0.5,0.866\nGOTO/100,0,50,0.08,-0.494,0.866\nFINI\n"
        )
    }

    #[test]
    fn the_longer_the_tool_the_farther_its_body() {
        assert_eq!(found(&program(",LENGTH,20")), []);
        let all = found(&program(",LENGTH,160"));
        assert_eq!((all.len(), all[0].status), (1, Status::Fail));
    }

    #[test]
    fn a_tool_without_length_is_not_known_once() {
        let twice = program("").replace("FINI", "GOTO/0,0,50,0,-0.5,0.866\nFINI");
        let all = found(&twice);
        assert_eq!((all.len(), all[0].status, all[0].count), (1, Status::Unknown, 2));
        assert!(
            all[0].message.contains("the tool length is unknown"),
            "{}",
            all[0].message
        );
        let bound = all[0].values.iter().find(|(key, _)| *key == "above_tip_mm");
        assert_eq!(bound, Some(&("above_tip_mm", crate::ValueKey::Number(1000.0))));
    }

    /// A turn so small that even a tool of a metre keeps its path.
    #[test]
    fn small_turns_need_no_length() {
        let text = "LOADTL/1\nMULTAX/ON\nFEDRAT/500,MMPM\nGOTO/0,0,50,0,-0.5,0.8660254\nGOTO/100,0,50,0.008,-0.499936,0.8660254\nFINI\n";
        assert_eq!(found(text), []);
    }
}
