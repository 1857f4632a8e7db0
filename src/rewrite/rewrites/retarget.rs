//! Writes the program for another control or another machine, and proves that the tool does the same there.
//!
//! # Why
//! A part moves to another machine: other axes, rotary axes in other places, another control. Posting it again needs the CAM system; editing
//! it by hand goes wrong where postures, work planes and cycles differ.
//!
//! # How
//! `trunnion fix FILE --rewrite retarget --to DIALECT`, or `--to-machine NAME`, runs the program, finds the axis positions of the target machine
//! for every tip and tool axis, and writes each block with the codes of the target. It is what `trunnion convert` does, as the last of several
//! rewrites: those before it change the program for its own machine, and `retarget` writes what they leave. `convert` has more choices of
//! how the program is written.
//!
//! # Example
//! ```gcode before fanuc-30i mill-3axis
//! O1
//! G21 G90 G94 G17 G54
//! G0 X2. Y0. Z5. S8000 M3
//! G1 Z0. F500
//! X10.
//! M30
//! ```
//! ```gcode after --to sinumerik-840d
//! N10 G90 G17 G40 G710 G94
//! N20 G54
//! N30 S8000 M3
//! N40 G0 X2 Y0 Z5
//! N50 G1 Z0 F500
//! N60 X10
//! N70 M30
//! ```
//!
//! # Claim
//! Both programs, each run for its own control and machine, bring the tip to the same places with the same tool axis and feed, within the
//! tolerances; effects such as spindle, coolant and tool changes come at the same motions. The certificate is that of a conversion.
//!
//! # Traps
//! - Without a target nothing is written.
//! - What has no counterpart on the target is refused by name, or listed as left out.
//! - The whole program is rewritten: comments get lines of their own, numbers have the decimals of the target.
//! - `--write` is refused, because a program for another control belongs in its own file: use `-o FILE`.
//!
//! # Sources
//! docs/decisions/0180-retarget-is-the-last-rewrite.md; docs/certificates.md.
use super::Body;
use crate::{Known, Options, Proposed, Refusal};
use trunnion_check::Settings;
use trunnion_syntax::Program;

pub(super) const REWRITE: Body = Body {
    cures: &[],
    writes: None,
    propose,
};

/// It has no edits: the caller that knows the target asks the converter.
fn propose(_: &Program, _: &Settings<'_>, _: &Options, _: &Known) -> Proposed {
    Err(Refusal::missing(
        "retarget needs a target: name the control with --to DIALECT, or the machine with --to-machine NAME",
    ))
}
