//! The program uses a tool length that is not declared: it is taken as zero.
//!
//! # Why
//! With tool centre point control the linear axes move together with the rotary axes; the longer the tool, the
//! farther. With a length of zero the computed travel and speed of the linear axes are too small.
//!
//! # Example
//! ```gcode fanuc-30i
//! N10 G0 G43 H5 Z10.
//! ;      ^^^ tool-length-unset: the length of H5 is not declared and is taken as zero
//! ```
//!
//! # Use instead
//! Declare it in `trunnion.toml`: `[[tool]] number = 5, length = 120.5`, in mm.
//!
//! # Guarantee
//! Sound; reported once per tool.
//!
//! # Sources
//! * docs/contract.md#offsets-and-tool-lengths
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Info, &[Wake::Fault(check)]);

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    if let FaultKind::ToolLengthUnset { tool } = &fault.kind {
        let digits = tool.trim_start_matches(|c: char| !c.is_ascii_digit());
        let number = if digits.chars().all(|c| c.is_ascii_digit()) && !digits.is_empty() {
            digits
        } else {
            "..."
        };
        let name = if tool == "T" { "the tool in use" } else { tool };
        out.report(
            fault.range,
            format!("the length of {name} is not declared and is taken as zero"),
        )
        .note("the tool length is measured from the gauge point of the spindle to the tip, in mm")
        .help(format!(
            "declare it in trunnion.toml: [[tool]] number = {number}, length = ..."
        ))
        .merge(Merge::once(hash(tool)));
    }
}
