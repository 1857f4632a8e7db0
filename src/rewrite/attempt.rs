//! An attempt: what a rewrite proposes is proved and compared with the program before; what cannot be proved at one place is left out there.
use crate::edited::Edited;
use crate::no_worse::{cured_errors, no_worse_report, no_worse_turns, speaks_against};
use crate::{Change, Known, Options, Place, Refusal, Rewrite};
use core::cell::OnceCell;
use core::fmt::Write;
use trunnion_certify::{Certificate, Claim, Outcome, certify};
use trunnion_check::{Report, Settings, check_objections};
use trunnion_interp::Setup;
use trunnion_machine::Machine;
use trunnion_same::{Input, assumed, with_zeros};
use trunnion_syntax::{BlockId, LineIndex, Program, TextEdit, parse};

/// So many places are left out one after the other because they cannot be proved; then all of them are refused. Each costs a proof.
const MOST_PROOFS: usize = 32;

/// Of a long program fewer places are left out: all proofs together read no more blocks than this, or are so many.
const MOST_PROVED_BLOCKS: usize = 4_000_000;
const LEAST_PROOFS: usize = 4;

/// How many proofs of a program of so many blocks are tried.
fn most_proofs(blocks: usize) -> usize {
    (MOST_PROVED_BLOCKS / blocks.max(1)).clamp(LEAST_PROOFS, MOST_PROOFS)
}

/// What became of a place.
#[derive(Clone, Debug, PartialEq)]
pub enum State {
    /// Changed, and proved.
    Proved,
    /// It would be possible if this were declared or allowed.
    Possible(String),
    /// Not changed, and why.
    Refused(String),
}

/// A place of the program before, and what became of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Judged {
    /// Its first block.
    pub first: BlockId,
    /// Its last block.
    pub last: BlockId,
    /// Lines of both, from 1.
    pub lines: (u32, u32),
    /// What became of it.
    pub state: State,
}

/// A proved change.
#[derive(Clone, Debug)]
pub struct Proved {
    /// Edits, sorted.
    pub edits: Vec<TextEdit>,
    /// The text after.
    pub after: Vec<u8>,
    /// The proof.
    pub certificate: Box<Certificate>,
    /// What it was proved with: undeclared values that the settings assume are zero in it, where the proof needs them.
    pub setup: Setup,
    /// What it does.
    pub summary: String,
}

/// The outcome of a rewrite. No place and nothing proved: there is nothing to do.
#[derive(Clone, Debug, Default)]
pub struct Attempt {
    /// Each place, in the order of the program.
    pub places: Vec<Judged>,
    /// What is proved, where anything is.
    pub proved: Option<Proved>,
}

impl Attempt {
    /// What is proved; `Ok(None)`: there is nothing to do. `Err`: nothing is changed, and why.
    pub fn outcome(self) -> Result<Option<Proved>, String> {
        match (self.proved, reasons(&self.places)) {
            (None, Some(reasons)) => Err(reasons),
            (proved, _) => Ok(proved),
        }
    }

    /// Why places are not changed, as one text for people: the first three reasons, each once. `None`: all are, or there is nothing to do.
    pub fn reasons(&self) -> Option<String> {
        reasons(&self.places)
    }

    /// One answer for the whole program.
    fn whole(program: &Program, change: Change) -> Self {
        let last = BlockId(program.block_count().saturating_sub(1) as u32);
        let first = BlockId(0);
        Self::of(program, vec![Place { first, last, change }], None)
    }

    fn of(program: &Program, places: Vec<Place>, proved: Option<Proved>) -> Self {
        let index = LineIndex::new(program.source());
        let line = |block: BlockId| {
            let known = (block.0 as usize) < program.block_count();
            let start = if known { program.block(block).range().start } else { 0 };
            index.line_column(program.source(), start).0
        };
        let judged = |place: Place| Judged {
            first: place.first,
            last: place.last,
            lines: (line(place.first), line(place.last)),
            state: match place.change {
                Change::Edits(_) => State::Proved,
                Change::Possible(reason) => State::Possible(reason),
                Change::Refused(reason) => State::Refused(reason),
            },
        };
        Self {
            places: places.into_iter().map(judged).collect(),
            proved,
        }
    }
}

fn reasons(places: &[Judged]) -> Option<String> {
    let mut reasons: Vec<(&str, u32, usize)> = Vec::new();
    for place in places {
        let (State::Possible(reason) | State::Refused(reason)) = &place.state else {
            continue;
        };
        match reasons.iter_mut().find(|(known, ..)| known == reason) {
            Some((_, _, more)) => *more += 1,
            None => reasons.push((reason, place.lines.0, 0)),
        }
    }
    // one place alone may be the whole program: its reason names the line, where there is one
    let alone = places.len() == 1 && places[0].lines.0 != places[0].lines.1;
    let shown = reasons.iter().take(3).map(|&(reason, line, more)| {
        let named = alone || reason.contains("line ");
        let mut text = if named {
            reason.to_owned()
        } else {
            format!("line {line}: {reason}")
        };
        if more > 0 {
            let _ = write!(text, " (and at {more} other places)");
        }
        text
    });
    let mut text = shown.collect::<Vec<_>>().join("; ");
    if reasons.len() > 3 {
        let _ = write!(text, "; and {} other reasons", reasons.len() - 3);
    }
    (!reasons.is_empty()).then_some(text)
}

/// Why a proof fails.
pub(crate) struct Failure {
    pub(crate) reason: String,
    /// Byte of the text after that it is about.
    pub(crate) at: Option<usize>,
}

impl From<String> for Failure {
    fn from(reason: String) -> Self {
        Self { reason, at: None }
    }
}

/// Proposes at all places and proves; see [`attempt_at`].
pub fn attempt(rewrite: &Rewrite, program: &Program, settings: &Settings<'_>, options: &Options) -> Attempt {
    attempt_at(rewrite, program, settings, options, |_| true, &Known::default())
}

/// Proposes, and proves what is proposed at the places that are `wanted`. A place where the proof fails is refused, and the rest is
/// proved again. Refused too: a change after which a rotary axis turns farther or in larger steps, a rule that the rewrite does not
/// claim to fix reports more errors or leaves more undecided, or the verdict on the program is worse. (Findings that it fixes may spread: less in one block,
/// a little more in the next.) `known`: of this program.
pub fn attempt_at(
    rewrite: &Rewrite,
    program: &Program,
    settings: &Settings<'_>,
    options: &Options,
    wanted: impl Fn(&Place) -> bool,
    known: &Known,
) -> Attempt {
    if rewrite.changes_motions()
        && let Err(reason) = known.runs_straight(program, settings)
    {
        return Attempt::whole(program, Change::Refused(reason.clone()));
    }
    let proposal = match rewrite.propose(program, settings, options, known) {
        Ok(Some(proposal)) => proposal,
        Ok(None) => return Attempt::default(),
        Err(Refusal::Whole(change)) => return Attempt::whole(program, change),
        Err(Refusal::Places(mut places)) => {
            places.retain(&wanted);
            return Attempt::of(program, places, None);
        }
    };
    let mut places = proposal.places;
    places.retain(wanted);
    let mut prover = Prover {
        rewrite,
        program,
        settings,
        before: OnceCell::new(),
        summary: proposal.summary,
    };
    let proposed = changed(&places);
    let most = most_proofs(program.block_count());
    let mut tries = 0;
    while let Some(edits) = edits(&places) {
        tries += 1;
        match prover.prove(&edits, &proposal.claim) {
            // the numbers of the summary are those of all places that were proposed
            Ok(mut proved) if tries > 1 => {
                let left = changed(&places);
                proved.summary = format!(
                    "{left} of {proposed} places; all {proposed} would be: {}",
                    proved.summary
                );
                return Attempt::of(program, places, Some(proved));
            }
            Ok(proved) => return Attempt::of(program, places, Some(proved)),
            Err(failure) => {
                let at = failure.at.map(|at| Edited::new(&edits).before(at));
                refuse(program, &mut places, failure.reason, at.filter(|_| tries < most));
            }
        }
    }
    Attempt::of(program, places, None)
}

/// How many places have edits.
fn changed(places: &[Place]) -> usize {
    places
        .iter()
        .filter(|place| matches!(place.change, Change::Edits(_)))
        .count()
}

/// All edits, sorted. `None`: no place has any.
fn edits(places: &[Place]) -> Option<Vec<TextEdit>> {
    let mut all: Vec<TextEdit> = Vec::new();
    for place in places {
        if let Change::Edits(edits) = &place.change {
            all.extend_from_slice(edits);
        }
    }
    all.sort_by_key(|edit| (edit.range.start, edit.range.end));
    (!all.is_empty()).then_some(all)
}

/// Refuses the changed place that holds a byte of the program before, or the nearest one before it; without such a place, all.
fn refuse(program: &Program, places: &mut [Place], reason: String, at: Option<usize>) {
    let changed = |place: &&mut Place| matches!(place.change, Change::Edits(_));
    let starts_before = |place: &&mut Place, at: usize| program.block(place.first).range().start as usize <= at;
    let one = at.and_then(|at| {
        places
            .iter_mut()
            .filter(changed)
            .filter(|place| starts_before(place, at))
            .max_by_key(|place| place.first)
    });
    if let Some(place) = one {
        place.change = Change::Refused(reason);
        return;
    }
    for place in places.iter_mut().filter(changed) {
        place.change = Change::Refused(reason.clone());
    }
}

/// Proves changes of one program.
struct Prover<'a> {
    rewrite: &'a Rewrite,
    program: &'a Program,
    settings: &'a Settings<'a>,
    /// The report on the program before.
    before: OnceCell<Report>,
    summary: String,
}

impl Prover<'_> {
    fn prove(&mut self, edits: &[TextEdit], claim: &Claim) -> Result<Proved, Failure> {
        let Some(machine) = self.settings.machine else {
            return Err("no machine is named (--machine)".to_owned().into());
        };
        let before = self.program.source();
        let Some(after) = trunnion_syntax::apply_edits(before, edits) else {
            return Err("the edits overlap".to_owned().into());
        };
        let dialect = self.settings.dialect;
        let prove = |setup| certify(before, &after, dialect, machine, setup, claim);
        let mut setup = self.settings.setup.clone();
        let mut outcome = prove(&setup);
        if let (Outcome::Unknown(_), Some(zeros)) = (&outcome, self.assumed(machine)) {
            // what is the same with the values that the user takes as zero
            (outcome, setup) = (prove(&zeros), zeros);
        }
        let certificate = match outcome {
            Outcome::Proved(certificate) => certificate,
            Outcome::Refuted(witness) => {
                return Err(Failure {
                    at: witness.line.and_then(|line| line_start(&after, line)),
                    reason: format!("refuted: {witness}"),
                });
            }
            Outcome::Unknown(gap) => {
                return Err(Failure {
                    at: gap.line.and_then(|line| line_start(&after, line)),
                    reason: format!("not proved: {gap}"),
                });
            }
        };
        // as it will be stored: what is read back must be what was proved
        certificate.can_be_stored().map_err(Failure::from)?;
        // the guard follows what a rewrite makes least: postures their cost, smooth-pole the slope, which it compares itself
        if matches!(certificate.claim, Claim::SamePoses { .. }) {
            no_worse_turns(&certificate)?;
        }
        let is = check_objections(&parse(after.clone(), self.program.options()), self.settings);
        if !speaks_against(&is) {
            return Ok(self.proved(edits, after, certificate, setup, ""));
        }
        let was = self
            .before
            .get_or_init(|| check_objections(self.program, self.settings));
        no_worse_report(self.rewrite, was, &is)?;
        let errors = [was, &is].map(|report| cured_errors(self.rewrite, report));
        // less in one block and more in the next can be more blocks with errors: people decide whether they want that
        let spread = if errors[1] > errors[0] {
            format!(
                "; {} -> {} errors of {}, each smaller but in more blocks",
                errors[0],
                errors[1],
                self.rewrite.cures.join(", ")
            )
        } else {
            String::new()
        };
        Ok(self.proved(edits, after, certificate, setup, &spread))
    }

    /// What is proved; `spread`: what is added to the summary.
    fn proved(
        &self,
        edits: &[TextEdit],
        after: Vec<u8>,
        certificate: Box<Certificate>,
        setup: Setup,
        spread: &str,
    ) -> Proved {
        Proved {
            edits: edits.to_vec(),
            after,
            certificate,
            setup,
            summary: format!("{}{spread}", self.summary),
        }
    }
}

impl Prover<'_> {
    /// The setup with the undeclared values at zero that the user assumes to be; `None`: there are none.
    fn assumed(&self, machine: &Machine) -> Option<Setup> {
        let input = Input {
            program: self.program,
            dialect: self.settings.dialect,
            setup: &self.settings.setup,
            machine: Some(machine),
        };
        let assume = self.settings.assume;
        let unset = assumed(input, [assume.work_offset, assume.tool_length]);
        (!unset.is_empty()).then(|| with_zeros(&self.settings.setup, &unset))
    }
}

/// The first byte of a line (from 1).
fn line_start(text: &[u8], line: u32) -> Option<usize> {
    LineIndex::new(text).offset(text, line, 1).map(|start| start as usize)
}

#[cfg(test)]
mod tests;
