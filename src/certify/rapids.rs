//! A run of rapid motions that differs between two programs: same ends, nowhere below the level at which the old run went across the tool but where that
//! one was itself, and clear of all obstacles. Nothing is searched here: each motion of the program after is measured against each obstacle.
use crate::certificate::RapidChanges;
use crate::clear::{Clearance, is_declared};
use crate::compare::{Place, above, at_block_of, forward_residual};
use crate::{Claim, Outcome};
use trunnion_geometry::deg;
use trunnion_geometry::math::angle_between;
use trunnion_interp::MotionKind;
use trunnion_machine::{Across, Machine, Stance, TravelLevel};
use trunnion_same::Step;

/// Rotary joints that differ by no more stand still, rad.
const STANDS: f64 = 1e-9;

/// A run that differs.
pub(crate) struct ChangedRun<'a> {
    pub(crate) machine: &'a Machine,
    pub(crate) claim: &'a Claim,
    /// The first motion, in the program after.
    pub(crate) first: Place,
    /// Line of each motion of the program after.
    pub(crate) lines: &'a [u32],
    /// The highest level at which the program before goes across the tool there.
    pub(crate) level: Option<TravelLevel>,
}

/// Where two runs differ, by index: motions that both make alike at the beginning, and the ends of what differs.
pub(crate) struct Differing {
    pub(crate) head: usize,
    pub(crate) old: usize,
    pub(crate) new: usize,
}

impl Differing {
    /// What both do alike before and after the part that differs need not be known: a first positioning begins anywhere.
    pub(crate) fn of(before: &[Step], after: &[Step]) -> Self {
        let most = before.len().min(after.len()) - 1;
        let alike = |pair: &(&Step, &Step)| same_rapid(pair.0, pair.1);
        let head = before.iter().zip(after).take(most).take_while(alike).count();
        let ends = before.iter().rev().zip(after.iter().rev());
        let tail = ends.take(most - head).take_while(alike).count();
        Self {
            head,
            old: before.len() - tail,
            new: after.len() - tail,
        }
    }
}

/// The level of rapids after one more motion: a cut begins anew.
pub(crate) fn level_past(known: Option<TravelLevel>, machine: &Machine, step: &Step) -> Option<TravelLevel> {
    match step.motion.kind {
        MotionKind::Rapid => step
            .leg
            .as_ref()
            .map_or(known, |leg| TravelLevel::extended(known, machine, leg)),
        MotionKind::Dwell(_) => known,
        _ => None,
    }
}

/// The same with the rapids that follow, as long as the tool stays the same.
pub(crate) fn level_on(known: Option<TravelLevel>, machine: &Machine, rest: &[Step]) -> Option<TravelLevel> {
    let same = |step: &&Step| {
        let end = step.leg.as_ref().and_then(|leg| leg.end.as_ref().ok());
        end.is_some_and(|end| known.is_some_and(|level| level.is_of(end)))
    };
    let rest = rest.iter().take_while(same);
    rest.fold(known, |level, step| level_past(level, machine, step))
}

/// Whether a rapid is the same in both programs.
pub(crate) fn same_rapid(was: &Step, is: &Step) -> bool {
    match (&was.leg, &is.leg) {
        (Some(old), Some(new)) => {
            let same_motion = old.motion == at_block_of(old, &new.motion);
            old.end == new.end && old.start == new.start && old.known_joints == new.known_joints && same_motion
        }
        _ => false,
    }
}

impl ChangedRun<'_> {
    /// Adds the run to the certificate's numbers, and returns how far forward kinematics is from the programmed poses: mm, deg.
    pub(crate) fn judge(
        &self,
        before: &[Step],
        after: &[Step],
        total: &mut RapidChanges,
    ) -> Result<Vec<(f64, f64)>, Outcome> {
        let Claim::ClearRapids { clearance_mm, .. } = *self.claim else {
            return Err(self.unknown("rapids are not claimed to be clear of obstacles"));
        };
        if self.machine.obstacles.is_empty() {
            return Err(self.unknown("no obstacle is declared: [[obstacle]] in trunnion.toml or in the machine file"));
        }
        let (old, new) = (self.stances(before, "original")?, self.stances(after, "changed")?);
        self.same_ends(&old, &new)?;
        let follows = self.where_it_was(&old, after)?;
        total.runs += 1;
        total.motions_before += before.len() as u64;
        total.motions_after += after.len() as u64;
        total.length_before_mm += length(&old);
        total.length_after_mm += length(&new);
        let mut residuals = Vec::new();
        for ((step, line), follows) in after.iter().zip(self.lines).zip(follows) {
            let leg = step.leg.as_ref().ok_or_else(|| self.unknown("no machine is named"))?;
            let at = Place {
                line: *line,
                ..self.first
            };
            residuals.extend(forward_residual(self.machine, at, leg)?);
            let clearance = Clearance {
                machine: self.machine,
                motion: self.first.motion,
                line: *line,
                keep: clearance_mm,
            };
            // on the old way it is in the part as it was before
            let least = clearance.clear(step, leg, |obstacle| {
                !follows || !self.machine.obstacles[obstacle].is_part()
            })?;
            if least.is_finite() && total.least_distance_mm.is_none_or(|known| least < known) {
                (total.least_distance_mm, total.line) = (Some(least), *line);
            }
        }
        for step in before {
            if let Some(leg) = &step.leg {
                residuals.extend(forward_residual(self.machine, self.first, leg)?);
            }
        }
        Ok(residuals)
    }

    fn unknown(&self, message: &str) -> Outcome {
        Outcome::unknown(format!("line {}: {message}", self.first.line))
    }

    fn refute<T>(&self, line: u32, message: String) -> Result<T, Outcome> {
        Err(Outcome::refuted_at(self.first.motion, line, message))
    }

    /// The position of the machine before the run and after each of its motions, in which no rotary axis turns.
    fn stances<'s>(&self, run: &'s [Step], which: &str) -> Result<Vec<&'s Stance>, Outcome> {
        let mut stances: Vec<&Stance> = Vec::new();
        for step in run {
            let leg = step.leg.as_ref().ok_or_else(|| self.unknown("no machine is named"))?;
            let lost = || self.unknown(&format!("in the {which} program the machine's position is unknown"));
            if stances.is_empty() {
                stances.push(leg.start.as_ref().ok_or_else(lost)?);
            }
            stances.push(leg.end.as_ref().map_err(|_| lost())?);
            let assumed = matches!(
                self.claim,
                Claim::ClearRapids {
                    assumed_zeros: true,
                    ..
                }
            );
            is_declared(step, assumed).map_err(|why| self.unknown(&why))?;
        }
        let first = stances[0];
        let turns = |stance: &&Stance| {
            let rotary = self.machine.axes.iter().enumerate();
            let mut rotary = rotary.filter(|(_, axis)| axis.kind == trunnion_machine::AxisKind::Rotary);
            rotary.any(|(joint, _)| above((stance.joints[joint] - first.joints[joint]).abs(), STANDS))
        };
        if stances.iter().any(turns) {
            return Err(self.unknown(&format!(
                "in the {which} program a rotary axis turns in these rapid motions"
            )));
        }
        Ok(stances)
    }

    fn same_ends(&self, old: &[&Stance], new: &[&Stance]) -> Result<(), Outcome> {
        let (mm, degrees) = self.claim.tolerances();
        let ends = [
            ("start", old[0], new[0]),
            ("end", old[old.len() - 1], new[new.len() - 1]),
        ];
        for (which, was, is) in ends {
            let shift = was.tip_distance_to(is);
            if above(shift, mm) {
                return self.refute(
                    self.first.line,
                    format!("the {which} of the rapid motions shifts by {shift:.6} mm; {mm} mm is allowed"),
                );
            }
            let turn = deg(angle_between(&was.axis, &is.axis));
            if above(turn, degrees) {
                return self.refute(
                    self.first.line,
                    format!("the tool axis turns by {turn:.6} deg at the {which} of the rapid motions; {degrees} deg is allowed"),
                );
            }
        }
        Ok(())
    }

    /// Which motions of the program after are where the tool was before: an old motion, or straight along the tool above the start or the end. All others
    /// run no lower than the highest level at which the old rapids went across the tool: below that nothing is declared but the obstacles.
    fn where_it_was(&self, old: &[&Stance], after: &[Step]) -> Result<Vec<bool>, Outcome> {
        let tolerance = self.claim.tolerances().0;
        // with one tool, whatever was active before the first motion
        let length = old[old.len() - 1].tool_length;
        let near = |a: &Stance, b: &Stance| !above(a.tip_distance_to(b), tolerance);
        let level = self.level.and_then(|level| level.height());
        let mut follows = Vec::new();
        for (index, (step, line)) in after.iter().zip(self.lines).enumerate() {
            let leg = step.leg.as_ref().ok_or_else(|| self.unknown("no machine is named"))?;
            let (Some(across), Some(start), Ok(end)) = (Across::of(self.machine, leg, length), &leg.start, &leg.end)
            else {
                return Err(self.unknown("it is not known how high the rapid motions are"));
            };
            let from_end = (index + old.len() - 1).checked_sub(after.len());
            let is_old = [Some(index), from_end].into_iter().flatten().any(|at| {
                let pair = old.get(at).zip(old.get(at + 1));
                pair.is_some_and(|(from, to)| near(from, start) && near(to, end))
            });
            let lower = if across.heights[0] <= across.heights[1] {
                start
            } else {
                end
            };
            let is_upright = || !across.sideways && [old[0], old[old.len() - 1]].iter().any(|place| near(place, lower));
            let follow = is_old || is_upright();
            follows.push(follow);
            let deeper = level.map_or(f64::INFINITY, |level| level - across.lowest);
            if !follow && above(deeper, tolerance) {
                let by = if deeper.is_finite() {
                    format!("{deeper:.6} mm below the level at which the rapids were before")
                } else {
                    "where no rapid did before".to_owned()
                };
                return self.refute(
                    *line,
                    format!("the rapid motion goes across the tool {by}, and only declared obstacles are known there"),
                );
            }
        }
        Ok(follows)
    }
}

/// Length of the tip's path, mm.
fn length(stances: &[&Stance]) -> f64 {
    stances.windows(2).map(|pair| pair[0].tip_distance_to(pair[1])).sum()
}
