//! At the programmed feed an axis would have to move faster than it can.
//!
//! # Why
//! The control slows the whole block down, or the axis lags behind. The tool then cuts more slowly than intended,
//! rubs and leaves a mark, and the program takes longer than its feeds suggest.
//!
//! # Example
//! ```gcode sinumerik-840d mikron-ucp710
//! N10 TRAORI
//! N20 G0 X0 Y0 Z50 A30 C0
//! N30 G1 X1 C9 F1000
//! ;         ^^ axis-overspeed: C would have to run at
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
//! Sound for axes with a declared speed, at the worst moment inside the block. An axis that moves and has no
//! declared speed is reported as unknown, once. Where linear and rotary axes move together without tool centre
//! point control, a parameter of some controls (Fanuc and similar) decides whether F is the speed along X Y Z or
//! along all axes. Silence then holds for both meanings. Where an axis is too fast if F is the speed along X Y Z, which is the
//! faster case, this rule says unknown, once, and `feed-drop` is silent. Where only rotary axes turn on a Haas,
//! whose settings decide what F means, it says unknown, once. Up to 8 consecutive blocks are reported one by one; a
//! longer run is reported as one finding with its worst block.
//!
//! # Thresholds
//! `vmax` of each axis in the machine file.
//!
//! # Sources
//! * docs/kinematics.md#axis-speed-and-feed
//! * Haas 96-8210 (mill operator's manual): G93 does not need settings 34 and 79 (diameters of the 4th and 5th
//!   axis), so G94 does.
use crate::prelude::*;
use crate::view::NO_TURN;
use trunnion_interp::{Feed, MotionKind};
use trunnion_machine::{Axis, AxisKind, shortest_time};

pub(super) const RULE: Body = Body::sound(Warning, &[Wake::HeldBackCut(check)]).follows_pole_event();

/// Relative room for rounding.
const ROUNDING: f64 = 1e-9;

fn check(cut: &facts::HeldBackCut<'_>, out: &mut Reporter<'_>) {
    undeclared(cut, out);
    if cut.turns_by_diameter() {
        return unsettled(cut, out, BY_DIAMETER);
    }
    if let Some(seconds) = standing(cut) {
        return overrun(cut, seconds, out);
    }
    let judged = cut.feed_limit().and_then(|limit| Some((limit, limit.axis_speed?)));
    let Some((limit, needed)) = judged else {
        return undecided(cut, out);
    };
    if needed <= limit.axis_limit * (1.0 + ROUNDING) {
        return;
    }
    if cut.feed_is_ambiguous() {
        return unsettled(cut, out, AMBIGUOUS);
    }
    let axis = &cut.machine.axes[limit.axis];
    let key = u64::from(axis.letter) + 256 * u64::from(cut.feed_in_degrees());
    out.finding(cut, Merge::runs(key, -limit.feed_mm_min), |draft| {
        let name = letter(axis.letter);
        let feed = cut.programmed_feed();
        let at = feed.map_or_else(String::new, |feed| format!(" at F{}", number(feed)));
        draft
            .at_axis(axis.letter)
            .say(format!(
                "{name} would have to run at {}{at}, but its maximum is {}",
                speed(axis, needed),
                speed(axis, limit.axis_limit)
            ))
            .note(format!(
                "the highest feed for this block is {} {}",
                highest_rate(limit.feed_mm_min),
                cut.feed_unit()
            ))
            .help("reduce the feed in this block, or change the path so that the axis moves less")
            .value_text("axis", name.clone())
            .value_text("limiting_axis", name)
            .value(cut.feed_keys()[1], limit.feed_mm_min);
        match axis.kind {
            AxisKind::Linear => draft
                .value("value_mm_min", needed * 60.0)
                .value("limit_mm_min", limit.axis_limit * 60.0),
            AxisKind::Rotary => draft
                .value("value_deg_s", deg(needed))
                .value("limit_deg_s", deg(limit.axis_limit)),
        };
        if let Some(feed) = feed {
            draft.value(cut.feed_keys()[0], feed);
        }
        draft.fix_pole(cut).fix_turns(cut);
    });
}

/// The time of a block in which the tip stands still under inverse time, s: it needs no path. Not where the lever of the turn is unknown.
fn standing(cut: &facts::Cut<'_>) -> Option<f64> {
    match cut.motion().feed {
        Feed::InverseTime(per_minute) if cut.leg.length <= 0.0 && cut.leads_tip() && !cut.lever_is_undeclared() => {
            Some(60.0 / per_minute).filter(|seconds| seconds.is_finite() && *seconds > 0.0)
        }
        _ => None,
    }
}

/// An axis that cannot follow in the time that the program gives the block.
fn overrun(cut: &facts::Cut<'_>, seconds: f64, out: &mut Reporter<'_>) {
    let Some(least) = shortest_time(cut.machine, cut.leg, seconds) else {
        return undecided(cut, out);
    };
    if least.seconds <= seconds * (1.0 + ROUNDING) {
        return;
    }
    let axis = &cut.machine.axes[least.axis];
    let needed = least.rate / seconds;
    out.finding(
        cut,
        Merge::runs(u64::from(axis.letter) + STANDING, least.seconds),
        |draft| {
            let name = letter(axis.letter);
            draft
                .at_axis(axis.letter)
                .say(format!(
                    "{name} would have to run at {} in the {} s of this block, but its maximum is {}",
                    speed(axis, needed),
                    number(seconds),
                    speed(axis, least.axis_limit)
                ))
                .note(format!(
                    "the shortest time for this block is {} s",
                    number(least.seconds)
                ))
                .help("give the block more time (a smaller F under G93)")
                .value_text("axis", name.clone())
                .value_text("limiting_axis", name)
                .value("time_s", seconds)
                .value("time_bound_s", least.seconds);
            match axis.kind {
                AxisKind::Linear => draft
                    .value("value_mm_min", needed * 60.0)
                    .value("limit_mm_min", least.axis_limit * 60.0),
                AxisKind::Rotary => draft
                    .value("value_deg_s", deg(needed))
                    .value("limit_deg_s", deg(least.axis_limit)),
            };
        },
    );
}

/// Added to the key of merging where the tip stands still.
const STANDING: u64 = 512;

/// The fastest reading of F overruns an axis, another one may not.
const AMBIGUOUS: [&str; 3] = [
    "linear and rotary axes move together: a parameter of this control decides whether F is mm/min along X Y Z or sqrt(mm2+deg2); speeds are not judged",
    "if F is the speed along X Y Z, an axis is too fast here",
    "switch tool centre point control on, or program inverse time (G93)",
];

/// On a Haas F of a turn is the speed along circles whose diameters are settings.
const BY_DIAMETER: [&str; 3] = [
    "only rotary axes move: this control measures F along circles with the diameters in its settings 34 and 79; speeds are not judged",
    "the axes may turn faster than F in degrees per minute",
    "program inverse time (G93), or declare [control] feed = \"xyz\" if F is in degrees per minute",
];

/// What F means is ambiguous: message, note and help, once.
fn unsettled(view: &LegView<'_>, out: &mut Reporter<'_>, [message, note, help]: [&str; 3]) {
    out.unknown(view, Merge::once(hash(message)), |draft| {
        draft.say(message).note(note).help(help);
    });
}

/// A block whose speed cannot be computed although its ends and its feed are known: reported once per cause.
fn undecided(cut: &facts::Cut<'_>, out: &mut Reporter<'_>) {
    let moves = |i: usize| (cut.start.joints[i] - cut.end.joints[i]).abs() > NO_TURN;
    let declared = |(i, axis): (usize, &Axis)| axis.max_speed.is_some() && moves(i);
    if !cut.machine.axes.iter().enumerate().any(declared) {
        return;
    }
    let why = match (cut.motion().feed, cut.motion().kind) {
        // the faults that removed the feed or the centre of the arc are reported by their own rules
        (Feed::Unknown | Feed::Rapid, _) | (_, MotionKind::Arc(None)) => return,
        (Feed::PerRevolution(_), _) if cut.motion().most_rpm().is_none() => {
            "the feed is per revolution and the spindle speed is unknown"
        }
        _ if cut.leg.length <= 0.0 && cut.rotary_turns() => {
            "the tip does not move while rotary axes turn: what F means then depends on the control"
        }
        _ if cut.leg.length <= 0.0 => "linear axes move although X Y Z stay the same: what F means there is unknown",
        _ => "the motion is not modelled",
    };
    out.unknown(cut, Merge::once(hash(why)), |draft| {
        draft.say(format!("it is not known whether an axis is too fast: {why}"));
    });
}

/// An axis that moves but has no declared speed cannot be judged: reported once per axis.
fn undeclared(cut: &facts::Cut<'_>, out: &mut Reporter<'_>) {
    for (i, axis) in cut.machine.axes.iter().enumerate() {
        let moves = cut.start.joints[i] != cut.end.joints[i];
        if axis.max_speed.is_none() && moves && out.once(u64::from(axis.letter)) {
            out.event(|draft| {
                let name = letter(axis.letter);
                draft
                    .at_axis(axis.letter)
                    .say(format!(
                        "machine {} declares no speed for {name}: it is not known whether {name} is too fast",
                        cut.machine.id
                    ))
                    .help("declare it in the machine file: dyn = { vmax = ... }, in mm/s or deg/s")
                    .value_text("axis", name)
                    .unknown();
            });
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::fixture::assert_drawn;

    /// C turns 90 deg in 60/F s and reaches 120 deg/s: 0.75 s are enough, F80.
    #[test]
    fn inverse_time_is_judged_where_the_tip_stands_still() {
        let text = |feed: u32| format!("TRAORI\nG0 X0 Y0 Z50 A0 C0\nG93 G1 C90 F{feed}\nM30\n");
        let found = |feed| {
            let fixture = crate::fixture::Fixture::parse("gcode sinumerik-840d mikron-ucp710", &text(feed));
            let report = fixture.check().unwrap();
            let own = report.findings().filter(|found| found.rule == "axis-overspeed");
            own.map(|found| found.message.clone()).collect::<Vec<_>>()
        };
        assert_eq!(found(79), [] as [&str; 0]);
        let message = "C would have to run at 122 deg/s in the 0.741 s of this block, but its maximum is 120 deg/s";
        assert_eq!(found(81), [message]);
    }

    #[test]
    fn where_only_rotary_axes_turn_the_feed_is_in_degrees() {
        let text = "N10 G0 X0 Y0 Z50 A30 C0\nN20 G1 C90 F7200\nN30 C180 F7300\n";
        let report = crate::fixture::Fixture::parse("gcode mikron-ucp710", text)
            .check()
            .unwrap();
        let found: Vec<_> = report.findings().filter(|d| d.rule == "axis-overspeed").collect();
        assert_eq!((found.len(), found[0].block.as_deref()), (1, Some("N30")));
        assert_eq!(found[0].notes, ["the highest feed for this block is 7200 deg/min"]);
        assert!(
            found[0]
                .values
                .contains(&("feed_deg_min", crate::ValueKey::Number(7300.0)))
        );
    }

    /// On a Haas F of a turn is the speed along a circle of a set diameter, so that C may run faster than by F in degrees: 7100 are within its speed.
    #[test]
    fn on_a_haas_the_feed_of_a_turn_is_a_setting() {
        let said = |info: &str, block: &str| -> Vec<String> {
            let text = format!("G0 X0. Y0. Z50. A30. C0.\n{block}\nM30\n");
            let report = crate::fixture::Fixture::parse(info, &text).check().unwrap();
            let own = report.findings().filter(|d| d.rule == "axis-overspeed");
            own.map(|d| format!("{:?} {}", d.status, &d.message[..24])).collect()
        };
        let haas = "gcode haas-ngc mikron-ucp710";
        for feed in ["F7100.", "F7300."] {
            assert_eq!(
                said(haas, &format!("G1 C90. {feed}")),
                ["Unknown only rotary axes move: t"]
            );
        }
        assert_eq!(said(haas, "G93 G1 C90. F2."), [""; 0]);
        assert_eq!(said(haas, "G1 X1. C9. F1000."), ["Unknown linear and rotary axes m"]);
        // declared: degrees
        let declared = "gcode haas-ngc mikron-ucp710+control.feed=\"xyz\"";
        assert_eq!(said(declared, "G1 C90. F7100."), [""; 0]);
        assert_eq!(said(declared, "G1 C90. F7300.").len(), 1);
    }

    #[test]
    fn a_standing_tip_under_tcp_is_unknown_once() {
        let report = assert_drawn(
            "gcode sinumerik-840d mikron-ucp710",
            "N10 TRAORI\nN20 G0 X0 Y0 Z50 A30 C0\nN30 G1 C90 F500\n;   ^^^^^^^^^^^ axis-overspeed: it is not known whether an axis is too fast: the tip does not move\nN40 C0\nN50 M30\n",
        );
        assert_eq!(report.diagnostics[0].count, 2);
    }

    #[test]
    fn linear_and_rotary_axes_together_are_unknown_where_a_parameter_says_what_f_means() {
        let found = |info: &str, last: &str| {
            let second = if info.contains("ferrari") { 'B' } else { 'A' };
            let text = format!("N10 G17 G21 G90 G94\nN20 G0 X0.1 Y0.1 Z50. {second}30. C0.1\n{last}\nN50 M30\n");
            let report = crate::fixture::Fixture::parse(info, &text).check().unwrap();
            assert!(report.findings().all(|d| d.rule != "feed-drop") || report.summary.unknown == 0);
            report
                .diagnostics
                .into_iter()
                .filter(|d| d.rule == "axis-overspeed")
                .map(|d| (d.status, d.count))
                .collect::<Vec<_>>()
        };
        let fast = "N30 G1 X1. C9. F9000.\nN40 X2. C20.";
        assert_eq!(
            found("gcode fanuc-30i mikron-ucp710", fast),
            [(crate::Status::Unknown, 2)]
        );
        assert_eq!(found("gcode ferrari-bc", fast), [(crate::Status::Unknown, 2)]);
        assert_eq!(
            found("gcode linuxcnc mikron-ucp710", fast),
            [(crate::Status::Fail, 1), (crate::Status::Fail, 1)]
        );
        // along all axes the block only takes longer: what keeps the limits along X Y Z keeps them anyway
        assert_eq!(found("gcode fanuc-30i mikron-ucp710", "N30 G1 X1. C9. F300."), []);
    }

    #[test]
    fn switching_tool_centre_point_control_off_is_no_standing_tip() {
        for end in [
            "TRAFOOF\nN40 G1 X0 Y0 Z50 F500",
            "TRAFOOF\nN40 G1 X10 F500",
            "TRAFOOF\nN40 G1 Z50 A30 C0 F500",
        ] {
            let text = format!("N10 TRAORI\nN20 G0 X0 Y0 Z50 A30 C0\nN30 {end}\nN50 M30\n");
            let report = crate::fixture::Fixture::parse("gcode sinumerik-840d mikron-ucp710", &text)
                .check()
                .unwrap();
            assert!(
                report.findings().all(|d| !d.message.contains("does not move")),
                "{:?}",
                report.diagnostics
            );
        }
    }

    #[test]
    fn feed_per_revolution_needs_the_spindle() {
        assert_drawn(
            "gcode mill-3axis",
            "N10 G0 X0 Y0 Z50\nN20 G95 G1 X10 F0.1\n;   ^^^^^^^^^^^^^^^ axis-overspeed: it is not known whether an axis is too fast: the feed is per revolution\nN30 S1000 M3\nN40 X0\n",
        );
    }

    /// `blocks` feed motions in each of which C turns 9 deg in 1 mm.
    fn program(blocks: u32) -> String {
        let line = |i: u32| format!("G1 X{i} C{} F1000\n", 9 * i);
        let lines: String = (1..=blocks).map(line).collect();
        format!("TRAORI\nG0 X0 Y0 Z50 A30 C0\n{lines}M30\n")
    }

    #[test]
    fn short_runs_are_told_block_by_block_and_long_ones_once() {
        let found = |blocks| {
            let fixture = crate::fixture::Fixture::parse("gcode sinumerik-840d mikron-ucp710", &program(blocks));
            let report = fixture.check().unwrap();
            report
                .diagnostics
                .into_iter()
                .filter(|d| d.rule == "axis-overspeed")
                .collect::<Vec<_>>()
        };
        assert_eq!(found(8).len(), 8);
        let long = found(20);
        assert_eq!((long.len(), long[0].count), (1, 20));
    }

    #[test]
    fn the_worst_of_a_long_run_is_worded_wherever_it_lies() {
        use core::fmt::Write;
        // the fewer mm for 9 deg of C, the lower the feed: worst in block 15
        let mut text = String::from("TRAORI\nG0 X0 Y0 Z50 A30 C0\n");
        let mut x = 0.0;
        for i in 1..=20_i32 {
            x += 0.5 + f64::from((i - 15).abs()) / 100.0;
            let _ = writeln!(text, "N{i} G1 X{x:.3} C{} F1000", 9 * i);
        }
        let report = crate::fixture::Fixture::parse("gcode sinumerik-840d mikron-ucp710", &text)
            .check()
            .unwrap();
        for rule in ["axis-overspeed", "feed-drop"] {
            let found: Vec<_> = report.findings().filter(|d| d.rule == rule).collect();
            assert_eq!(
                (found.len(), found[0].count, found[0].block.as_deref()),
                (1, 20, Some("N1"))
            );
            let limit = found[0].values.iter().find_map(|(key, value)| match value {
                crate::ValueKey::Number(limit) if *key == "feed_limit_mm_min" => Some(*limit),
                _ => None,
            });
            assert!((limit.unwrap() - 400.0).abs() < 0.5, "{rule}: {limit:?}");
            let worst = found[0].related[0].0;
            assert!(
                text[..worst.start as usize].lines().last().unwrap().starts_with("N15 "),
                "{rule}"
            );
            assert!(
                text[..found[0].last.start as usize]
                    .lines()
                    .last()
                    .unwrap()
                    .starts_with("N20 "),
                "{rule}"
            );
        }
    }

    #[test]
    fn fixes_are_offered_where_they_may_help() {
        let fixes = |words: &str| {
            let text = format!("TRAORI\nG0 X0 Y0 Z50 A30 C0\nG1 {words} F2000\nM30\n");
            let report = crate::fixture::Fixture::parse("gcode sinumerik-840d mikron-ucp710", &text)
                .check()
                .unwrap();
            report
                .findings()
                .find(|d| d.rule == "axis-overspeed")
                .map(|d| d.fixes.clone())
        };
        assert_eq!(fixes("X1 C90"), Some(vec![]));
        assert_eq!(fixes("X1 C350"), Some(vec!["unwind-rotary"]));
        assert_eq!(fixes("X1 C90 A-1"), Some(vec!["smooth-pole"]));
    }
}
