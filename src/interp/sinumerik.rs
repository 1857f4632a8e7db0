//! The flow of Sinumerik programs: IF, CASE, jumps, loops, repeated sections, subprograms.
//!
//! Sources: Sinumerik 840D sl / ONE Programming Manual (12/2019): jumps 3.1.5, repetition of sections 3.1.6, control structures 3.1.7,
//! subprograms 3.2.2 and 3.2.3; "check structures are found by a search for their keywords while the program runs". What is not documented
//! there (a jump into a loop, out of a repeated section, which of two labels REPEAT takes) is not decided here.
mod call;
mod index;
mod names;
mod statement;
mod text;
mod words;

pub(crate) use call::{Level, With, too_deep};
pub(crate) use index::index;
pub(crate) use names::files;

use crate::flow::Index;
use crate::{FaultKind, Refusal};
use trunnion_syntax::{BlockId, Program};

/// The fact that a label is missing.
pub(crate) fn no_label(message: String) -> FaultKind {
    FaultKind::Rejected {
        refusal: Refusal::Label,
        message,
        alarm: Some("14080".to_owned()),
    }
}

/// Why the outcome of a jump is not known: it leads into a structure from outside, or out of a section that is repeated.
pub(crate) fn wrong_target(
    index: &Index,
    program: &Program,
    repeated: Option<(u32, u32)>,
    (from, to): (u32, u32),
) -> Option<FaultKind> {
    if let Some(entered) = index.loops.entered(from, to, |_| true) {
        let block = program.block(BlockId(entered.open));
        let what = format!(
            "a jump into `{}` of line {} from outside, which is not documented",
            program.text(block.range()).trim(),
            entered.open + 1
        );
        return Some(FaultKind::NotDecided { what });
    }
    repeated
        .filter(|&(first, last)| !(first..=last).contains(&to))
        .map(|_| {
            let what = "a jump out of a section that REPEAT repeats, which is not documented".to_owned();
            FaultKind::NotDecided { what }
        })
}
