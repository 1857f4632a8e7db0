//! The tool nearly stands still in the cut.
//!
//! # Why
//! Where the tip hardly moves while the spindle turns, the tool rubs and heats the same spot: it leaves a mark that can be seen and felt. It happens
//! where rotary axes turn far while the tip moves only a short distance, for example next to the pole.
//!
//! # Example
//! ```gcode sinumerik-840d mikron-ucp710
//! N10 TRAORI
//! N20 G0 X0 Y0 Z50 A30 C0
//! N30 S9000 M3
//! N40 G1 X0.05 C40 F1000
//! ;   ^^^^^^^^^^^^^^^^^^ dwell-mark: the tool nearly stands still
//! ;            ^^^ axis-overspeed: C would have to run at
//! ;                ^^^^^ feed-drop: the axes allow
//! N50 M30
//! ```
//!
//! # Use instead
//! ```gcode sinumerik-840d mikron-ucp710
//! N10 TRAORI
//! N20 G0 X0 Y0 Z50 A30 C0
//! N30 S9000 M3
//! N40 G1 X50 C40 F1000
//! N50 M30
//! ```
//!
//! # Guarantee
//! Silence proves nothing. The rule judges the planned speed of feed motions with the spindle on, on machines that declare the accelerations of their axes.
//! A dwell that the program asks for is not a finding, nor are the start and the end of a cut. Consecutive blocks are one finding.
//!
//! # Thresholds
//! Below 5 % of the programmed feed for more than 0.05 s without a break, in one block or over several.
//!
//! # Sources
//! * docs/kinematics.md#time
use crate::pace::{PaceKind, Place};
use crate::prelude::*;
use trunnion_machine::Machine;

pub(super) const RULE: Body = Body::heuristic(Warning, &[Wake::Pace(PaceKind::Crawl, report)]).follows_pole_event();

fn report(place: &Place, machine: &Machine, out: &mut Reporter<'_>) {
    let (unit, keys) = place.unit();
    let corner = "let the control round the corner (a path tolerance, an arc), or lower F there";
    let help = if machine.rotary.is_empty() {
        corner.to_owned()
    } else {
        format!(
            "where rotary axes turn, spread their turn over a longer path, or turn them out of the cut; else {corner}"
        )
    };
    out.event(|draft| {
        draft
            .say(format!(
                "the tool nearly stands still in the cut: below 5 % of {} {unit} for {} s",
                number(place.feed),
                number((place.value * 1000.0).round() / 1000.0)
            ))
            .help(help)
            .value("value_s", place.value)
            .value(keys[0], place.feed)
            .spans(place.count, place.last);
    });
}

#[cfg(test)]
mod tests {
    use crate::fixture::check_on;
    use crate::{Report, ValueKey};

    fn mark(dynamics: &str, blocks: &str) -> Report {
        let axis = |letter: &str| format!("{{letter=\"{letter}\", sign=1, dyn={{{dynamics}}}}}");
        let axes = ["X", "Y", "Z"].map(axis).join(", ");
        let text = format!(
            "schema = \"ncmachine/1\"\naxis = [{axes}]\n[control]\nfamily = \"fanuc-30i\"\nrapid = \"synchronous\"\ncorner = {{ model = \"exact-stop\" }}\n"
        );
        let machine = trunnion_machine::load("m", &text).expect("valid");
        let program = format!("G21 G17 G90 G94\nG0 X0. Y0. Z0.\nS900 M3\n{blocks}M30\n");
        check_on(&machine, "fanuc-30i", &program)
    }

    fn seconds(dynamics: &str, blocks: &str) -> Vec<f64> {
        let report = mark(dynamics, blocks);
        let own = report.findings().filter(|d| d.rule == "dwell-mark");
        let value = |value: &ValueKey| match value {
            ValueKey::Number(value) => *value,
            ValueKey::Text(_) => panic!("a number of seconds"),
        };
        own.map(|d| value(&d.values[0].1)).collect()
    }

    /// Below 5 % of 516.7 mm/s for 0.026 s at the start and at the end, 0.4 s apart; about a corner both are one.
    #[test]
    fn both_ends_of_a_block_are_not_one() {
        let dynamics = "vmax=1000, amax=1000";
        assert_eq!(seconds(dynamics, "G1 X500. F31000.\n"), [0.0; 0]);
        let [corner] = seconds(dynamics, "G1 X500. F31000.\nY500.\n")[..] else {
            panic!("one corner");
        };
        assert!((corner - 2.0 * 0.05 * 31.0 / 60.0).abs() < 1e-3, "{corner}");
    }

    /// The text names F of the block that is left slowly, not of the one that begins there.
    #[test]
    fn a_mark_names_the_feed_of_its_block() {
        let report = mark("vmax=1000, amax=200", "G1 X500. F31000.\nZ5. F500.\n");
        let own: Vec<_> = report.findings().filter(|d| d.rule == "dwell-mark").collect();
        assert!(
            own.len() == 1 && own[0].message.contains("5 % of 31000 mm/min"),
            "{own:?}"
        );
    }

    /// With 200 mm/s^3 it takes sqrt(2 5/200) = 0.224 s to get to 5 mm/s, on both sides of a corner.
    #[test]
    fn a_jerk_makes_the_tool_crawl_longer() {
        let [corner] = seconds("vmax=1000, amax=1000, jmax=200", "G1 X500. F6000.\nY500.\n")[..] else {
            panic!("one corner");
        };
        assert!((corner - 0.447).abs() < 1e-3, "{corner}");
    }
}
