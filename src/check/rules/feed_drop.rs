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
//! Sound for axes with a declared speed: the worst moment inside the block is judged, not the average. Acceleration is
//! not considered. Up to 8 consecutive blocks are reported one by one; a longer run is reported as one finding with
//! its worst block. What it finds follows from an axis that is too fast: it is listed in the finding of `axis-overspeed`
//! for the same blocks, which takes its level.
//!
//! # Thresholds
//! `feed_drop_warning`: 0.8 of the programmed feed; `feed_drop_error`: 0.3.
//!
//! # Sources
//! * docs/kinematics.md#axis-speed-and-feed
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Warning, &[Wake::HeldBackCut(check)])
    .follows_pole_event()
    .follows("axis-overspeed");

/// Relative room for rounding.
const ROUNDING: f64 = 1e-9;

fn check(cut: &facts::HeldBackCut<'_>, out: &mut Reporter<'_>) {
    let Some(limit) = cut.feed_limit() else { return };
    let Some(feed) = cut.programmed_feed().filter(|feed| *feed > 0.0) else {
        return;
    };
    let share = limit.feed_mm_min / feed;
    let tolerances = &cut.machine.tolerances;
    // what is ambiguous is reported by axis-overspeed: the axis that drops the feed is too fast at the programmed one
    if share >= tolerances.feed_drop_warning * (1.0 - ROUNDING) || cut.feed_is_ambiguous() {
        return;
    }
    let severity = if share < tolerances.feed_drop_error {
        Error
    } else {
        Warning
    };
    // a run of one axis, as that of axis-overspeed, which it is part of
    let letter_of_axis = cut.machine.axes[limit.axis].letter;
    let key = u64::from(letter_of_axis) + 256 * u64::from(cut.feed_in_degrees());
    out.finding_as(severity, cut, Merge::runs(key, -limit.feed_mm_min), |draft| {
        let name = letter(letter_of_axis);
        let (unit, keys) = (cut.feed_unit(), cut.feed_keys());
        let percent = number((share * 1000.0).round() / 10.0);
        draft
            .at_axis(b'F')
            .say(format!(
                "the axes allow {} {unit}, {percent} % of the programmed {} {unit}",
                highest_rate(limit.feed_mm_min),
                number(feed)
            ))
            .note(format!("{name} limits the block"))
            .help("reduce the feed in this block, or change the path so that the axis moves less")
            .value(keys[0], feed)
            .value(keys[1], limit.feed_mm_min)
            .value("share_percent", share * 100.0)
            .value_text("limiting_axis", name)
            .fix_pole(cut)
            .fix_turns(cut)
            .fix_feed();
    });
}

#[cfg(test)]
mod tests {
    use crate::Severity;

    #[test]
    fn below_eighty_percent_it_warns_below_thirty_it_is_an_error() {
        // C turns 9 deg in 1 mm at 120 deg/s: 800 mm/min
        // one finding, with that of the axis
        for (feed, severity) in [
            (1000, None),
            (1001, Some((Severity::Warning, 1))),
            (2667, Some((Severity::Error, 1))),
        ] {
            let text = format!("TRAORI\nG0 X0 Y0 Z50 A30 C0\nG1 X1 C9 F{feed}\nM30\n");
            let fixture = crate::fixture::Fixture::parse("gcode sinumerik-840d mikron-ucp710", &text);
            let report = fixture.check().unwrap();
            let found = report
                .findings()
                .find(|d| d.rule == "feed-drop")
                .map(|d| (d.severity, report.diagnostics.len()));
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
        let found: Vec<_> = report.findings().filter(|d| d.rule == "feed-drop").collect();
        assert_eq!(
            (found.len(), found[0].count, found[0].severity),
            (1, 12, Severity::Error)
        );
    }
}
