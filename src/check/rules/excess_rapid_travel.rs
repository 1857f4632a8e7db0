//! The rapid motions from one cut to the next make a long detour.
//!
//! # Why
//! Rapid motions cut nothing: every detour is lost time in each part. Often the cause is a point left over from an
//! edit, or a return to a safe position that nothing needs.
//!
//! # Example
//! ```gcode mill-3axis
//! N10 G0 X0 Y0 Z50
//! N20 G1 X10 F500
//! N30 G0 Z60
//! N40 G0 Y200
//! N50 G0 X20
//! N60 G0 Y0
//! N70 G1 X30
//! ;   ^^^^^^ excess-rapid-travel: the rapid motions to this block travel 410 mm across the tool; the direct distance is 10 mm
//! N80 M30
//! ```
//!
//! # Use instead
//! ```gcode mill-3axis
//! N10 G0 X0 Y0 Z50
//! N20 G1 X10 F500
//! N30 G0 Z60
//! N50 G0 X20
//! N70 G1 X30
//! N80 M30
//! ```
//!
//! # Guarantee
//! Heuristic: a detour around a clamp is not wasted, and only declared obstacles (`[[obstacle]]`) are known. The rule judges
//! consecutive rapid motions between two feed motions with one tool. It compares the travel of the linear axes across the tool (a
//! retract along the tool is not counted) and the turn of each rotary axis with the direct distance between the
//! same ends; where obstacles are declared and no rotary axis turns, with the shortest path past them (`reroute-rapid` takes it where it is not below the level of the rapids). A direct distance below 0.1 mm or 0.1 deg counts as 0.1 mm or 0.1 deg; a detour below 10 mm or 10 deg is not
//! reported.
//!
//! # Thresholds
//! `rapid_ratio`: 2.
//!
//! # Sources
//! * docs/kinematics.md#travel-ratios
use crate::place::code_range;
use crate::prelude::*;
use trunnion_geometry::{Vec3, rad};
use trunnion_machine::{Space, ToolBody};

pub(super) const RULE: Body = Body::heuristic(Warning, &[Wake::Arrival(check)]);

/// A shorter direct distance is taken as this, mm or deg.
const LEAST: f64 = 0.1;

/// A smaller detour is not reported, mm or deg.
const DETOUR: f64 = 10.0;

fn check(arrival: &facts::Arrival<'_>, out: &mut Reporter<'_>) {
    let rapids = arrival.rapids;
    let ratio = arrival.machine.tolerances.rapid_ratio;
    let far =
        |way: f64, direct: f64, unit: f64| way > ratio * direct.max(LEAST * unit) && way - direct >= DETOUR * unit;
    let first = code_range(out.program(), rapids.first);
    let words = |draft: &mut Draft<'_>, message: String| {
        draft
            .say(message)
            .note(format!(
                "{} rapid motions; up to {} times the direct distance is allowed",
                rapids.count,
                number(ratio)
            ))
            .help("move there directly if nothing is in the way")
            .related(first, "the rapid motions start here");
    };
    // the way past obstacles is no shorter than the direct one
    let is_far = far(rapids.way_mm, rapids.direct_mm, 1.0);
    let past = is_far.then(|| past_obstacles(arrival)).flatten();
    let least_mm = past.unwrap_or(rapids.direct_mm).max(rapids.direct_mm);
    if far(rapids.way_mm, least_mm, 1.0) {
        out.event(|draft| {
            let (way, direct) = (mm(rapids.way_mm), mm(least_mm));
            let which = if past.is_some() {
                "the shortest path past the obstacles"
            } else {
                "the direct distance"
            };
            words(
                draft,
                format!("the rapid motions to this block travel {way} across the tool; {which} is {direct}"),
            );
            draft
                .fix_rapid(arrival)
                .value("value_mm", rapids.way_mm)
                .value("direct_mm", least_mm);
        });
    }
    for (slot, &axis) in arrival.machine.rotary.iter().enumerate().take(2) {
        let (turned, direct) = (rapids.turned[slot], rapids.direct_turn[slot]);
        if far(turned, direct, rad(1.0)) {
            out.event(|draft| {
                let name = letter(arrival.machine.axes[axis].letter);
                let (by, least) = (degrees(turned), degrees(direct));
                words(
                    draft,
                    format!("the rapid motions to this block turn {name} by {by}; the direct turn is {least}"),
                );
                draft
                    .value("value_deg", deg(turned))
                    .value("direct_deg", deg(direct))
                    .value_text("axis", name);
            });
        }
    }
}

/// Travel across the tool on the shortest way past the declared obstacles, mm; `None` where it is not known.
fn past_obstacles(arrival: &facts::Arrival<'_>) -> Option<f64> {
    let (machine, rapids) = (arrival.machine, arrival.rapids);
    if machine.obstacles.only_parts() || rapids.turned != [0.0; 2] || arrival.trail.undeclared.open() {
        return None;
    }
    let body = arrival.trail.tool.as_ref().and_then(ToolBody::of)?;
    let end = arrival.leg.start.as_ref()?;
    let keep = machine.tolerances.clearance_mm();
    let space = Space::new(machine, &rapids.from, end.tool_length, &body, keep).ok()?;
    let ends = (space.tip(machine, &rapids.from), space.tip(machine, &end.joints));
    let (points, _) = space
        .way((&ends.0, &ends.1), f64::NEG_INFINITY, Vec3::norm, |_| true)
        .ok()?;
    Some(points.windows(2).map(|pair| (pair[1] - pair[0]).xy().norm()).sum())
}

#[cfg(test)]
mod tests {
    use crate::fixture::{Fixture, assert_drawn};

    /// The obstacle of the paper, ten times as large: the long way round it is 127.97 mm, the shortest 84.72 mm, the direct distance 60 mm.
    #[test]
    fn the_long_way_round_the_barrier_of_the_paper_is_told() {
        let cut = "G0 X59 Y50 Z0\nG1 X60 F500\n";
        assert_drawn(
            "gcode mill-3axis",
            &format!("{cut}G0 X40 Y60\nG0 Y100\nG0 X60 Y110\nG1 X61\nM30\n"),
        );
        assert_drawn(
            "gcode mill-3axis",
            &format!(
                "{cut}G0 X90 Y60\nG0 X110 Y70\nG0 Y90\nG0 X90 Y100\nG0 X60 Y110\nG1 X61\n;^^^^^ excess-rapid-travel: the rapid motions to this block travel 128 mm across the tool; the direct distance is 60 mm\nM30\n"
            ),
        );
    }

    #[test]
    fn retracts_and_tool_changes_are_no_detour() {
        assert_drawn(
            "gcode mill-3axis",
            "G0 X0 Y0 Z0\nG1 X1 F500\nG0 Z200\nG0 X2\nG0 Z0\nG1 X3\nG0 Y100\nG4 F1\nG0 Y0\nG1 X4\nM30\n",
        );
        let text = |change: &str| format!("G0 X0 Y0 Z0 A0 C0\nG1 X1 F500\nG0 Y200\n{change}G0 Y0 Z0 X1\nG1 X4\nM30\n");
        for (change, count) in [("T2 M6\n", 0), ("", 1)] {
            let report = Fixture::parse("gcode mikron-ucp710", &text(change)).check().unwrap();
            let own = report.diagnostics.iter().filter(|d| d.rule == "excess-rapid-travel");
            assert_eq!(own.count(), count, "{change}: {:?}", report.diagnostics);
        }
    }

    #[test]
    fn turns_for_nothing_are_told_by_axis() {
        assert_drawn(
            "gcode mikron-ucp710",
            "G0 X0 Y0 Z0 A0 C0\nG1 X1 F500\nG0 C90\nG0 C1\nG1 X4\n;^^^^ excess-rapid-travel: the rapid motions to this block turn C by 179 deg; the direct turn is 1 deg\nM30\n",
        );
    }

    #[test]
    fn a_tilted_head_retracts_along_its_tool() {
        // B 90: the tool is parallel to X
        assert_drawn(
            "gcode ferrari-bc",
            "G0 X0 Y0 Z0 B90 C0\nG1 Y1 F500\nG0 X200\nG0 Y2\nG0 X0\nG1 Y3\nM30\n",
        );
    }
}
