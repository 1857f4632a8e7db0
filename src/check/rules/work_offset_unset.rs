//! The program uses a work offset that is not declared: it is taken as zero.
//!
//! # Why
//! The position of the part in the machine decides whether the axes have enough travel and, without tool centre
//! point control, how the tip moves. With an offset of zero the part zero is the machine zero.
//!
//! # Example
//! ```gcode
//! N10 G54
//! ;   ^^^ work-offset-unset: G54 is not declared and is taken as zero
//! N20 G0 X0 Y0
//! ```
//!
//! # Use instead
//! Declare it in `trunnion.toml`: `[work_offsets] G54 = { X = 0, Y = 0, Z = 0 }`, in mm and degrees.
//!
//! # Guarantee
//! Sound; reported once per offset.
//!
//! # Sources
//! * docs/contract.md#offsets-and-tool-lengths
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Info, &[Wake::Fault(check)]);

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    if let FaultKind::WorkOffsetUnset { name } = &fault.kind {
        out.report(fault.range, format!("{name} is not declared and is taken as zero"))
            .note("the part zero is assumed to be at the machine zero")
            .help(format!(
                "declare it in trunnion.toml: [work_offsets] {name} = {{ X = 0, Y = 0, Z = 0 }}"
            ))
            .merge(Merge::once(hash(name)));
    }
}
