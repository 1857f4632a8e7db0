//! A canned cycle is used wrongly.
//!
//! # Why
//! A cycle without its retract plane, without depth, or with the plane below the bottom stops the control, or drives the tool
//! through the part in rapid. LinuxCNC says `R clearance plane unspecified in cycle`.
//!
//! # Example
//! ```gcode fanuc-30i
//! N10 G0 X0. Y0. Z50.
//! N20 G83 X10. Y10. Z-5. R2. F100.
//! ;       ^^^^ canned-cycle: G83 without Q
//! N30 M30
//! ```
//!
//! # Use instead
//! ```gcode fanuc-30i
//! N10 G0 X0. Y0. Z50.
//! N20 G83 X10. Y10. Z-5. R2. Q1. F100.
//! N30 G80
//! N40 M30
//! ```
//!
//! # Guarantee
//! Sound for the cycles that are modelled; others are said to be not modelled.
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
    refused(fault, out, &[Refusal::CannedCycle]);
}
