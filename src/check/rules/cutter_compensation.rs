//! Cutter radius compensation is impossible here, or used wrongly.
//!
//! # Why
//! Where the tool does not fit into a corner or an arc the control stops, or it cuts into the part. Planes, offsets and some codes
//! may not change while it is on: LinuxCNC says `Cannot change planes with cutter radius compensation on`.
//!
//! # Example
//! ```gcode linuxcnc
//! G0 X0 Y0 Z0
//! G41.1 D10
//! G18
//! ;^^ cutter-compensation:
//! M2
//! ```
//!
//! # Use instead
//! ```gcode linuxcnc
//! G0 X0 Y0 Z0
//! G18
//! G40
//! M2
//! ```
//!
//! # Guarantee
//! Sound for the contours that are modelled; others are said to be not modelled.
//!
//! # Sources
//! Answers of the interpreter of LinuxCNC 2.9.
use crate::prelude::*;

pub(super) const RULE: Body = Body {
    severity: Severity::Error,
    guarantee: Guarantee::Sound,
    level: Level::Fault(check),
};

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    refused(fault, out, &[Refusal::Compensation]);
}
