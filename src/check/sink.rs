//! Where rules report to: they write the messages; levels, suppression, block numbers and merging are handled here.
use crate::caller::Part;
use crate::diagnostic::Origin;
use crate::finding::{Draft, within};
use crate::keyed::Keyed;
use crate::nearest::NearCodes;
use crate::runs::{Log, Merge, Repeat};
use crate::slip::bare_keyword;
use crate::suppress::Suppressions;
use crate::view::LegView;
use crate::wake::Wake;
use crate::words::hash;
use crate::{Diagnostic, RuleLevel, Severity, Status};
use core::cell::OnceCell;
use std::collections::BTreeSet;
use trunnion_dialect::{Dialect, Language};
use trunnion_interp::{ChainId, Fault, FaultKind, Frame, Refusal};
use trunnion_machine::Machine;
use trunnion_syntax::{BlockId, Program, TextRange};

/// Something that wakes a rule that is not allowed everywhere, with the level the settings give the rule.
#[derive(Clone, Copy)]
pub(crate) struct Active {
    pub(crate) name: &'static str,
    severity: Severity,
    /// Severity of every finding of the rule, if the settings name one.
    level: Option<Severity>,
    pub(crate) wake: Wake,
}

impl Active {
    /// Whether the settings or the rule itself make its findings errors.
    pub(crate) fn may_be_error(&self) -> bool {
        self.level.unwrap_or(self.severity) == Severity::Error
    }
}

/// Collects findings of rules.
pub(crate) struct Reporter<'a> {
    program: &'a Program,
    dialect: &'a Dialect,
    suppressions: &'a Suppressions,
    log: Log,
    /// Of the rule that runs now.
    name: &'static str,
    severity: Severity,
    level: Option<Severity>,
    /// The block it looks at; `None`: the block of what it reports.
    block: Option<BlockId>,
    sequence: u64,
    pub(crate) place: Option<Box<str>>,
    /// The calls in which the current block runs.
    chain: ChainId,
    pending: Vec<Draft<'a>>,
    /// The number of the block of the last finding, as it is written.
    numbered: Option<(BlockId, Option<String>)>,
    told: Keyed<(u64, &'static str), ()>,
    /// A rule writes the message of a leg that it has found before.
    wording: bool,
    /// The running rule has reported or counted something.
    spoke: bool,
    /// The running rule reads the program as a whole, or has asked whether it said this before.
    of_whole: bool,
    /// An earlier part of the program is not known: what it may have said once is not said.
    continues: bool,
    part: OnceCell<Part>,
    names_plane: OnceCell<bool>,
    judges_machine: bool,
    control_known: bool,
    /// Findings of legs that are no errors are left out.
    objections_only: bool,
    /// Where words with a letter O for a zero begin, each reported once.
    slips: BTreeSet<u32>,
    near: NearCodes<'a>,
    /// Pieces of motions that were looked at for obstacles.
    pieces: u64,
}

mod scope;
mod slips;

impl<'a> Reporter<'a> {
    pub(crate) fn new(program: &'a Program, dialect: &'a Dialect, suppressions: &'a Suppressions) -> Self {
        Self {
            program,
            dialect,
            suppressions,
            log: Log::default(),
            name: "",
            severity: Severity::Error,
            level: None,
            block: None,
            place: None,
            sequence: 0,
            chain: ChainId::MAIN,
            pending: Vec::new(),
            numbered: None,
            told: Keyed::default(),
            wording: false,
            spoke: false,
            of_whole: false,
            continues: false,
            part: OnceCell::new(),
            names_plane: OnceCell::new(),
            judges_machine: false,
            control_known: true,
            objections_only: false,
            slips: BTreeSet::new(),
            near: NearCodes::new(dialect),
            pieces: 0,
        }
    }

    /// The program that is checked.
    pub(crate) fn program(&self) -> &'a Program {
        self.program
    }

    /// The dialect that the program is read in.
    pub(crate) fn dialect(&self) -> &'a Dialect {
        self.dialect
    }

    /// The text of a range to be quoted: its first 40 characters, and `...` where there are more.
    pub(crate) fn text(&self, range: TextRange) -> String {
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

    /// Starts a finding at a place; the message says what is wrong, in one sentence with numbers and units.
    pub(crate) fn report(&mut self, range: TextRange, message: impl Into<String>) -> &mut Draft<'a> {
        self.draft().at(range).say(message)
    }

    /// Starts a finding at the code of a block.
    pub(crate) fn report_block(&mut self, message: impl Into<String>) -> &mut Draft<'a> {
        self.draft().say(message)
    }

    /// Reports a block that the control refuses for this sort of reason, with the control's own message.
    pub(crate) fn refused(&mut self, fault: &Fault, sort: Refusal) -> Option<&mut Draft<'a>> {
        let FaultKind::Rejected {
            refusal,
            message,
            alarm,
        } = &fault.kind
        else {
            return None;
        };
        if sort != *refusal {
            return None;
        }
        let mut message = message.trim().trim_end_matches('.').to_owned();
        let mut range = fault.range;
        let keyword = (self.dialect.quirks.language == Language::Linuxcnc && !message.starts_with("in "))
            .then(|| bare_keyword(self.program, range.start))
            .flatten();
        if let Some((keyword, place)) = keyword {
            message = format!(
                "`{keyword}` needs an O-word before it: write `o100 {keyword}`, with the same number at its other parts"
            );
            range = place;
        }
        let draft = self.report(range, message.as_str());
        draft
            .note("the control refuses the block")
            .merge(Merge::runs(hash(&message), 0.0));
        if let Some(alarm) = alarm {
            draft
                .note(format!("the control says: {alarm}"))
                .value_text("alarm", alarm.clone());
        }
        Some(draft)
    }

    /// Reports a finding of a leg that is never merged with others.
    pub(crate) fn event(&mut self, word: impl FnOnce(&mut Draft<'a>)) {
        word(self.draft());
    }

    /// Reports a finding of a leg. `word` writes the message; if blocks before it have this finding already, only when it stays the worst.
    pub(crate) fn finding(&mut self, view: &LegView<'_>, merge: Merge, word: impl FnOnce(&mut Draft<'a>)) {
        let severity = self.level.unwrap_or(self.severity);
        if self.objections_only && severity < Severity::Error {
            self.spoke = true;
            return;
        }
        if !self.absorb(severity, Status::Fail, view, merge) {
            let draft = self.draft().merge(merge);
            word(draft);
            debug_assert!(
                draft.own_severity() <= severity || self.level.is_some(),
                "`finding_as` says that it is worse"
            );
        }
    }

    /// The same with another severity than the rule's own.
    pub(crate) fn finding_as(
        &mut self,
        severity: Severity,
        view: &LegView<'_>,
        merge: Merge,
        word: impl FnOnce(&mut Draft<'a>),
    ) {
        self.severity = severity;
        self.finding(view, merge, word);
    }

    /// As [`Self::finding`], where the rule could not decide; the message says what is missing.
    pub(crate) fn unknown(&mut self, view: &LegView<'_>, merge: Merge, word: impl FnOnce(&mut Draft<'a>)) {
        if !self.absorb(Severity::Info, Status::Unknown, view, merge) {
            word(self.draft().unknown().merge(merge));
        }
    }

    fn draft(&mut self) -> &mut Draft<'a> {
        self.spoke = true;
        let origin = Origin {
            chain: self.chain,
            ..Origin::default()
        };
        let block = self.block.unwrap_or_default();
        self.pending
            .push(Draft::new(self.program, block, self.name, self.severity, origin));
        let last = self.pending.len() - 1;
        if let Some(place) = &self.place {
            self.pending[last].note(format!("in {place}"));
        }
        &mut self.pending[last]
    }

    /// Whether consecutive blocks have this finding already: then it is counted, and its message is written later if it stays the worst.
    fn absorb(&mut self, severity: Severity, status: Status, view: &LegView<'_>, merge: Merge) -> bool {
        let Some(block) = self.block else { return false };
        let rule = self.name;
        let repeat = Repeat {
            rule,
            key: merge.key,
            badness: merge.badness,
            severity,
            status,
            block,
            sequence: self.sequence,
        };
        let absorbed = !self.wording && !self.suppressions.allows(rule, block) && self.log.absorb(repeat, view);
        self.spoke |= absorbed;
        absorbed
    }

    /// Whether a cause, of unknown status, was reported before: then it is counted, and needs no message.
    pub(crate) fn repeats(&mut self, cause: u64, range: TextRange) -> bool {
        let Some(block) = self.block else { return false };
        let repeats = !self.suppressions.allows(self.name, block)
            && self.log.repeat((self.name, cause), block, within(self.program, range));
        self.spoke |= repeats;
        repeats
    }

    /// Writes the messages of the worst legs of runs that only kept them.
    pub(crate) fn word_worst(&mut self, machine: &Machine, rules: &[Active]) {
        for unworded in self.log.end(self.program) {
            let kept = &unworded.kept;
            let view = LegView::new((machine, self.dialect), &kept.leg, kept.posture_before, &kept.trail);
            self.wording = true;
            for rule in rules.iter().filter(|rule| rule.name == unworded.rule) {
                self.enter(rule, Some(kept.leg.motion.block), 0);
                rule.wake.read_leg(&view, self);
            }
            self.wording = false;
            let own = |(diagnostic, merge): &(Diagnostic, Option<Merge>)| {
                diagnostic.status == unworded.status && merge.is_some_and(|merge| merge.key == unworded.key)
            };
            let words = self.pending.drain(..).map(Draft::finish).find(own);
            self.log.worded(unworded, words.map(|(words, _)| words), self.program);
        }
    }

    /// True the first time the running rule asks about `cause`, so that one cause is reported once.
    pub(crate) fn once(&mut self, cause: u64) -> bool {
        self.of_whole = true;
        !self.continues && self.told.insert((cause, self.name), ())
    }

    /// Whether further motions may be looked at for obstacles: of the motions before, no more than `most` pieces were looked at.
    pub(crate) fn may_look(&self, most: u64) -> bool {
        // what was reported is worded again
        self.wording || self.pieces <= most
    }

    /// So many pieces of a motion were looked at for obstacles.
    pub(crate) fn looked_at(&mut self, pieces: u64) {
        if !self.wording {
            self.pieces = self.pieces.saturating_add(pieces);
        }
    }

    /// Names the rule that runs next and the block it looks at. `sequence` counts blocks for merging.
    #[inline]
    pub(crate) fn enter(&mut self, rule: &Active, block: Option<BlockId>, sequence: u64) {
        self.name = rule.name;
        self.severity = rule.severity;
        self.level = rule.level;
        self.block = block;
        self.sequence = sequence;
        (self.spoke, self.of_whole) = (false, !rule.wake.is_of_place());
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
        for (mut diagnostic, merge) in self.pending.drain(..).map(Draft::finish) {
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
            diagnostic.origin.of_whole = self.of_whole || merge.is_some_and(|merge| merge.everywhere);
            if (block.0 as usize) < program.block_count() {
                // a line of a thousand mistakes is read once for its number
                if self.numbered.as_ref().is_none_or(|(last, _)| *last != block) {
                    let number = program.block(block).number();
                    self.numbered = Some((block, number.map(|range| program.text(range).into_owned())));
                }
                diagnostic.block = self.numbered.as_ref().and_then(|(_, number)| number.clone());
            }
            self.log.near = block;
            self.log.add(program, diagnostic, merge, self.sequence);
        }
    }

    /// All findings; `chain` returns the calls of a chain.
    pub(crate) fn finish(self, chain: &dyn Fn(ChainId) -> Vec<Frame>) -> Vec<Diagnostic> {
        self.log.finish(self.program, chain)
    }
}

/// All that wakes a rule that is not allowed everywhere, in the order of the rules. The last entry for a name wins.
pub(crate) fn active(levels: &[(String, RuleLevel)]) -> Vec<Active> {
    let level = |name: &str| {
        levels
            .iter()
            .rev()
            .find(|(known, _)| known == name)
            .map(|(_, level)| *level)
    };
    let mut out = Vec::new();
    for rule in crate::rules() {
        let level = match level(rule.name) {
            Some(RuleLevel::Allow) => continue,
            Some(RuleLevel::At(severity)) => Some(severity),
            None => None,
        };
        out.extend(rule.wakes.iter().map(|&wake| Active {
            name: rule.name,
            severity: rule.severity,
            level,
            wake,
        }));
    }
    out
}
