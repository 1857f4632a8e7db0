//! Merging: the same finding in consecutive blocks becomes one diagnostic at the first of them, with the worst values.
use crate::{Diagnostic, Status};
use std::collections::BTreeMap;
use trunnion_syntax::TextRange;

/// Runs of findings that differ in their numbers are reported block by block up to this many blocks.
pub(crate) const SHORT_RUN: usize = 8;

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
    /// Counter of the last block in it.
    sequence: u64,
    /// Findings with their badness; one for all blocks once `merged`.
    items: Vec<(f64, Diagnostic)>,
    merged: bool,
    /// Where the worst lies, once merged.
    worst: TextRange,
}

/// Collects diagnostics and merges runs.
#[derive(Default)]
pub(crate) struct Log {
    /// By rule, key and whether it is unknown.
    open: BTreeMap<(&'static str, u64, bool), Run>,
    closed: Vec<Diagnostic>,
}

impl Log {
    /// Adds a finding. `sequence` counts blocks: a run goes on while it grows by one at most.
    pub(crate) fn add(&mut self, diagnostic: Diagnostic, merge: Option<Merge>, sequence: u64) {
        let Some(merge) = merge else {
            self.closed.push(diagnostic);
            return;
        };
        let place = (diagnostic.rule, merge.key, diagnostic.status == Status::Unknown);
        if let Some(run) = self.open.get_mut(&place)
            && (merge.everywhere || sequence <= run.sequence + 1)
        {
            run.extend(diagnostic, merge.badness, sequence);
            return;
        }
        let worst = diagnostic.range;
        let items = vec![(merge.badness, diagnostic)];
        if let Some(ended) = self.open.insert(
            place,
            Run {
                show: merge.show,
                sequence,
                items,
                merged: false,
                worst,
            },
        ) {
            ended.close(&mut self.closed);
        }
    }

    /// All diagnostics, sorted by place, then rule.
    pub(crate) fn finish(mut self) -> Vec<Diagnostic> {
        for run in self.open.into_values() {
            run.close(&mut self.closed);
        }
        self.closed
            .sort_by(|a, b| (a.range, a.rule, &a.message).cmp(&(b.range, b.rule, &b.message)));
        self.closed
    }
}

impl Run {
    fn extend(&mut self, diagnostic: Diagnostic, badness: f64, sequence: u64) {
        self.sequence = sequence;
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

    fn close(mut self, out: &mut Vec<Diagnostic>) {
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
    use crate::Severity;

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
        let mut log = Log::default();
        log.add(finding(1, "a"), Some(merge(1, 1.0, 1)), 1);
        log.add(finding(2, "b"), Some(merge(1, 3.0, 1)), 2);
        log.add(finding(3, "c"), Some(merge(1, 2.0, 1)), 3);
        let found = log.finish();
        assert_eq!(found.len(), 1);
        assert_eq!((found[0].count, found[0].range.start, found[0].last.start), (3, 10, 30));
        assert_eq!(found[0].message, "b");
        assert_eq!(found[0].related[0].0.start, 20);
    }

    #[test]
    fn a_gap_or_another_axis_starts_anew() {
        let mut log = Log::default();
        log.add(finding(1, "a"), Some(merge(1, 1.0, 1)), 1);
        log.add(finding(2, "b"), Some(merge(2, 1.0, 1)), 2);
        log.add(finding(4, "c"), Some(merge(1, 1.0, 1)), 4);
        assert_eq!(log.finish().len(), 3);
    }

    #[test]
    fn short_runs_are_shown_block_by_block() {
        let mut log = Log::default();
        for at in 1..=8 {
            log.add(finding(at, "a"), Some(merge(1, 1.0, 8)), u64::from(at));
        }
        assert_eq!(log.finish().len(), 8);
        let mut log = Log::default();
        for at in 1..=9 {
            log.add(finding(at, "a"), Some(merge(1, f64::from(at), 8)), u64::from(at));
        }
        let found = log.finish();
        assert_eq!((found.len(), found[0].count, found[0].related[0].0.start), (1, 9, 90));
    }

    #[test]
    fn events_are_never_merged() {
        let mut log = Log::default();
        log.add(finding(1, "a"), None, 1);
        log.add(finding(2, "b"), None, 2);
        assert_eq!(log.finish().len(), 2);
    }
}
