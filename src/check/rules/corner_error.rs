//! The servo loops cut a corner by more than the tolerance.
//!
//! # Why
//! The axes follow the reference with a lag. At a corner the lag of one axis ends before that of the other begins, and the tool goes round the
//! inside: material stays, or is gouged at a concave corner.
//!
//! # Example
//! ```gcode fanuc-30i boring-mill-w
//! N10 G21 G17 G90 G94
//! N20 G0 X0. Y0. Z100. W0. B0.
//! N30 S900 M3
//! N40 G1 X50. F3000.
//! N50 Y50.
//! ;   ^^^^ corner-error: the servo loops cut this corner by
//! N60 M30
//! ```
//!
//! # Use instead
//! ```gcode fanuc-30i boring-mill-w
//! N10 G21 G17 G90 G94
//! N20 G0 X0. Y0. Z100. W0. B0.
//! N30 S900 M3
//! N40 G1 X50. F20.
//! N50 Y50.
//! N60 M30
//! ```
//!
//! # Guarantee
//! Silence proves nothing. Only machines with the same `kv` and `kff` in their first three linear axes, and with accelerations, are judged, at corners
//! between feed motions with the spindle on in which no rotary axis turns. The error is that of a lag of the first order, at the planned speed at the
//! corner; `trunnion servo FILE --at LINE` simulates it. Consecutive corners are one finding with the worst of them.
//!
//! # Thresholds
//! `[control] corner.tolerance` of the machine file, else 0.02 mm.
//!
//! # Sources
//! * docs/kinematics.md#servo
use crate::pace::{CORNER, PaceKind, Place};
use crate::prelude::*;
use trunnion_machine::Machine;

pub(super) const RULE: Body = Body::heuristic(Warning, &[Wake::Pace(PaceKind::Corner, report)]);

fn report(place: &Place, machine: &Machine, out: &mut Reporter<'_>) {
    let tolerance = machine.control.planning.corner_tolerance.unwrap_or(CORNER);
    out.event(|draft| {
        draft
            .say(format!(
                "the servo loops cut this corner by {}, more than {}, at {} mm/min",
                mm(place.value),
                mm(tolerance),
                number(place.feed.round())
            ))
            .help("reduce the feed at the corner, round it, or stop there exactly; `trunnion servo FILE --at LINE --tolerance-mm MM` says what keeps it")
            .value("value_mm", place.value)
            .value("limit_mm", tolerance)
            .value("feed_mm_min", place.feed)
            .spans(place.count, place.last);
    });
}
