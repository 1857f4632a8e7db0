//! A jump, loop or call names a label, sequence number or O-word that does not exist, or exists twice.
//!
//! # Why
//! The control stops in the middle of the program, with the tool wherever it happens to be. Where the number exists
//! twice, controls differ in which one they take.
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
//! Sound where the run reaches the jump. A label that a Klartext program has twice is reported without a jump to it, too: the control refuses the
//! program when it is loaded.
//!
//! # Sources
//! * LinuxCNC 2.9 (2023): the answers of its interpreter.
//! * FANUC Series 16i/18i-PB B-63684EN/01: custom macro, branch and repetition.
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Error, &[Wake::Refused(Refusal::Label, check)]);

fn check(draft: &mut Draft<'_>) {
    draft.help("correct the number, or add the label where the program should continue");
}
