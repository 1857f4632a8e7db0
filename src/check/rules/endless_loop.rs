//! A loop, or a chain of calls, does not come to an end.
//!
//! # Why
//! The machine runs until somebody stops it. A loop that is meant to run for ever (a bar feeder, a warm-up) is told too: allow the
//! rule there with the reason.
//!
//! # Example
//! ```gcode fanuc-30i
//! N10 #1 = 0
//! N20 WHILE [#1 LT 3] DO 1
//! ;^^^^^^^^^^^^^^^^^^^^^^^ endless-loop: this did not come to an end
//! N30 #2 = #2 + 1
//! N40 END 1
//! N50 M30
//! ```
//!
//! # Use instead
//! ```gcode fanuc-30i
//! N10 #1 = 0
//! N20 WHILE [#1 LT 3] DO 1
//! N30 #1 = #1 + 1
//! N40 END 1
//! N50 M30
//! ```
//!
//! # Guarantee
//! A loop that is reported did not end within the bounds of the run (`[limits] blocks` in `trunnion.toml`, else 10 000 000 executed
//! blocks). A program that is not reported ends, where everything in it was decided.
//!
//! # Sources
//! Engineering judgement.
use crate::prelude::*;

pub(super) const RULE: Body = Body {
    severity: Severity::Error,
    guarantee: Guarantee::Sound,
    level: Level::Fault(check),
};

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    if let FaultKind::EndlessLoop { blocks } = fault.kind {
        out.report(
            fault.range,
            format!("this did not come to an end within {blocks} executed blocks"),
        )
        .note("what comes behind it was not checked")
        .help("change in the loop what its condition asks for; where it only runs long, raise `blocks` of [limits] in trunnion.toml")
        .value("executed_blocks", blocks as f64);
    }
}
