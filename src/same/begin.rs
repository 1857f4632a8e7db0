//! Where two motions begin, and whether one whose start is unknown may be a part of the other.
use crate::Claim;
use crate::cut::may_be_cut;
use crate::item::{Item, Step};
use crate::near::same_sort;
use crate::verdict::{Difference, Verdict};
use trunnion_interp::{AXIS_LETTERS, Motion, MotionKind, Orientation, Position};

/// A motion begins where the one before it ended, and these were compared, unless a statement (FROM of APT) says where the tool is: whether two
/// begin at one place.
pub(crate) fn begin_alike(was: &Step, is: &Step, claim: &Claim) -> Result<(), Verdict> {
    let (a, b) = (&was.motion, &is.motion);
    let other_frame = a.zero.map(f64::to_bits) != b.zero.map(f64::to_bits) || a.tcp != b.tcp || !same_sort(a, b);
    if a.machine_coordinates || b.machine_coordinates || other_frame || a.kind == MotionKind::Unknown {
        return Ok(());
    }
    let letter = |mask: u16| {
        AXIS_LETTERS
            .into_iter()
            .zip(0..9)
            .find(|(_, axis)| mask & (1 << axis) != 0)
    };
    let place = |what: String| Difference {
        before: Some(a.block),
        after: Some(b.block),
        what,
    };
    let both = a.start.known & b.start.known & a.end.known;
    // ends that were compared may be off by the tolerance, and a cut may be off by it too
    let off = |axis: usize| (a.start.values[axis] - b.start.values[axis]).abs() > 2.0 * limit(axis, claim);
    let elsewhere = (0..9).filter(|axis| off(*axis)).fold(0, |all, axis| all | 1 << axis) & both;
    let anew = was.starts_anew || is.starts_anew;
    if let Some((letter, axis)) = letter(elsewhere).filter(|_| anew) {
        let (from, to) = (a.start.values[axis], b.start.values[axis]);
        let letter = char::from(letter);
        return Err(Verdict::Differs(place(format!(
            "they begin at different places: {letter}{from} and {letter}{to}"
        ))));
    }
    // a rapid may take any way; where both end at one place, only the way of a cut is open
    let open = (a.start.known ^ b.start.known) & a.end.known & b.end.known;
    match letter(open).filter(|_| !claim.across && a.is_feed()) {
        Some((letter, _)) => Err(Verdict::Unknown(place(format!(
            "where {} begins is known in only one of the programs",
            char::from(letter)
        )))),
        None => Ok(()),
    }
}

fn limit(axis: usize, claim: &Claim) -> f64 {
    if (3..6).contains(&axis) { claim.deg } else { claim.mm }
}

fn is_straight(motion: &Motion) -> bool {
    matches!(motion.kind, MotionKind::Linear | MotionKind::Rapid)
}

/// Whether the points of a motion between its ends are unknown: its start is, or how the tool turns on the way.
pub(crate) fn way_is_open(step: &Step) -> bool {
    let motion = &step.motion;
    let turns = || (3..6).any(|axis| (motion.start.values[axis] - motion.end.values[axis]).abs() > 1e-9);
    let turn_is_open = match motion.orientation {
        Orientation::Words => motion.tcp && motion.great_circle != Some(false) && turns(),
        Orientation::Vector(start, end) => start != Some(end),
    };
    is_straight(motion) && may_be_cut(step) && (motion.start.known != motion.end.known || turn_is_open)
}

/// Whether a motion may be a part of another that ends elsewhere, as far as is known: the motion after it goes on to where the other ends. For
/// two of which [`way_is_open`] holds for one.
pub(crate) fn may_be_part(short: &Step, long: &Step, next: Option<&Item>, claim: &Claim) -> bool {
    let (piece, whole) = (&short.motion, &long.motion);
    if !is_straight(piece) || core::mem::discriminant(&piece.kind) != core::mem::discriminant(&whole.kind) {
        return false;
    }
    if !continues(&whole.start, &piece.end, &whole.end, claim) {
        return false;
    }
    let rest = match next {
        Some(Item::Motion(next)) if is_straight(&next.motion) => &next.motion,
        Some(Item::Motion(next)) => return next.motion.kind == MotionKind::Unknown,
        // what is not modelled may move
        Some(Item::Happens { .. }) => return true,
        None => return false,
    };
    continues(&piece.end, &rest.end, &whole.end, claim)
}

/// Whether the way from `corner` to `next` goes along the way from `corner` to `goal`, in the axes known in all three. Rotary axes may run
/// nearly so: on a great circle their words are not linear.
fn continues(corner: &Position, next: &Position, goal: &Position, claim: &Claim) -> bool {
    let known = corner.known & next.known & goal.known;
    let axes: Vec<usize> = (0..9).filter(|axis| known & (1 << axis) != 0).collect();
    let to = |end: &Position, axis: usize| end.values[axis] - corner.values[axis];
    let Some(&widest) = axes
        .iter()
        .max_by(|a, b| to(goal, **a).abs().total_cmp(&to(goal, **b).abs()))
    else {
        return true;
    };
    if to(goal, widest).abs() <= limit(widest, claim) {
        // nothing moves in the axes that are known
        return axes
            .iter()
            .all(|axis| to(next, *axis).abs() <= 2.0 * limit(*axis, claim));
    }
    let share = to(next, widest) / to(goal, widest);
    let off = |axis: usize| (to(next, axis) - share * to(goal, axis)).abs();
    let bend = |axis: usize| {
        if (3..6).contains(&axis) {
            0.05 * to(goal, axis).abs()
        } else {
            0.0
        }
    };
    share > 0.0
        && axes
            .iter()
            .all(|axis| off(*axis) <= (2.0 * limit(*axis, claim) + bend(*axis)) * share.max(1.0))
}
