//! Merging: the same finding in consecutive blocks becomes one diagnostic at the first of them, with the worst values.
use crate::again::Passes;
use crate::open::{Open, Place};
use crate::place::code_range;
use crate::trail::Trail;
use crate::view::LegView;
use crate::{Diagnostic, Severity, Status};
use std::collections::BTreeMap;
use trunnion_interp::{ChainId, Frame};
use trunnion_machine::Leg;
use trunnion_syntax::{BlockId, Program, TextRange};

/// Runs of findings that differ in their numbers are reported block by block up to this many blocks.
pub(crate) const SHORT_RUN: usize = 8;

/// Of one rule at most this many diagnostics are listed per file; one more counts the rest, so that a file of noise cannot
/// fill the memory.
const LISTED: u32 = 10_000;

/// How findings of one rule are put together. Findings that are events (`pole-flip`) have none and are never merged.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Merge {
    /// What must agree apart from the rule: an axis letter, a text's hash, or 0.
    pub(crate) key: u64,
    /// How bad: message and values of the largest are kept.
    pub(crate) badness: f64,
    /// Runs up to this many blocks are reported block by block.
    pub(crate) show: usize,
    /// Merges over gaps too: a cause that is reported once in the whole program.
    pub(crate) everywhere: bool,
}

impl Merge {
    /// In consecutive blocks the finding is reported once; `key` must agree (an axis letter, or 0), the largest `badness` is kept.
    pub(crate) const fn run(key: u64, badness: f64) -> Self {
        Self {
            key,
            badness,
            show: 1,
            everywhere: false,
        }
    }

    /// As [`Self::run`], but short runs are reported block by block.
    pub(crate) const fn runs(key: u64, badness: f64) -> Self {
        Self {
            show: SHORT_RUN,
            ..Self::run(key, badness)
        }
    }

    /// The finding is reported once in the whole program, at its first place; `key` must agree.
    pub(crate) const fn once(key: u64) -> Self {
        Self {
            everywhere: true,
            ..Self::run(key, 0.0)
        }
    }
}

/// A run of findings that may still grow.
struct Run {
    show: usize,
    everywhere: bool,
    /// Counter of the last motion in it.
    sequence: u64,
    /// The block of that motion.
    block: Option<BlockId>,
    /// Findings with their badness; one for all blocks once `merged`.
    items: Vec<(f64, Diagnostic)>,
    merged: bool,
    /// Where the worst one is, once merged.
    worst: TextRange,
    /// The last block, where it was only counted.
    last: Option<BlockId>,
    /// The worst leg, where it is not worded yet.
    unworded: Option<Box<Kept>>,
    /// A run of a later pass: it is counted at the first report and has no items.
    later: Option<u32>,
}

/// A leg whose message is written once its run has ended: most blocks of a long run are not the worst of it.
pub(crate) struct Kept {
    pub(crate) leg: Leg,
    pub(crate) posture_before: i8,
    pub(crate) trail: Trail,
}

/// A run that has ended and has no message yet.
pub(crate) struct PendingRun {
    pub(crate) rule: &'static str,
    pub(crate) key: u64,
    pub(crate) status: Status,
    pub(crate) kept: Box<Kept>,
    run: Run,
}

/// A finding without a message yet, because its run may get worse.
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
    open: Open<Run>,
    closed: Vec<Diagnostic>,
    ended: Vec<PendingRun>,
    /// Per rule: how many are listed, and the rest.
    listed: BTreeMap<&'static str, (u32, Option<Diagnostic>)>,
    passes: Passes,
    /// The current block ran before.
    pub(crate) again: bool,
    /// The current block: most findings are in it.
    pub(crate) near: BlockId,
}

impl Log {
    /// Adds a finding. `sequence` counts motions: a run continues while it grows by one at most, and in one block that makes many (a pecking cycle).
    pub(crate) fn add(&mut self, program: &Program, diagnostic: Diagnostic, merge: Option<Merge>, sequence: u64) {
        let Some(merge) = merge else {
            self.add_event(diagnostic);
            return;
        };
        let place = (diagnostic.rule, merge.key, diagnostic.status == Status::Unknown);
        let block = program.block_near(diagnostic.range.start, self.near);
        let again = self.again;
        let same_block = |run: &Run| !again && block.is_some() && run.block == block;
        if let Some(run) = self.open.get_mut(&place)
            && (merge.everywhere || sequence <= run.sequence + 1 || same_block(run))
        {
            run.block = block;
            match run.later {
                Some(slot) => {
                    run.sequence = sequence;
                    self.passes.add(slot, diagnostic);
                }
                None => run.extend(diagnostic, merge, sequence, &mut self.passes),
            }
            return;
        }
        let worst = diagnostic.range;
        let mut run = Run {
            show: merge.show,
            everywhere: merge.everywhere,
            sequence,
            block,
            items: Vec::new(),
            merged: false,
            worst,
            last: None,
            unworded: None,
            later: None,
        };
        if let Some(slot) = self.reported_before(&diagnostic, merge.key) {
            self.passes.add(slot, diagnostic);
            run.later = Some(slot);
        } else {
            let Some(mut diagnostic) = self.list(diagnostic) else {
                return;
            };
            self.passes.told(&mut diagnostic, merge.key);
            run.items.push((merge.badness, diagnostic));
        }
        if let Some(ended) = self.open.insert(place, run) {
            self.close(place, ended, program);
        }
    }

    /// Adds a finding that is never merged with others.
    fn add_event(&mut self, diagnostic: Diagnostic) {
        if let Some(slot) = self.reported_before(&diagnostic, 0) {
            self.passes.add(slot, diagnostic);
        } else if let Some(mut diagnostic) = self.list(diagnostic) {
            self.passes.told(&mut diagnostic, 0);
            self.closed.push(diagnostic);
        }
    }

    /// In a later pass: the counter of the finding that an earlier pass reported at this place.
    fn reported_before(&self, diagnostic: &Diagnostic, key: u64) -> Option<u32> {
        if self.again {
            self.passes.find(diagnostic, key)
        } else {
            None
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

    /// Counts a finding without writing its message: true if its run is merged already. Where it is the worst so far its leg is kept.
    pub(crate) fn absorb(&mut self, repeat: Repeat, view: &LegView<'_>) -> bool {
        let place = (repeat.rule, repeat.key, repeat.status == Status::Unknown);
        let Some(run) = self.open.get_mut(&place) else {
            return false;
        };
        let continues = repeat.sequence <= run.sequence + 1 || !self.again && run.block == Some(repeat.block);
        if !(run.everywhere || continues) || !(run.merged || run.show == 1) {
            return false;
        }
        run.block = Some(repeat.block);
        if let Some(slot) = run.later {
            run.sequence = repeat.sequence;
            return self.passes.count(slot, repeat.severity);
        }
        let [(badness, whole)] = run.items.as_mut_slice() else {
            return false;
        };
        if repeat.badness > *badness {
            *badness = repeat.badness;
            match &mut run.unworded {
                Some(kept) => {
                    kept.leg.copy_from(view.leg);
                    (kept.posture_before, kept.trail) = (view.posture_before, *view.trail);
                }
                None => {
                    run.unworded = Some(Box::new(Kept {
                        leg: view.leg.clone(),
                        posture_before: view.posture_before,
                        trail: *view.trail,
                    }));
                }
            }
        }
        whole.severity = whole.severity.max(repeat.severity);
        whole.count += 1;
        run.sequence = repeat.sequence;
        run.last = Some(repeat.block);
        true
    }

    /// Counts a cause that is reported once ([`Merge::once`]), of unknown status: true if it was reported.
    pub(crate) fn repeat(&mut self, (rule, key): (&'static str, u64), block: BlockId, range: TextRange) -> bool {
        let Some(run) = self.open.get_mut(&(rule, key, true)) else {
            return false;
        };
        let [(_, whole)] = run.items.as_mut_slice() else {
            return false;
        };
        if !run.everywhere || run.later.is_some() {
            return false;
        }
        whole.count += 1;
        whole.last = range;
        (run.merged, run.last, run.block) = (true, None, Some(block));
        true
    }

    fn close(&mut self, place: Place, mut run: Run, program: &Program) {
        match run.unworded.take() {
            Some(kept) => {
                let status = if place.2 { Status::Unknown } else { Status::Fail };
                self.ended.push(PendingRun {
                    rule: place.0,
                    key: place.1,
                    status,
                    kept,
                    run,
                });
            }
            None => run.close(program, &mut self.closed),
        }
    }

    /// Ends all runs; those without a message are handed out, and come back through [`Self::worded`].
    pub(crate) fn end(&mut self, program: &Program) -> Vec<PendingRun> {
        for (place, run) in self.open.take() {
            self.close(place, run, program);
        }
        core::mem::take(&mut self.ended)
    }

    /// Takes the message of a run's worst leg.
    pub(crate) fn worded(&mut self, unworded: PendingRun, words: Option<Diagnostic>, program: &Program) {
        let mut run = unworded.run;
        if let (Some(words), [(_, whole)]) = (words, run.items.as_mut_slice()) {
            run.worst = words.range;
            whole.take_words(words);
        }
        run.close(program, &mut self.closed);
    }

    /// All diagnostics, sorted by place, then rule; `chain` returns the calls of a chain.
    pub(crate) fn finish(mut self, program: &Program, chain: &dyn Fn(ChainId) -> Vec<Frame>) -> Vec<Diagnostic> {
        for unworded in self.end(program) {
            self.worded(unworded, None, program);
        }
        for diagnostic in &mut self.closed {
            self.passes.complete(diagnostic, chain);
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

impl Diagnostic {
    /// Takes the message of `worse`; place, count and severity stay.
    pub(crate) fn take_words(&mut self, worse: Self) {
        self.message = worse.message;
        self.notes = worse.notes;
        self.help = worse.help;
        self.values = worse.values;
        self.take_fixes(worse.fixes);
    }

    fn take_fixes(&mut self, fixes: Vec<&'static str>) {
        for fix in fixes {
            if !self.fixes.contains(&fix) {
                self.fixes.push(fix);
            }
        }
    }
}

impl Run {
    fn extend(&mut self, mut diagnostic: Diagnostic, merge: Merge, sequence: u64, passes: &mut Passes) {
        self.sequence = sequence;
        self.last = None;
        if !self.merged && self.items.len() < self.show {
            // it may stay single
            passes.told(&mut diagnostic, merge.key);
        }
        self.items.push((merge.badness, diagnostic));
        if self.merged || self.items.len() > self.show {
            self.merged = true;
            let mut items = self.items.drain(..);
            let Some((mut badness, mut whole)) = items.next() else {
                return;
            };
            for (other, next) in items {
                whole.count += next.count;
                whole.last = next.last;
                whole.severity = whole.severity.max(next.severity);
                if other > badness {
                    badness = other;
                    self.worst = next.range;
                    self.unworded = None;
                    whole.take_words(next);
                } else {
                    whole.take_fixes(next.fixes);
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
mod tests;
