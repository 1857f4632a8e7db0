//! No machine is named, so axes, limits and speeds were not checked.
//!
//! # Why
//! The same program is right on one machine and wrong on another. Without a machine only text and programmed motion are
//! judged, and the verdict is unknown rather than pass.
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
//! Sound; told once per file, at its first byte.
//!
//! # Sources
//! Trunnion's interface: what cannot be decided is unknown, and says what is missing.
use crate::prelude::*;

pub(super) const RULE: Body = Body {
    severity: Severity::Info,
    guarantee: Guarantee::Sound,
    level: Level::Program(check),
};

fn check(overview: &Overview<'_>, out: &mut Reporter<'_>) {
    if overview.settings.machine.is_none() {
        let first = u32::from(!overview.program.source().is_empty());
        out.report(
            TextRange::new(0, first),
            "no machine is named: axes, limits and speeds were not checked",
        )
        .help("name one: --machine NAME or FILE, or `machine = \"NAME\"` in trunnion.toml")
        .unknown();
    }
}
