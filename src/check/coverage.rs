//! What part of a program was checked: which blocks ran, how many motions, and what was left out and why.
mod moves;
mod sections;
mod tally;

use crate::program_bounds::is_end;
use crate::sink::{Reporter, active};
use crate::suppress::{Suppressions, has_code};
use crate::visited::Visited;
use crate::wake::Wake;
use crate::{Diagnostic, Report, Settings};
use moves::moves;
use sections::Sections;
pub(crate) use sections::{Mark, mark};
pub(crate) use tally::Tally;
use trunnion_dialect::Dialect;
use trunnion_interp::{directives, slash};
use trunnion_syntax::{Block, BlockId, Program};

/// Why blocks did not run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotRunReason {
    /// They come before the first `%`, and the control skips them.
    BeforeStart,
    /// They belong to a subprogram that nothing calls.
    SubprogramNotCalled,
    /// They come after the end of the program.
    AfterEnd,
    /// A jump or a branch skips them.
    JumpedOver,
    /// They begin with `/`, and the settings say that such blocks are skipped.
    BlockDelete,
    /// The run could not be followed that far.
    GivenUp,
}

impl NotRunReason {
    /// As reports spell it: `subprogram-not-called`.
    pub fn name(self) -> &'static str {
        match self {
            Self::BeforeStart => "before-start",
            Self::SubprogramNotCalled => "subprogram-not-called",
            Self::AfterEnd => "after-end",
            Self::JumpedOver => "jumped-over",
            Self::BlockDelete => "block-delete",
            Self::GivenUp => "given-up",
        }
    }
    /// For people: completes "lines 3 to 9 did not run: ...".
    pub(crate) fn because(self) -> &'static str {
        match self {
            Self::BeforeStart => "they come before the first `%`",
            Self::SubprogramNotCalled => "nothing in this file calls their subprogram",
            Self::AfterEnd => "they come after the end of the program",
            Self::JumpedOver => "a jump or branch skips them",
            Self::BlockDelete => "block delete skips them",
            Self::GivenUp => "the run could not be followed that far",
        }
    }
}

/// Consecutive blocks that did not run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotRun {
    /// The first.
    pub first: BlockId,
    /// The last.
    pub last: BlockId,
    /// Why.
    pub reason: NotRunReason,
    /// Some of them would move the machine.
    pub moves: bool,
}

/// A rule that judged nothing, because the machine file does not declare what it needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotJudged {
    /// Its name.
    pub rule: &'static str,
    /// What the machine file would have to declare.
    pub needs: &'static str,
}

/// Where a run was stopped.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct GivenUp {
    /// The block.
    pub block: BlockId,
    /// The rule that says why: `not-decided`.
    pub reason: &'static str,
}

/// What part of a program was checked.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Coverage {
    /// Blocks with content in the file, each once.
    pub blocks: u64,
    /// Those of them that ran at least once.
    pub blocks_run: u64,
    /// Motions, as often as they are run; dwells are motions.
    pub motions: u64,
    /// Motions whose end is known.
    pub motions_known: u64,
    /// Motions that move something: all but dwells.
    pub travels: u64,
    /// Blocks with content that did not run.
    pub not_run: Vec<NotRun>,
    /// Rules that judged nothing on this machine.
    pub not_judged: Vec<NotJudged>,
    /// Where the run was stopped.
    pub given_up: Option<GivenUp>,
    /// Motions by what is known of their ends.
    pub(crate) ends: tally::Ends,
    /// The blocks that ran.
    pub(crate) ran: Visited,
    /// The block that ran last.
    pub(crate) last: Option<BlockId>,
}

impl Coverage {
    /// Adds what another run of the same program covered (block delete in its other state).
    pub(crate) fn join(&mut self, other: &Self) {
        self.ran.join(&other.ran);
        self.last = self.last.max(other.last);
        self.travels = self.travels.min(other.travels);
        if self.given_up.is_none() {
            self.given_up.clone_from(&other.given_up);
        }
    }

    /// Parts that move the machine and were not checked, unless another finding gives the reason.
    pub(crate) fn gaps(&self) -> impl Iterator<Item = &NotRun> {
        // an alarm stops the program on purpose, but what follows it was not looked at all the same
        let alarm = self
            .given_up
            .as_ref()
            .is_some_and(|given_up| given_up.reason == "program-alarm");
        let explained = move |reason| match reason {
            NotRunReason::GivenUp => !alarm,
            reason => reason == NotRunReason::BlockDelete,
        };
        self.not_run
            .iter()
            .filter(move |part| part.moves && !explained(part.reason))
    }

    /// The text before the first `%`, which the control skips.
    pub(crate) fn leader(&self) -> Option<&NotRun> {
        self.not_run
            .first()
            .filter(|part| part.reason == NotRunReason::BeforeStart)
    }

    /// Works out which blocks did not run, once the run is over.
    pub(crate) fn complete(&mut self, program: &Program, dialect: &Dialect) {
        self.motions_known = self.ends.known(program);
        let ran = self.ran.clone();
        let with_code = || {
            (0..program.block_count() as u32)
                .map(BlockId)
                .filter(|&id| has_code(program, id))
                .filter(|&id| ran.has(id) || !is_end(&program.block(id), dialect))
        };
        let (mut blocks, mut run) = (0, 0);
        for id in with_code() {
            blocks += 1;
            run += u64::from(self.ran.has(id));
        }
        (self.blocks, self.blocks_run) = (blocks, run);
        if run == blocks {
            return;
        }
        let sections = Sections::of(program, dialect, &self.ran);
        let leader = trunnion_interp::leader(program, dialect);
        let mut open: Option<(NotRun, usize)> = None;
        for id in with_code() {
            if self.ran.has(id) {
                self.not_run.extend(open.take().map(|part| part.0));
                continue;
            }
            let block = program.block(id);
            let (section, called) = sections.at(id);
            let is_leader = id.0 < leader;
            let reason = if is_leader {
                NotRunReason::BeforeStart
            } else {
                self.reason(&block, dialect, called)
            };
            let moves = !is_leader && moves(&block, dialect);
            match &mut open {
                Some((part, of)) if *of == section && part.reason == reason => {
                    part.last = id;
                    part.moves |= moves;
                }
                _ => {
                    let part = NotRun {
                        first: id,
                        last: id,
                        reason,
                        moves,
                    };
                    self.not_run.extend(open.replace((part, section)).map(|part| part.0));
                }
            }
        }
        self.not_run.extend(open.map(|part| part.0));
    }

    fn reason(&self, block: &Block<'_>, dialect: &Dialect, called: bool) -> NotRunReason {
        let id = block.id();
        if !called {
            return NotRunReason::SubprogramNotCalled;
        }
        if self.given_up.as_ref().is_some_and(|given_up| id > given_up.block) {
            return NotRunReason::GivenUp;
        }
        if slash(block, dialect).is_some() {
            return NotRunReason::BlockDelete;
        }
        if self.last.is_none_or(|last| id > last) {
            return NotRunReason::AfterEnd;
        }
        NotRunReason::JumpedOver
    }
}

/// The rules that are in force and judge nothing on this machine.
pub(crate) fn not_judged(settings: &Settings<'_>) -> Vec<NotJudged> {
    let Some(machine) = settings.judged_machine() else {
        return Vec::new();
    };
    let mut active = active(&settings.rules);
    active.dedup_by_key(|entry| entry.name);
    let lacking = |name| Some((name, crate::rule(name)?.needs?(machine)?));
    let found = active.iter().filter_map(|entry| lacking(entry.name));
    found.map(|(rule, needs)| NotJudged { rule, needs }).collect()
}

/// Adds what the rules have to say about the parts of the program that did not run.
pub(crate) fn tell(program: &Program, settings: &Settings<'_>, report: &mut Report) {
    let coverage = &report.coverage;
    let has = |rule: &str| report.diagnostics.iter().any(|found| found.rule == rule);
    // a file without any block has its finding, and a run that was stopped has reported why
    let is_told = has("empty-program") || coverage.given_up.as_ref().is_some_and(|given_up| has(given_up.reason));
    let is_open =
        coverage.leader().is_some() || coverage.gaps().next().is_some() || (coverage.travels == 0 && !is_told);
    if !is_open || crate::unreadable::is_utf16(program.source()) {
        return;
    }
    let directives = directives(program);
    let suppressions = Suppressions::new(program, &directives);
    let mut found = findings(program, settings, &suppressions, coverage);
    report.summary.count(&found);
    report.diagnostics.append(&mut found);
    report
        .diagnostics
        .sort_by_key(|found| (found.range.start, found.range.end));
}

/// What the rules find in the part that was checked.
fn findings(
    program: &Program,
    settings: &Settings<'_>,
    suppressions: &Suppressions,
    coverage: &Coverage,
) -> Vec<Diagnostic> {
    let mut reporter = Reporter::new(program, settings.dialect, suppressions);
    crate::pass::ask(&active(&settings.rules), &mut reporter, (None, 0), |wake, out| {
        if let Wake::Coverage(rule) = wake {
            rule(coverage, out);
        }
    });
    reporter.finish(&|_| Vec::new())
}

#[cfg(test)]
mod tests {
    use crate::fixture::check_on;

    #[test]
    fn rules_without_data_are_named_until_the_machine_declares_it() {
        let lacking = |axis: &str, control: &str, extra: &str| -> Vec<&'static str> {
            let linear =
                ["X", "Y", "Z"].map(|letter| format!("{{letter=\"{letter}\", sign=1, dyn={{vmax=200{axis}}}}}"));
            let text = format!(
                "schema = \"ncmachine/1\"\naxis = [{extra}{}]\n[control]\nfamily = \"fanuc-30i\"\n{control}",
                linear.join(", ")
            );
            let machine = trunnion_machine::load("m", &text).expect("valid");
            let report = check_on(&machine, "fanuc-30i", "G21 G90 G94\nM30\n");
            report.coverage.not_judged.iter().map(|lacking| lacking.rule).collect()
        };
        let rotary = |uncertainty: &str| {
            format!(
                "{{letter=\"C\", kind=\"rotary\", sign=1, dir=[0,0,1], point=[0,0,0], side=\"table\"{uncertainty}}}, "
            )
        };
        assert_eq!(lacking("", "", ""), ["corner-error", "short-block-time"]);
        assert_eq!(lacking(", kv=20", "", ""), ["short-block-time"]);
        assert_eq!(lacking(", kv=20", "planner = { block_time = 0.001 }\n", ""), [""; 0]);
        let all = ["corner-error", "pivot-uncertainty", "short-block-time"];
        assert_eq!(lacking("", "", &rotary("")), all);
        assert_eq!(lacking("", "", &rotary(", uncertainty={point=0.01}")), [all[0], all[2]]);
    }
}
