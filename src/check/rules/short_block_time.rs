//! Blocks take less time than the control needs to process them.
//!
//! # Why
//! A control needs some time for each block. Where the program has more blocks than it can process at the programmed feed, it slows down, or
//! the machine stutters.
//!
//! # Example
//! ```gcode fanuc-30i boring-mill-w
//! N10 G21 G17 G90 G94
//! N20 G0 X0. Y0. Z100. W0. B0.
//! N30 S900 M3
//! N40 G1 X0.05 F3000.
//! ;   ^^^^^^^^^^^^^^^ short-block-time: a block takes 1 ms
//! N50 X0.1
//! N60 X90.
//! N70 M30
//! ```
//!
//! # Use instead
//! ```gcode fanuc-30i boring-mill-w
//! N10 G21 G17 G90 G94
//! N20 G0 X0. Y0. Z100. W0. B0.
//! N30 S900 M3
//! N40 G1 X90. F3000.
//! N50 M30
//! ```
//!
//! # Guarantee
//! Silence proves nothing on a machine that declares no `block_time` (the coverage of the check says so); otherwise each feed motion with the spindle on is judged by its length and feed.
//! Consecutive blocks are one finding.
//!
//! # Thresholds
//! `[control] planner.block_time` of the machine file, s.
//!
//! # Sources
//! * docs/kinematics.md#time
use crate::pace::{PaceKind, Place};
use crate::prelude::*;
use trunnion_machine::Machine;

pub(super) const RULE: Body = Body::heuristic(Warning, &[Wake::Pace(PaceKind::Short, report)]).needs(|machine| {
    let missing = machine.control.block_time.is_none();
    missing.then_some("[control] planner.block_time")
});

fn report(place: &Place, machine: &Machine, out: &mut Reporter<'_>) {
    let limit = machine.control.block_time.unwrap_or(0.0);
    let (unit, keys) = place.unit();
    let own = limit * place.value / place.feed;
    out.event(|draft| {
        draft
            .say(format!(
                "a block takes {} ms at {} {unit}, and the control needs {} ms for one: it slows down to {} {unit}",
                number((own * 1e5).round() / 100.0),
                number(place.feed),
                number(limit * 1e3),
                number(place.value.round())
            ))
            .help("program longer blocks, or a lower feed")
            .value("value_s", own)
            .value("limit_s", limit)
            .value(keys[0], place.feed)
            .value(keys[1], place.value)
            .spans(place.count, place.last);
    });
}
