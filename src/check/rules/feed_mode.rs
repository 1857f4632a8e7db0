//! Rotary and linear axes move together, and F is not the speed of the tool tip.
//!
//! # Why
//! Without tool centre point control F is measured along X Y Z. While a rotary axis carries the part or the tool along, the tip moves much faster over the
//! material than F says: chips become too thick and the tool may break. Inverse time (G93) states the time of each block instead.
//!
//! # Example
//! ```gcode linuxcnc linuxcnc-xyzac-trt
//! N10 G21 G17 G90 G94 G49
//! N20 G0 X0 Y40 Z20 A10 C0
//! N30 S900 M3
//! N40 G1 X2 C60 F20
//! ;   ^^^^^^^^^^^^^ path-deviation: the tip leaves the programmed segment by
//! ;   ^^^^^^^^^^^^^ feed-mode: the tip moves at
//! N50 M2
//! ```
//!
//! # Use instead
//! ```gcode linuxcnc linuxcnc-xyzac-trt
//! N10 G21 G17 G90 G94 G49
//! N20 G0 X0 Y40 Z20 A10 C0
//! N30 S900 M3
//! N40 G1 X2 F20
//! N50 M2
//! ```
//!
//! # Guarantee
//! Silence proves nothing. The rule compares the distance of the tip's positions on the part with the length along which F is measured, in feed motions with the
//! spindle on whose position on the part is known. Consecutive blocks are one finding with the worst of them.
//!
//! # Thresholds
//! The tip moves at more than 1.25 times F.
//!
//! # Sources
//! * docs/kinematics.md#axis-speed-and-feed
use crate::pace::{PaceKind, Place};
use crate::prelude::*;
use trunnion_machine::Machine;

pub(super) const RULE: Body = Body::heuristic(Warning, &[Wake::Pace(PaceKind::Mode, report)]);

fn report(place: &Place, _: &Machine, out: &mut Reporter<'_>) {
    out.event(|draft| {
        draft
            .say(format!(
                "the tip moves at {} mm/min or more over the part, {} times the programmed {} mm/min",
                number(place.value.round()),
                number((place.value / place.feed * 10.0).round() / 10.0),
                number(place.feed)
            ))
            .help("program inverse time (G93), or switch tool centre point control on")
            .value("value_mm_min", place.value)
            .value("feed_mm_min", place.feed)
            .spans(place.count, place.last);
    });
}
