//! A rotary axis turns although it must stand still while cutting, or although the program has clamped it.
//!
//! # Why
//! On 3+2 machines, and on indexing tables with a clamp, rotary axes are positioned out of the cut. A feed motion
//! that turns them works against the clamp, or stops with an alarm in the cut. Where the program closes and opens
//! the clamp by codes, no motion at all may turn the axis while the clamp is closed.
//!
//! # Example
//! The machine file says `clamp = true` for C.
//!
//! ```gcode sinumerik-840d mikron-ucp710+C.clamp
//! N10 TRAORI
//! N20 G0 X0 Y0 Z50 A20 C0
//! N30 G1 X10 C5 F100
//! ;          ^^ clamped-axis-moves: C turns by 5 deg in a feed motion, but must stand still while cutting
//! N40 M30
//! ```
//!
//! The machine file says `clamp_codes = { on = "M10", off = "M11" }` for C.
//!
//! ```gcode fanuc-30i mikron-ucp710+C.clamp_codes={on="M10",off="M11"}
//! N10 M11
//! N20 G0 X0. Y0. Z50. A20. C0.
//! N30 M10
//! N40 G0 C90.
//! ;      ^^^^ clamped-axis-moves: C turns by 90 deg while it is clamped
//! N50 M30
//! ```
//!
//! # Use instead
//! ```gcode fanuc-30i mikron-ucp710+C.clamp_codes={on="M10",off="M11"}
//! N10 M11
//! N20 G0 X0. Y0. Z50. A20. C0.
//! N30 M10
//! N40 M11
//! N50 G0 C90.
//! N60 M30
//! ```
//!
//! # Guarantee
//! Sound for motions between known positions. The finding is unknown where it is uncertain whether a motion turns a
//! clamped axis, and where the state of the clamp is unknown: before the first clamp code, in the block of a
//! clamp code, and after a code or call with an unknown effect. Codes in called files are included. On a great circle an
//! axis that leaves its value and returns to it has turned; over the pole, where its path is unknown, it may have
//! turned.
//!
//! # Sources
//! * docs/kinematics.md#clamped-axes
use crate::prelude::*;
use crate::view::NO_TURN;
use trunnion_interp::{AxisLetter, Clamp, MotionKind, Orientation};
use trunnion_machine::{AxisKind, rotary_turns};

pub(super) const RULE: Body = Body::sound(Error, &[Wake::ClampedTurn(check)]);

fn check(view: &facts::ClampedTurn<'_>, out: &mut Reporter<'_>) {
    if view.motion().is_feed() && view.rotary_turns() {
        in_the_cut(view, out);
    }
    for (axis, entry) in view.machine.axes.iter().enumerate() {
        if entry.extra.clamp_codes.is_some() && entry.kind == AxisKind::Rotary {
            by_code(view, axis, out);
        }
    }
}

/// Axes that must not move while cutting.
fn in_the_cut(view: &LegView<'_>, out: &mut Reporter<'_>) {
    if !view.machine.axes.iter().any(|axis| axis.extra.clamp) {
        return;
    }
    let turns = rotary_turns(view.machine, view.leg);
    let at_least = turns.unwrap_or(view.leg.rotary_change);
    for (&joint, turn) in view.machine.rotary.iter().zip(at_least) {
        let axis = &view.machine.axes[joint];
        let key = u64::from(axis.letter);
        if !axis.extra.clamp {
            continue;
        }
        let name = letter(axis.letter);
        let note = || format!("the machine file of {} says clamp = true for {name}", view.machine.id);
        if turn > NO_TURN {
            out.finding(view, Merge::run(key, turn), |draft| {
                draft
                    .at_axis(axis.letter)
                    .say(format!(
                        "{name} turns by {} in a feed motion, but must stand still while cutting",
                        degrees(turn)
                    ))
                    .note(note())
                    .help("turn the axis in a rapid motion out of the cut")
                    .value_text("axis", name.clone())
                    .value("rotary_change_deg", deg(turn));
            });
        } else if turns.is_none() {
            out.unknown(view, Merge::once(key + 4096), |draft| {
                draft
                    .at_axis(axis.letter)
                    .say(format!(
                        "it is not known whether {name} turns between the ends of this cut"
                    ))
                    .note(note())
                    .help("divide the turn of the other axis into smaller steps, or turn it out of the cut")
                    .value_text("axis", name.clone());
            });
        }
    }
}

/// How far a motion turns an axis.
#[derive(Clone, Copy, PartialEq)]
enum Turn {
    No,
    By(f64),
    /// It is not known whether, or how far.
    Perhaps,
}

fn turn(view: &LegView<'_>, axis: usize) -> Turn {
    let motion = view.motion();
    if let Some((start, end)) = view.stances() {
        let by = (end.joints[axis] - start.joints[axis]).abs();
        let index = view.machine.rotary.iter().position(|&joint| joint == axis);
        return match (rotary_turns(view.machine, view.leg), index) {
            (Some(turns), Some(index @ 0..2)) if by.max(turns[index]) > NO_TURN => Turn::By(by.max(turns[index])),
            (None, _) if by <= NO_TURN => Turn::Perhaps,
            _ if by > NO_TURN => Turn::By(by),
            _ => Turn::No,
        };
    }
    let word = AxisLetter::new(view.machine.axes[axis].letter).map(|letter| usize::from(letter.0));
    let [from, to] = [&motion.start, &motion.end].map(|at| word.and_then(|word| at.get(word)));
    match (motion.kind, motion.orientation) {
        (MotionKind::Dwell(_), _) => Turn::No,
        (MotionKind::Unknown, _) | (_, Orientation::Vector(..)) => Turn::Perhaps,
        // the position is unknown both before and after this block: the block does not name it
        _ if to.is_none() || from == to => Turn::No,
        _ => Turn::Perhaps,
    }
}

/// An axis that codes clamp.
fn by_code(view: &LegView<'_>, axis: usize, out: &mut Reporter<'_>) {
    let entry = &view.machine.axes[axis];
    let (Some(codes), turn) = (entry.extra.clamp_codes, turn(view, axis)) else {
        return;
    };
    if turn == Turn::No {
        return;
    }
    let clamps = &view.trail.clamps;
    let (clamp, here) = AxisLetter::new(entry.letter).map_or((Clamp::Unsaid, false), |letter| {
        let here = clamps.named_here(letter);
        (if here { Clamp::Unknown } else { clamps.of(letter) }, here)
    });
    let (name, key) = (letter(entry.letter), 256 + u64::from(entry.letter));
    let note = || {
        format!(
            "the machine file of {} says that M{} clamps {name} and M{} releases it",
            view.machine.id, codes.on, codes.off
        )
    };
    let message = match (clamp, turn) {
        (Clamp::Open, _) => return,
        (Clamp::Closed, Turn::By(by)) => {
            out.finding(view, Merge::run(key, by), |draft| {
                draft
                    .at_axis(entry.letter)
                    .say(format!("{name} turns by {} while it is clamped", degrees(by)))
                    .note(note())
                    .help(format!(
                        "release it before (M{}), and clamp it again afterwards",
                        codes.off
                    ))
                    .value_text("axis", name.clone())
                    .value("rotary_change_deg", deg(by));
            });
            return;
        }
        (Clamp::Closed, _) => format!("{name} is clamped, and it is not known whether this motion turns it"),
        (Clamp::Unsaid, _) => format!(
            "{name} may be clamped: neither M{} nor M{} has run yet",
            codes.on, codes.off
        ),
        (Clamp::Unknown, _) if here => {
            format!(
                "{name} may be clamped: it is not known whether its clamp acts before or after the motion of this block"
            )
        }
        (Clamp::Unknown, _) => {
            format!("{name} may be clamped: it is not known which of its clamp codes ran last")
        }
    };
    let cause = clamp as u64 * 2 + u64::from(here);
    out.unknown(view, Merge::once(key + 256 * (1 + cause)), |draft| {
        draft
            .at_axis(entry.letter)
            .say(message)
            .note(note())
            .help(format!(
                "program M{} in a separate block before the axis turns",
                codes.off
            ))
            .value_text("axis", name.clone());
    });
}
