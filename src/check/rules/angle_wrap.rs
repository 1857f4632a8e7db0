//! A rotary axis turns the long way round, because the control takes its word literally.
//!
//! # Why
//! From 350 deg to 10 deg the axis can turn 20 deg forward or 340 deg back. A control that takes rotary words
//! literally turns back: in the cut the tool then sweeps around the part. Where a control takes the shorter turn by
//! itself (M126, a rollover axis), the machine file says so.
//!
//! # Example
//! ```gcode sinumerik-840d mikron-ucp710
//! N10 TRAORI
//! N20 G0 X0 Y0 Z50 A20 C350
//! N30 G1 X10 C10 F20
//! ;          ^^^ angle-wrap: C turns back by 340 deg to reach 10 deg; the shorter way is 20 deg forward
//! N40 M30
//! ```
//!
//! # Use instead
//! ```gcode sinumerik-840d mikron-ucp710
//! N10 TRAORI
//! N20 G0 X0 Y0 Z50 A20 C350
//! N30 G1 X10 C370 F20
//! N40 M30
//! ```
//!
//! # Guarantee
//! Sound for feed motions between known positions; a rapid that turns the long way round is an info. Without tool
//! centre point control a word that turns the axis by a full turn or more is assumed to be intended. A plain word after
//! DC, ACP, ACN or M126 has carried the axis beyond a full turn is left to `ambiguous-posture`.
//!
//! # Thresholds
//! Half a turn.
//!
//! # Sources
//! * docs/kinematics.md#rotary-words-and-full-turns
//! * HEIDENHAIN TNC 640 34059x-05 (ISO programming): M126.
use crate::prelude::*;
use core::f64::consts::{PI, TAU};
use trunnion_interp::{AXIS_LETTERS, Orientation};
use trunnion_machine::{Limits, Wrap};

pub(super) const RULE: Body = Body::sound(Error, &[Wake::LongTurn(check)]);

/// Turns that differ from half a turn only by rounding are half turns.
const SLACK: f64 = 1e-6;

fn check(leg: &facts::LongTurn<'_>, out: &mut Reporter<'_>) {
    let (motion, start, end) = (leg.motion(), leg.start, leg.end);
    if motion.orientation != Orientation::Words {
        return;
    }
    for &joint in &leg.machine.rotary {
        let axis = &leg.machine.axes[joint];
        let turn = end.joints[joint] - start.joints[joint];
        let place = AXIS_LETTERS.iter().position(|letter| *letter == axis.letter);
        let word = place.and_then(|place| motion.end.get(place));
        let meant = turn.abs() >= TAU - SLACK && !leg.leads_tip();
        if axis.extra.wrap != Wrap::Literal || word.is_none() || turn.abs() <= PI + SLACK || meant {
            continue;
        }
        let short = turn - TAU * (turn / TAU).round();
        let name = letter(axis.letter);
        let way = |turn: f64| if turn < 0.0 { "back" } else { "forward" };
        let reachable = match axis.limits {
            Limits::Unbounded => true,
            Limits::Range(low, high) => (low..=high).contains(&(start.joints[joint] + short)),
        };
        out.event(|draft| {
            draft
                .at_axis(axis.letter)
                .say(format!(
                    "{name} turns {} by {} to reach {}; the shorter way is {} {}",
                    way(turn),
                    degrees(turn.abs()),
                    degrees(end.joints[joint]),
                    degrees(short.abs()),
                    way(short)
                ))
                .value_text("axis", name.clone())
                .value("rotary_change_deg", deg(turn))
                .value("value_deg", deg(end.joints[joint]))
                .value("shorter_deg", deg(short));
            if reachable {
                draft.help(format!("write {name} as {}", number(deg(start.joints[joint] + short))));
                draft.fix_turns(leg);
            } else {
                draft
                    .note(format!("the shorter way would take {name} out of its travel"))
                    .help("retract, and turn the axis back out of the cut");
            }
            if !motion.is_feed() {
                draft.severity(Info);
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use crate::fixture::{Fixture, assert_drawn};

    /// The rows of M126: without it 350 to 10 is -340 and 10 to 340 is +330, with it +20 and -30.
    #[test]
    fn the_shortest_way_of_a_declared_axis_is_silent() {
        let source = trunnion_machine::builtin_source("mikron-ucp710").unwrap();
        // the rows that check the file say that the words are literal
        let source = source.split("[[check]]").next().unwrap();
        let shortest = source.replace("wrap = \"literal\"", "wrap = \"shortest\"");
        for (machine, turns) in [(source.to_owned(), [-340.0, 330.0]), (shortest, [20.0, -30.0])] {
            let machine = trunnion_machine::load("mikron", &machine).unwrap();
            for ((from, to), turn) in [(350, 10), (10, 340)].into_iter().zip(turns) {
                let text = format!("TRAORI\nG0 X0 Y0 Z50 A20 C{from}\nG1 X10 C{to} F20\nM30\n");
                let dialect = trunnion_dialect::builtin("sinumerik-840d").unwrap();
                let report = crate::check(
                    &trunnion_syntax::parse(text.into_bytes(), dialect.lex),
                    &crate::Settings::new(dialect, Some(&machine), trunnion_interp::Setup::default()),
                );
                let found: Vec<_> = report.diagnostics.iter().filter(|d| d.rule == "angle-wrap").collect();
                if f64::abs(turn) > 180.0 {
                    let crate::ValueKey::Number(told) = found[0].values[1].1 else {
                        panic!("no number")
                    };
                    assert!((told - turn).abs() < 1e-9, "{told}");
                } else {
                    assert!(found.is_empty(), "{found:?}");
                }
            }
        }
    }

    #[test]
    fn rapids_are_infos_and_half_a_turn_is_none() {
        let report = assert_drawn(
            "gcode sinumerik-840d mikron-ucp710",
            "N10 TRAORI\nN20 G0 X0 Y0 Z50 A20 C400\nN30 G0 C0\n;      ^^ angle-wrap: C turns back by 400 deg\nN40 G0 C180\nN50 M30\n",
        );
        assert_eq!(report.diagnostics[0].severity, crate::Severity::Info);
    }

    #[test]
    fn whole_turns_without_tcp_are_meant() {
        let text = "N10 G0 X0 Y0 Z50 A0 C0\nN20 G1 X1 C3600 F20\nN30 M30\n";
        let report = Fixture::parse("gcode sinumerik-840d mikron-ucp710", text)
            .check()
            .unwrap();
        assert!(report.diagnostics.iter().all(|d| d.rule != "angle-wrap"));
    }
}
