//! Away from the part and back between two cuts: each motion keeps to a volume in which the tool has been, or clears all declared obstacles.
//!
//! A tool that moves away along its own axis stays inside the space that it and its holder fill, so that nothing that belongs to the part can be hit; the
//! same holds on the way back to a pose that the tool had before. In between, in the air, obstacles decide. Source: docs/kinematics.md#retracting.
use crate::clear::{Clearance, is_declared};
use crate::compare::{Place, above, forward_residual};
use crate::path::{Path, apart};
use crate::{Claim, Outcome};
use trunnion_geometry::math::angle_between;
use trunnion_geometry::{Vec3, deg};
use trunnion_interp::MotionKind;
use trunnion_machine::{Leg, Machine, RapidPath, Stance, linear_steps};
use trunnion_same::Step;

/// Rotary joints that differ by no more stand still, rad.
const STANDS: f64 = 1e-9;

/// Where the tool is between two cuts.
pub(crate) enum Excursion {
    /// In the cut: the last one, where there was one.
    InCut(Option<Box<Step>>),
    /// In the air, after rapids.
    Away(Option<Box<Step>>),
    /// On the ramp above the last cut.
    OnRamp(Box<Step>),
    /// Back: the next cut begins in another posture or with other turns.
    Back,
}

/// One excursion, judged motion by motion.
pub(crate) struct Judge<'a> {
    pub(crate) machine: &'a Machine,
    pub(crate) claim: &'a Claim,
    pub(crate) motion: usize,
}

/// Numbers of one motion for the certificate.
pub(crate) struct Measured {
    /// Smallest proven distance from an obstacle, mm; infinite where there is none.
    pub(crate) least_mm: f64,
    /// Length of the tip's path, mm.
    pub(crate) length_mm: f64,
    /// How far forward kinematics is from the programmed pose, mm and deg.
    pub(crate) residual: Option<(f64, f64)>,
}

impl Judge<'_> {
    /// Whether a line at feed is not the cut that comes next in the program before, but leads out along the tool axis from where that begins.
    pub(crate) fn leaves(&self, cut: &Step, step: &Step) -> bool {
        let (Ok((leg, start, end)), Ok((_, _, own_end))) = (stances(step, 0), stances(cut, 0)) else {
            return false;
        };
        let (mm, degrees) = self.claim.tolerances();
        let is_cut = end.tip_distance_to(own_end) <= mm && deg(angle_between(&end.axis, &own_end.axis)) <= degrees;
        leg.motion.kind == MotionKind::Linear
            && !is_cut
            && self.same_pose(cut, start, 0).is_ok()
            && self.stands(leg, 0).is_ok()
            && self.along(leg, (start, end), 1.0, 0).is_ok()
    }

    /// The motions that lead away from the part: the first along the tool axis, the others clear of all obstacles. `lines`: of each one.
    pub(crate) fn away(&self, cut: &Step, run: &[Step], lines: &[u32]) -> Result<Vec<Measured>, Outcome> {
        if cut.held.tool.as_ref().is_none_or(|tool| tool.shape.is_none()) {
            // a tool that is wider than its shank would cut on its way out
            return Err(unknown(
                lines[0],
                "the shape of the tool is not declared: [[tool]] shape in trunnion.toml",
            ));
        }
        let narrow = |tool: &trunnion_interp::Tool| {
            tool.holder_mm
                .zip(tool.diameter_mm)
                .is_some_and(|(holder, own)| holder < own)
        };
        if cut.held.tool.as_ref().is_some_and(narrow) {
            return Err(unknown(
                lines[0],
                "the holder is narrower than the tool: on its way out the tool would pass where it has not been",
            ));
        }
        let mut obstacles = self.machine.obstacles.iter();
        if !obstacles.any(|obstacle| obstacle.is_part() && obstacle.frame(self.machine) == Some(0)) {
            return Err(unknown(
                lines[0],
                "the part is not declared: [[obstacle]] with `part = true` that moves with the workpiece",
            ));
        }
        let mut found = Vec::new();
        for (index, (step, &line)) in run.iter().zip(lines).enumerate() {
            let (leg, start, end) = stances(step, line)?;
            self.declared(step, line)?;
            let mut least_mm = f64::INFINITY;
            if index == 0 {
                self.same_pose(cut, start, line)?;
                self.stands(leg, line)?;
                self.along(leg, (start, end), 1.0, line)?;
            } else {
                least_mm = self.clearance(line).clear(step, leg, |_| true)?;
            }
            found.push(self.measured(leg, (start, end), (least_mm, line))?);
        }
        Ok(found)
    }

    /// A line at feed in the air, where rotary axes turn, or back to the part; `cut`: the motion that comes next in the program before. With
    /// where the tool is then.
    pub(crate) fn back(
        &self,
        cut: &Step,
        step: &Step,
        line: u32,
        excursion: Excursion,
    ) -> Result<(Excursion, Measured), Outcome> {
        let (leg, start, end) = stances(step, line)?;
        self.declared(step, line)?;
        let pose = start_of(cut, line)?;
        let (mm, degrees) = self.claim.tolerances();
        let arrived = end.tip_distance_to(pose) <= mm && deg(angle_between(&end.axis, &pose.axis)) <= degrees;
        let turns = leg.rotary_change.iter().any(|&change| above(change, STANDS));
        let next = match excursion {
            Excursion::Away(last) if turns => {
                let least = self.clearance(line).clear(step, leg, |_| true)?;
                return Ok((Excursion::Away(last), self.measured(leg, (start, end), (least, line))?));
            }
            Excursion::Away(last) => {
                self.stands(leg, line)?;
                self.along(leg, (start, end), -1.0, line)?;
                match last {
                    _ if arrived => Excursion::Back,
                    Some(last) => Excursion::OnRamp(last),
                    None => return self.refute(line, "the tool does not come back to where it left the part"),
                }
            }
            Excursion::OnRamp(last) if arrived => {
                self.ramp(&last, cut, (leg, start), line)?;
                Excursion::Back
            }
            _ => return self.refute(line, "the tool does not come back to where it left the part"),
        };
        // the part is where the tool has been; other bodies of the machine stand elsewhere in the other posture
        let machine = self.machine;
        let others = |obstacle: usize| machine.obstacles[obstacle].frame(machine) != Some(0);
        let least = self.clearance(line).clear(step, leg, others)?;
        Ok((next, self.measured(leg, (start, end), (least, line))?))
    }

    /// The cut after an excursion: it ends as before (that is compared elsewhere), and turns no farther.
    pub(crate) fn cut_after(&self, before: &Leg, after: &Leg, line: u32) -> Result<(), Outcome> {
        if after.rotary_excess > 0.0 {
            return self.refute(line, "the cut after the retraction changes the posture");
        }
        let turns = before.rotary_change.iter().zip(&after.rotary_change);
        for (was, is) in turns {
            if above(*is, was + STANDS) || above(*is, core::f64::consts::PI + STANDS) {
                return self.refute(
                    line,
                    "the cut after the retraction turns a rotary axis farther than before, or by more than half a turn",
                );
            }
        }
        Ok(())
    }

    fn clearance(&self, line: u32) -> Clearance<'_> {
        let keep = match self.claim {
            Claim::InsertedRetracts { clearance_mm, .. } => *clearance_mm,
            _ => 0.0,
        };
        Clearance {
            machine: self.machine,
            motion: self.motion,
            line,
            keep,
        }
    }

    fn declared(&self, step: &Step, line: u32) -> Result<(), Outcome> {
        let assumed = matches!(
            self.claim,
            Claim::InsertedRetracts {
                assumed_zeros: true,
                ..
            }
        );
        is_declared(step, assumed).map_err(|why| unknown(line, &why))
    }

    fn refute<T>(&self, line: u32, message: &str) -> Result<T, Outcome> {
        Err(Outcome::refuted_at(self.motion, line, message))
    }

    fn same_pose(&self, cut: &Step, start: &Stance, line: u32) -> Result<(), Outcome> {
        let pose = start_of(cut, line)?;
        let (mm, degrees) = self.claim.tolerances();
        if above(start.tip_distance_to(pose), mm) || above(deg(angle_between(&start.axis, &pose.axis)), degrees) {
            return self.refute(line, "the tool leaves the part where the original program does not cut");
        }
        Ok(())
    }

    /// No rotary axis turns.
    fn stands(&self, leg: &Leg, line: u32) -> Result<(), Outcome> {
        if leg.rotary_change.iter().any(|&change| above(change, STANDS)) {
            return self.refute(line, "a rotary axis turns while the tool is at the part");
        }
        Ok(())
    }

    /// The tip moves along the tool axis, in the direction `sign`, on any path that the axes may take.
    fn along(&self, leg: &Leg, (start, end): (&Stance, &Stance), sign: f64, line: u32) -> Result<(), Outcome> {
        if !matches!(leg.motion.kind, MotionKind::Rapid | MotionKind::Linear) {
            return Err(unknown(line, "the motion is no straight line"));
        }
        let independent = leg.motion.kind == MotionKind::Rapid && self.machine.control.rapid != RapidPath::Synchronous;
        let parts = if independent {
            linear_steps(self.machine, (&start.joints, &end.joints), end.tool_length, 0).collect()
        } else {
            vec![end.tip - start.tip]
        };
        let along = |part: &Vec3| sign * part.dot(&start.axis);
        let off: f64 = parts
            .iter()
            .map(|part| (part - start.axis * (sign * along(part))).norm())
            .sum();
        let against: f64 = parts.iter().map(|part| (-along(part)).max(0.0)).sum();
        let mm = self.claim.tolerances().0;
        if above(off, mm) || above(against, mm) {
            return self.refute(
                line,
                &format!(
                    "the tool does not move along its axis: by up to {:.6} mm off it; {mm} mm is allowed",
                    off.max(against)
                ),
            );
        }
        Ok(())
    }

    /// The ramp runs above the last cut: at each moment the tool stands where that cut had it, lifted along its axis.
    fn ramp(&self, last: &Step, cut: &Step, (leg, start): (&Leg, &Stance), line: u32) -> Result<(), Outcome> {
        let (mm, degrees) = self.claim.tolerances();
        let (old, from, to) = stances(last, line)?;
        let straight = [&old.motion, &leg.motion]
            .iter()
            .all(|motion| motion.kind == MotionKind::Linear && motion.tcp);
        if !straight || last.held.tool != cut.held.tool {
            return Err(unknown(line, "no cut with the same tool leads along the ramp"));
        }
        self.same_pose(cut, to, line)?;
        let path = |leg: &Leg| {
            let (start, end) = (leg.start.as_ref()?, leg.end.as_ref().ok()?);
            Path::new(self.machine, leg, start, end, 0.0)
        };
        let (Some(was), Some(is)) = (path(old), path(leg)) else {
            return Err(unknown(line, "the path between the ends is not modelled"));
        };
        let turned = deg(apart(&was, &is).bound_axis);
        if above(turned, degrees) {
            return Err(unknown(
                line,
                &format!(
                    "on the ramp the tool axis is up to {turned:.6} deg away from the previous cut; {degrees} deg is allowed"
                ),
            ));
        }
        // the lift shrinks evenly from `lift` to nothing, while the tool axis turns by no more than the rotary axes do
        let lift = start.tip - from.tip;
        let height = lift.dot(&from.axis);
        let turn: f64 = old.rotary_change.iter().sum();
        let off = (lift - from.axis * height).norm() + lift.norm() * turn;
        if above(-height, mm) || above(off, mm) {
            return self.refute(
                line,
                &format!(
                    "the ramp is not above the previous cut, but {:.6} mm off; {mm} mm is allowed",
                    off.max(-height)
                ),
            );
        }
        Ok(())
    }

    fn measured(
        &self,
        leg: &Leg,
        (start, end): (&Stance, &Stance),
        (least_mm, line): (f64, u32),
    ) -> Result<Measured, Outcome> {
        let at = Place {
            motion: self.motion,
            line,
        };
        Ok(Measured {
            least_mm,
            length_mm: start.tip_distance_to(end),
            residual: forward_residual(self.machine, at, leg)?,
        })
    }
}

fn unknown(line: u32, message: &str) -> Outcome {
    Outcome::unknown_at(Some(line), format!("line {line}: {message}"))
}

fn stances(step: &Step, line: u32) -> Result<(&Leg, &Stance, &Stance), Outcome> {
    let leg = step.leg.as_ref().ok_or_else(|| unknown(line, "no machine is named"))?;
    match (&leg.start, &leg.end) {
        (Some(start), Ok(end)) => Ok((leg, start, end)),
        _ => Err(unknown(line, "the machine's position is unknown")),
    }
}

/// Where the next motion of the program before begins.
fn start_of(cut: &Step, line: u32) -> Result<&Stance, Outcome> {
    let leg = cut.leg.as_ref();
    leg.and_then(|leg| leg.start.as_ref())
        .ok_or_else(|| unknown(line, "where the next cut begins is unknown"))
}
