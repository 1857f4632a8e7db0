//! Where the program goes on depends on something that is not known here.
//!
//! # Why
//! A condition on a probed value, on an input of the machine or on the hour of the day is decided at the machine. What runs behind
//! it was not checked, and a verdict must not rest on a guess.
//!
//! # Example
//! ```gcode fanuc-30i
//! N10 IF [#1000 EQ 1] GOTO 30
//! ;      ^^^^^^^^^^^^ not-decided: where the program goes on depends on #1000
//! N20 G0 X10.
//! N30 M30
//! ```
//!
//! # Use instead
//! ```gcode fanuc-30i
//! N10 #1 = 1
//! N15 IF [#1 EQ 1] GOTO 30
//! N20 G0 X10.
//! N30 M30
//! ```
//!
//! # Guarantee
//! Sound: a program in which it is not reported was followed to its end, on the one way that it can take.
//!
//! # Sources
//! Trunnion's interface: what cannot be decided is unknown, and says what is missing.
use crate::prelude::*;

pub(super) const RULE: Body = Body {
    severity: Severity::Info,
    guarantee: Guarantee::Sound,
    level: Level::Fault(check),
};

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    if let FaultKind::NotDecided { what } = &fault.kind {
        out.report(fault.range, format!("where the program goes on depends on {what}"))
            .note("what runs behind it was not checked")
            .unknown();
    }
}
