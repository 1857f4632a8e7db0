//! How far the linear axes move in a block: the length of their path, and how far an axis moves beyond both its ends.
use crate::follow::follower::leads_path;
use crate::path::curvature::rough_bends;
use crate::path::joint_path::JointPath;
use crate::path::peak::{Piece, peak};
use crate::{Leg, Machine};
use trunnion_geometry::Vec3;
use trunnion_interp::MotionKind;

/// Bounds of the length of the path that the linear joints run in a block, mm (root of the sum of squares over the axes).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearTravel {
    /// Never above the truth.
    pub least_mm: f64,
    /// Never below the truth.
    pub most_mm: f64,
}

/// A linear axis that runs beyond both its ends inside a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Excursion {
    /// Index of the axis.
    pub axis: usize,
    /// How far beyond the nearer end, mm; never above the truth.
    pub beyond_mm: f64,
    /// Towards higher values.
    pub upward: bool,
}

/// Relative width to which the length is closed in.
const TIGHT: f64 = 1e-3;

/// This many pieces are enough if the length is known to be above the threshold, or has no bound.
const COARSE: u32 = 1024;

/// Most pieces a block is cut into, to decide on which side of a threshold its length is.
const PIECES: u32 = 16_384;

/// How near an excursion is brought to the truth, mm.
const CLOSE_MM: f64 = 1e-3;

/// Length of the path of the linear joints. Bounds may be coarse where they prove that it is at most `enough_mm`; else they are closed in
/// until they prove that it is more, or until the block would be cut into more than 16 384 pieces: then `enough_mm` is between them.
/// `None`: an unknown stance or path, or a rapid whose axes move independently.
///
/// Without TCP along a line the joints run straight. Else, on a piece of length h with |q''| <= Q the path is at least its chord and at most
/// root(chord^2 + Q^2 h^4 / 12): by Cauchy and Schwarz length^2 <= h int |q'|^2 = chord^2 + h int |q' - mean|^2, and q' deviates from its mean
/// by less than a straight line of slope Q would.
pub fn linear_travel(machine: &Machine, leg: &Leg, enough_mm: f64) -> Option<LinearTravel> {
    if crate::path::deviation::runs_dogleg(machine, leg) {
        return None;
    }
    let (start, end) = (leg.start.as_ref()?, leg.end.as_ref().ok()?);
    let line = match leg.motion.kind {
        MotionKind::Dwell(_) | MotionKind::Unknown | MotionKind::Arc(None) => return None,
        MotionKind::Rapid | MotionKind::Linear => true,
        MotionKind::Arc(Some(_)) => false,
    };
    let chord2: f64 = machine
        .linear
        .iter()
        .map(|&joint| (end.joints[joint] - start.joints[joint]).powi(2))
        .sum();
    let chord = chord2.sqrt();
    if line && (leg.rotary_change == [0.0; 2] || !leads_path(&leg.motion)) {
        return Some(LinearTravel {
            least_mm: chord,
            most_mm: chord,
        });
    }
    if let Some((rate, bend)) = rough_bends(machine, leg) {
        let most_mm = rate.min((chord2 + bend * bend / 12.0).sqrt());
        if most_mm <= enough_mm {
            return Some(LinearTravel {
                least_mm: chord,
                most_mm,
            });
        }
    }
    let course = JointPath::new(machine, leg)?;
    let (_, whole) = course.bends(0.0, 1.0);
    let whole = course.bends_at_once().then(|| whole.norm());
    let mut pieces = 4;
    loop {
        let found = lengths(&course, pieces, whole);
        let tight = found.most_mm <= found.least_mm * (1.0 + TIGHT) || pieces >= COARSE;
        let settled = found.most_mm <= enough_mm || (tight && found.least_mm > enough_mm);
        // where nothing bounds the length, more pieces do not help
        if settled || pieces >= PIECES || (pieces >= COARSE && found.most_mm.is_infinite()) {
            return Some(found);
        }
        pieces *= 4;
    }
}

/// Bounds from this many pieces; `bend`: of the second derivative, where it holds everywhere.
fn lengths(course: &JointPath<'_>, pieces: u32, bend: Option<f64>) -> LinearTravel {
    let h = 1.0 / f64::from(pieces);
    let idle: f64 = course
        .constants()
        .linear()
        .iter()
        .enumerate()
        .filter(|(index, _)| !course.constants().solved.contains(index))
        .map(|(_, linear)| ((course.end.joints[linear.joint] - course.start.joints[linear.joint]) * h).powi(2))
        .sum();
    let mut sum = LinearTravel {
        least_mm: 0.0,
        most_mm: 0.0,
    };
    let mut last: Vec3 = course.solved(&course.start.joints);
    for piece in 0..pieces {
        let (from, to) = (f64::from(piece) * h, f64::from(piece + 1) * h);
        let next = if piece + 1 == pieces {
            course.solved(&course.end.joints)
        } else {
            course.solved_at(to)
        };
        let chord2 = (next - last).norm_squared() + idle;
        let bend = bend.unwrap_or_else(|| course.bends(from, to).1.norm()) * h * h;
        // NaN proves nothing
        let most = (chord2 + bend * bend / 12.0).sqrt();
        sum.most_mm += if most.is_nan() { f64::INFINITY } else { most };
        sum.least_mm += if chord2.is_finite() { chord2.sqrt() } else { 0.0 };
        last = next;
    }
    sum
}

/// The linear joints that run more than `least_mm` beyond both their ends inside the block, each side once.
pub fn excursions(machine: &Machine, leg: &Leg, least_mm: f64) -> Vec<Excursion> {
    let mut out = Vec::new();
    let Some(course) = JointPath::new(machine, leg) else {
        return out;
    };
    let whole = course.bends_at_once().then(|| course.bends(0.0, 1.0).1);
    for (slot, &index) in course.constants().solved.iter().enumerate() {
        let axis = course.constants().linear[index].joint;
        let ends = [course.start.joints[axis], course.end.joints[axis]];
        for (sign, upward) in [(1.0, true), (-1.0, false)] {
            let nearer = (sign * ends[0]).max(sign * ends[1]);
            let beyond = |t: f64| {
                let value = if t <= 0.0 {
                    ends[0]
                } else if t >= 1.0 {
                    ends[1]
                } else {
                    course.solved_at(t)[slot]
                };
                sign * value - nearer
            };
            let over = |piece: &Piece| {
                let bends = whole.unwrap_or_else(|| course.bends(piece.from, piece.to).1);
                piece.below_parabola(bends[slot])
            };
            let found = peak(beyond, over, |bound, sampled, _| {
                bound <= least_mm || bound <= sampled + CLOSE_MM
            });
            if found.sampled > least_mm && found.sampled.is_finite() {
                out.push(Excursion {
                    axis,
                    beyond_mm: found.sampled,
                    upward,
                });
            }
        }
    }
    out
}
