//! No machine is named, so axes, limits and speeds were not checked.
//!
//! # Why
//! The same program is right on one machine and wrong on another. Without a machine only the text and the
//! programmed motion are judged, and the verdict is unknown rather than pass.
//!
//! # Example
//! ```gcode
//! N10 G0 X0 Y0
//! ;^ machine-unset: no machine is named
//! N20 M30
//! ```
//!
//! # Use instead
//! ```gcode mill-3axis
//! N10 G0 X0 Y0
//! N20 M30
//! ```
//!
//! # Guarantee
//! Sound; reported once per file, at its first byte.
//!
//! # Sources
//! * docs/contract.md#verdicts
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Info, &[Wake::Program(check)]);

fn check(overview: &Overview<'_>, out: &mut Reporter<'_>) {
    if overview.settings.machine.is_none() {
        let first = u32::from(!overview.program.source().is_empty());
        out.report(
            TextRange::new(0, first),
            "no machine is named: axes, limits and speeds were not checked",
        )
        .help("name the machine: --machine NAME or FILE, or `machine = \"NAME\"` in trunnion.toml")
        .unknown();
    }
}
