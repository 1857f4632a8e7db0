//! The control refuses the block.
//!
//! # Why
//! The program stops there. What the control says of it stands in the note, where that is known.
//!
//! # Example
//! ```gcode fanuc-30i
//! N10 G10 L2 P9 X0.
//! ;   ^^^ rejected-block:
//! N20 M30
//! ```
//!
//! # Use instead
//! ```gcode fanuc-30i
//! N10 G10 L2 P1 X0.
//! N20 M30
//! ```
//!
//! # Guarantee
//! Sound for what is modelled. Refusals that other rules name (feed, arcs, expressions, labels) are theirs.
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
    refused(fault, out, &[Refusal::Other]);
}
