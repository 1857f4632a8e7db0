//! A variable is used that has no value, does not exist, or must not be written.
//!
//! # Why
//! A misspelt name refers to another variable, or to none: the control stops there, or moves to an unintended
//! position. LinuxCNC says `Named parameter #<...> not defined`, and `Parameter number out of range` for a number
//! it does not have.
//!
//! # Example
//! ```gcode fanuc-30i
//! N10 #0 = 5
//! ;   ^^^^^^ undefined-variable:
//! N20 M30
//! ```
//!
//! # Use instead
//! ```gcode fanuc-30i
//! N10 #101 = 5
//! N20 M30
//! ```
//!
//! # Guarantee
//! Sound where the run reaches the block: a block after a condition that could not be decided is reported as not
//! decided.
//!
//! # Sources
//! * LinuxCNC 2.9 (2023): the answers of its interpreter.
//! * FANUC Series 16i/18i-PB B-63684EN/01: custom macro, variables.
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Error, &[Wake::Refused(Refusal::Variable, check)]);

fn check(draft: &mut Draft<'_>) {
    draft.help("give the variable a value before it is used, or correct its name");
}
