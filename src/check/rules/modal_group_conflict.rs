//! A block contains two codes of one modal group.
//!
//! # Why
//! Only one of them can be active. RS274/NGC controls stop; others take the last one, so the block does not do what
//! one of its codes says.
//!
//! # Example
//! ```gcode
//! N10 G0 G1 X10 F500
//! ;      ^^ modal-group-conflict: G1 contradicts G0
//! ```
//!
//! # Use instead
//! ```gcode
//! N10 G1 X10 F500
//! ```
//!
//! # Guarantee
//! Sound for the groups of the dialect's table; a warning on Fanuc, where the last one wins.
//!
//! # Sources
//! * NISTIR 6556 (2000), section 3.4 on modal groups.
//! * grammar/dialects/iso-6983.toml and the other tables next to it, for the groups of each control.
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(
    Error,
    &[Wake::Fault(check), Wake::Refused(Refusal::GroupConflict, plain)],
);

fn check(fault: &Fault, out: &mut Reporter<'_>) {
    let FaultKind::GroupConflict {
        group,
        first,
        second,
        first_range,
    } = &fault.kind
    else {
        return;
    };
    let last_wins = out.dialect().advice.last_word_wins;
    let draft = out.report(
        fault.range,
        format!("{second} contradicts {first}: both belong to the modal group `{group}`"),
    );
    draft
        .help("keep the one that you need, or write them in two blocks")
        .related(*first_range, format!("{first} is here"));
    if last_wins {
        draft.severity(Warning).note("on this control the last one wins");
    }
}
