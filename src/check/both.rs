//! Programs with blocks that begin with `/` while the state of the block delete switch is not declared: both states are judged.
use crate::{Diagnostic, Report, Settings};
use std::collections::HashSet;
use trunnion_interp::deleted_levels;
use trunnion_syntax::{Program, TextRange};

/// Whether the state of the switch matters and is not declared.
pub(crate) fn is_open(program: &Program, settings: &Settings<'_>) -> bool {
    settings.setup.control.block_delete.is_none()
        && memchr::memchr(b'/', program.source()).is_some()
        && deleted_levels(program, settings.dialect).1 > 0
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
