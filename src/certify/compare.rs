//! Two legs of the same number, one of each program: what differs, in numbers.
use crate::Claim;
use crate::certificate::MotionChange;
use crate::path::{Apart, Path, apart};
use crate::rerun::Step;
use crate::verdict::Stop;
use trunnion_geometry::deg;
use trunnion_geometry::math::angle_between;
use trunnion_interp::Motion;
use trunnion_machine::{Leg, Machine, NoStance, Stance, forward};

/// Forward kinematics may differ from the programmed pose by this much, mm and deg: more is a fault of this program, not a claim.
const FORWARD_TOLERANCE: f64 = 1e-6;

/// What comparing two legs gave.
pub(crate) enum Compared {
    /// Nothing differs.
    Same,
    /// The position is unknown in both, but they are programmed alike from a like state.
    UnknownAlike,
    /// They differ.
    Changed(Box<MotionChange>),
}

/// Where in the programs two legs stand.
#[derive(Clone, Copy)]
pub(crate) struct Place {
    /// Index of the motion.
    pub motion: usize,
    /// Line in the program after.
    pub line: u32,
}

/// Compares two legs under a claim.
pub(crate) fn compare(
    machine: &Machine,
    claim: &Claim,
    at: Place,
    before: &Step,
    after: &Step,
) -> Result<Compared, Stop> {
    let (old, new) = (&before.leg, &after.leg);
    same_kind(claim, at, &old.motion, &new.motion)?;
    let (was, is) = match (&old.end, &new.end) {
        (Ok(was), Ok(is)) => (was, is),
        (Err(_), Err(_)) if alike(old, new) => return Ok(Compared::UnknownAlike),
        (Err(why), _) => return Err(unknown(at, "before", why)),
        (_, Err(why)) => return Err(unknown(at, "after", why)),
    };
    if was == is && old.start == new.start && alike(old, new) {
        return Ok(Compared::Same);
    }
    if let Claim::SameBallCentre { ball_radius_mm, .. } = claim {
        same_ball(at, *ball_radius_mm, before, after)?;
    }
    let height = claim.point_height_mm();
    let way = way_between(machine, claim, at, old, new, height)?;
    let shift = |height: f64| ((is.tip + is.axis * height) - (was.tip + was.axis * height)).norm();
    let rotary = machine
        .rotary
        .iter()
        .map(|&joint| deg(is.joints[joint] - was.joints[joint]))
        .collect();
    let change = MotionChange {
        motion: at.motion as u64,
        line: at.line,
        point_shift_mm: shift(height),
        tip_shift_mm: shift(0.0),
        axis_change_deg: deg(angle_between(&was.axis, &is.axis)),
        rotary_change_deg: rotary,
        path_sampled_mm: way.sampled_mm,
        path_bound_mm: way.bound_mm,
        path_axis_bound_deg: deg(way.bound_axis),
    };
    judge(claim, at, &change, &way, turns_change(machine, old, new))?;
    Ok(Compared::Changed(Box::new(change)))
}

/// What must be equal whatever is claimed, and what must be equal in a rewrite.
fn same_kind(claim: &Claim, at: Place, old: &Motion, new: &Motion) -> Result<(), Stop> {
    let refuse = |what: &str| {
        Err(Stop::refuted_at(
            at.motion,
            at.line,
            format!("{what} differs between before and after"),
        ))
    };
    if core::mem::discriminant(&old.kind) != core::mem::discriminant(&new.kind) {
        return refuse("the kind of motion (rapid, line, arc, dwell)");
    }
    if old.zero != new.zero || old.machine_coordinates != new.machine_coordinates {
        return refuse("the zero point");
    }
    if old.tool != new.tool || old.tool_length_mm != new.tool_length_mm {
        return refuse("the tool or its length");
    }
    if !claim.is_rewrite() {
        return Ok(());
    }
    if old.tcp != new.tcp || old.great_circle != new.great_circle {
        return refuse("tool centre point control");
    }
    if process_differs(old, new) {
        return refuse("feed or spindle");
    }
    Ok(())
}

/// Whether feed or spindle differ.
pub(crate) fn process_differs(old: &Motion, new: &Motion) -> bool {
    old.feed != new.feed || old.spindle_on != new.spindle_on || old.spindle_rpm != new.spindle_rpm
}

/// Programmed alike, from a like state. The block's number plays no part.
fn alike(old: &Leg, new: &Leg) -> bool {
    let new_motion = Motion {
        block: old.motion.block,
        ..new.motion
    };
    old.start == new.start && old.known_joints == new.known_joints && old.motion == new_motion
}

fn unknown(at: Place, which: &str, why: &NoStance) -> Stop {
    let why = match why {
        NoStance::PositionUnknown(letters) => format!("the position of {letters} is unknown: program all axes before"),
        NoStance::Unreachable(_) | NoStance::OutsideLimits { .. } => "the machine cannot reach the pose".into(),
        NoStance::NotModelled => "the motion is not modelled".into(),
        NoStance::NoSuchAxis(letter) => format!("the machine has no axis {}", char::from(*letter)),
    };
    Stop::unknown(format!("line {}: in the program {which}, {why}", at.line))
}

/// A ball of the claimed radius must be declared where the motion differs.
fn same_ball(at: Place, radius: f64, before: &Step, after: &Step) -> Result<(), Stop> {
    for step in [before, after] {
        match step.ball_radius {
            Some(declared) if declared == radius => {}
            Some(declared) => {
                let message = format!("the declared ball has a radius of {declared} mm, the claim says {radius} mm");
                return Err(Stop::refuted_at(at.motion, at.line, message));
            }
            None => {
                return Err(Stop::unknown(format!(
                    "line {}: no ball tool is declared for this motion: (trunnion: tool 1 ball diameter ...) or --tool ball:D",
                    at.line
                )));
            }
        }
    }
    Ok(())
}

/// The difference of whole turns between the programs changes inside this motion.
fn turns_change(machine: &Machine, old: &Leg, new: &Leg) -> bool {
    let (Some(from), Some(to)) = (
        shift_of(machine, old.start, new.start),
        shift_of(machine, old.end.as_ref().ok().copied(), new.end.as_ref().ok().copied()),
    ) else {
        return false;
    };
    from != to
}

/// Whole turns between two stances, each rotary axis.
fn shift_of(machine: &Machine, was: Option<Stance>, is: Option<Stance>) -> Option<Vec<i64>> {
    let (was, is) = (was?, is?);
    let turns = |&joint: &usize| (deg(is.joints[joint] - was.joints[joint]) / 360.0).round() as i64;
    Some(machine.rotary.iter().map(turns).collect())
}

/// How far the ways between the ends lie apart.
fn way_between(machine: &Machine, claim: &Claim, at: Place, old: &Leg, new: &Leg, height: f64) -> Result<Apart, Stop> {
    let (was, is) = match (old.start, new.start) {
        (Some(was), Some(is)) => (was, is),
        (None, None) if alike(old, new) => return Ok(Apart::default()),
        // both come from an unknown position; the ends are compared all the same
        (None, None) if claim.is_rewrite() => return Ok(Apart::default()),
        _ => {
            return Err(Stop::unknown(format!(
                "line {}: the position before this motion is unknown",
                at.line
            )));
        }
    };
    let (Ok(was_end), Ok(is_end)) = (&old.end, &new.end) else {
        return Ok(Apart::default());
    };
    if same_way(machine, old, new) {
        return Ok(Apart::default());
    }
    let paths = Path::new(machine, old, was, *was_end, height).zip(Path::new(machine, new, is, *is_end, height));
    let Some((before, after)) = paths else {
        return Err(Stop::unknown(format!(
            "line {}: how far two different arcs lie apart is not modelled",
            at.line
        )));
    };
    Ok(apart(&before, &after))
}

/// Programmed alike but for the same whole turns of rotary axes at both ends: then the way is the same whatever its shape.
fn same_way(machine: &Machine, old: &Leg, new: &Leg) -> bool {
    let mut motion = Motion {
        block: old.motion.block,
        ..new.motion
    };
    let ends = [
        (old.start, new.start),
        (old.end.as_ref().ok().copied(), new.end.as_ref().ok().copied()),
    ];
    let shifts = ends.map(|(was, is)| shift_of(machine, was, is));
    if shifts[0].is_none() || shifts[0] != shifts[1] {
        return false;
    }
    for (was, is) in ends {
        let (Some(was), Some(is)) = (was, is) else { return false };
        let off = |&joint: &usize| {
            let change = deg(is.joints[joint] - was.joints[joint]);
            (change - 360.0 * (change / 360.0).round()).abs()
        };
        if was.tip != is.tip && (was.tip - is.tip).norm() > 1e-9 || machine.rotary.iter().map(off).any(|off| off > 1e-9)
        {
            return false;
        }
    }
    for axis in 3..6 {
        motion.start.values[axis] = old.motion.start.values[axis];
        motion.end.values[axis] = old.motion.end.values[axis];
    }
    motion == old.motion
}

/// Holds the numbers against the claim.
fn judge(claim: &Claim, at: Place, change: &MotionChange, way: &Apart, turns_change: bool) -> Result<(), Stop> {
    let (mm, degrees) = claim.tolerances();
    let refuse = |message: String| Err(Stop::refuted_at(at.motion, at.line, message));
    let point = if matches!(claim, Claim::SameBallCentre { .. }) {
        "ball's centre"
    } else {
        "tool tip"
    };
    if above(change.point_shift_mm, mm) {
        return refuse(format!(
            "the {point} shifts by {:.6} mm at the block's end, allowed is {mm} mm",
            change.point_shift_mm
        ));
    }
    if above(change.axis_change_deg, degrees) {
        return refuse(format!(
            "the tool axis turns by {:.6} deg at the block's end, allowed is {degrees} deg",
            change.axis_change_deg
        ));
    }
    let bound_claimed = match claim {
        Claim::SameBallCentre { .. } => return Ok(()),
        Claim::SamePoses { .. } => {
            for value in &change.rotary_change_deg {
                let off = value - 360.0 * (value / 360.0).round();
                if above(off.abs(), degrees) {
                    return refuse(format!(
                        "a rotary axis differs by {value:.6} deg, which is not a number of whole turns"
                    ));
                }
            }
            !turns_change
        }
        Claim::SameToolPath { .. } => true,
    };
    if bound_claimed && (above(way.sampled_mm, mm) || above(deg(way.sampled_axis), degrees)) {
        return refuse(format!(
            "inside the block the tips lie {:.6} mm apart and the tool axes {:.6} deg; allowed is {mm} mm and {degrees} deg",
            way.sampled_mm,
            deg(way.sampled_axis)
        ));
    }
    if bound_claimed && (above(way.bound_mm, mm) || above(deg(way.bound_axis), degrees)) {
        return Err(Stop::unknown(format!(
            "line {}: the tips lie at most {:.6} mm apart and the tool axes {:.6} deg, which is not enough to prove {mm} mm and {degrees} deg",
            at.line,
            way.bound_mm,
            deg(way.bound_axis)
        )));
    }
    Ok(())
}

/// Above the limit, or not a number.
fn above(value: f64, limit: f64) -> bool {
    value.is_nan() || value > limit
}

/// Distance of forward kinematics from the programmed pose at the end of a leg: mm, deg. `None` where no pose is known.
pub(crate) fn forward_residual(machine: &Machine, at: Place, leg: &Leg) -> Result<Option<(f64, f64)>, Stop> {
    let Ok(stance) = &leg.end else { return Ok(None) };
    let pose = forward(machine, &stance.joints, stance.tool_length);
    let zero = &leg.motion.zero;
    let tip = pose.tip - trunnion_geometry::Vec3::new(zero[0], zero[1], zero[2]);
    let residual = ((tip - stance.tip).norm(), deg(angle_between(&pose.axis, &stance.axis)));
    if above(residual.0, FORWARD_TOLERANCE) || above(residual.1, FORWARD_TOLERANCE) {
        return Err(Stop::unknown(format!(
            "line {}: forward kinematics of the joints misses the pose by {:e} mm and {:e} deg",
            at.line, residual.0, residual.1
        )));
    }
    Ok(Some(residual))
}
