//! The feed falls and rises again several times within a short path.
//!
//! # Why
//! Each time the machine slows down and speeds up again, the load on the tool changes. Short blocks with sharp corners, or limits that apply only in
//! some blocks, leave a pattern of marks on the surface.
//!
//! # Example
//! ```gcode fanuc-30i mill-3axis
//! N10 G21 G17 G90 G94
//! N20 G0 X0. Y0. Z0.
//! N30 S9000 M3
//! N40 G1 X0.5 F3000.
//! N50 Y0.5
//! N60 X1.
//! ;   ^^^ feed-oscillation: the feed swings
//! N70 Y1.
//! N80 M30
//! ```
//!
//! # Use instead
//! ```gcode fanuc-30i mill-3axis
//! N10 G21 G17 G90 G94
//! N20 G0 X0. Y0. Z0.
//! N30 S9000 M3
//! N40 G1 X0.5 F400.
//! N50 Y0.5
//! N60 X1.
//! N70 Y1.
//! N80 M30
//! ```
//!
//! # Guarantee
//! Silence proves nothing. The rule judges the planned speed of feed motions with the spindle on, on machines that declare the accelerations of their axes. A
//! single corner does not count as a swing: the feed has to fall below 70 % and recover twice. Blocks in which rotary axes turn are not judged. Consecutive blocks are one finding.
//!
//! # Thresholds
//! 30 % of the feed, twice within 2 mm of path.
//!
//! # Sources
//! * docs/kinematics.md#time
use crate::pace::{PaceKind, Place};
use crate::prelude::*;
use trunnion_machine::Machine;

pub(super) const RULE: Body = Body::heuristic(Warning, &[Wake::Pace(PaceKind::Swing, report)]).follows_pole_event();

fn report(place: &Place, _: &Machine, out: &mut Reporter<'_>) {
    out.event(|draft| {
        draft
            .say(format!(
                "the feed swings: within 2 mm it falls to {} mm/min and recovers twice; {} mm/min is programmed",
                number(place.value.round()),
                number(place.feed)
            ))
            .help("smooth the path, program longer blocks, or reduce the feed")
            .value("feed_mm_min", place.feed)
            .value("value_mm_min", place.value)
            .spans(place.count, place.last);
    });
}
