//! A word stands in a block in which nothing uses it.
//!
//! # Why
//! Something was meant by the word: a code is missing beside it, or the letter is wrong. LinuxCNC refuses the block (`P word with no
//! G2 G3 G4 ... to use it`), grbl too (error 36); other controls skip the word.
//!
//! # Example
//! ```gcode linuxcnc
//! G0 X10 P2
//! ;      ^^ unused-word:
//! M2
//! ```
//!
//! # Use instead
//! ```gcode linuxcnc
//! G0 X10
//! G4 P2
//! M2
//! ```
//!
//! # Guarantee
//! Sound for controls that refuse such a block. An error there; where the control skips the word, a warning.
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
    if let Some(draft) = refused(fault, out, &[Refusal::UnusedWord]) {
        draft.help("remove the word, or write the code that it belongs to");
    }
}
