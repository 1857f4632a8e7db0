//! A work offset is used that nobody declared: it is taken as zero.
//!
//! # Why
//! Where the part lies in the machine decides whether the travel of the axes is enough, and, without tool centre point
//! control, how the tip moves. With an offset of zero the part's zero is the machine's.
//!
//! # Example
//! ```gcode
//! N10 G54
//! ;   ^^^ work-offset-unset: G54 is not declared and taken as zero
//! N20 G0 X0 Y0
//! ```
//!
//! # Use instead
//! Declare it in `trunnion.toml`: `[work_offsets] G54 = { X = 0, Y = 0, Z = 0 }`, in mm and degrees.
//!
//! # Guarantee
//! Sound; told once per offset.
//!
//! # Sources
//! Trunnion's interface: where the part's zero lies in machine coordinates is a setting, not a guess.
use crate::prelude::*;

pub(super) const RULE: Body = Body {
    severity: Severity::Info,
    guarantee: Guarantee::Sound,
    level: Level::Fault(check),
};

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    if let FaultKind::WorkOffsetUnset { name } = &fault.kind {
        out.report(fault.range, format!("{name} is not declared and taken as zero"))
            .note("the part's zero is taken to lie at the machine's zero")
            .help(format!(
                "declare it in trunnion.toml: [work_offsets] {name} = {{ X = 0, Y = 0, Z = 0 }}"
            ))
            .merge_everywhere(hash(name));
    }
}
