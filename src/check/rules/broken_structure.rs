//! Loops, branches and subprograms do not fit together.
//!
//! # Why
//! A loop without its end, an `else` without its `if`, or an end that belongs to something else: the control stops,
//! or continues at an unexpected place.
//!
//! # Example
//! ```gcode fanuc-30i
//! N10 WHILE [#1 LT 3] DO 1
//! ;                   ^^^^ broken-structure: the END1 of this DO1 is missing
//! N20 #1 = #1 + 1
//! N30 M30
//! ```
//!
//! # Use instead
//! ```gcode fanuc-30i
//! N10 WHILE [#1 LT 3] DO 1
//! N20 #1 = #1 + 1
//! N30 END 1
//! N40 M30
//! ```
//!
//! # Guarantee
//! Sound where the run reaches it.
//!
//! # Sources
//! * LinuxCNC 2.9 (2023): the answers of its interpreter.
//! * FANUC Series 16i/18i-PB B-63684EN/01: custom macro, branch and repetition.
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Error, &[Wake::Refused(Refusal::Structure, plain)]);
