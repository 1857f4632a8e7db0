//! No machine is named, so axes, limits and speeds were not checked.
//!
//! # Why
//! The same program is right on one machine and wrong on another. Without a machine only the text and the
//! programmed motion are judged, and a pass says no more than that.
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
//! Sound; reported once per file, at its first byte. Not reported under `--scope motion` or `--scope language`, which need no
//! machine; under `--scope machine` the verdict is unknown.
//!
//! # Sources
//! * docs/contract.md#verdicts
use crate::config::Scope;
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Info, &[Wake::Program(check)]);

fn check(overview: &Overview<'_>, out: &mut Reporter<'_>) {
    let scope = overview.settings.scope;
    if overview.settings.machine.is_some() || scope.is_some_and(|scope| scope < Scope::Machine) {
        return;
    }
    let first = u32::from(!overview.program.source().is_empty());
    let draft = out.report(
        TextRange::new(0, first),
        "no machine is named: axes, limits and speeds were not checked",
    );
    draft.help("name the machine: --machine NAME or FILE, or `machine = \"NAME\"` in trunnion.toml; `trunnion machine list` lists the built-in ones");
    if scope.is_some() {
        draft.unknown();
    }
}
