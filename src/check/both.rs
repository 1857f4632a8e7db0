//! Programs with blocks that begin with `/` while the state of the block delete switch is not declared: both states are judged.
use crate::{Diagnostic, Report, Settings};
use std::collections::HashSet;
use trunnion_dialect::Dialect;
use trunnion_syntax::{Block, Item, Program, TextRange};

/// The `/` of a block with its level, if it deletes anything: it begins the block, or is inside it in dialects that allow that.
pub(crate) fn slash(block: &Block<'_>, dialect: &Dialect) -> Option<(u8, TextRange)> {
    let mut items = block.items();
    let first = items.next()?;
    let found = if let Item::Skip(level, range) = first {
        (level, range)
    } else if dialect.quirks.delete_rest {
        let range = items.find_map(|item| match item {
            Item::Other(range) if block.program().bytes(range).starts_with(b"/") => Some(range),
            _ => None,
        })?;
        let digits = block.program().text(TextRange::new(range.start + 1, range.end));
        (digits.parse().unwrap_or(1), range)
    } else {
        return None;
    };
    items.any(|item| !matches!(item, Item::Comment(_))).then_some(found)
}

/// The levels of the blocks that have a `/` which deletes anything, ascending, each once, and how many blocks they are.
pub(crate) fn levels(program: &Program, dialect: &Dialect) -> (Vec<u8>, usize) {
    let (mut levels, mut count) = (Vec::new(), 0);
    for (level, _) in program.blocks().filter_map(|block| slash(&block, dialect)) {
        count += 1;
        levels.push(level);
    }
    levels.sort_unstable();
    levels.dedup();
    (levels, count)
}

/// Whether the state of the switch matters and is not declared.
pub(crate) fn is_open(program: &Program, settings: &Settings<'_>) -> bool {
    settings.setup.control.block_delete.is_none()
        && memchr::memchr(b'/', program.source()).is_some()
        && levels(program, settings.dialect).1 > 0
}

/// What makes two findings the same.
type Key<'d> = (&'d str, TextRange, &'d str);

fn key(found: &Diagnostic) -> Key<'_> {
    (found.rule, found.range, &found.message)
}

/// Adds what is found while the blocks are skipped to what is found while they run.
pub(crate) fn join(off: &mut Report, on: &Report) {
    // what the other state has is not missing
    let absence = |found: &Diagnostic| crate::rule(found.rule).is_some_and(crate::Rule::finds_absences);
    let mut only_on: Vec<Diagnostic> = {
        let in_off: HashSet<Key<'_>> = off.diagnostics.iter().map(key).collect();
        let new = |found: &&Diagnostic| !absence(found) && !in_off.contains(&key(found));
        on.diagnostics.iter().filter(new).cloned().collect()
    };
    let in_on: HashSet<Key<'_>> = on.diagnostics.iter().map(key).collect();
    off.diagnostics
        .retain(|found| !absence(found) || in_on.contains(&key(found)));
    for found in &mut off.diagnostics {
        if !in_on.contains(&key(found)) {
            found.notes.push("only if the blocks with / run".to_owned());
        }
    }
    for found in &mut only_on {
        found.notes.push("only if the blocks with / are skipped".to_owned());
    }
    off.diagnostics.append(&mut only_on);
    off.diagnostics
        .sort_by_key(|found| (found.range.start, found.range.end));
    off.coverage.join(&on.coverage);
    off.summary.recount(&off.diagnostics);
    for assumed in &on.assumptions {
        if !off.assumptions.contains(assumed) {
            off.assumptions.push(assumed.clone());
        }
    }
    off.cycle_time_s = match (off.cycle_time_s, on.cycle_time_s) {
        (Some(a), Some(b)) => Some([a[0].min(b[0]), a[1].max(b[1])]),
        _ => None,
    };
}
