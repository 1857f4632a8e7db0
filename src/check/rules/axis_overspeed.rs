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
use trunnion_machine::{Axis, AxisKind, passes_singular, shortest_time};

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
        let at = match (feed, cut.motion().feed) {
            (None, _) => String::new(),
            // F is turns of the block per minute there
            (Some(feed), Feed::InverseTime(_)) => format!(" at {} {}", number(feed), cut.feed_unit()),
            (Some(feed), _) => format!(" at F{}", number(feed)),
        };
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
        speed_values(draft, axis, needed, limit.axis_limit);
        if let Some(feed) = feed {
            draft.value(cut.feed_keys()[0], feed);
        }
        draft.fix_pole(cut).fix_turns(cut).fix_feed();
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
            speed_values(draft, axis, needed, least.axis_limit);
            draft.fix_feed();
        },
    );
}

/// The speed that a block needs and the highest one of an axis, mm/s or rad/s.
fn speed_values(draft: &mut Draft<'_>, axis: &Axis, needed: f64, limit: f64) {
    match axis.kind {
        AxisKind::Linear => draft
            .value("value_mm_min", needed * 60.0)
            .value("limit_mm_min", limit * 60.0),
        AxisKind::Rotary => draft.value("value_deg_s", deg(needed)).value("limit_deg_s", deg(limit)),
    };
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
        _ if passes_singular(cut.machine, cut.leg) => {
            "the rotary axes pass a position at which the linear axes cannot hold the tip on its path"
        }
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
