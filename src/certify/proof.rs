//! The proof so far: what comparing pairs of motions has found.
use crate::certificate::{MotionCounts, PostureCosts, RapidChanges, RotaryChange, Worst, WorstChanges};
use crate::chosen::Chosen;
use crate::compare::{Compared, Pair, Place, forward_residual, process_differs};
use crate::rapids::{ChangedRun, Differing, level_on, level_past, same_rapid};
use crate::retracts::{self, Excursion};
use crate::{Claim, Outcome};
use trunnion_dialect::RotaryFeed;
use trunnion_geometry::deg;
use trunnion_machine::{Leg, Machine, TravelLevel};
use trunnion_same::{Difference, Judge, Refitted, Step, Verdict};
use trunnion_syntax::{BlockId, LineIndex, Program};

/// What is found while both programs run.
pub(crate) struct Proof<'a> {
    machine: &'a Machine,
    /// What decides what F means where rotary axes move, in the dialect of the program after.
    rotary_feed: RotaryFeed,
    claim: &'a Claim,
    after: &'a Program,
    lines: LineIndex,
    pub(crate) motions: MotionCounts,
    pub(crate) worst: WorstChanges,
    pub(crate) rotary: Vec<RotaryChange>,
    pub(crate) changes: Vec<crate::certificate::MotionChange>,
    /// Positions of the rotary axes, where the claim is about postures.
    chosen: Option<Chosen<'a>>,
    /// The line that is being made in pieces.
    begun: Option<crate::pieces::Begun>,
    /// Runs of rapids that differ.
    pub(crate) rapids: Option<RapidChanges>,
    /// How high the rapids of the program before have gone across the tool since the last cut.
    level: Option<TravelLevel>,
    /// Where the tool is, where it may leave the part.
    excursion: Excursion,
    /// What ended the proof, where that was a pair of motions.
    pub(crate) failed: Option<Outcome>,
}

impl Judge for Proof<'_> {
    fn pair(&mut self, before: &Step, after: &Step) -> Result<(), Verdict> {
        self.level = level_past(self.level, self.machine, before);
        self.add(before, after)
            .map_err(|outcome| self.fail(outcome, before, after))
    }

    fn rapids(&mut self, before: &[Step], after: &[Step]) -> Result<(), Verdict> {
        if before.len() == after.len() && before.iter().zip(after).all(|(was, is)| same_rapid(was, is)) {
            return before.iter().zip(after).try_for_each(|(was, is)| self.pair(was, is));
        }
        let Differing { head, old, new } = Differing::of(before, after);
        let mut leading = before.iter().zip(after).take(head);
        leading.try_for_each(|(was, is)| self.pair(was, is))?;
        let (was, is) = (&before[head..old], &after[head..new]);
        for step in was {
            self.level = level_past(self.level, self.machine, step);
        }
        self.changed_rapids(was, is, level_on(self.level, self.machine, &before[old..]))
            .map_err(|outcome| self.fail(outcome, &was[0], &is[0]))?;
        before[old..]
            .iter()
            .zip(&after[new..])
            .try_for_each(|(was, is)| self.pair(was, is))
    }

    fn piece(&mut self, before: &Step, after: &Step) -> Result<Option<bool>, Verdict> {
        let (Some(old), Some(new)) = (&before.leg, &after.leg) else {
            return Ok(None);
        };
        let at = Place {
            motion: self.motions.total as usize,
            line: self.line(after.motion.block),
        };
        let found = crate::pieces::piece(self.machine, [old, new], &mut self.begun, self.claim.tolerances());
        let difference = |what: String| Difference {
            before: Some(before.motion.block),
            after: Some(after.motion.block),
            what,
        };
        match found {
            Ok(None) => Ok(None),
            Ok(Some(piece)) => {
                raise(&mut self.worst.path_bound_mm, piece.bound_mm, at);
                self.motions.total += 1;
                self.motions.changed += 1;
                Ok(Some(piece.last))
            }
            Err(crate::pieces::Wrong::Refuted(what)) => Err(Verdict::Differs(difference(what))),
            Err(crate::pieces::Wrong::Unknown(what)) => Err(Verdict::Unknown(difference(what.to_owned()))),
        }
    }

    fn leaves(&self, before: &Step, after: &Step) -> bool {
        matches!(self.claim, Claim::InsertedRetracts { .. }) && self.retracts().leaves(before, after)
    }

    fn retract(&mut self, before: &Step, after: &[Step]) -> Result<(), Verdict> {
        let Excursion::InCut(last) = core::mem::replace(&mut self.excursion, Excursion::Back) else {
            let why = Outcome::unknown("the tool leaves the part again before it cuts");
            return Err(self.fail(why, before, &after[0]));
        };
        self.excursion = Excursion::Away(last);
        let lines: Vec<u32> = after.iter().map(|step| self.line(step.motion.block)).collect();
        let found = self.retracts().away(before, after, &lines);
        let found = found.map_err(|outcome| self.fail(outcome, before, &after[0]))?;
        self.rapids.get_or_insert_default().runs += 1;
        for (measured, line) in found.iter().zip(lines) {
            self.add_excursion(measured, line);
        }
        Ok(())
    }

    fn returns(&mut self, before: &Step, after: &Step) -> Result<bool, Verdict> {
        let line = self.line(after.motion.block);
        let excursion = core::mem::replace(&mut self.excursion, Excursion::InCut(None));
        let found = self.retracts().back(before, after, line, excursion);
        let (next, measured) = found.map_err(|outcome| self.fail(outcome, before, after))?;
        self.excursion = next;
        self.add_excursion(&measured, line);
        Ok(matches!(self.excursion, Excursion::Back))
    }

    fn refitted(&mut self, before: &Step, after: &Step, found: Refitted) -> Result<(), Verdict> {
        self.add_refitted(before, after, found);
        Ok(())
    }

    fn cut(&mut self, off: f64) {
        let at = Place {
            motion: self.motions.total as usize,
            line: 0,
        };
        raise(&mut self.worst.path_bound_mm, off, at);
    }
}

impl<'a> Proof<'a> {
    pub(crate) fn new((machine, rotary_feed): (&'a Machine, RotaryFeed), claim: &'a Claim, after: &'a Program) -> Self {
        let axis = |&joint: &usize| RotaryChange {
            axis: char::from(machine.axes[joint].letter).to_string(),
            step_before_deg: 0.0,
            step_after_deg: 0.0,
            travel_before_deg: 0.0,
            travel_after_deg: 0.0,
        };
        Self {
            machine,
            rotary_feed,
            claim,
            after,
            lines: LineIndex::new(after.source()),
            motions: MotionCounts::default(),
            worst: WorstChanges::default(),
            rotary: machine.rotary.iter().map(axis).collect(),
            changes: Vec::new(),
            chosen: matches!(claim, Claim::LeastPostures { .. }).then(|| Chosen::new(machine)),
            begun: None,
            rapids: None,
            level: None,
            excursion: Excursion::InCut(None),
            failed: None,
        }
    }

    /// A verdict about something other than the path of a pair of motions.
    pub(crate) fn outcome(&self, verdict: Verdict, before: &Program) -> Outcome {
        let (refuted, found) = match verdict {
            Verdict::Differs(found) => (true, found),
            Verdict::Unknown(found) => (false, found),
            Verdict::Same => return Outcome::unknown("nothing was compared"),
        };
        let line = found.after.map(|block| self.line(block));
        let lines = LineIndex::new(before.source());
        let old = found
            .before
            .map(|block| lines.line_column(before.source(), before.block(block).range().start).0);
        let place = match (old, line) {
            (Some(old), Some(new)) => format!("line {old} of the original program and line {new} of the changed one: "),
            (Some(old), None) => format!("line {old} of the original program: "),
            (None, Some(new)) => format!("line {new} of the changed program: "),
            (None, None) => String::new(),
        };
        if refuted {
            Outcome::Refuted(crate::Witness {
                motion: None,
                line,
                message: format!("{place}{}", found.what),
            })
        } else {
            Outcome::unknown_at(line, format!("{place}{}", found.what))
        }
    }

    /// Whether the postures are the cheapest, where that is claimed.
    pub(crate) fn postures(&mut self) -> Result<Option<PostureCosts>, Outcome> {
        match (self.chosen.take(), self.claim) {
            (
                Some(chosen),
                Claim::LeastPostures {
                    tolerance_deg,
                    cost,
                    labels,
                    ..
                },
            ) => chosen.judge(*cost, labels, *tolerance_deg).map(Some),
            _ => Ok(None),
        }
    }

    /// What ends the proof at a pair of steps.
    fn fail(&mut self, outcome: Outcome, before: &Step, after: &Step) -> Verdict {
        let verdict = if matches!(outcome, Outcome::Unknown(_)) {
            Verdict::Unknown
        } else {
            Verdict::Differs
        };
        let what = match &outcome {
            Outcome::Refuted(witness) => witness.message.clone(),
            _ => String::new(),
        };
        self.failed = Some(outcome);
        verdict(Difference {
            before: Some(before.motion.block),
            after: Some(after.motion.block),
            what,
        })
    }

    /// A run of rapids that differs.
    fn changed_rapids(&mut self, before: &[Step], after: &[Step], level: Option<TravelLevel>) -> Result<(), Outcome> {
        let lines: Vec<u32> = after.iter().map(|step| self.line(step.motion.block)).collect();
        let mut total = self.rapids.unwrap_or_default();
        let run = ChangedRun {
            machine: self.machine,
            claim: self.claim,
            first: Place {
                motion: self.motions.total as usize,
                line: lines[0],
            },
            lines: &lines,
            level,
        };
        let residuals = run.judge(before, after, &mut total)?;
        self.rapids = Some(total);
        for (mm, degrees) in residuals {
            raise(&mut self.worst.forward_residual_mm, mm, run.first);
            raise(&mut self.worst.forward_residual_deg, degrees, run.first);
        }
        self.motions.total += before.len() as u64;
        self.motions.changed += before.len() as u64;
        Ok(())
    }

    fn retracts(&self) -> retracts::Judge<'a> {
        retracts::Judge {
            machine: self.machine,
            claim: self.claim,
            motion: self.motions.total as usize,
        }
    }

    /// A motion that only the program after has.
    fn add_excursion(&mut self, measured: &retracts::Measured, line: u32) {
        let at = Place {
            motion: self.motions.total as usize,
            line,
        };
        let total = self.rapids.get_or_insert_default();
        total.motions_after += 1;
        total.length_after_mm += measured.length_mm;
        let least = measured.least_mm;
        if least.is_finite() && total.least_distance_mm.is_none_or(|known| least < known) {
            (total.least_distance_mm, total.line) = (Some(least), line);
        }
        if let Some((mm, degrees)) = measured.residual {
            raise(&mut self.worst.forward_residual_mm, mm, at);
            raise(&mut self.worst.forward_residual_deg, degrees, at);
        }
    }

    /// The cut after an excursion begins in another posture. The cut is remembered: the tool may come back above it.
    fn excursion_ends(&mut self, was: &Step, is: &Step, line: u32) -> Result<bool, Outcome> {
        if !matches!(self.claim, Claim::InsertedRetracts { .. }) {
            return Ok(false);
        }
        let last = core::mem::replace(&mut self.excursion, Excursion::InCut(Some(Box::new(is.clone()))));
        if !matches!(last, Excursion::Back) {
            return Ok(false);
        }
        if let (Some(old), Some(new)) = (&was.leg, &is.leg) {
            self.retracts().cut_after(old, new, line)?;
        }
        Ok(true)
    }

    fn line(&self, block: BlockId) -> u32 {
        self.lines
            .line_column(self.after.source(), self.after.block(block).range().start)
            .0
    }

    /// A motion that takes the place of several: its shift is that of what the claim is about, its path bound that of the whole path.
    fn add_refitted(&mut self, was: &Step, is: &Step, found: Refitted) {
        let at = Place {
            motion: self.motions.total as usize,
            line: self.line(is.motion.block),
        };
        let points_only = matches!(
            self.claim,
            Claim::RefittedPath {
                source: crate::RefitSource::Points,
                ..
            }
        );
        let shift = if points_only { found.points_mm } else { found.paths_mm };
        raise(&mut self.worst.point_shift_mm, shift, at);
        raise(&mut self.worst.path_bound_mm, found.paths_mm, at);
        // a line that begins beside the old one is another line
        let differs = found.motions > 1 || was.motion.kind != is.motion.kind || found.paths_mm > 1e-6;
        self.motions.changed += u64::from(differs);
        self.motions.total += 1;
    }

    fn add(&mut self, was: &Step, is: &Step) -> Result<(), Outcome> {
        let at = Place {
            motion: self.motions.total as usize,
            line: self.line(is.motion.block),
        };
        let (Some(old), Some(new)) = (&was.leg, &is.leg) else {
            return Err(Outcome::unknown("no machine is named"));
        };
        if let Some(chosen) = &mut self.chosen {
            chosen.add(old, new, at.line);
        }
        let residuals = [
            forward_residual(self.machine, at, old)?,
            forward_residual(self.machine, at, new)?,
        ];
        for (mm, degrees) in residuals.into_iter().flatten() {
            raise(&mut self.worst.forward_residual_mm, mm, at);
            raise(&mut self.worst.forward_residual_deg, degrees, at);
        }
        for (index, rotary) in self.rotary.iter_mut().enumerate() {
            let joint = self.machine.rotary[index];
            let steps = [old, new].map(|leg| rotary_step(leg, joint));
            rotary.step_before_deg = rotary.step_before_deg.max(steps[0]);
            rotary.step_after_deg = rotary.step_after_deg.max(steps[1]);
            rotary.travel_before_deg += steps[0];
            rotary.travel_after_deg += steps[1];
        }
        let ends_only = self.excursion_ends(was, is, at.line)?;
        let pair = Pair {
            machine: self.machine,
            claim: self.claim,
            at,
            before: was,
            after: is,
            ends_only,
        };
        if let Claim::AdaptedFeed { asked_mm_min, .. } = self.claim {
            crate::feed::adapted((self.machine, self.rotary_feed), [old, new], *asked_mm_min)
                .map_err(|gap| gap.at(at.motion, at.line))?;
        }
        match pair.compare()? {
            Compared::Same => {}
            Compared::UnknownAlike => self.motions.unknown += 1,
            Compared::Changed(change) => {
                raise(&mut self.worst.point_shift_mm, change.point_shift_mm, at);
                raise(&mut self.worst.tip_shift_mm, change.tip_shift_mm, at);
                raise(&mut self.worst.axis_change_deg, change.axis_change_deg, at);
                raise(&mut self.worst.path_bound_mm, change.path_bound_mm, at);
                raise(&mut self.worst.path_axis_bound_deg, change.path_axis_bound_deg, at);
                self.motions.changed += 1;
                self.changes.push(*change);
            }
        }
        self.motions.process_changed += u64::from(process_differs(&was.motion, &is.motion));
        self.motions.total += 1;
        Ok(())
    }
}

/// Size of a joint's step in one motion, deg; 0 where an end is unknown.
fn rotary_step(leg: &Leg, joint: usize) -> f64 {
    match (&leg.start, &leg.end) {
        (Some(start), Ok(end)) => deg((end.joints[joint] - start.joints[joint]).abs()),
        _ => 0.0,
    }
}

/// Keeps the worst value and its place.
fn raise(worst: &mut Worst, value: f64, at: Place) {
    if value > worst.value || worst.line == 0 {
        *worst = Worst {
            value,
            motion: at.motion as u64,
            line: at.line,
        };
    }
}
