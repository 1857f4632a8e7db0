//! Joints outside their travel, at the end of a block or inside it.
use crate::follow::follower::leads_path;
use crate::path::curvature::rough_bends;
use crate::path::joint_path::JointPath;
use crate::path::peak::{Piece, peak};
use crate::path::rotary_path::RotaryPath;
use crate::{Joints, Leg, Limits, Machine, RapidPath};
use trunnion_interp::MotionKind;

/// One joint outside its travel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Excess {
    /// Index of the axis.
    pub axis: usize,
    /// Worst value, mm or rad.
    pub value: f64,
    /// The limit it breaks, mm or rad.
    pub limit: f64,
    /// Whether it happens inside the block while both ends are legal on this axis.
    pub inside: bool,
    /// Only if the axes of this rapid arrive together, which the machine file does not declare.
    pub if_together: bool,
}

/// How far a joint may be beyond its limit and still be taken as on it, mm or rad: rounding.
pub const LIMIT_SLACK: f64 = 1e-6;

/// How near sample and bound are brought, mm, where a limit is broken inside a block.
const CLOSE_MM: f64 = 1e-3;

/// All joints outside their travel in this leg, each limit once with the worst value. At the end: the known joints, also
/// where the stance is not known; at a start that the program gave without a motion, all of them. Inside the block, whatever its ends
/// are: linear joints under TCP or along arcs, and rotary ones on a great circle, by the bound of docs/kinematics.md#between-the-ends-of-a-block and bisection;
/// other joints move linearly from end to end, so that an end is their worst. A joint that only returns from beyond its limit is not
/// named again: the block before named it.
///
/// False where what happens between the ends is not known (a great circle over the pole): findings are then true, but their
/// absence is not proven.
pub fn limit_excess(machine: &Machine, leg: &Leg, out: &mut Vec<Excess>) -> bool {
    if let (true, Some(start)) = (leg.start_given, &leg.start) {
        ends(machine, &start.joints, u16::MAX, out);
    }
    let (joints, known) = (&leg.known_joints.0, leg.known_joints.1);
    ends(machine, joints, known, out);
    // an arc that does not exist has no path between its ends: it is a fault of the program, reported as one
    if leg.motion.kind == MotionKind::Arc(None) || !may_bend(machine, leg) {
        return true;
    }
    let Some(course) = JointPath::new(machine, leg) else {
        return false;
    };
    inside(&course, is_undeclared(machine, leg), out);
    true
}

/// Whether the axes of a rapid may arrive together or each separately: what happens between the ends is then unknown for both. If the axes of
/// a control move separately, it is unknown whether they still do while it guides the tip.
fn is_undeclared(machine: &Machine, leg: &Leg) -> bool {
    leg.motion.kind == MotionKind::Rapid && machine.control.rapid != RapidPath::Synchronous
}

/// The axes of a mask that are outside their travel.
fn ends(machine: &Machine, joints: &Joints, known: u16, out: &mut Vec<Excess>) {
    for (axis, entry) in machine.axes.iter().enumerate() {
        if known & (1 << axis) != 0
            && let Some(limit) = broken(entry.limits, joints[axis])
        {
            add(
                out,
                Excess {
                    axis,
                    value: joints[axis],
                    limit,
                    inside: false,
                    if_together: false,
                },
            );
        }
    }
}

/// Adds what is found, or replaces a smaller excess over the same limit.
fn add(out: &mut Vec<Excess>, found: Excess) {
    match out
        .iter_mut()
        .find(|known| known.axis == found.axis && known.limit == found.limit)
    {
        Some(known) if known.beyond() >= found.beyond() => {}
        Some(known) => *known = found,
        None => out.push(found),
    }
}

impl Excess {
    fn beyond(&self) -> f64 {
        (self.value - self.limit).abs()
    }
}

/// Whether linear joints can move nonlinearly, and far enough to leave their travel between the ends.
fn may_bend(machine: &Machine, leg: &Leg) -> bool {
    let (Some(start), Ok(end)) = (&leg.start, &leg.end) else {
        return false;
    };
    if matches!(leg.motion.kind, MotionKind::Arc(_)) {
        return true;
    }
    if leg.rotary_change == [0.0; 2] || !leads_path(&leg.motion) {
        return false;
    }
    let Some((_, bend)) = rough_bends(machine, leg) else {
        return true;
    };
    let room = |index: &usize| {
        let joint = machine.constants.linear[*index].joint;
        let (from, to) = (start.joints[joint], end.joints[joint]);
        match machine.axes[joint].limits {
            Limits::Unbounded => f64::INFINITY,
            Limits::Range(low, high) => (high - from.max(to)).min(from.min(to) - low),
        }
    };
    machine.constants.solved.iter().any(|index| room(index) < bend * 0.125)
}

/// The limit that a value breaks.
fn broken(limits: Limits, value: f64) -> Option<f64> {
    let Limits::Range(low, high) = limits else { return None };
    if value > high + LIMIT_SLACK {
        Some(high)
    } else if value < low - LIMIT_SLACK {
        Some(low)
    } else {
        None
    }
}

/// Joints that are further outside their travel between the ends than at them. `if_together`: only if the axes arrive together.
fn inside(course: &JointPath<'_>, if_together: bool, out: &mut Vec<Excess>) {
    let constants = &course.machine.constants;
    let (_, whole) = course.bends(0.0, 1.0);
    let at_once = course.bends_at_once();
    for (slot, &index) in constants.solved.iter().enumerate() {
        let over = |piece: &Piece| {
            let bends = if at_once {
                whole
            } else {
                course.bends(piece.from, piece.to).1
            };
            piece.below_parabola(bends[slot])
        };
        judge(
            course,
            constants.linear[index].joint,
            |t| course.solved_at(t)[slot],
            over,
            (if_together, out),
        );
    }
    if let RotaryPath::GreatCircle(circle) = &course.spin {
        let from = course.start.rotary(course.machine);
        for (slot, rotary) in constants.rotary().iter().enumerate() {
            let value = |t: f64| circle.joints(t, from).map_or(f64::NAN, |joints| joints[slot]);
            let over = |piece: &Piece| piece.below_parabola(course.spin_bounds(piece.from, piece.to).bend[slot]);
            judge(course, rotary.joint, value, over, (if_together, out));
        }
    }
}

/// One joint against both its limits: `value` at a share of the block, `bound` of a piece.
fn judge(
    course: &JointPath<'_>,
    axis: usize,
    value: impl Fn(f64) -> f64,
    bound: impl Fn(&Piece) -> f64,
    (if_together, out): (bool, &mut Vec<Excess>),
) {
    let limits = course.machine.axes[axis].limits;
    let Limits::Range(low, high) = limits else { return };
    let (from, to) = (course.start.joints[axis], course.end.joints[axis]);
    let both_legal = broken(limits, from).is_none() && broken(limits, to).is_none();
    for (sign, limit) in [(1.0, high), (-1.0, low)] {
        let over = |q: f64| sign * (q - limit);
        let whole = Piece {
            from: 0.0,
            to: 1.0,
            value_from: over(from),
            value_to: over(to),
            tag_from: (),
            tag_to: (),
        };
        // what the ends reach is already reported, here or by the block before
        let told = over(from).max(over(to)).max(0.0) + LIMIT_SLACK;
        // if an end is beyond it, that much is certain
        let certain = if_together && told > 2.0 * LIMIT_SLACK;
        if certain || bound(&whole) <= told {
            continue;
        }
        let found = peak(
            |t| {
                if t <= 0.0 {
                    over(from)
                } else if t >= 1.0 {
                    over(to)
                } else {
                    over(value(t))
                }
            },
            &bound,
            |bound, sampled, _| bound <= told || (sampled > told && bound <= sampled + CLOSE_MM),
        );
        if found.sampled > told && found.sampled.is_finite() {
            add(
                out,
                Excess {
                    axis,
                    value: limit + sign * found.sampled,
                    limit,
                    inside: both_legal,
                    if_together,
                },
            );
        }
    }
}
