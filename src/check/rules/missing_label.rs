//! A jump, loop or call names a label, sequence number or O-word that is not there, or is there twice.
//!
//! # Why
//! The control stops in the middle of the program, with the tool where it happens to be. Where the number is there twice,
//! controls differ in which of them they take.
//!
//! # Example
//! ```gcode fanuc-30i
//! N10 GOTO 100
//! ;        ^^^ missing-label: there is no block N100
//! N90 M30
//! ```
//!
//! # Use instead
//! ```gcode fanuc-30i
//! N10 GOTO 90
//! N90 M30
//! ```
//!
//! # Guarantee
//! Sound where the run reaches the jump.
//!
//! # Sources
//! Answers of the interpreter of LinuxCNC 2.9; the Fanuc manuals on branch and repetition.
use crate::prelude::*;

pub(super) const RULE: Body = Body {
    severity: Severity::Error,
    guarantee: Guarantee::Sound,
    level: Level::Fault(check),
};

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    if let Some(draft) = refused(fault, out, &[Refusal::Label]) {
        draft.help("correct the number, or write the label where the program is to go on");
    }
}
