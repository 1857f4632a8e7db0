//! Two legs of the same number, one of each program: what differs, in numbers.
use crate::certificate::MotionChange;
use crate::path::{Apart, Path, apart};
use crate::{Claim, Outcome};
use trunnion_geometry::math::angle_between;
use trunnion_geometry::{Vec3, deg};
use trunnion_interp::{Motion, MotionKind};
use trunnion_machine::{Leg, Machine, NoStance, Stance, forward};
use trunnion_same::Step;

/// Forward kinematics may differ from the programmed pose by this much, mm and deg: more is a fault of this program, not a claim.
const FORWARD_TOLERANCE: f64 = 1e-6;

/// Where two legs are in their programs.
#[derive(Clone, Copy)]
pub(crate) struct Place {
    /// Index of the motion.
    pub motion: usize,
    /// Line in the program after.
    pub line: u32,
}

/// The result of comparing two legs.
pub(crate) enum Compared {
    /// Nothing differs.
    Same,
    /// The position is unknown in both, but they are programmed alike from a like state.
    UnknownAlike,
    /// They differ.
    Changed(Box<MotionChange>),
}

/// Two legs under a claim.
pub(crate) struct Pair<'a> {
    /// The machine.
    pub machine: &'a Machine,
    /// The claim.
    pub claim: &'a Claim,
    /// Where.
    pub at: Place,
    /// In the program before.
    pub before: &'a Step,
    /// In the program after.
    pub after: &'a Step,
    /// Nothing is claimed of the path between its ends: it begins in another posture.
    pub ends_only: bool,
}

/// The position of the zero point of X Y Z, mm.
fn zero(motion: &Motion) -> Vec3 {
    Vec3::new(motion.zero[0], motion.zero[1], motion.zero[2])
}

/// The stances of both programs at the same moment.
pub(super) type Both<'s> = (&'s Stance, &'s Stance);

impl Pair<'_> {
    /// Compares the paths; the active modes were compared before. `Err` where the claim is refuted or cannot be decided.
    pub(crate) fn compare(&self) -> Result<Compared, Outcome> {
        self.same_kind()?;
        let (old, new) = (self.before_leg()?, self.after_leg()?);
        let alike = self.alike(old, new);
        let (was, is) = match (&old.end, &new.end) {
            (Ok(was), Ok(is)) => (was, is),
            (Err(_), Err(_)) if alike => return Ok(Compared::UnknownAlike),
            (Err(_), Err(_)) if !self.claim.is_rewrite() => return self.by_words(),
            (Err(why), _) => return Err(self.no_pose("original", why)),
            (_, Err(why)) => return Err(self.no_pose("changed", why)),
        };
        if was == is && alike {
            return Ok(Compared::Same);
        }
        self.same_ball()?;
        self.same_rotary_words(&old.motion, &new.motion)?;
        let start = old.start.as_ref().zip(new.start.as_ref());
        let way = if start.is_none() && alike {
            Apart::default()
        } else {
            self.way(start, (was, is))?
        };
        let height = self.claim.point_height_mm();
        let moved = zero(&new.motion) - zero(&old.motion);
        let moved = if moved.iter().all(|value| value.is_finite()) {
            moved
        } else {
            Vec3::zeros()
        };
        let shift = |height: f64| ((is.tip + moved + is.axis * height) - (was.tip + was.axis * height)).norm();
        let rotary = self.machine.rotary.iter();
        let change = MotionChange {
            motion: self.at.motion as u64,
            line: self.at.line,
            point_shift_mm: shift(height),
            tip_shift_mm: shift(0.0),
            axis_change_deg: deg(angle_between(&was.axis, &is.axis)),
            rotary_change_deg: rotary.map(|&joint| deg(is.joints[joint] - was.joints[joint])).collect(),
            path_sampled_mm: way.sampled_mm,
            path_bound_mm: way.bound_mm,
            path_axis_bound_deg: deg(way.bound_axis),
        };
        self.judge_end(&change)?;
        self.judge_path(&way, start, (was, is))?;
        Ok(Compared::Changed(Box::new(change)))
    }

    fn before_leg(&self) -> Result<&Leg, Outcome> {
        self.before
            .leg
            .as_ref()
            .ok_or_else(|| self.unknown("no machine is named"))
    }

    fn after_leg(&self) -> Result<&Leg, Outcome> {
        self.after
            .leg
            .as_ref()
            .ok_or_else(|| self.unknown("no machine is named"))
    }

    pub(super) fn refute<T>(&self, message: String) -> Result<T, Outcome> {
        Err(Outcome::refuted_at(self.at.motion, self.at.line, message))
    }

    pub(super) fn unknown(&self, message: &str) -> Outcome {
        Outcome::unknown_at(Some(self.at.line), format!("line {}: {message}", self.at.line))
    }

    fn no_pose(&self, which: &str, why: &NoStance) -> Outcome {
        let why = match why {
            NoStance::PositionUnknown(letters) => format!("the position of {letters} is unknown: program it first"),
            NoStance::Unreachable(_) | NoStance::OutsideLimits { .. } | NoStance::PostureRefused { .. } => {
                "the machine cannot reach the pose".into()
            }
            NoStance::Singular => "the linear axes do not span space at this position of the rotary axes".into(),
            NoStance::NotModelled => "the motion is not modelled".into(),
            NoStance::HeldElsewhere { axis, .. } => {
                format!("the machine file holds axis {} at another position", char::from(*axis))
            }
            NoStance::PlaneMisaligned(_) => "the tool is not perpendicular to the tilted plane".into(),
            NoStance::RotaryOffset(letter) => {
                format!(
                    "a work offset in {} under tool centre point control is not modelled",
                    char::from(*letter)
                )
            }
            NoStance::NoSuchAxis(letter) => format!("the machine has no axis {}", char::from(*letter)),
            NoStance::TurnsSpent(most) => crate::conversion::turns_spent(*most),
        };
        self.unknown(&format!("in the {which} program, {why}"))
    }

    /// What must be equal in a rewrite in addition to what `trunnion_same` compares.
    fn same_kind(&self) -> Result<(), Outcome> {
        let (old, new) = (&self.before.motion, &self.after.motion);
        let differs = if !self.claim.is_rewrite() {
            return Ok(());
        } else if old
            .zero
            .iter()
            .zip(&new.zero)
            .any(|(a, b)| a != b && !(a.is_nan() && b.is_nan()))
        {
            "the zero point"
        } else if old.tcp != new.tcp || old.great_circle != new.great_circle {
            "tool centre point control"
        } else if process_differs(old, new) {
            "feed or spindle"
        } else {
            return Ok(());
        };
        self.refute(format!("{differs} differs between before and after"))
    }

    /// Programmed alike, from a like state.
    fn alike(&self, old: &Leg, new: &Leg) -> bool {
        let mut motion = at_block_of(old, &new.motion);
        if matches!(self.claim, Claim::AdaptedFeed { .. }) {
            // the path does not depend on it
            motion.feed = old.motion.feed;
        }
        old.start == new.start && old.known_joints == new.known_joints && old.motion == motion
    }

    /// A ball, of the claimed radius where one is claimed, must be declared where the motion differs.
    fn same_ball(&self) -> Result<(), Outcome> {
        let claimed = match self.claim {
            Claim::SameBallCentre { ball_radius_mm, .. } => Some(*ball_radius_mm),
            Claim::SameProgrammedCentre { .. } => None,
            _ => return Ok(()),
        };
        for step in [self.before, self.after] {
            match (step.held.ball_radius, claimed) {
                (Some(declared), Some(radius)) if declared != radius => {
                    return self.refute(format!(
                        "the declared ball has a radius of {declared} mm, the claim says {radius} mm"
                    ));
                }
                (Some(_), _) => {}
                (None, _) => {
                    return Err(
                        self.unknown("no ball is declared for this motion: (trunnion: tool 1 ball diameter ...)")
                    );
                }
            }
        }
        self.no_new_swap()
    }

    /// No cut swaps the posture where it did not before.
    fn no_new_swap(&self) -> Result<(), Outcome> {
        let (old, new) = (self.before_leg()?, self.after_leg()?);
        let swaps = |leg: &Leg| leg.rotary_excess > self.machine.tolerances.swap_excess;
        if new.motion.is_feed() && swaps(new) && !swaps(old) {
            return self.refute(format!(
                "the cut swaps the posture with {:.3} deg of rotary travel more than needed, and did not before",
                deg(new.rotary_excess)
            ));
        }
        Ok(())
    }

    /// How far apart the paths between the ends are.
    fn way(&self, start: Option<Both<'_>>, end: Both<'_>) -> Result<Apart, Outcome> {
        let (old, new) = (self.before_leg()?, self.after_leg()?);
        let Some((was, is)) = start else {
            // straight from a position unknown to both, from which nothing is checked (interface section 7)
            let straight = matches!(old.motion.kind, MotionKind::Rapid | MotionKind::Linear);
            let comparable = old.motion.tcp == new.motion.tcp && straight && old.start.is_none() && new.start.is_none();
            return if comparable {
                Ok(Apart::default())
            } else {
                Err(self.unknown("the position before is unknown"))
            };
        };
        if self.same_full_turns((was, is), end) {
            return Ok(Apart::default());
        }
        let height = self.claim.point_height_mm();
        let before = Path::new(self.machine, old, was, end.0, height);
        let after = Path::new(self.machine, new, is, end.1, height);
        let (Some(before), Some(after)) = (before, after) else {
            return self.arcs((was, is), end);
        };
        Ok(apart(&before, &after))
    }

    /// Programmed alike but for the same whole turns of rotary axes at both ends: then the path is the same whatever its shape.
    fn same_full_turns(&self, start: Both<'_>, end: Both<'_>) -> bool {
        let turned_only = |(was, is): Both<'_>| {
            let off = |&joint: &usize| off_whole_turns(deg(is.joints[joint] - was.joints[joint]));
            (was.tip - is.tip).norm() <= 1e-9 && self.machine.rotary.iter().all(|joint| off(joint) <= 1e-9)
        };
        let (Some(old), Some(new)) = (&self.before.leg, &self.after.leg) else {
            return false;
        };
        let mut motion = at_block_of(old, &new.motion);
        for axis in 3..6 {
            motion.start.values[axis] = old.motion.start.values[axis];
            motion.end.values[axis] = old.motion.end.values[axis];
        }
        motion == old.motion && self.turns(start) == self.turns(end) && turned_only(start) && turned_only(end)
    }

    /// Whole turns between two stances, each rotary axis.
    fn turns(&self, (was, is): Both<'_>) -> Vec<i64> {
        let turns = |&joint: &usize| (deg(is.joints[joint] - was.joints[joint]) / 360.0).round() as i64;
        self.machine.rotary.iter().map(turns).collect()
    }

    /// Compares the numbers at the block's end with the claim.
    fn judge_end(&self, change: &MotionChange) -> Result<(), Outcome> {
        let (mm, degrees) = self.claim.tolerances();
        let point = if self.claim.point_height_mm() == 0.0 {
            "tool tip"
        } else {
            "ball's centre"
        };
        if above(change.point_shift_mm, mm) {
            let shift = change.point_shift_mm;
            return self.refute(format!(
                "the {point} shifts by {shift:.6} mm at the block's end; {mm} mm is allowed"
            ));
        }
        if above(change.axis_change_deg, degrees) {
            let turn = change.axis_change_deg;
            return self.refute(format!(
                "the tool axis turns by {turn:.6} deg at the block's end; {degrees} deg is allowed"
            ));
        }
        let off = change
            .rotary_change_deg
            .iter()
            .find(|&&value| above(off_whole_turns(value), degrees));
        match off {
            Some(value) if matches!(self.claim, Claim::SamePoses { .. }) => self.refute(format!(
                "a rotary axis differs by {value:.6} deg, which is not a number of whole turns"
            )),
            _ => Ok(()),
        }
    }

    /// Compares what is between the ends with the claim.
    fn judge_path(&self, way: &Apart, start: Option<Both<'_>>, end: Both<'_>) -> Result<(), Outcome> {
        let claimed = match self.claim {
            Claim::SameBallCentre { .. } | Claim::SameProgrammedCentre { .. } | Claim::LeastPostures { .. } => false,
            Claim::SamePoses { .. } => start.is_some_and(|start| self.turns(start) == self.turns(end)),
            Claim::AdaptedFeed { .. }
            | Claim::InsertedPoints { .. }
            | Claim::InsertedRetracts { .. }
            | Claim::SameToolPath { .. }
            | Claim::RefittedPath { .. }
            | Claim::ClearRapids { .. }
            | Claim::SamePath { .. } => !self.ends_only,
        };
        let (mm, degrees) = self.claim.tolerances();
        let (sampled_axis, bound_axis) = (deg(way.sampled_axis), deg(way.bound_axis));
        if claimed && (above(way.sampled_mm, mm) || above(sampled_axis, degrees)) {
            return self.refute(format!(
                "inside the block the tips are {:.6} mm and the tool axes {sampled_axis:.6} deg apart; {mm} mm and {degrees} deg are allowed",
                way.sampled_mm
            ));
        }
        if claimed && (above(way.bound_mm, mm) || above(bound_axis, degrees)) {
            return Err(self.unknown(&format!(
                "the bounds of {:.6} mm and {bound_axis:.6} deg inside the block do not prove {mm} mm, {degrees} deg",
                way.bound_mm
            )));
        }
        Ok(())
    }
}

/// Whether feed or spindle differ.
pub(crate) fn process_differs(old: &Motion, new: &Motion) -> bool {
    old.feed != new.feed || old.spindle_on != new.spindle_on || old.spindle_rpm != new.spindle_rpm
}

/// A motion with the block of another leg, so that the block's number does not affect a comparison.
pub(crate) fn at_block_of(leg: &Leg, motion: &Motion) -> Motion {
    Motion {
        block: leg.motion.block,
        chain: leg.motion.chain,
        effects: leg.motion.effects,
        ..*motion
    }
}

/// Distance of an angle from the nearest number of whole turns, deg.
fn off_whole_turns(degrees: f64) -> f64 {
    (degrees - 360.0 * (degrees / 360.0).round()).abs()
}

/// Above the limit, or not a number.
pub(super) fn above(value: f64, limit: f64) -> bool {
    value.is_nan() || value > limit
}

/// Distance of forward kinematics from the programmed pose at the end of a leg: mm, deg. `None` where no pose is known.
pub(crate) fn forward_residual(machine: &Machine, at: Place, leg: &Leg) -> Result<Option<(f64, f64)>, Outcome> {
    let zero = &leg.motion.zero;
    let line = at.line;
    let no_zero = || {
        let text = format!("line {line}: the zero point is unknown, so the position of the machine is unknown");
        Err(Outcome::unknown(text))
    };
    let lost = zero.iter().any(|value| !value.is_finite());
    let Ok(stance) = &leg.end else {
        return if lost { no_zero() } else { Ok(None) };
    };
    let pose = forward(machine, &stance.joints, stance.tool_length);
    let (mm, degrees) = (
        (pose.tip - Vec3::new(zero[0], zero[1], zero[2]) - stance.tip).norm(),
        deg(angle_between(&pose.axis, &stance.axis)),
    );
    if above(mm, FORWARD_TOLERANCE) || above(degrees, FORWARD_TOLERANCE) {
        if lost {
            return no_zero();
        }
        return Err(Outcome::unknown(format!(
            "line {line}: forward kinematics misses the pose by {mm:e} mm, {degrees:e} deg"
        )));
    }
    Ok(Some((mm, degrees)))
}

#[cfg(test)]
mod tests {
    #[test]
    fn what_is_not_a_number_keeps_no_limit() {
        assert!(super::above(f64::NAN, 1.0) && super::above(1.1, 1.0) && !super::above(1.0, 1.0));
    }
}
