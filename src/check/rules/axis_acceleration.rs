//! At the programmed feed an axis would need more acceleration in a bend of the path than it has.
//!
//! # Why
//! On a small arc, or where a rotary axis changes its speed, the feed alone asks for acceleration. The control slows down there, or the axis
//! lags behind and the arc becomes smaller than programmed.
//!
//! # Example
//! ```gcode fanuc-30i mill-3axis
//! N10 G21 G17 G90 G94
//! N20 G0 X0. Y0. Z0.
//! N30 S9000 M3
//! N40 G1 X5. F3000.
//! N50 G2 X5.4 I0.2 J0.
//! ;   ^^^^^^^^^^^^^^^^ axis-acceleration: in this bend
//! N60 M30
//! ```
//!
//! # Use instead
//! ```gcode fanuc-30i mill-3axis
//! N10 G21 G17 G90 G94
//! N20 G0 X0. Y0. Z0.
//! N30 S9000 M3
//! N40 G1 X5. F1000.
//! N50 G2 X5.4 I0.2 J0.
//! N60 M30
//! ```
//!
//! # Guarantee
//! Silence proves nothing. Only axes whose acceleration is declared are judged, in feed motions with the spindle on. The whole acceleration of an
//! axis is taken for the bend. Where the tip is guided while rotary axes turn, the bend is sampled. Consecutive blocks with the same axis are one finding.
//!
//! # Thresholds
//! `amax` of each axis in the machine file; 70 % of the programmed feed.
//!
//! # Sources
//! * docs/kinematics.md#time
use crate::pace::{PaceKind, Place};
use crate::prelude::*;
use trunnion_machine::Machine;

pub(super) const RULE: Body = Body::heuristic(Warning, &[Wake::Pace(PaceKind::Bend, report)]).follows_pole_event();

fn report(place: &Place, machine: &Machine, out: &mut Reporter<'_>) {
    let name = machine
        .axes
        .get(usize::from(place.joint))
        .map_or_else(String::new, |axis| letter(axis.letter));
    let (unit, keys) = place.unit();
    out.event(|draft| {
        draft
            .say(format!(
                "in this bend {name} reaches its acceleration at {} {unit}; {} {unit} is programmed",
                number(place.value.round()),
                number(place.feed)
            ))
            .help("reduce the feed here, or make the bend wider")
            .value_text("axis", name)
            .value(keys[0], place.feed)
            .value(keys[1], place.value)
            .spans(place.count, place.last);
    });
}
