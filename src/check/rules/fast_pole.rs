//! The tool axis passes the pole nearer than the first rotary axis can follow at the programmed feed.
//!
//! # Why
//! A straight pass at a distance d from the pole, at w deg/s, asks the first rotary axis for w/d. The nearer and the faster, the more,
//! until the axis holds the tool back and it leaves a mark. How near is too near depends on the feed and the axis, not on a fixed
//! cone.
//!
//! # Example
//! ```gcode sinumerik-840d mikron-ucp710
//! N10 TRAORI
//! N20 G0 X0 Y0 Z50 A3 C0
//! N30 G1 X2 A3 C8 F2000
//! ;            ^^ fast-pole: at F2000 the tool axis has to keep 3.329 deg away from the pole for C to follow; it passes 3 deg
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
//! Heuristic: the distance at the end or inside the block is exact, the asked speed and acceleration are those of a straight pass at the
//! block's mean turning speed. Blocks in which the first axis turns less than five times as far as the tool axis are silent: that is not
//! the pole's doing, and straight over the pole the tool can pass with that axis at rest. Only what the machine file declares of the first axis is judged; `axis-overspeed` is the proof
//! for its speed.
//!
//! # Thresholds
//! d = max(w / vmax, w sqrt(0.6495 / amax)), `vmax` and `amax` of the rotary axis nearest the workpiece.
//!
//! # Sources
//! Trunnion's kinematics notes, sections 2.4 and 5 (POLE-DYN).
use crate::prelude::*;
use crate::runs::SHORT_RUN;
use crate::trail::axes_chord;
use trunnion_geometry::math::angle_between;
use trunnion_interp::Feed;
use trunnion_machine::{Axis, Leg};

pub(super) const RULE: Body = Body {
    severity: Severity::Warning,
    guarantee: Guarantee::Heuristic,
    level: Level::Leg(Needs::FEED.and(Needs::POLE_HURRIES), check),
};

/// Where the first axis turns less than this many times as far as the tool axis the pole is not to blame.
const AMPLIFIED: f64 = 5.0;

/// A tool axis that turns less stands still, rad: 1e-4 deg.
const STILL: f64 = 1.7e-6;

/// Peak acceleration of the first axis on a straight pass is this times w^2 / d^2 (kinematics notes 2.4).
const PASS: f64 = 0.6495;

/// Seconds that an axis needs for a pass at 1 rad from the pole, per rad that the tool axis turns (kinematics notes 2.4).
pub(crate) fn pass(axis: &Axis) -> f64 {
    let by_speed = axis.max_speed.map_or(0.0, |speed| 1.0 / speed);
    let by_acceleration = axis.max_acceleration.map_or(0.0, |limit| (PASS / limit).sqrt());
    by_speed.max(by_acceleration)
}

/// Whether the pole may be too near, by the chord between the tool axes instead of the angle; `pass` is that of the first rotary axis.
/// Also where the block's time is not a number.
#[inline]
pub(crate) fn may_hurry(leg: &Leg, chord: f64, pass: f64, seconds: f64) -> bool {
    let turn = leg.rotary_change[0];
    if turn == 0.0 {
        return false;
    }
    // an arc is at least its chord, at most pi / 2 times as long, and at most 1.0472 times where the chord is no longer than 1
    let longest = if chord <= 1.0 {
        1.05
    } else {
        core::f64::consts::FRAC_PI_2
    };
    let far = leg.pole_angle_min * seconds >= pass * chord * longest * (1.0 + 1e-9);
    !far && turn > AMPLIFIED * chord * (1.0 - 1e-9)
}

fn check(view: &LegView<'_>, out: &mut Reporter<'_>) {
    let turn = view.leg.rotary_change[0];
    if turn == 0.0 || !view.motion().is_feed() || !view.machine.constants.has_pair() {
        return;
    }
    let Some((start, end)) = view.stances() else { return };
    let axis = &view.machine.axes[view.machine.rotary[0]];
    let Some(seconds) = duration(view) else { return };
    let pass = pass(axis);
    let cone = |angle: f64| pass * angle / seconds;
    let passes = view.leg.pole_angle_min;
    if !may_hurry(view.leg, axes_chord(view.leg), pass, seconds) {
        return;
    }
    let angle = angle_between(&start.axis, &end.axis);
    let distance = cone(angle);
    if passes >= distance || angle <= STILL || turn <= AMPLIFIED * angle {
        return;
    }
    if view.feed_is_ambiguous(out.dialect()) || out.repeats(view, 0, distance - passes) {
        return;
    }
    let name = letter(axis.letter);
    let range = axis_word(out.program(), view.motion().block, axis.letter);
    let at = view
        .programmed_feed()
        .map_or_else(String::new, |feed| format!("at F{} ", number(feed)));
    let draft = out.report(
        range,
        format!(
            "{at}the tool axis has to keep {} away from the pole for {name} to follow; it passes {}",
            degrees(distance),
            past_pole(passes)
        ),
    );
    draft
        .note(format!(
            "the tool axis turns at {} deg/s; {name} turns {} in the block",
            number(deg(angle / seconds)),
            degrees(turn)
        ))
        .help("lower the feed near the pole, or tilt the path away from it")
        .value_text("axis", name)
        .value("pole_angle_deg", deg(passes))
        .value("limit_deg", deg(distance))
        .value("rotary_change_deg", deg(turn))
        .merge_runs_over(SHORT_RUN, 0, distance - passes);
    if view.near_pole() && view.forced_swap().is_none() {
        draft.fix("smooth-pole");
    }
}

/// How long the block takes at the programmed feed, s.
fn duration(view: &LegView<'_>) -> Option<f64> {
    let seconds = match view.motion().feed {
        Feed::InverseTime(per_minute) => 60.0 / per_minute,
        _ if view.leg.length > 0.0 => view.leg.length / view.programmed_feed()? * 60.0,
        _ => return None,
    };
    (seconds > 0.0 && seconds.is_finite()).then_some(seconds)
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
        let text = source.replacen("vmax = 120", "vmax = 120, amax = 5", 1);
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
