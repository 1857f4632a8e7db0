//! An expression cannot be read, or has no value.
//!
//! # Why
//! A division by zero, the root of a negative number or a bracket too few stops the control where it comes to the block: in a
//! loop perhaps only in the hundredth pass. LinuxCNC says `Attempt to divide by zero` and `Negative argument to sqrt`.
//!
//! # Example
//! ```gcode fanuc-30i
//! N10 #1 = 0
//! N20 #2 = 10 / #1
//! ;        ^^^^^^^ bad-expression: division by zero
//! N30 M30
//! ```
//!
//! # Use instead
//! ```gcode fanuc-30i
//! N10 #1 = 4
//! N20 #2 = 10 / #1
//! N30 M30
//! ```
//!
//! # Guarantee
//! Sound where the run reaches the block with known values; an expression of unknown values is said to be not decided.
//!
//! # Sources
//! Answers of the interpreter of LinuxCNC 2.9; the Fanuc manuals on custom macro arithmetic.
use crate::prelude::*;

pub(super) const RULE: Body = Body {
    severity: Severity::Error,
    guarantee: Guarantee::Sound,
    level: Level::Fault(check),
};

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    refused(fault, out, &[Refusal::Expression]);
}
