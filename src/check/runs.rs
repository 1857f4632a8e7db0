//! Merging: the same finding in consecutive blocks becomes one diagnostic at the first of them, with the worst values.
use crate::place::code_range;
use crate::{Diagnostic, Severity, Status};
use std::collections::BTreeMap;
use trunnion_syntax::{BlockId, Program, TextRange};

/// Runs of findings that differ in their numbers are reported block by block up to this many blocks.
pub(crate) const SHORT_RUN: usize = 8;

/// Of one rule at most this many diagnostics are listed per file; one more counts the rest, so that a file of noise cannot
/// fill the memory.
const LISTED: u32 = 10_000;

/// How findings of one rule are put together. Findings that are events (`pole-flip`) have none and are never merged.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Merge {
    /// What must agree beside the rule: an axis letter, a text's hash, or 0.
    pub(crate) key: u64,
    /// How bad: message and values of the largest are kept.
    pub(crate) badness: f64,
    /// Runs up to this many blocks are reported block by block.
    pub(crate) show: usize,
    /// Merges over gaps too: a cause that is told once in the whole program.
    pub(crate) everywhere: bool,
}

/// A run of findings that may still grow.
struct Run {
    show: usize,
    everywhere: bool,
    /// Counter of the last block in it.
    sequence: u64,
    /// Findings with their badness; one for all blocks once `merged`.
    items: Vec<(f64, Diagnostic)>,
    merged: bool,
    /// Where the worst lies, once merged.
    worst: TextRange,
    /// The last block, where it was only counted.
    last: Option<BlockId>,
}

/// A finding that is not worded yet, because its run may have worse to tell.
#[derive(Clone, Copy)]
pub(crate) struct Repeat {
    pub(crate) rule: &'static str,
    pub(crate) key: u64,
    pub(crate) badness: f64,
    pub(crate) severity: Severity,
    pub(crate) status: Status,
    pub(crate) block: BlockId,
    pub(crate) sequence: u64,
}

/// Collects diagnostics and merges runs.
#[derive(Default)]
pub(crate) struct Log {
    /// By rule, key and whether it is unknown.
    open: BTreeMap<(&'static str, u64, bool), Run>,
    closed: Vec<Diagnostic>,
    /// Per rule: how many are listed, and the rest.
    listed: BTreeMap<&'static str, (u32, Option<Diagnostic>)>,
}

impl Log {
    /// Adds a finding. `sequence` counts blocks: a run goes on while it grows by one at most.
    pub(crate) fn add(&mut self, program: &Program, diagnostic: Diagnostic, merge: Option<Merge>, sequence: u64) {
        let Some(merge) = merge else {
            if let Some(diagnostic) = self.list(diagnostic) {
                self.closed.push(diagnostic);
            }
            return;
        };
        let place = (diagnostic.rule, merge.key, diagnostic.status == Status::Unknown);
        if let Some(run) = self.open.get_mut(&place)
            && (merge.everywhere || sequence <= run.sequence + 1)
        {
            run.extend(diagnostic, merge.badness, sequence);
            return;
        }
        let Some(diagnostic) = self.list(diagnostic) else {
            return;
        };
        let worst = diagnostic.range;
        let items = vec![(merge.badness, diagnostic)];
        if let Some(ended) = self.open.insert(
            place,
            Run {
                show: merge.show,
                everywhere: merge.everywhere,
                sequence,
                items,
                merged: false,
                worst,
                last: None,
            },
        ) {
            ended.close(program, &mut self.closed);
        }
    }

    /// Gives a diagnostic back while the rule's list is not full, else counts it among the rest.
    fn list(&mut self, diagnostic: Diagnostic) -> Option<Diagnostic> {
        let (count, rest) = self.listed.entry(diagnostic.rule).or_default();
        if *count < LISTED {
            *count += 1;
            return Some(diagnostic);
        }
        match rest {
            None => *rest = Some(diagnostic),
            Some(rest) => {
                rest.count = rest.count.saturating_add(diagnostic.count);
                rest.last = diagnostic.last;
                rest.severity = rest.severity.max(diagnostic.severity);
                if diagnostic.status == Status::Fail {
                    rest.status = Status::Fail;
                }
            }
        }
        None
    }

    /// Counts a finding without wording it: true where its run is merged already and has told worse.
    pub(crate) fn absorb(&mut self, repeat: Repeat) -> bool {
        let place = (repeat.rule, repeat.key, repeat.status == Status::Unknown);
        let Some(run) = self.open.get_mut(&place) else {
            return false;
        };
        if !(run.everywhere || repeat.sequence <= run.sequence + 1) || !(run.merged || run.show == 1) {
            return false;
        }
        let [(badness, whole)] = run.items.as_mut_slice() else {
            return false;
        };
        if repeat.badness > *badness || repeat.severity > whole.severity {
            return false;
        }
        whole.count += 1;
        run.sequence = repeat.sequence;
        run.last = Some(repeat.block);
        true
    }

    /// All diagnostics, sorted by place, then rule.
    pub(crate) fn finish(mut self, program: &Program) -> Vec<Diagnostic> {
        for run in self.open.into_values() {
            run.close(program, &mut self.closed);
        }
        for mut rest in self.listed.into_values().filter_map(|(_, rest)| rest) {
            rest.message = format!(
                "{} more findings of {} are not listed one by one",
                rest.count, rest.rule
            );
            rest.notes = Vec::new();
            rest.values = Vec::new();
            self.closed.push(rest);
        }
        self.closed
            .sort_by(|a, b| (a.range, a.rule, &a.message).cmp(&(b.range, b.rule, &b.message)));
        self.closed
    }
}

impl Run {
    fn extend(&mut self, diagnostic: Diagnostic, badness: f64, sequence: u64) {
        self.sequence = sequence;
        self.last = None;
        self.items.push((badness, diagnostic));
        if self.merged || self.items.len() > self.show {
            self.merged = true;
            let mut items = self.items.drain(..);
            let Some((mut badness, mut whole)) = items.next() else {
                return;
            };
            for (other, next) in items {
                whole.count += next.count;
                whole.last = next.last;
                if other > badness {
                    badness = other;
                    self.worst = next.range;
                    whole.message = next.message;
                    whole.notes = next.notes;
                    whole.help = next.help;
                    whole.values = next.values;
                }
                whole.severity = whole.severity.max(next.severity);
                for fix in next.fixes {
                    if !whole.fixes.contains(&fix) {
                        whole.fixes.push(fix);
                    }
                }
            }
            self.items.push((badness, whole));
        }
    }

    fn close(mut self, program: &Program, out: &mut Vec<Diagnostic>) {
        if let (Some(block), [(_, whole)]) = (self.last, self.items.as_mut_slice()) {
            whole.last = code_range(program, block);
        }
        if let [(_, whole)] = self.items.as_mut_slice()
            && self.worst != whole.range
        {
            whole.related.push((self.worst, "the worst of them is here".to_owned()));
        }
        out.extend(self.items.into_iter().map(|(_, diagnostic)| diagnostic));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trunnion_syntax::{LexOptions, parse};

    fn empty() -> Program {
        parse(Vec::new(), LexOptions::default())
    }

    fn finding(at: u32, message: &str) -> Diagnostic {
        let range = TextRange::new(at * 10, at * 10 + 3);
        Diagnostic {
            rule: "axis-limit",
            severity: Severity::Error,
            status: Status::Fail,
            range,
            block: None,
            message: message.to_owned(),
            notes: Vec::new(),
            help: None,
            values: Vec::new(),
            fixes: Vec::new(),
            related: Vec::new(),
            count: 1,
            last: range,
        }
    }

    fn merge(key: u64, badness: f64, show: usize) -> Merge {
        Merge {
            key,
            badness,
            show,
            everywhere: false,
        }
    }

    #[test]
    fn consecutive_findings_become_one_with_the_worst() {
        let program = empty();
        let mut log = Log::default();
        log.add(&program, finding(1, "a"), Some(merge(1, 1.0, 1)), 1);
        log.add(&program, finding(2, "b"), Some(merge(1, 3.0, 1)), 2);
        log.add(&program, finding(3, "c"), Some(merge(1, 2.0, 1)), 3);
        let found = log.finish(&program);
        assert_eq!(found.len(), 1);
        assert_eq!((found[0].count, found[0].range.start, found[0].last.start), (3, 10, 30));
        assert_eq!(found[0].message, "b");
        assert_eq!(found[0].related[0].0.start, 20);
    }

    #[test]
    fn a_gap_or_another_axis_starts_anew() {
        let program = empty();
        let mut log = Log::default();
        log.add(&program, finding(1, "a"), Some(merge(1, 1.0, 1)), 1);
        log.add(&program, finding(2, "b"), Some(merge(2, 1.0, 1)), 2);
        log.add(&program, finding(4, "c"), Some(merge(1, 1.0, 1)), 4);
        assert_eq!(log.finish(&program).len(), 3);
    }

    #[test]
    fn short_runs_are_shown_block_by_block() {
        let program = empty();
        let mut log = Log::default();
        for at in 1..=8 {
            log.add(&program, finding(at, "a"), Some(merge(1, 1.0, 8)), u64::from(at));
        }
        assert_eq!(log.finish(&program).len(), 8);
        let program = empty();
        let mut log = Log::default();
        for at in 1..=9 {
            log.add(
                &program,
                finding(at, "a"),
                Some(merge(1, f64::from(at), 8)),
                u64::from(at),
            );
        }
        let found = log.finish(&program);
        assert_eq!((found.len(), found[0].count, found[0].related[0].0.start), (1, 9, 90));
    }

    #[test]
    fn events_are_never_merged() {
        let program = empty();
        let mut log = Log::default();
        log.add(&program, finding(1, "a"), None, 1);
        log.add(&program, finding(2, "b"), None, 2);
        assert_eq!(log.finish(&program).len(), 2);
    }

    #[test]
    fn what_is_counted_without_words_moves_the_end() {
        let program = parse(b"G0 X0\nX1\nX2\nX3\n".to_vec(), LexOptions::default());
        let mut log = Log::default();
        log.add(&program, finding(0, "a"), Some(merge(1, 5.0, 1)), 1);
        let repeat = |badness, severity, sequence| Repeat {
            rule: "axis-limit",
            key: 1,
            badness,
            severity,
            status: Status::Fail,
            block: BlockId(2),
            sequence,
        };
        assert!(!log.absorb(repeat(6.0, Severity::Error, 2)), "worse must be worded");
        assert!(!log.absorb(repeat(4.0, Severity::Error, 3)), "not consecutive");
        assert!(log.absorb(repeat(4.0, Severity::Error, 2)));
        assert!(log.absorb(repeat(4.0, Severity::Warning, 3)));
        let found = log.finish(&program);
        assert_eq!((found.len(), found[0].count), (1, 3));
        assert_eq!(found[0].last, TextRange::new(9, 11));
    }

    #[test]
    fn a_file_of_noise_is_not_listed_to_its_end() {
        let program = empty();
        let mut log = Log::default();
        for at in 0..LISTED + 5 {
            log.add(&program, finding(at, "a"), None, u64::from(at));
        }
        let found = log.finish(&program);
        assert_eq!(found.len(), LISTED as usize + 1);
        let rest = &found[LISTED as usize];
        assert_eq!(rest.count, 5);
        assert!(rest.message.starts_with("5 more findings"), "{}", rest.message);
    }
}
