//! MULTAX is on and a GOTO has no tool vector.
//!
//! # Why
//! The tool axis keeps its direction. That may be intended, or the vector may have been lost in an earlier
//! processing step.
//!
//! # Example
//! ```gcode apt
//! MULTAX/ON
//! FEDRAT/500
//! GOTO/0,0,10,0,0,1
//! GOTO/5,0,10
//! $$   ^^^^^^ apt-vector-missing: MULTAX is on, but GOTO has no tool vector
//! FINI
//! ```
//!
//! # Use instead
//! ```gcode apt
//! MULTAX/ON
//! GOTO/0,0,10,0,0,1
//! GOTO/5,0,10,0,0,1
//! FINI
//! ```
//!
//! # Guarantee
//! Sound; the last vector is kept.
//!
//! # Sources
//! * docs/kinematics.md#apt-vectors
//! * ISO 4343:2000, MULTAX.
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Warning, &[Wake::Fault(check)]);

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    if fault.kind == FaultKind::AptVectorMissing {
        out.report(fault.range, "MULTAX is on, but GOTO has no tool vector")
            .note("the last tool vector is kept")
            .help("write i, j, k after x, y, z, or switch off with MULTAX/OFF")
            .merge(Merge::run(0, 0.0));
    }
}
