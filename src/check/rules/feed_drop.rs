//! In a block the axes allow only a small part of the programmed feed.
//!
//! # Why
//! The tool slows down in the cut. It rubs instead of cutting and leaves a mark, and the program takes longer than
//! its feeds suggest.
//!
//! # Example
//! ```gcode sinumerik-840d mikron-ucp710
//! N10 TRAORI
//! N20 G0 X0 Y0 Z50 A30 C0
//! N30 G1 X1 C9 F2000
//! ;         ^^ axis-overspeed: C would have to run at
//! ;            ^^^^^ feed-drop: the axes allow
//! N40 M30
//! ```
//!
//! # Use instead
//! ```gcode sinumerik-840d mikron-ucp710
//! N10 TRAORI
//! N20 G0 X0 Y0 Z50 A30 C0
//! N30 G1 X1 C9 F600
//! N40 M30
//! ```
//!
//! # Guarantee
//! Sound for axes with a declared speed: the worst moment inside the block counts, not its average. Acceleration is
//! not considered. Up to 8 consecutive blocks are reported one by one; a longer run is reported as one finding with
//! its worst block.
//!
//! # Thresholds
//! `feed_drop_warning`: 0.8 of the programmed feed; `feed_drop_error`: 0.3.
//!
//! # Sources
//! * docs/kinematics.md#axis-speed-and-feed
use super::axis_overspeed::feed_keys;
use crate::prelude::*;
use crate::runs::SHORT_RUN;

pub(super) const RULE: Body = Body {
    severity: Severity::Warning,
    guarantee: Guarantee::Sound,
    level: Level::Leg(Needs::FEED.and(Needs::HURRIES), check),
};

/// Relative room for rounding.
const ROUNDING: f64 = 1e-9;

fn check(view: &LegView<'_>, out: &mut Reporter<'_>) {
    if !view.motion().is_feed() {
        return;
    }
    let Some(limit) = view.feed_limit() else { return };
    let Some(feed) = view.programmed_feed().filter(|feed| *feed > 0.0) else {
        return;
    };
    let share = limit.feed_mm_min / feed;
    let tolerances = &view.machine.tolerances;
    if share >= tolerances.feed_drop_warning * (1.0 - ROUNDING) {
        return;
    }
    // reported by axis-overspeed: the axis that drops the feed is too fast at the programmed one
    if view.feed_is_ambiguous(out.dialect()) {
        return;
    }
    let severity = if share < tolerances.feed_drop_error {
        Severity::Error
    } else {
        Severity::Warning
    };
    let key = u64::from(view.feed_in_degrees());
    if out.repeats_as(severity, view, key, -limit.feed_mm_min) {
        return;
    }
    let name = letter(view.machine.axes[limit.axis].letter);
    let range = axis_word(out.program(), view.motion().block, b'F');
    let (unit, keys) = (view.feed_unit(), feed_keys(view));
    let percent = number((share * 1000.0).round() / 10.0);
    let draft = out.report(
        range,
        format!(
            "the axes allow {} {unit}, {percent} % of the programmed {} {unit}",
            highest_rate(limit.feed_mm_min),
            number(feed)
        ),
    );
    draft
        .note(format!("{name} limits the block"))
        .help("reduce the feed in this block, or change the path so that the axis moves less")
        .value(keys[0], feed)
        .value(keys[1], limit.feed_mm_min)
        .value("share_percent", share * 100.0)
        .value_text("limiting_axis", name)
        .severity(severity);
    if view.near_pole() && view.forced_swap().is_none() {
        draft.fix("smooth-pole");
    }
    if view.turns_far() {
        draft.fix("unwind-rotary");
    }
    draft.merge_runs_over(SHORT_RUN, key, -limit.feed_mm_min);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn below_eighty_percent_it_warns_below_thirty_it_is_an_error() {
        // C turns 9 deg in 1 mm at 120 deg/s: 800 mm/min
        for (feed, severity) in [
            (1000, None),
            (1001, Some(Severity::Warning)),
            (2667, Some(Severity::Error)),
        ] {
            let text = format!("TRAORI\nG0 X0 Y0 Z50 A30 C0\nG1 X1 C9 F{feed}\nM30\n");
            let fixture = crate::fixture::Fixture::parse("gcode sinumerik-840d mikron-ucp710", &text);
            let report = fixture.check().unwrap();
            let found = report
                .diagnostics
                .iter()
                .find(|d| d.rule == "feed-drop")
                .map(|d| d.severity);
            assert_eq!(found, severity, "F{feed}: {:?}", report.diagnostics);
        }
    }

    #[test]
    fn a_long_run_of_warnings_with_one_error_is_an_error() {
        // C turns 9 deg in each mm at 120 deg/s: 800 mm/min; the error comes where the allowed feed is the same
        let feed = |i| if i == 11 { 4000 } else { 1600 };
        let row = |i| format!("X{i} C{} F{}\n", 9 * i, feed(i));
        let rows = (1..=12).map(row).collect::<Vec<_>>().concat();
        let text = format!("TRAORI\nG0 X0 Y0 Z50 A30 C0\nG1 F1600\n{rows}M30\n");
        let fixture = crate::fixture::Fixture::parse("gcode sinumerik-840d mikron-ucp710", &text);
        let report = fixture.check().unwrap();
        let found: Vec<_> = report.diagnostics.iter().filter(|d| d.rule == "feed-drop").collect();
        assert_eq!(
            (found.len(), found[0].count, found[0].severity),
            (1, 12, Severity::Error)
        );
    }
}
