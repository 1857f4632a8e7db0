//! In a feed motion the linear axes travel much farther than the tip.
//!
//! # Why
//! While the tool turns, the linear axes carry the tip along. Far from the rotary axes, or near the pole, they
//! travel in large loops for a short cut. That costs time and accuracy, and a loop may lead out of the travel or
//! into a clamp.
//!
//! # Example
//! ```gcode sinumerik-840d mikron-ucp710
//! N10 TRAORI
//! N20 G0 X0 Y0 Z200 A10 C0
//! N30 G1 X5 A25 F50
//! ;         ^^^ excess-linear-travel: the linear axes travel
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
//! Sound where the path of the axes is known: their travel is bounded from both sides until it is clearly above or
//! below the allowed value. Where the bounds do not settle it, the rule says unknown and gives both. On a great
//! circle over the pole the path is unknown, and `axis-limit` says so. Blocks without rotary motion are not judged:
//! there the axes travel as far as the tip. A tip path shorter than 0.1 mm counts as 0.1 mm; without tool centre
//! point control it is the distance between the tips in the workpiece.
//!
//! # Thresholds
//! `linear_ratio`: 5, the travel of the linear axes (root of the sum of squares) divided by the travel of the tip.
//! A note names each axis that runs more than 1 mm beyond both its ends.
//!
//! # Sources
//! * docs/kinematics.md#travel-ratios
use crate::prelude::*;
use trunnion_machine::excursions;

pub(super) const RULE: Body = Body::sound(Warning, &[Wake::FarCut(check)]).follows_pole_event();

/// Key for merging what is not proven.
const BETWEEN: u64 = 1;

/// Axes that run farther than this beyond both ends are noted, mm.
const BEYOND_MM: f64 = 1.0;

fn check(cut: &facts::FarCut<'_>, out: &mut Reporter<'_>) {
    const LEAST_MM: f64 = facts::FarCut::LEAST_MM;
    let (travel, tip, allowed) = (&cut.travel, cut.tip_mm, cut.allowed_mm);
    if travel.least_mm <= allowed {
        return between(cut, out);
    }
    let times = travel.least_mm / tip.max(LEAST_MM);
    out.finding(cut, Merge::runs(0, times), |draft| {
        at_turning_word(cut, draft)
            .say(format!(
                "the linear axes travel {} while the tip travels {}",
                mm(travel.least_mm),
                mm(tip)
            ))
            .note(format!(
                "{} times as far; up to {} times is allowed, and a tip path below {LEAST_MM} mm counts as {LEAST_MM} mm",
                number(times),
                number(cut.machine.tolerances.linear_ratio)
            ))
            .help("turn the tool axis more evenly, set up the part closer to the rotary axes, or turn the axes out of the cut")
            .value("value_mm", travel.least_mm)
            .value("tip_mm", tip)
            .value("limit_mm", allowed);
        for excursion in excursions(cut.machine, cut.leg, BEYOND_MM) {
            let name = letter(cut.machine.axes[excursion.axis].letter);
            let side = if excursion.upward { "above" } else { "below" };
            draft.note(format!(
                "inside the block {name} moves {} {side} both its end positions",
                mm(excursion.beyond_mm)
            ));
        }
        draft.fix_turns(cut);
    });
}

/// At the word of the rotary axis that turns most: it is what makes the linear axes move.
fn at_turning_word<'d, 'p>(cut: &LegView<'_>, draft: &'d mut Draft<'p>) -> &'d mut Draft<'p> {
    let turns = cut.machine.rotary.iter().zip(cut.leg.rotary_change);
    match turns.max_by(|one, other| one.1.abs().total_cmp(&other.1.abs())) {
        Some((axis, _)) => draft.at_axis(cut.machine.axes[*axis].letter),
        None => draft,
    }
}

/// The threshold is between the bounds.
fn between(cut: &facts::FarCut<'_>, out: &mut Reporter<'_>) {
    let (travel, tip, allowed) = (&cut.travel, cut.tip_mm, cut.allowed_mm);
    out.unknown(cut, Merge::runs(BETWEEN, travel.most_mm), |draft| {
        let most = if travel.most_mm.is_finite() {
            format!("at most {}", bound_mm(travel.most_mm))
        } else {
            "no upper bound is known".to_owned()
        };
        at_turning_word(cut, draft)
            .say(format!(
                "it is not proven whether the linear axes travel more than {} while the tip travels {}: at least {}, {most}",
                mm(allowed),
                mm(tip),
                mm(travel.least_mm)
            ))
            .help("divide the block into smaller steps")
            .value("least_mm", travel.least_mm)
            .value("tip_mm", tip)
            .value("limit_mm", allowed);
        if travel.most_mm.is_finite() {
            draft.value("bound_mm", travel.most_mm);
        }
    });
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
            let own = report.findings().filter(|d| d.rule == "excess-linear-travel");
            assert_eq!(own.count(), count, "X{x}: {:?}", report.diagnostics);
        }
    }

    /// C turns by 90 deg and X and Y carry the tool along, so that the tip does not move on the part while they run 141 mm: a zero point that
    /// changes between the blocks moves nothing.
    #[test]
    fn the_way_of_the_tip_is_that_on_the_part_whatever_the_zero_point() {
        for (shift, x) in [("", -100), ("TRANS X500\n", -600)] {
            let text = format!("G0 X0 Y-100 Z50 A0 C0\n{shift}G1 X{x} Y0 C90 F50\nM30\n");
            let fixture = Fixture::parse("gcode sinumerik-840d mikron-ucp710", &text);
            let report = fixture.check().unwrap();
            let own = report.findings().find(|d| d.rule == "excess-linear-travel");
            let said = own.map(|own| own.message.as_str());
            assert_eq!(
                said,
                Some("the linear axes travel 141.4 mm while the tip travels 0 mm"),
                "{shift}"
            );
        }
    }

    /// How an allowed ratio changes the verdict on a block.
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

    /// Between ratios that fail and ratios that hold there is one that is not proven: it is reported, with both bounds.
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
                .any(|note| note == "inside the block Z moves 9.369 mm above both its end positions"),
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
