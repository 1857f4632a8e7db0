//! A coordinate has no decimal point, on a control where a parameter decides what that means.
//!
//! # Why
//! `X10` can mean 10 mm on one machine and 0.010 mm on another machine with the same control. The program text
//! looks the same on both.
//!
//! # Example
//! ```gcode fanuc-30i
//! N10 G21 G90 G94
//! N20 G1 X10 Y5. F200
//! ;      ^^^ ambiguous-implicit-decimal: `X10` has no decimal point
//! N30 M30
//! ```
//!
//! # Use instead
//! ```gcode fanuc-30i
//! N10 G21 G90 G94
//! N20 G1 X10. Y5. F200
//! N30 M30
//! ```
//!
//! # Guarantee
//! Sound for coordinates, arc centres, radii and feeds that are written as numbers other than zero. On a Fanuc a whole feed in mm/min is the same
//! either way; in inch, per turn, as the lead of a thread and in inverse time it is not, nor is a dwell `G4 X1`, whose time is unknown.
//! Coordinates are reported once in the program, and feeds once, with the number of blocks; each block counts once, by its first such word.
//!
//! # Sources
//! * FANUC Series 30i B-64490EN (parameter manual): parameter 3401, bit 0 (DPI).
//! * Haas 96-8210 (mill operator's manual): settings 77 and 162.
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Warning, &[Wake::Fault(check)]);

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    // the number may end at a letter O, which is reported as what it is
    if fault.kind == FaultKind::AmbiguousDecimal && !out.has_letter_o(fault.range) {
        let text = out.text(fault.range);
        let feed = text.starts_with(['F', 'f']);
        let advice = &out.dialect().advice;
        let setting = advice
            .whole_feed
            .as_ref()
            .filter(|_| feed)
            .or(advice.whole_coordinate.as_ref());
        let draft = out.report(
            fault.range,
            format!("`{text}` has no decimal point: its size depends on a parameter of the control"),
        );
        if let Some(setting) = setting {
            draft.note(setting);
        }
        draft
            .help(format!("write `{text}.`"))
            .replace_with(format!("{text}."))
            .merge(Merge::once(u64::from(feed)));
    }
}
