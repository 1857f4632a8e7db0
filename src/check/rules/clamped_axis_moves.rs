//! A rotary axis that must stand still while cutting turns in a feed motion.
//!
//! # Why
//! On 3+2 machines, and on indexing tables with a clamp, rotary axes are positioned out of the cut. A feed motion that turns them
//! works against the clamp, or stops with an alarm in the cut.
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
//! # Use instead
//! ```gcode sinumerik-840d mikron-ucp710+C.clamp
//! N10 TRAORI
//! N20 G0 X0 Y0 Z50 A20 C5
//! N30 G1 X10 F100
//! N40 M30
//! ```
//!
//! # Guarantee
//! Sound for feed motions between known positions.
//!
//! # Sources
//! Trunnion's kinematics notes, section 5 (LOCK-3P2).
use crate::prelude::*;
use crate::view::NO_TURN;

pub(super) const RULE: Body = Body {
    severity: Severity::Error,
    guarantee: Guarantee::Sound,
    level: Level::Leg(Needs::FEED.and(Needs::TURNS).and(Needs::CLAMP), check),
};

fn check(view: &LegView<'_>, out: &mut Reporter<'_>) {
    if !view.motion().is_feed() || !view.rotary_turns() {
        return;
    }
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
}
