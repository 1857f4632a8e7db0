//! Cutter radius compensation is impossible here, or programmed incorrectly.
//!
//! # Why
//! Where the tool does not fit into a corner or an arc, the control stops or the tool cuts into the part. Planes,
//! offsets and some codes must not change while compensation is on: LinuxCNC says `Cannot change planes with cutter
//! radius compensation on`.
//!
//! # Example
//! ```gcode fanuc-30i
//! (trunnion: tool 1 flat diameter 10)
//! N10 G17 G90 G0 X0. Y-10. Z0.
//! N20 G41 D1 G1 X10. Y0. F100.
//! N30 X30.
//! N40 G3 X34. Y4. R4.
//! ;^^^^^^^^^^^^^^^^^^ cutter-compensation: the tool is too large
//! ;^^^^^^^^^^^^^^^^^^ not-modelled:
//! N50 G1 Y20.
//! N60 G40 X0.
//! N70 M30
//! ```
//!
//! # Use instead
//! ```gcode fanuc-30i
//! (trunnion: tool 1 flat diameter 10)
//! N10 G17 G90 G0 X0. Y-10. Z0.
//! N20 G41 D1 G1 X10. Y0. F100.
//! N30 X30.
//! N40 G3 X36. Y6. R6.
//! N50 G1 Y20.
//! N60 G40 X0.
//! N70 M30
//! ```
//!
//! # Guarantee
//! Compensation that is still on at the end of the program is a warning. Sound for the contours that are modelled; others are reported as not modelled.
//!
//! # Sources
//! * LinuxCNC 2.9 (2023): the answers of its interpreter.
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Error, &[Wake::Refused(Refusal::Compensation, plain), Wake::Fault(left)]);

fn left(fault: &Fault, out: &mut Reporter<'_>) {
    if fault.kind == FaultKind::CompensationLeft {
        out.report(
            fault.range,
            "cutter compensation is still on at the end of the program: the tool does not reach the last position, but a point beside it",
        )
        .severity(Warning)
        .help("write G40 in the motion that leaves the contour");
    }
}
