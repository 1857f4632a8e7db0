//! An expression cannot be read, or has no value.
//!
//! # Why
//! A division by zero, the root of a negative number or a missing bracket stops the control when it reaches the
//! block. In a loop that may be as late as the hundredth pass. LinuxCNC says `Attempt to divide by zero` and
//! `Negative argument to sqrt`.
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
//! Sound where the run reaches the block with known values. An expression with unknown values is reported as not
//! decided.
//!
//! # Sources
//! * LinuxCNC 2.9 (2023): the answers of its interpreter.
//! * FANUC Series 16i/18i-PB B-63684EN/01: custom macro, arithmetic.
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Error, &[Wake::Refused(Refusal::Expression, plain)]);
