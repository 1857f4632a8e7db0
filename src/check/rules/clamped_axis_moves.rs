//! A rotary axis turns that must stand still while cutting, or that a code has clamped.
//!
//! # Why
//! On 3+2 machines, and on indexing tables with a clamp, rotary axes are positioned out of the cut. A feed motion that turns them
//! works against the clamp, or stops with an alarm in the cut. Where codes of the program close and open the clamp, no motion at all may
//! turn the axis while it is closed.
//!
//! # Example
//! The machine file has `clamp = true` at C.
//!
//! ```gcode sinumerik-840d mikron-ucp710+C.clamp
//! N10 TRAORI
//! N20 G0 X0 Y0 Z50 A20 C0
//! N30 G1 X10 C5 F100
//! ;          ^^ clamped-axis-moves: C turns by 5 deg in a feed motion, but must stand still while cutting
//! N40 M30
//! ```
//!
//! The machine file has `clamp_codes = { on = "M10", off = "M11" }` at C.
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
//! Sound for motions between known positions. Where a motion may turn an axis and its clamp is closed, not yet named, named in the same
//! block, or by an expression or a file that is called, the finding is unknown. Codes in a called file in which nothing moves are not seen.
//!
//! # Sources
//! Trunnion's kinematics notes, section 5 (LOCK-3P2).
use crate::clamps::{Clamp, said};
use crate::prelude::*;
use crate::view::NO_TURN;
use trunnion_interp::{AxisLetter, MotionKind, Orientation};
use trunnion_machine::AxisKind;

pub(super) const RULE: Body = Body {
    severity: Severity::Error,
    guarantee: Guarantee::Sound,
    level: Level::Leg(Needs::CLAMP, check),
};

fn check(view: &LegView<'_>, out: &mut Reporter<'_>) {
    if view.motion().is_feed() && view.rotary_turns() {
        in_the_cut(view, out);
    }
    for (axis, entry) in view.machine.axes.iter().enumerate() {
        if entry.extra.clamp_codes.is_some() && entry.kind == AxisKind::Rotary {
            by_code(view, axis, out);
        }
    }
}

/// Axes that must stand still while cutting.
fn in_the_cut(view: &LegView<'_>, out: &mut Reporter<'_>) {
    for (&joint, turn) in view.machine.rotary.iter().zip(view.leg.rotary_change) {
        let axis = &view.machine.axes[joint];
        let key = u64::from(axis.letter);
        if !axis.extra.clamp || turn <= NO_TURN || out.repeats(view, key, turn) {
            continue;
        }
        let name = letter(axis.letter);
        let range = axis_word(out.program(), view.motion().block, axis.letter);
        out.report(
            range,
            format!(
                "{name} turns by {} in a feed motion, but must stand still while cutting",
                degrees(turn)
            ),
        )
        .note(format!(
            "the machine file of {} says clamp = true at {name}",
            view.machine.id
        ))
        .help("turn the axis in a rapid motion out of the cut")
        .value_text("axis", name)
        .value("rotary_change_deg", deg(turn))
        .merge(key, turn);
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
        return if by > NO_TURN { Turn::By(by) } else { Turn::No };
    }
    let word = AxisLetter::new(view.machine.axes[axis].letter).map(|letter| usize::from(letter.0));
    let [from, to] = [&motion.start, &motion.end].map(|at| word.and_then(|word| at.get(word)));
    match (motion.kind, motion.orientation) {
        (MotionKind::Dwell(_), _) => Turn::No,
        (MotionKind::Unknown, _) | (_, Orientation::Vector(..)) => Turn::Perhaps,
        // neither before nor behind this block the program knows it: the block does not name it
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
    let block = view.motion().block;
    let here = (block.0 as usize) < out.program().block_count() && said(&out.program().block(block), codes).is_some();
    let clamp = if here {
        Clamp::NotRead
    } else {
        view.trail.clamps.of(axis)
    };
    let (name, key) = (letter(entry.letter), 256 + u64::from(entry.letter));
    let range = axis_word(out.program(), block, entry.letter);
    let note = format!(
        "the machine file of {} says that M{} clamps {name} and M{} releases it",
        view.machine.id, codes.on, codes.off
    );
    let message = match (clamp, turn) {
        (Clamp::Open, _) => return,
        (Clamp::Closed, Turn::By(by)) => {
            if out.repeats(view, key, by) {
                return;
            }
            out.report(range, format!("{name} turns by {} while it is clamped", degrees(by)))
                .note(note)
                .help(format!("release it before (M{}), and clamp it again behind", codes.off))
                .value_text("axis", name)
                .value("rotary_change_deg", deg(by))
                .merge(key, by);
            return;
        }
        (Clamp::Closed, _) => format!("{name} is clamped, and it is not known whether this turns it"),
        (Clamp::Unsaid, _) => format!("{name} may be clamped: no M{} or M{} has run yet", codes.on, codes.off),
        (Clamp::NotRead, _) if here => {
            format!("{name} may be clamped: whether its clamp moves before this block's motion or behind is not known")
        }
        (Clamp::NotRead, _) => {
            format!("{name} may be clamped: the code is an expression, or stands in a file that is called")
        }
    };
    let cause = clamp as u64 * 2 + u64::from(here);
    out.report(range, message)
        .note(note)
        .help(format!(
            "program M{} in a block of its own before the axis turns",
            codes.off
        ))
        .value_text("axis", name)
        .unknown()
        .merge_everywhere(key + 256 * (1 + cause));
}

#[cfg(test)]
mod tests {
    use crate::fixture::assert_drawn;

    #[test]
    fn a_run_of_blocks_is_told_once_and_the_free_axis_may_turn() {
        let report = assert_drawn(
            "gcode sinumerik-840d mikron-ucp710+C.clamp",
            "N10 TRAORI\nN20 G0 X0 Y0 Z50 A20 C0\nN30 G1 X10 A21 F100\nN40 G1 X20 C1\n;          ^^ clamped-axis-moves: C turns by 2 deg\nN50 G1 X30 C3\nN60 M30\n",
        );
        assert_eq!(report.diagnostics[0].count, 2);
    }

    const CODES: &str = "mikron-ucp710+C.clamp_codes={on=\"M10\",off=\"M11\"}";

    fn drawn(dialect: &str, text: &str) {
        assert_drawn(&format!("gcode {dialect} {CODES}"), text);
    }

    #[test]
    fn a_clamp_that_no_code_has_named_is_not_decided() {
        drawn(
            "haas-ngc",
            "G0 X0. Y0. Z50. A20. C0.\n;                    ^^^ clamped-axis-moves: C may be clamped: no M10 or M11 has run yet\nG0 C9.\nX5.\nM30\n",
        );
    }

    #[test]
    fn a_code_beside_the_motion_is_not_decided_and_holds_behind_it() {
        drawn(
            "fanuc-30i",
            "M11\nG0 X0. Y0. Z50. A20. C0.\nG0 C9. M10\n;  ^^^ clamped-axis-moves: C may be clamped: whether its clamp moves before\nG0 A9.\nG0 C5.\n;  ^^^ clamped-axis-moves: C turns by 4 deg while it is clamped\nM30\n",
        );
    }

    #[test]
    fn codes_of_a_subprogram_in_the_file_are_read() {
        let report = assert_drawn(
            &format!("gcode haas-ngc {CODES}"),
            "M11\nG0 X0. Y0. Z50. A20. C0.\nM98 P5\nG0 C9.\nM30\nO5\nM10\nG0 C5.\n;  ^^^ clamped-axis-moves: C turns by 5 deg while it is clamped\nM99\n",
        );
        assert_eq!(report.diagnostics[0].count, 2);
    }

    #[test]
    fn a_code_by_an_expression_is_not_decided() {
        drawn(
            "haas-ngc",
            "M11\nG0 X0. Y0. Z50. A20. C0.\n#1=10\nM#1\nG0 C9.\n;  ^^^ clamped-axis-moves: C may be clamped: the code is an expression\nM30\n",
        );
    }

    #[test]
    fn vectors_and_swivels_turn_a_clamped_axis_too() {
        drawn(
            "fanuc-30i",
            "M11\nG0 X0. Y0. Z50. A0. C0.\nM10\nG68.2 X0. Y0. Z0. I30. J20. K0.\nG53.1\n;^^^^ clamped-axis-moves: C turns by\nG69\nM30\n",
        );
    }
}
