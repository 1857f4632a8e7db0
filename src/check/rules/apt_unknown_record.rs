//! An APT record is not known.
//!
//! # Why
//! It is skipped. It may move the tool or change how later records are meant, so positions are unknown from there on.
//!
//! # Example
//! ```gcode apt
//! WIGGLE/1,2
//! $$^^^^ apt-unknown-record: APT record WIGGLE is not known
//! $$^^^^^^^^ not-modelled: not modelled: WIGGLE
//! FINI
//! ```
//!
//! # Use instead
//! ```gcode apt
//! GOTO/1,2,3
//! FINI
//! ```
//!
//! # Guarantee
//! Heuristic: a post-processor may know words that the table does not.
//!
//! # Sources
//! The table `grammar/dialects/apt.toml`.
use crate::prelude::*;

pub(super) const RULE: Body = Body {
    severity: Severity::Warning,
    guarantee: Guarantee::Heuristic,
    level: Level::Fault(check),
};

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    if fault.kind == FaultKind::AptUnknownRecord {
        let text = out.text(fault.range);
        let major: String = text.split('/').next().unwrap_or_default().trim().to_owned();
        out.report(fault.range, format!("APT record {major} is not known"))
            .note("it is skipped; it may move the tool or the coordinates, so positions are unknown from here on")
            .help("check its spelling; if it matters only to the post-processor, allow it with a comment")
            .merge(hash(&major), 0.0);
    }
}
