//! What one block of a Sinumerik takes.
//!
//! Source: Sinumerik 840D sl / ONE Programming Manual, Fundamentals, rules of blocks and of programmable frames (as gEdit repeats them).
use crate::codes::Found;
use crate::core::Report;
use crate::words::Words;
use crate::{FaultKind, Refusal};
use trunnion_dialect::{Action, CodeKind};
use trunnion_syntax::TextRange;

/// M functions of a block.
const MOST_M: usize = 5;
/// Letters of words that a frame does not read.
const FOREIGN: &[u8] = b"DFHST";

/// `CYCLE81(...)`; MCALL before it is part of the call.
fn is_cycle(found: &Found<'_>) -> bool {
    found.with_arguments && (found.code.id.starts_with("CYCLE") || found.code.id.starts_with("HOLES"))
}

fn is_frame(found: &Found<'_>) -> bool {
    matches!(found.code.action, Action::ProgrammableShift | Action::ProgrammableFrame)
        && found.code.kind == CodeKind::Name
}

/// Reports a block with more M functions than the control takes, and other words beside a frame word or a cycle.
pub(crate) fn one_block(codes: &[Found<'_>], words: &Words, report: &mut Report<'_>) {
    let mut refuse = |range: TextRange, message: String| {
        let kind = FaultKind::Rejected {
            refusal: Refusal::Other,
            message,
            alarm: None,
        };
        report.fault(range, kind);
    };
    let functions = codes.iter().filter(|found| found.code.kind == CodeKind::M);
    if functions.clone().count() > MOST_M
        && let Some(last) = functions.max_by_key(|found| found.range.start)
    {
        refuse(
            last.range,
            format!("more than {MOST_M} M functions in a block: write the others into the next block"),
        );
    }
    let beside = FOREIGN.iter().any(|letter| words.letters & (1 << (letter - b'A')) != 0);
    if let Some(cycle) = codes.iter().find(|found| is_cycle(found)) {
        let others = codes
            .iter()
            .filter(|found| !is_cycle(found) && found.code.id != "MCALL");
        if beside || others.count() > 0 {
            let message = format!(
                "other words beside {}: a cycle is called in a block of its own",
                cycle.code.id
            );
            refuse(cycle.range, message);
        }
    }
    if let Some(frame) = codes
        .iter()
        .find(|found| is_frame(found))
        .filter(|_| beside || codes.len() > 1)
    {
        let message = format!(
            "other words beside {}: a frame word stands in a block of its own",
            frame.code.id
        );
        refuse(frame.range, message);
    }
}
