//! Whether what a run finds was found in the text before.
use trunnion_interp::{Fault, FaultKind, Refusal};
use trunnion_syntax::{Program, SyntaxError, SyntaxErrorKind};

/// Whether the rules of the text have already reported this place.
pub(crate) fn text_rule_reported(program: &Program, fault: &Fault) -> bool {
    let refused = matches!(
        fault.kind,
        FaultKind::Rejected {
            refusal: Refusal::Syntax | Refusal::Number | Refusal::Expression,
            ..
        }
    );
    let lacks_feed = matches!(fault.kind, FaultKind::MissingFeed { .. });
    let bracket = |errors: &[SyntaxError]| {
        let open = |error: &SyntaxError| error.kind == SyntaxErrorKind::UnbalancedBracket;
        let in_block = |error: &&SyntaxError| program.block_at(error.range.start) == Some(fault.block);
        // they are sorted, and there may be as many as faults: only those of the block are looked at
        let begin = program.block(fault.block).range().start;
        let from = errors.partition_point(|error| error.range.start < begin);
        errors[from..].iter().take_while(in_block).any(open)
    };
    // what follows a bracket that is not closed is not read as it was meant
    if (refused || lacks_feed) && bracket(program.errors()) {
        return true;
    }
    refused && {
        let errors = program.errors();
        // the missing value is expected where it should begin, after the blanks
        let before = &program.source()[..fault.range.start as usize];
        let blanks = before.iter().rev().take_while(|byte| matches!(byte, b' ' | b'\t'));
        let start = fault.range.start - blanks.count() as u32;
        let from = errors.partition_point(|error| error.range.end < start);
        // they are sorted: if the first of them begins later, so do all
        errors
            .get(from)
            .is_some_and(|error| error.range.start <= fault.range.end)
    }
}
