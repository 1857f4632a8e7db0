//! A variable is used that has no value, does not exist, or may not be written.
//!
//! # Why
//! A misspelt name reads as another variable, or as none: the control stops there, or moves to a place nobody has chosen.
//! LinuxCNC says `Named parameter #<...> not defined`, and `Parameter number out of range` for a number it does not have.
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
//! Sound where the run reaches the block: a block behind a condition that could not be decided is said to be not decided.
//!
//! # Sources
//! Answers of the interpreter of LinuxCNC 2.9; the Fanuc manuals on custom macro variables.
use crate::prelude::*;

pub(super) const RULE: Body = Body {
    severity: Severity::Error,
    guarantee: Guarantee::Sound,
    level: Level::Fault(check),
};

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    if let Some(draft) = refused(fault, out, &[Refusal::Variable]) {
        draft.help("give the variable a value before it is used, or correct its name");
    }
}
