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
//! Sound for coordinates, arc centres, radii and, on a Haas, feeds that are written as numbers other than zero.
//! Consecutive blocks are reported once, and in each block only the first such word.
//!
//! # Sources
//! * FANUC Series 30i B-64490EN (parameter manual): parameter 3401, bit 0 (DPI).
//! * Haas 96-8210 (mill operator's manual): settings 77 and 162.
use crate::prelude::*;

pub(super) const RULE: Body = Body {
    severity: Severity::Warning,
    guarantee: Guarantee::Sound,
    level: Level::Fault(check),
};

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    if fault.kind == FaultKind::AmbiguousDecimal {
        let text = out.text(fault.range);
        let feed = text.starts_with(['F', 'f']);
        let note = match (out.dialect().starts_with("haas"), feed) {
            (true, true) => "setting 77 (scale integer F) decides; here F is taken as written",
            (true, false) => {
                "setting 162 (default to float): off means least increments (0.001 mm), on means millimetres; millimetres are assumed here"
            }
            _ => {
                "parameter 3401 bit 0 (DPI): 0 means least increments (0.001 mm), 1 means millimetres; millimetres are assumed here"
            }
        };
        out.report(
            fault.range,
            format!("`{text}` has no decimal point: its size depends on a parameter of the control"),
        )
        .note(note)
        .help(format!("write `{text}.`"))
        .merge(u64::from(feed), 0.0);
    }
}
