//! Motions that do nothing, and motions that another program makes in several pieces.
use crate::Claim;
use crate::item::Step;
use trunnion_geometry::arc::Arc;
use trunnion_interp::{Argument, Feed, MotionKind, Orientation, Position, Swivel};

/// A coordinate that differs by no more has not moved, mm or deg: sums of offsets are rounded.
const STANDS: f64 = 1e-9;

/// Whether a motion moves nothing and takes no time: a block that repeats the position before it.
pub(crate) fn is_idle(step: &Step) -> bool {
    step.may_repeat && step.said.is_none() && stays(step) && !runs_beside(step)
}

/// Whether the tool runs beside the programmed path by an amount that is not computed: how a corner is cut depends on all blocks around it.
fn runs_beside(step: &Step) -> bool {
    step.motion.undeclared.beside != 0
}

/// Why two motions cannot be compared where one program has a block that the other has not, and the tool runs beside the programmed path by
/// an amount that nobody declares.
pub(crate) fn blocks_count(was: &Step, is: &Step, is_cut: bool) -> Option<String> {
    let beside = runs_beside(was) || runs_beside(is);
    (beside && (is_cut || stays(was) != stays(is))).then(|| {
        "one of them makes this path in more blocks under cutter radius compensation, and the radius is not declared: how the control cuts the corners \
         depends on the blocks"
            .to_owned()
    })
}

/// Whether a motion repeats the position before it, after something that may have moved the machine.
pub(crate) fn repeats_place(step: &Step) -> bool {
    !step.may_repeat && stays(step)
}

fn stays(step: &Step) -> bool {
    let motion = &step.motion;
    let same_place = |a: &Position, b: &Position| {
        a.known == b.known
            && (0..9).all(|axis| a.known & (1 << axis) == 0 || (a.values[axis] - b.values[axis]).abs() <= STANDS)
    };
    let turned = match motion.orientation {
        Orientation::Words => false,
        Orientation::Vector(start, end) => start != Some(end),
    };
    let open = step.leg.as_ref().is_some_and(|leg| leg.open.is_some());
    matches!(motion.kind, MotionKind::Rapid | MotionKind::Linear)
        && !matches!(motion.feed, Feed::InverseTime(_))
        && motion.tilt.swivel == Swivel::No
        && motion.tilt.free == 0
        && motion.end.known != 0
        && motion.says_way & !motion.end.known == 0
        && !turned
        && !motion.machine_coordinates
        && step.process.get("coordinates").is_empty()
        && !open
        && same_place(&motion.start, &motion.end)
        && !is_coupled(step)
}

/// The settings that may couple the feed to the speed of the spindle.
pub const COUPLING_KEYS: [&str; 2] = ["cycle", "path-control"];

/// Whether a setting of [`COUPLING_KEYS`] does: a tap, a thread, a boring cycle, or the tapping mode of a control.
pub fn couples_feed(key: &str, to: &[Argument]) -> bool {
    match key {
        "cycle" => !to.is_empty(),
        "path-control" => to.first().is_some_and(|code| code.name == "G63"),
        _ => false,
    }
}

/// Whether the feed belongs to the speed of the spindle.
pub(crate) fn feed_is_a_pitch(step: &Step) -> bool {
    COUPLING_KEYS.iter().any(|key| couples_feed(key, step.process.get(key)))
}

/// Whether a cycle or the spindle is coupled to the motion.
fn is_coupled(step: &Step) -> bool {
    !step.process.get("cycle").is_empty()
}

/// Whether a motion may be made in several pieces without a difference: not if each piece ends with a stop, has its own time, or is coupled
/// to the spindle.
pub(crate) fn may_be_cut(step: &Step) -> bool {
    let stops = step.process.get("path-control").first();
    let exact = |code: &str| code == "G61" && !step.process.exact_path();
    let stops = stops.is_some_and(|code| matches!(code.name.as_ref(), "G60" | "G61.1") || exact(&code.name));
    !stops
        && !is_coupled(step)
        && !matches!(step.motion.feed, Feed::InverseTime(_))
        && step.motion.tilt.swivel == Swivel::No
}

/// Cuts `long` where `short` ends, if that is on it within `mm` and `deg`: then `long` becomes the rest of it, and the largest
/// distance of the point from it is returned (mm or deg).
pub(crate) fn cut(long: &mut Step, short: &Step, claim: &Claim) -> Option<f64> {
    let (mm, deg) = (claim.mm, claim.deg);
    if !may_be_cut(long) || !may_be_cut(short) {
        return None;
    }
    let (motion, end) = (&long.motion, &short.motion.end);
    if motion.start.known != motion.end.known || end.known != motion.end.known {
        return None;
    }
    let offset = |axis: usize| short.motion.zero[axis] - motion.zero[axis];
    let mut point = motion.end;
    for axis in 0..9 {
        point.values[axis] = end.values[axis] + if offset(axis).is_nan() { 0.0 } else { offset(axis) };
    }
    let share = match (&motion.kind, &short.motion.kind) {
        (MotionKind::Linear, MotionKind::Linear) => straight_share(motion.start, motion.end, point),
        (MotionKind::Rapid, MotionKind::Rapid) => {
            // the axes of a rapid may move independently: then its path is straight only where one axis moves
            let moving = (0..9).filter(|axis| (motion.end.values[*axis] - motion.start.values[*axis]).abs() > STANDS);
            if !claim.straight_rapids && moving.count() != 1 {
                return None;
            }
            straight_share(motion.start, motion.end, point)
        }
        (MotionKind::Arc(Some(arc)), MotionKind::Arc(Some(piece))) => arc_share(arc, piece, (mm, deg)),
        _ => None,
    }?;
    let turns = (3..6).any(|axis| (motion.end.values[axis] - motion.start.values[axis]).abs() > STANDS);
    match motion.orientation {
        // rotary words may be interpolated on a great circle, which is not linear in them
        Orientation::Words if turns && motion.tcp && motion.great_circle != Some(false) => return None,
        Orientation::Words => {}
        Orientation::Vector(Some(start), to) if (start - to).norm() <= STANDS => {}
        Orientation::Vector(..) => return None,
    }
    let mut off: f64 = 0.0;
    for axis in 0..9 {
        if motion.end.known & (1 << axis) == 0 {
            continue;
        }
        if matches!(motion.kind, MotionKind::Arc(_)) && axis < 3 {
            continue;
        }
        let (from, to) = (motion.start.values[axis], motion.end.values[axis]);
        let distance = (from + (to - from) * share - point.values[axis]).abs();
        let limit = if (3..6).contains(&axis) { deg } else { mm };
        if distance > limit {
            return None;
        }
        off = off.max(distance);
    }
    if let (MotionKind::Arc(Some(arc)), Some(at)) = (&motion.kind, point.xyz()) {
        let distance = (arc.point_at(share) - at).norm();
        if distance > mm {
            return None;
        }
        off = off.max(distance);
    }
    let kind = match motion.kind {
        MotionKind::Arc(Some(arc)) => MotionKind::Arc(Some(rest(&arc, share))),
        kind => kind,
    };
    long.motion.kind = kind;
    long.motion.start = point;
    if let (Some(leg), Some(other)) = (&mut long.leg, &short.leg) {
        leg.start = other.end.as_ref().ok().copied();
        leg.motion = long.motion;
    }
    long.is_part = true;
    long.starts_anew = false;
    Some(off)
}

/// The share of a straight motion at which it comes nearest to a point, by the axis that moves most; `None` outside of it.
fn straight_share(start: Position, end: Position, point: Position) -> Option<f64> {
    let change = |axis: usize| end.values[axis] - start.values[axis];
    let axis = (0..9)
        .filter(|axis| end.known & (1 << axis) != 0)
        .max_by(|a, b| change(*a).abs().total_cmp(&change(*b).abs()))?;
    let share = (point.values[axis] - start.values[axis]) / change(axis);
    (share > 0.0 && share < 1.0).then_some(share)
}

/// The share of an arc that a piece from its start covers.
fn arc_share(arc: &Arc, piece: &Arc, (mm, _): (f64, f64)) -> Option<f64> {
    let share = piece.sweep / arc.sweep * arc.normal.dot(&piece.normal).signum();
    let along = arc.normal.cross(&piece.normal).norm() <= 1e-9;
    let height = |centre: trunnion_geometry::Vec3| centre - arc.normal * arc.normal.dot(&centre);
    let centred = (height(arc.centre) - height(piece.centre)).norm() <= mm;
    (along && centred && share > 0.0 && share < 1.0).then_some(share)
}

/// The rest of an arc after a share of it.
fn rest(arc: &Arc, share: f64) -> Arc {
    let start = arc.point_at(share);
    Arc {
        start,
        centre: arc.centre + arc.normal * arc.normal.dot(&(start - arc.start)),
        sweep: arc.sweep * (1.0 - share),
        radius_start: arc.radius_start + (arc.radius_end - arc.radius_start) * share,
        ..*arc
    }
}
