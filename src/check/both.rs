//! Programs with blocks that begin with `/`, where nobody says how the switch for block delete stands: both states are judged.
use crate::report::Summary;
use crate::{Diagnostic, Report, Settings};
use std::collections::HashSet;
use trunnion_syntax::{Item, Program, TextRange};

/// Rules that find something missing: what the other state has is not missing.
const ABSENCES: [&str; 2] = ["machine-not-used", "unused-suppression"];

/// The levels of the blocks that begin with `/` and hold anything else, ascending, each once, and how many blocks they are.
pub(crate) fn levels(program: &Program) -> (Vec<u8>, usize) {
    let (mut levels, mut count) = (Vec::new(), 0);
    for block in program.blocks() {
        let mut items = block.items();
        let Some(Item::Skip(level, _)) = items.next() else {
            continue;
        };
        if items.any(|item| !matches!(item, Item::Comment(_))) {
            count += 1;
            levels.push(level);
        }
    }
    levels.sort_unstable();
    levels.dedup();
    (levels, count)
}

/// Whether the state of the switch matters and is not declared.
pub(crate) fn is_open(program: &Program, settings: &Settings<'_>) -> bool {
    settings.setup.control.block_delete.is_none() && program.source().contains(&b'/') && levels(program).1 > 0
}

/// What makes two findings the same.
type Key<'d> = (&'d str, TextRange, &'d str);

fn key(found: &Diagnostic) -> Key<'_> {
    (found.rule, found.range, &found.message)
}

/// Adds what is found while the blocks are skipped to what is found while they run.
pub(crate) fn join(off: &mut Report, on: &Report) {
    let absence = |found: &Diagnostic| ABSENCES.contains(&found.rule);
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
            found.notes.push("only where the blocks with / are run".to_owned());
        }
    }
    for found in &mut only_on {
        found.notes.push("only where the blocks with / are skipped".to_owned());
    }
    off.diagnostics.append(&mut only_on);
    off.diagnostics
        .sort_by_key(|found| (found.range.start, found.range.end));
    let (blocks, motions) = (off.summary.blocks, off.summary.motions);
    off.summary = Summary {
        blocks,
        motions,
        ..Summary::default()
    };
    off.summary.count(&off.diagnostics);
    off.cycle_time_s = match (off.cycle_time_s, on.cycle_time_s) {
        (Some(a), Some(b)) => Some([a[0].min(b[0]), a[1].max(b[1])]),
        _ => None,
    };
}
