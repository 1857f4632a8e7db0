//! The tool nearly stands still in the cut.
//!
//! # Why
//! Where the tip hardly moves while the spindle turns, the tool rubs and heats the same spot: it leaves a mark that can be seen and felt. It happens
//! where rotary axes turn far while the tip moves only a short distance, for example next to the pole.
//!
//! # Example
//! ```gcode sinumerik-840d mikron-ucp710
//! N10 TRAORI
//! N20 G0 X0 Y0 Z50 A30 C0
//! N30 S9000 M3
//! N40 G1 X0.05 C40 F1000
//! ;   ^^^^^^^^^^^^^^^^^^ dwell-mark: the tool nearly stands still
//! ;            ^^^ axis-overspeed: C would have to run at
//! ;                ^^^^^ feed-drop: the axes allow
//! N50 M30
//! ```
//!
//! # Use instead
//! ```gcode sinumerik-840d mikron-ucp710
//! N10 TRAORI
//! N20 G0 X0 Y0 Z50 A30 C0
//! N30 S9000 M3
//! N40 G1 X50 C40 F1000
//! N50 M30
//! ```
//!
//! # Guarantee
//! Silence proves nothing. The rule judges the planned speed of feed motions with the spindle on, on machines that declare the accelerations of their axes.
//! A dwell that the program asks for is not a finding. Consecutive blocks are one finding.
//!
//! # Thresholds
//! Below 5 % of the programmed feed for more than 0.05 s without a break, in one block or over several.
//!
//! # Sources
//! * docs/kinematics.md#time
use crate::pace::{PaceKind, Place};
use crate::prelude::*;
use trunnion_machine::Machine;

pub(super) const RULE: Body = Body::heuristic(Warning, &[Wake::Pace(PaceKind::Crawl, report)]).follows_pole_event();

fn report(place: &Place, _: &Machine, out: &mut Reporter<'_>) {
    let (unit, keys) = place.unit();
    out.event(|draft| {
        draft
            .say(format!(
                "the tool nearly stands still in the cut: below 5 % of {} {unit} for {} s",
                number(place.feed),
                number((place.value * 1000.0).round() / 1000.0)
            ))
            .help("spread the turn of the rotary axes over a longer path, or turn them out of the cut")
            .value("value_s", place.value)
            .value(keys[0], place.feed)
            .spans(place.count, place.last);
    });
}
