//! In a feed motion the linear axes run much farther than the tip does.
//!
//! # Why
//! While the tool is turned the linear axes carry the tip along: far from the rotary axes, or near the pole, they run loops for
//! a short cut. That costs time and accuracy, and the loop may lead out of the travel or into a clamp.
//!
//! # Example
//! ```gcode sinumerik-840d mikron-ucp710
//! N10 TRAORI
//! N20 G0 X0 Y0 Z200 A10 C0
//! N30 G1 X5 A25 F50
//! ;         ^^^ excess-linear-travel: the linear axes run
//! N40 M30
//! ```
//!
//! # Use instead
//! ```gcode sinumerik-840d mikron-ucp710
//! N10 TRAORI
//! N20 G0 X0 Y0 Z200 A10 C0
//! N30 G1 X50 A25 F50
//! N40 M30
//! ```
//!
//! # Guarantee
//! Sound where the path of the axes is known: the length is bounded from both sides until it is on one side of what is allowed;
//! where that does not come about the rule says unknown, with both bounds. Over the pole on a great circle it is not
//! known, and `axis-limit` says so. Blocks without rotary motion are not judged: there the axes run as far as the tip. A tip
//! path below 0.1 mm counts as 0.1 mm; without tool centre point control it counts from tip to tip in the workpiece.
//!
//! # Thresholds
//! `linear_ratio`: 5, way of the linear axes (root of the sum of squares) over way of the tip. Noted are axes that run more
//! than 1 mm beyond both their ends.
//!
//! # Sources
//! Trunnion's kinematics notes, section 5 (LIN-EXCESS, LIM-LIN-INTERNAL); the paper on tool-path optimisation on loops of
//! machines with two rotary axes.
use crate::prelude::*;
use crate::runs::SHORT_RUN;
use trunnion_machine::{LinearTravel, Machine, excursions, linear_travel};
use trunnion_syntax::Program;

pub(super) const RULE: Body = Body {
    severity: Severity::Warning,
    guarantee: Guarantee::Sound,
    level: Level::Leg(Needs::FEED.and(Needs::TURNS).and(Needs::TRAVELS), check),
};

/// A shorter tip path counts as this, mm.
const LEAST_MM: f64 = 0.1;

/// Key for merging what is not proven.
const BETWEEN: u64 = 1;

/// Axes that run farther than this beyond both ends are noted, mm.
const BEYOND_MM: f64 = 1.0;

/// How far the linear joints may run while the tip runs `tip`, mm.
#[inline]
pub(crate) fn allowed(machine: &Machine, tip: f64) -> f64 {
    machine.tolerances.linear_ratio * tip.max(LEAST_MM)
}

fn check(view: &LegView<'_>, out: &mut Reporter<'_>) {
    if !view.motion().is_feed() || !view.rotary_turns() {
        return;
    }
    let Some((start, end)) = view.stances() else { return };
    let tip = if view.leads_tip() && !view.motion().machine_coordinates {
        view.leg.length
    } else {
        start.tip_distance_to(end)
    };
    let ratio = view.machine.tolerances.linear_ratio;
    let allowed = allowed(view.machine, tip);
    let Some(travel) = linear_travel(view.machine, view.leg, allowed) else {
        return;
    };
    if travel.most_mm <= allowed {
        return;
    }
    if travel.least_mm <= allowed {
        return between(view, out, &travel, tip, allowed);
    }
    let times = travel.least_mm / tip.max(LEAST_MM);
    if out.repeats(view, 0, times) {
        return;
    }
    let range = turning_word(view, out.program());
    let draft = out.report(
        range,
        format!(
            "the linear axes run {} while the tip runs {}",
            mm(travel.least_mm),
            mm(tip)
        ),
    );
    draft
        .note(format!(
            "{} times as far; allowed are {} times, a tip path below {LEAST_MM} mm counting as that",
            number(times),
            number(ratio)
        ))
        .help("lead the tool axis more evenly, set the part nearer to the rotary axes, or turn the axes out of the cut")
        .value("value_mm", travel.least_mm)
        .value("tip_mm", tip)
        .value("limit_mm", allowed)
        .merge_runs_over(SHORT_RUN, 0, times);
    for excursion in excursions(view.machine, view.leg, BEYOND_MM) {
        let name = letter(view.machine.axes[excursion.axis].letter);
        let side = if excursion.upward { "above" } else { "below" };
        draft.note(format!(
            "inside the block {name} runs {} {side} both its ends",
            mm(excursion.beyond_mm)
        ));
    }
    if view.turns_far() {
        draft.fix("unwind-rotary");
    }
}

/// The word of the rotary axis that turns most: it is what makes the linear axes run.
fn turning_word(view: &LegView<'_>, program: &Program) -> TextRange {
    let block = view.motion().block;
    let turns = view.machine.rotary.iter().zip(view.leg.rotary_change);
    let most = turns.max_by(|one, other| one.1.abs().total_cmp(&other.1.abs()));
    most.map_or_else(
        || code_range(program, block),
        |(axis, _)| axis_word(program, block, view.machine.axes[*axis].letter),
    )
}

/// The threshold lies between the bounds.
fn between(view: &LegView<'_>, out: &mut Reporter<'_>, travel: &LinearTravel, tip: f64, allowed: f64) {
    if out.repeats_unknown(view, BETWEEN, travel.most_mm) {
        return;
    }
    let range = turning_word(view, out.program());
    let most = if travel.most_mm.is_finite() {
        format!("{} at most", bound_mm(travel.most_mm))
    } else {
        "an upper bound is not known".to_owned()
    };
    let draft = out.report(
        range,
        format!(
            "whether the linear axes run more than {} while the tip runs {} is not proven: {} at least, {most}",
            mm(allowed),
            mm(tip),
            mm(travel.least_mm)
        ),
    );
    draft
        .help("program the block in smaller steps")
        .value("least_mm", travel.least_mm)
        .value("tip_mm", tip)
        .value("limit_mm", allowed)
        .unknown()
        .merge_runs_over(SHORT_RUN, BETWEEN, travel.most_mm);
    if travel.most_mm.is_finite() {
        draft.value("bound_mm", travel.most_mm);
    }
}

#[cfg(test)]
mod tests {
    use crate::fixture::{Fixture, assert_drawn, check_on};

    #[test]
    fn five_times_the_way_of_the_tip_is_the_threshold() {
        // Y and Z run 200 mm * 30 deg = 104.72 mm along an arc while X runs with the tip
        let text = |x: f64| format!("TRAORI\nG0 X0 Y0 Z200 A10 C0\nG1 X{x} A40 F50\nM30\n");
        for (x, count) in [(21.2, 1), (21.5, 0)] {
            let fixture = Fixture::parse("gcode sinumerik-840d mikron-ucp710", &text(x));
            let report = fixture.check().unwrap();
            let own = report.diagnostics.iter().filter(|d| d.rule == "excess-linear-travel");
            assert_eq!(own.count(), count, "X{x}: {:?}", report.diagnostics);
        }
    }

    /// C turns by 90 deg and X and Y carry the tool along, so that the tip stands still on the part while they run 141 mm: a zero point that
    /// changes between the blocks moves nothing.
    #[test]
    fn the_way_of_the_tip_is_that_on_the_part_whatever_the_zero_point() {
        for (shift, x) in [("", -100), ("TRANS X500\n", -600)] {
            let text = format!("G0 X0 Y-100 Z50 A0 C0\n{shift}G1 X{x} Y0 C90 F50\nM30\n");
            let fixture = Fixture::parse("gcode sinumerik-840d mikron-ucp710", &text);
            let report = fixture.check().unwrap();
            let own = report.diagnostics.iter().find(|d| d.rule == "excess-linear-travel");
            let said = own.map(|own| own.message.as_str());
            assert_eq!(
                said,
                Some("the linear axes run 141.4 mm while the tip runs 0 mm"),
                "{shift}"
            );
        }
    }

    /// What a ratio that is allowed makes of a block.
    fn status(ratio: f64) -> Option<(crate::Status, Vec<(&'static str, crate::ValueKey)>)> {
        let text = "TRAORI\nG0 X0 Y20 Z100 A10 C0\nG1 X3 A70 C50 F50\nM30\n";
        let mut machine = trunnion_machine::builtin("mikron-ucp710").expect("embedded").clone();
        machine.tolerances.linear_ratio = ratio;
        let report = check_on(&machine, "sinumerik-840d", text);
        let found = report
            .diagnostics
            .into_iter()
            .find(|d| d.rule == "excess-linear-travel");
        found.map(|found| (found.status, found.values))
    }

    /// Between ratios that fail and ratios that hold lies one that is not proven: it is not silent, and names both bounds.
    #[test]
    fn a_length_at_the_threshold_is_not_proven() {
        let (mut low, mut high) = (5.0, 200.0);
        let values = loop {
            let middle = 0.5 * (low + high);
            match status(middle) {
                None => high = middle,
                Some((crate::Status::Fail, _)) => low = middle,
                Some((crate::Status::Unknown, values)) => break values,
            }
            assert!(
                high - low > 1e-12,
                "silent on one side, failed on the other: {low} {high}"
            );
        };
        let value = |key: &str| {
            values
                .iter()
                .find(|(name, _)| *name == key)
                .map(|(_, value)| value.clone())
        };
        let (Some(crate::ValueKey::Number(least)), Some(crate::ValueKey::Number(most))) =
            (value("least_mm"), value("bound_mm"))
        else {
            panic!("no bounds: {values:?}")
        };
        assert!(least < most && most - least < 1e-5, "{values:?}");
    }

    #[test]
    fn axes_that_run_beyond_their_ends_are_noted() {
        let report = assert_drawn(
            "gcode sinumerik-840d mikron-ucp710",
            "TRAORI\nG0 X0 Y0 Z100 A-25 C0\nG1 X1 A40 F50\n;     ^^^ excess-linear-travel: \n;     ^^^ only-one-posture: \n;     ^^^ pole-crossing: \nM30\n",
        );
        let notes = &report.diagnostics[0].notes;
        // Z: 100 cos 25 deg = 90.6, 100, 76.6
        assert!(
            notes
                .iter()
                .any(|note| note == "inside the block Z runs 9.369 mm above both its ends"),
            "{notes:?}"
        );
    }

    #[test]
    fn without_rotary_motion_nothing_is_judged() {
        assert_drawn(
            "gcode sinumerik-840d mikron-ucp710",
            "TRAORI\nG0 X0 Y0 Z100 A20 C0\nG1 X0.001 F50\nX50\nM30\n",
        );
    }
}
