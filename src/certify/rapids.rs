//! A run of rapid motions that differs between two programs: same ends, no lower, and clear of all obstacles. Nothing is searched here: each motion
//! of the program after is measured against each obstacle.
use crate::certificate::RapidChanges;
use crate::clear::{Clearance, is_declared};
use crate::compare::{Place, above, at_block_of, forward_residual};
use crate::{Claim, Outcome};
use trunnion_geometry::deg;
use trunnion_geometry::math::angle_between;
use trunnion_machine::{Machine, Stance, forward};
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
        self.no_lower(&old, &new)?;
        total.runs += 1;
        total.motions_before += before.len() as u64;
        total.motions_after += after.len() as u64;
        total.length_before_mm += length(&old);
        total.length_after_mm += length(&new);
        let mut residuals = Vec::new();
        for (step, line) in after.iter().zip(self.lines) {
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
            let least = clearance.clear(step, leg, |obstacle| !self.machine.obstacles[obstacle].is_part())?;
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

    /// The tool is never lower along its axis than before: what is below is not declared.
    fn no_lower(&self, old: &[&Stance], new: &[&Stance]) -> Result<(), Outcome> {
        // with one tool, whatever was active before the first motion
        let length = old[old.len() - 1].tool_length;
        let lowest = |stances: &[&Stance]| {
            let heights = stances
                .iter()
                .map(|stance| stance.axis.dot(&forward(self.machine, &stance.joints, length).tip));
            heights.fold(f64::INFINITY, f64::min)
        };
        let deeper = lowest(old) - lowest(new);
        if above(deeper, self.claim.tolerances().0) {
            return self.refute(
                self.first.line,
                format!("the rapid motions go {deeper:.6} mm lower along the tool than before, where only declared obstacles are known"),
            );
        }
        Ok(())
    }
}

/// Length of the tip's path, mm.
fn length(stances: &[&Stance]) -> f64 {
    stances.windows(2).map(|pair| pair[0].tip_distance_to(pair[1])).sum()
}
