//! Joints outside their travel, at the end of a block or inside it.
use crate::bound::{Piece, peak};
use crate::course::{Course, Track};
use crate::{AxisKind, Leg, Limits, Machine};

/// One joint outside its travel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Excess {
    /// Index of the axis.
    pub axis: usize,
    /// Worst value, mm or rad.
    pub value: f64,
    /// The limit it breaks, mm or rad.
    pub limit: f64,
    /// Whether it happens inside the block while both ends are legal.
    pub inside: bool,
}

/// How far a joint may lie beyond its limit and still count as on it, mm or rad: rounding.
const SLACK: f64 = 1e-6;

/// How near sample and bound are brought, mm, where a limit is broken inside a block.
const CLOSE_MM: f64 = 1e-3;

/// All joints outside their travel in this leg. At the end: the known joints, also where the stance is not known. Inside the block
/// (while both ends are legal): linear joints under TCP or along arcs, by the bound of kinematics notes 3 and bisection; other joints
/// run straight from end to end and cannot leave their travel in between.
pub fn limit_excess(machine: &Machine, leg: &Leg, out: &mut Vec<Excess>) {
    let (joints, known) = (&leg.known_joints.0, leg.known_joints.1);
    for (axis, entry) in machine.axes.iter().enumerate() {
        if known & (1 << axis) != 0
            && let Some(limit) = broken(entry.limits, joints[axis])
        {
            out.push(Excess { axis, value: joints[axis], limit, inside: false });
        }
    }
    if let Some(course) = Course::new(machine, leg)
        && bends(&course)
    {
        inside(&course, out);
    }
}

/// The limit that a value breaks.
fn broken(limits: Limits, value: f64) -> Option<f64> {
    let Limits::Range(low, high) = limits else { return None };
    if value > high + SLACK {
        Some(high)
    } else if value < low - SLACK {
        Some(low)
    } else {
        None
    }
}

/// Whether linear joints can run otherwise than straight.
fn bends(course: &Course<'_>) -> bool {
    matches!(course.track, Track::Arc(_)) || (course.tip && course.turns_at_all())
}

/// Linear joints that leave their travel between two legal ends.
fn inside(course: &Course<'_>, out: &mut Vec<Excess>) {
    let constants = &course.machine.constants;
    let (_, bends) = course.bends();
    for (slot, &index) in constants.solved.iter().enumerate() {
        let axis = constants.linear[index].joint;
        let entry = &course.machine.axes[axis];
        debug_assert_eq!(entry.kind, AxisKind::Linear);
        let Limits::Range(low, high) = entry.limits else { continue };
        let (from, to) = (course.start.joints[axis], course.end.joints[axis]);
        if broken(entry.limits, from).is_some() || broken(entry.limits, to).is_some() {
            continue;
        }
        for (sign, limit) in [(1.0, high), (-1.0, low)] {
            let over = |q: f64| sign * (q - limit);
            if over(from).max(over(to)) + bends[slot] * 0.125 <= SLACK {
                continue;
            }
            let found = peak(
                |t| over(course.moment(t).solved[slot]),
                |piece: &Piece| piece.below_parabola(bends[slot]),
                |bound, sampled, _| bound <= SLACK || (sampled > SLACK && bound <= sampled + CLOSE_MM),
            );
            if found.sampled > SLACK {
                out.push(Excess { axis, value: limit + sign * found.sampled, limit, inside: true });
            }
        }
    }
}
