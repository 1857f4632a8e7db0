//! An arc has neither centre nor radius.
//!
//! # Why
//! The control cannot know which arc is meant; most stop, some run a line.
//!
//! # Example
//! ```gcode
//! N10 G17 G0 X0 Y0
//! N20 G2 X10 Y0 F300
//! ;      ^^^ arc-centre-missing: the arc has neither centre nor radius
//! ```
//!
//! # Use instead
//! ```gcode
//! N10 G17 G0 X0 Y0
//! N20 G2 X10 Y0 I5 J0 F300
//! ```
//!
//! # Guarantee
//! Sound.
//!
//! # Sources
//! The NIST RS274/NGC interpreter, version 3, on arcs at feed rate (G2, G3).
use crate::prelude::*;

pub(super) const RULE: Body = Body {
    severity: Severity::Error,
    guarantee: Guarantee::Sound,
    level: Level::Fault(check),
};

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    if fault.kind == FaultKind::ArcCentreMissing {
        out.report(fault.range, "the arc has neither centre nor radius")
            .help("write the centre words of the plane (G17: I J, G18: K I, G19: J K), or a radius");
    }
}
