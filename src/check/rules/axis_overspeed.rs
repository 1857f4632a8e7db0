//! At the programmed feed an axis would have to move faster than it can.
//!
//! # Why
//! The control slows the whole block down, or follows with an error. The tool then cuts slower than meant, rubs, and leaves a
//! mark; the program takes longer than its feeds say.
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
//! Sound for axes with a declared speed, at the worst moment inside the block; an axis that moves without a declared speed is
//! reported as unknown, once. Up to 8 consecutive blocks are reported one by one, longer runs as one with their worst.
//!
//! # Thresholds
//! `vmax` of each axis in the machine file.
//!
//! # Sources
//! Trunnion's kinematics notes, sections 4.1 and 5 (VEL-AXIS).
use crate::prelude::*;
use crate::runs::SHORT_RUN;
use trunnion_machine::AxisKind;

pub(super) const RULE: Body = Body {
    severity: Severity::Warning,
    guarantee: Guarantee::Sound,
    level: Level::Leg(check),
};

/// Relative room for rounding.
const ROUNDING: f64 = 1e-9;

fn check(view: &LegView<'_>, out: &mut Reporter<'_>) {
    if !view.motion().is_feed() {
        return;
    }
    undeclared(view, out);
    let Some(limit) = view.feed_limit() else { return };
    let Some(needed) = limit.axis_speed else { return };
    if needed <= limit.axis_limit * (1.0 + ROUNDING) {
        return;
    }
    let axis = &view.machine.axes[limit.axis];
    if out.repeats(u64::from(axis.letter), -limit.feed_mm_min) {
        return;
    }
    let name = letter(axis.letter);
    let range = axis_word(out.program(), view.motion().block, axis.letter);
    let feed = view.programmed_feed_mm_min();
    let at = feed.map_or_else(String::new, |feed| format!(" at F{}", number(feed)));
    let draft = out.report(
        range,
        format!(
            "{name} would have to run at {}{at}, it reaches {}",
            speed(axis, needed),
            speed(axis, limit.axis_limit)
        ),
    );
    draft
        .note(format!(
            "the block can run at {} mm/min at most",
            number(limit.feed_mm_min)
        ))
        .help("lower the feed in this block, or lead the tool axis so that the axis turns less")
        .value_text("axis", name.clone())
        .value_text("limiting_axis", name)
        .value("feed_limit_mm_min", limit.feed_mm_min);
    match axis.kind {
        AxisKind::Linear => draft
            .value("value_mm_min", needed * 60.0)
            .value("limit_mm_min", limit.axis_limit * 60.0),
        AxisKind::Rotary => draft
            .value("value_deg_s", deg(needed))
            .value("limit_deg_s", deg(limit.axis_limit)),
    };
    if let Some(feed) = feed {
        draft.value("feed_mm_min", feed);
    }
    if view.near_pole() {
        draft.fix("smooth-pole");
    }
    draft.merge_runs_over(SHORT_RUN, u64::from(axis.letter), -limit.feed_mm_min);
}

/// An axis that moves but has no declared speed cannot be judged: told once per axis.
fn undeclared(view: &LegView<'_>, out: &mut Reporter<'_>) {
    let Some((start, end)) = view.stances() else { return };
    for (i, axis) in view.machine.axes.iter().enumerate() {
        if axis.max_speed.is_none() && start.joints[i] != end.joints[i] && out.once(u64::from(axis.letter)) {
            let range = axis_word(out.program(), view.motion().block, axis.letter);
            let name = letter(axis.letter);
            out.report(
                range,
                format!(
                    "{} declares no speed for {name}: whether {name} is overrun is not known",
                    view.machine.id
                ),
            )
            .help("declare it in the machine file: dyn = { vmax = ... }, mm/s or deg/s")
            .value_text("axis", name)
            .unknown();
        }
    }
}

#[cfg(test)]
mod tests {

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
}
