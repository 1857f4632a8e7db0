//! The tool axis passes closer to the pole than the first rotary axis can follow at the programmed feed.
//!
//! # Why
//! A straight pass at a distance d from the pole at w deg/s needs w/d from the first rotary axis. The closer and
//! faster the pass, the more it needs, until the axis slows the tool down and the tool leaves a mark. How close is
//! too close depends on the feed and the axis, not on a fixed cone.
//!
//! # Example
//! ```gcode sinumerik-840d mikron-ucp710
//! N10 TRAORI
//! N20 G0 X0 Y0 Z50 A3 C0
//! N30 G1 X2 A3 C8 F2000
//! ;            ^^ fast-pole: at F2000 the tool axis must stay 3.329 deg away from the pole so that C can follow; it passes 3 deg
//! ;            ^^ axis-overspeed: C would have to run at
//! N40 M30
//! ```
//!
//! # Use instead
//! ```gcode sinumerik-840d mikron-ucp710
//! N10 TRAORI
//! N20 G0 X0 Y0 Z50 A3 C0
//! N30 G1 X2 A3 C8 F1000
//! N40 M30
//! ```
//!
//! # Guarantee
//! Heuristic: the distance from the pole at the end of or inside the block is exact; the speed and acceleration are
//! those of a straight pass at the mean turning speed of the block. Blocks in which the first axis turns less than
//! five times as far as the tool axis are not reported: there the pole is not the cause, and the tool can pass straight
//! over the pole with that axis at rest. The rule uses only what the machine file declares for the first axis;
//! `axis-overspeed` proves its speed.
//!
//! # Thresholds
//! d = max(w / vmax, w sqrt(0.6495 / amax)), with `vmax` and `amax` of the rotary axis nearest the workpiece.
//!
//! # Sources
//! * docs/kinematics.md#how-fast-the-first-axis-turns-near-the-pole
use crate::prelude::*;

pub(super) const RULE: Body = Body::heuristic(Warning, &[Wake::PolePass(check)]).nears_pole_event();

fn check(pass: &facts::PolePass<'_>, out: &mut Reporter<'_>) {
    if pass.feed_is_ambiguous() {
        return;
    }
    let (turn, passes) = (pass.leg.rotary_change[0], pass.leg.pole_angle_min);
    out.finding(pass, Merge::runs(0, pass.distance - passes), |draft| {
        let name = letter(pass.axis.letter);
        let at = pass
            .programmed_feed()
            .map_or_else(String::new, |feed| format!("at F{} ", number(feed)));
        draft
            .at_axis(pass.axis.letter)
            .say(format!(
                "{at}the tool axis must stay {} away from the pole so that {name} can follow; it passes {}",
                degrees(pass.distance),
                past_pole(passes)
            ))
            .note(format!(
                "the tool axis turns at {} deg/s; {name} turns {} in the block",
                number(deg(pass.angle / pass.seconds)),
                degrees(turn)
            ))
            .help("reduce the feed near the pole, or tilt the path away from it")
            .value_text("axis", name)
            .value("pole_angle_deg", deg(passes))
            .value("limit_deg", deg(pass.distance))
            .value("rotary_change_deg", deg(turn))
            .fix_pole(pass);
    });
}

#[cfg(test)]
mod tests {
    use crate::Diagnostic;
    use crate::fixture::{Fixture, check_on};

    fn found(text: &str) -> Vec<Diagnostic> {
        let fixture = Fixture::parse("gcode sinumerik-840d mikron-ucp710", text);
        let own = |d: &Diagnostic| d.rule == "fast-pole";
        fixture.check().unwrap().diagnostics.into_iter().filter(own).collect()
    }

    #[test]
    fn the_cone_grows_with_the_feed() {
        // the tool axis turns 0.4184 deg in 2 mm; C reaches 120 deg/s: 3 deg are enough up to 1802 mm/min
        let text = |feed: u32| format!("TRAORI\nG0 X0 Y0 Z50 A3 C0\nG1 X2 A3 C8 F{feed}\nM30\n");
        assert_eq!(found(&text(1790)), []);
        assert_eq!(found(&text(1815)).len(), 1);
        let inverse = "TRAORI\nG0 X0 Y0 Z50 A3 C0\nG93 G1 X2 A3 C8 F910\nM30\n";
        assert_eq!(found(inverse).len(), 1);
        assert_eq!(found(&inverse.replace("F910", "F890")), []);
    }

    #[test]
    fn straight_over_the_pole_the_first_axis_rests() {
        assert_eq!(found("TRAORI\nG0 X0 Y0 Z50 A3 C0\nG1 X2 A-3 C0.5 F2000\nM30\n"), []);
    }

    /// An acceleration of 5 deg/s2 asks for more than the speed of 120 deg/s does.
    #[test]
    fn a_slow_starter_needs_more_room() {
        let source = trunnion_machine::builtin_source("mikron-ucp710").expect("embedded");
        let text = source
            .replacen("amax = 500", "amax = 5", 1)
            .replacen("C = 500", "C = 5", 1);
        let machine = trunnion_machine::load("slow", &text).expect("valid");
        let program = "TRAORI\nG0 X0 Y0 Z50 A3 C0\nG1 X2 A3 C8 F320\nM30\n";
        let report = check_on(&machine, "sinumerik-840d", program);
        let own = report
            .diagnostics
            .iter()
            .find(|d| d.rule == "fast-pole")
            .expect("found");
        // w = 0.4184 deg / 0.375 s = 1.1156 deg/s; w sqrt(0.6495 / amax) = 3.043 deg
        assert!(own.message.contains("3.04"), "{}", own.message);
    }
}
