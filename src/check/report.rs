//! What a check found, as plain data: findings, counts and the verdict.
use crate::coverage::Coverage;
use crate::{Diagnostic, Severity, Status};
use trunnion_syntax::Program;

/// The verdict on a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Nothing at or above the level that is denied, nothing unknown.
    Pass,
    /// Some finding at or above the level that is denied.
    Fail,
    /// No such finding, but something could not be decided.
    Unknown,
}

impl Verdict {
    /// `pass`, `fail` or `unknown`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Pass => "pass",
            Self::Fail => "fail",
            Self::Unknown => "unknown",
        }
    }
}

/// Counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Summary {
    /// Blocks with content (not empty lines, not lines of comments only) in the file, each once.
    pub blocks: u64,
    /// Motions, as often as they are run.
    pub motions: u64,
    /// Errors.
    pub errors: u64,
    /// Warnings.
    pub warnings: u64,
    /// Infos with status fail.
    pub infos: u64,
    /// Diagnostics with status unknown.
    pub unknown: u64,
}

impl Summary {
    /// Counts these findings in place of those that were counted.
    pub(crate) fn recount(&mut self, diagnostics: &[Diagnostic]) {
        *self = Self {
            blocks: self.blocks,
            motions: self.motions,
            ..Self::default()
        };
        self.count(diagnostics);
    }

    /// Counts findings by status and severity.
    pub(crate) fn count(&mut self, diagnostics: &[Diagnostic]) {
        for diagnostic in diagnostics {
            let count = match (diagnostic.status, diagnostic.severity) {
                (Status::Unknown, _) => &mut self.unknown,
                (Status::Fail, Severity::Error) => &mut self.errors,
                (Status::Fail, Severity::Warning) => &mut self.warnings,
                (Status::Fail, Severity::Info) => &mut self.infos,
            };
            *count += 1;
        }
    }
}

/// What a check found.
#[derive(Clone, Debug, Default)]
pub struct Report {
    /// Sorted by place; in a block errors of its text come first.
    pub diagnostics: Vec<Diagnostic>,
    /// Counts.
    pub summary: Summary,
    /// Lowest and highest time the program takes from its first known position on, s. Lowest: no axis needs time to
    /// accelerate. Highest: the machine stops after every block and accelerates no faster than its machine file declares.
    /// `None`: some time is not known (no machine, no feed, a dwell in turns, an acceleration that is not declared).
    pub cycle_time_s: Option<[f64; 2]>,
    /// What part of the program was checked.
    pub coverage: Coverage,
    /// Undeclared values that were assumed, in words: `G54 = 0 (not declared)`. In the order in which the program needs it.
    pub assumptions: Vec<String>,
}

impl Report {
    /// Puts what is wrong in the text of a block before what follows from it: a word that is no number leaves its axis unknown, and that is
    /// reported further left.
    pub(crate) fn causes_first(&mut self, program: &Program) {
        let is_text = |found: &Diagnostic| {
            let fails = found.status == Status::Fail && found.severity == Severity::Error;
            fails && crate::rule(found.rule).is_some_and(|rule| rule.level() == "text")
        };
        if self.diagnostics.iter().any(is_text) {
            self.diagnostics
                .sort_by_cached_key(|found| (program.block_at(found.range.start), !is_text(found)));
        }
    }

    /// All findings: those of the list, each followed by the ones that it leads.
    pub fn findings(&self) -> impl Iterator<Item = &Diagnostic> {
        let list = self.diagnostics.iter();
        list.flat_map(|found| core::iter::once(found).chain(&found.also))
    }

    /// Takes the findings out that `accepted` names, in the order of the list, and counts the rest anew.
    pub fn take_out(&mut self, mut accepted: impl FnMut(&Diagnostic) -> bool) -> Vec<Diagnostic> {
        let all = core::mem::take(&mut self.diagnostics);
        let (out, rest) = all.into_iter().partition(|found| accepted(found));
        self.diagnostics = rest;
        if !Vec::is_empty(&out) {
            let rest = core::mem::take(&mut self.diagnostics);
            self.summary.recount(&rest);
            self.diagnostics = rest;
        }
        out
    }

    /// The verdict when findings at or above `deny` count as failures.
    pub fn verdict(&self, deny: Severity) -> Verdict {
        let denied = |d: &Diagnostic| d.status == Status::Fail && d.severity >= deny;
        if self.diagnostics.iter().any(denied) {
            Verdict::Fail
        } else if self.summary.unknown > 0 {
            Verdict::Unknown
        } else {
            Verdict::Pass
        }
    }
}
