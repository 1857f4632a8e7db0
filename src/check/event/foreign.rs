//! A line in another language: many words of it have no meaning, and that is one mistake.
use super::{Blocks, carry};
use crate::{Diagnostic, Report, Severity, Status};
use trunnion_syntax::{LineIndex, Program};

/// What reports text that the dialect cannot read.
const RULES: [&str; 3] = ["syntax-error", "unknown-word", "unknown-code"];

/// From so many of them on, a line is taken to be foreign as a whole: two may be two slips.
const MANY: usize = 3;

/// Puts the findings about text that cannot be read together where one block has many: the first leads. One whose likely spelling is known
/// stays by itself, so that an editor can offer it.
pub(super) fn group(program: &Program, report: &mut Report) {
    let unread = |found: &Diagnostic| {
        let fails = found.status == Status::Fail && found.severity == Severity::Error;
        fails && found.replacement.is_none() && RULES.contains(&found.rule)
    };
    let blocks = Blocks(program);
    let mut of_block: Vec<(u32, usize)> = Vec::new();
    for (index, found) in report.diagnostics.iter().enumerate().filter(|(_, found)| unread(found)) {
        of_block.push((blocks.span(found).0, index));
    }
    of_block.sort_unstable();
    let foreign = of_block.chunk_by(|a, b| a.0 == b.0).filter(|found| found.len() >= MANY);
    let foreign: Vec<&[(u32, usize)]> = foreign.collect();
    if foreign.is_empty() {
        return;
    }
    let lines = LineIndex::new(program.source());
    let mut found: Vec<Option<Diagnostic>> = report.diagnostics.drain(..).map(Some).collect();
    for members in foreign {
        let first = members
            .iter()
            .min_by_key(|(_, index)| found[*index].as_ref().map(|of| of.range));
        let Some((_, lead)) = first else { continue };
        let others = members.iter().filter(|(_, index)| index != lead);
        let others: Vec<Diagnostic> = others.filter_map(|(_, index)| found[*index].take()).collect();
        if let Some(lead) = &mut found[*lead] {
            carry((program, &lines), lead, others);
        }
    }
    report.diagnostics = found.into_iter().flatten().collect();
    report.summary.recount(&report.diagnostics);
}
