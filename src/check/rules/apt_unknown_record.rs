//! An APT record is unknown to Trunnion.
//!
//! # Why
//! The record is skipped. It may move the tool or change the meaning of later records, so positions are unknown
//! from there on.
//!
//! # Example
//! ```gcode apt
//! WIGGLE/1,2
//! $$^^^^ apt-unknown-record: unknown APT record WIGGLE
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
//! * grammar/dialects/apt.toml, the table of APT words.
//! * ISO 4343:2000, the post-processor commands of APT.
use crate::prelude::*;

pub(super) const RULE: Body = Body::heuristic(Warning, &[Wake::Fault(check)]);

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    if fault.kind == FaultKind::AptUnknownRecord {
        let text = out.text(fault.range);
        let major: String = text.split('/').next().unwrap_or_default().trim().to_owned();
        out.report(fault.range, format!("unknown APT record {major}"))
            .note(
                "the record is skipped; it may move the tool or the coordinates, so positions are unknown from here on",
            )
            .help("check its spelling; if only the post-processor needs it, allow it with a comment")
            .merge(Merge::run(hash(&major), 0.0));
    }
}
