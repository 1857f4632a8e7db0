//! Where rules report to: wording is theirs; levels, suppression, block numbers and merging are done here.
use crate::diagnostic::Origin;
use crate::needs::Needs;
use crate::rule::LegRule;
use crate::runs::{Log, Merge, Repeat};
use crate::suppress::Suppressions;
use crate::view::LegView;
use crate::{Diagnostic, RuleLevel, Severity, Status, ValueKey};
use trunnion_interp::{ChainId, Frame};
use trunnion_machine::Machine;
use trunnion_syntax::{BlockId, Program, TextRange};

/// A rule in the list with the level the settings give it.
#[derive(Clone, Copy)]
pub(crate) struct Active<F> {
    pub(crate) name: &'static str,
    pub(crate) severity: Severity,
    /// Severity of every finding of the rule, if the settings name one.
    pub(crate) level: Option<Severity>,
    pub(crate) run: F,
}

impl<F> Active<F> {
    /// The same with something else to run.
    pub(crate) fn with<G>(&self, run: G) -> Active<G> {
        Active {
            name: self.name,
            severity: self.severity,
            level: self.level,
            run,
        }
    }
}

/// Collects findings of rules.
pub struct Reporter<'a> {
    program: &'a Program,
    dialect: &'a str,
    suppressions: &'a Suppressions,
    log: Log,
    /// Of the rule that runs now.
    name: &'static str,
    severity: Severity,
    level: Option<Severity>,
    /// The block it looks at; `None`: the block of what it reports.
    block: Option<BlockId>,
    sequence: u64,
    /// The calls in which the block in hand runs.
    chain: ChainId,
    pending: Vec<Draft>,
    told: Vec<(&'static str, u64)>,
    /// A rule words a leg it has found before.
    wording: bool,
    /// The running rule has reported or counted something.
    spoke: bool,
}

/// A finding while its rule still words it.
pub struct Draft {
    diagnostic: Diagnostic,
    merge: Option<Merge>,
}

impl<'a> Reporter<'a> {
    pub(crate) fn new(program: &'a Program, dialect: &'a str, suppressions: &'a Suppressions) -> Self {
        Self {
            program,
            dialect,
            suppressions,
            log: Log::default(),
            name: "",
            severity: Severity::Error,
            level: None,
            block: None,
            sequence: 0,
            chain: ChainId::MAIN,
            pending: Vec::new(),
            told: Vec::new(),
            wording: false,
            spoke: false,
        }
    }

    /// The program that is checked.
    pub fn program(&self) -> &'a Program {
        self.program
    }

    /// The name of the dialect the program is read in.
    pub fn dialect(&self) -> &'a str {
        self.dialect
    }

    /// The text of a range to be quoted: its first 40 characters, and `...` where there are more.
    pub fn text(&self, range: TextRange) -> String {
        const MOST: usize = 40;
        // a character has at most 4 bytes; one that is cut at the end is after the last one shown
        let some = TextRange::new(
            range.start,
            range.end.min(range.start.saturating_add(4 * MOST as u32 + 4)),
        );
        let text = self.program.text(some);
        match text.char_indices().nth(MOST) {
            Some((end, _)) => format!("{}...", &text[..end]),
            None => text.into_owned(),
        }
    }

    /// Starts a finding; the message says what is wrong, in one sentence with numbers and units.
    pub fn report(&mut self, range: TextRange, message: impl Into<String>) -> &mut Draft {
        self.spoke = true;
        let range = self.inside(range);
        let diagnostic = Diagnostic {
            rule: self.name,
            severity: self.severity,
            status: Status::Fail,
            range,
            block: None,
            message: message.into(),
            notes: Vec::new(),
            help: None,
            values: Vec::new(),
            fixes: Vec::new(),
            related: Vec::new(),
            count: 1,
            last: range,
            origin: Origin {
                chain: self.chain,
                later: None,
            },
        };
        self.pending.push(Draft {
            diagnostic,
            merge: None,
        });
        let last = self.pending.len() - 1;
        &mut self.pending[last]
    }

    /// True where consecutive blocks have this finding already: it is counted, and worded later should it stay the worst.
    /// `key` and `badness` as in [`Draft::merge`].
    pub fn repeats(&mut self, view: &LegView<'_>, key: u64, badness: f64) -> bool {
        self.repeats_as(self.severity, view, key, badness)
    }

    /// As [`Self::repeats`], for a finding with another severity than the rule's own.
    pub fn repeats_as(&mut self, severity: Severity, view: &LegView<'_>, key: u64, badness: f64) -> bool {
        self.absorb(self.level.unwrap_or(severity), Status::Fail, view, key, badness)
    }

    /// As [`Self::repeats`], for a finding that could not be decided.
    pub fn repeats_unknown(&mut self, view: &LegView<'_>, key: u64, badness: f64) -> bool {
        self.absorb(Severity::Info, Status::Unknown, view, key, badness)
    }

    fn absorb(&mut self, severity: Severity, status: Status, view: &LegView<'_>, key: u64, badness: f64) -> bool {
        let Some(block) = self.block else { return false };
        let rule = self.name;
        let repeat = Repeat {
            rule,
            key,
            badness,
            severity,
            status,
            block,
            sequence: self.sequence,
        };
        let absorbed = !self.wording && !self.suppressions.allows(rule, block) && self.log.absorb(repeat, view);
        self.spoke |= absorbed;
        absorbed
    }

    /// Words the worst legs of runs that only kept them.
    pub(crate) fn word_worst(&mut self, machine: &Machine, rules: &[Active<(Needs, LegRule)>]) {
        for unworded in self.log.end(self.program) {
            let kept = &unworded.kept;
            let mut words = None;
            if let Some(rule) = rules.iter().find(|rule| rule.name == unworded.rule) {
                let view = LegView::new(machine, &kept.leg, kept.posture_before, &kept.trail);
                self.enter(rule, Some(kept.leg.motion.block), 0);
                self.wording = true;
                (rule.run.1)(&view, self);
                self.wording = false;
                let mut drafts = self.pending.drain(..);
                let own = |draft: &Draft| {
                    draft.diagnostic.status == unworded.status
                        && draft.merge.is_some_and(|merge| merge.key == unworded.key)
                };
                words = drafts.find(own).map(|draft| draft.diagnostic);
            }
            self.log.worded(unworded, words, self.program);
        }
    }

    /// True the first time the running rule asks for `cause`, so that one cause is reported once.
    pub fn once(&mut self, cause: u64) -> bool {
        // causes differ more often than rules do, and are compared faster
        let known = |told: &(&'static str, u64)| told.1 == cause && told.0 == self.name;
        let first = !self.told.iter().any(known);
        if first {
            self.told.push((self.name, cause));
        }
        first
    }

    /// Names the rule that runs next and the block it looks at. `sequence` counts blocks for merging.
    #[inline]
    pub(crate) fn enter<F>(&mut self, rule: &Active<F>, block: Option<BlockId>, sequence: u64) {
        self.name = rule.name;
        self.severity = rule.severity;
        self.level = rule.level;
        self.block = block;
        self.sequence = sequence;
        self.spoke = false;
    }

    /// How the run came to what the rules see next: whether its block ran `again`, and in which calls.
    pub(crate) fn origin(&mut self, again: bool, chain: ChainId) {
        self.log.again = again;
        self.chain = chain;
    }

    /// Whether the running rule has reported nothing and counted nothing.
    pub(crate) fn is_silent(&self) -> bool {
        !self.spoke
    }

    /// Takes what the rule reported.
    #[inline]
    pub(crate) fn leave(&mut self) {
        if !self.pending.is_empty() {
            self.take_pending();
        }
    }

    fn take_pending(&mut self) {
        let program = self.program;
        for Draft { mut diagnostic, merge } in self.pending.drain(..) {
            let block = self
                .block
                .or_else(|| program.block_at(diagnostic.range.start))
                .unwrap_or_default();
            if self.suppressions.allows(diagnostic.rule, block) {
                continue;
            }
            if let Some(level) = self.level
                && diagnostic.status == Status::Fail
            {
                diagnostic.severity = level;
            }
            if (block.0 as usize) < program.block_count() {
                diagnostic.block = program
                    .block(block)
                    .number()
                    .map(|range| program.text(range).into_owned());
            }
            self.log.add(program, diagnostic, merge, self.sequence);
        }
    }

    /// All findings; `chain` returns the calls of a chain.
    pub(crate) fn finish(self, chain: &dyn Fn(ChainId) -> Vec<Frame>) -> Vec<Diagnostic> {
        self.log.finish(self.program, chain)
    }

    fn inside(&self, range: TextRange) -> TextRange {
        let end = self.program.source().len() as u32;
        let start = range.start.min(end);
        TextRange::new(start, range.end.clamp(start, end))
    }
}

impl Draft {
    /// Why it matters, or more numbers.
    pub fn note(&mut self, note: impl Into<String>) -> &mut Self {
        self.diagnostic.notes.push(note.into());
        self
    }

    /// Says it in other words.
    pub(crate) fn reword(&mut self, message: impl Into<String>) -> &mut Self {
        self.diagnostic.message = message.into();
        self
    }

    /// What to do.
    pub fn help(&mut self, help: impl Into<String>) -> &mut Self {
        self.diagnostic.help = Some(help.into());
        self
    }

    /// A number of the message; the key ends in its unit.
    pub fn value(&mut self, key: &'static str, value: f64) -> &mut Self {
        self.diagnostic.values.push((key, ValueKey::Number(value)));
        self
    }

    /// A text of the message, such as an axis letter.
    pub fn value_text(&mut self, key: &'static str, value: impl Into<String>) -> &mut Self {
        self.diagnostic.values.push((key, ValueKey::Text(value.into())));
        self
    }

    /// Another severity than the rule's own.
    pub fn severity(&mut self, severity: Severity) -> &mut Self {
        self.diagnostic.severity = severity;
        self
    }

    /// The rule could not decide; the message says what is missing.
    pub fn unknown(&mut self) -> &mut Self {
        self.diagnostic.status = Status::Unknown;
        self.diagnostic.severity = Severity::Info;
        self
    }

    /// A rewrite that may cure it.
    pub fn fix(&mut self, rewrite: &'static str) -> &mut Self {
        self.diagnostic.fixes.push(rewrite);
        self
    }

    /// Another place of interest.
    pub fn related(&mut self, range: TextRange, message: impl Into<String>) -> &mut Self {
        self.diagnostic.related.push((range, message.into()));
        self
    }

    /// In consecutive blocks the finding is reported once; `key` must agree (an axis letter, or 0), the largest `badness` is kept.
    pub fn merge(&mut self, key: u64, badness: f64) -> &mut Self {
        self.merge = Some(Merge {
            key,
            badness,
            show: 1,
            everywhere: false,
        });
        self
    }

    /// The finding is reported once in the whole program, at its first place; `key` must agree.
    pub fn merge_everywhere(&mut self, key: u64) -> &mut Self {
        self.merge = Some(Merge {
            key,
            badness: 0.0,
            show: 1,
            everywhere: true,
        });
        self
    }

    /// As [`Self::merge`], but runs of up to `show` blocks are reported block by block.
    pub fn merge_runs_over(&mut self, show: usize, key: u64, badness: f64) -> &mut Self {
        self.merge = Some(Merge {
            key,
            badness,
            show,
            everywhere: false,
        });
        self
    }
}

/// The rules of one level that are not allowed everywhere, with their levels. The last entry for a name wins.
pub(crate) fn active<F: Copy>(
    levels: &[(String, RuleLevel)],
    pick: impl Fn(crate::Level) -> Option<F>,
) -> Vec<Active<F>> {
    let mut out = Vec::new();
    for rule in crate::rules() {
        let Some(run) = pick(rule.level) else { continue };
        let level = levels
            .iter()
            .rev()
            .find(|(name, _)| name == rule.name)
            .map(|(_, level)| *level);
        let level = match level {
            Some(RuleLevel::Allow) => continue,
            Some(RuleLevel::At(severity)) => Some(severity),
            None => None,
        };
        out.push(Active {
            name: rule.name,
            severity: rule.severity,
            level,
            run,
        });
    }
    out
}
