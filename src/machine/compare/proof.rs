//! Upper bounds of what a wrong machine file does to the tip: along a block, and at all poses inside the travel.
use super::{Comparison, TipDifference};
use crate::kinematics::forward::Turn;
use crate::path::curvature::{Carried, Shift};
use crate::path::deviation::runs_dogleg;
use crate::path::joint_path::JointPath;
use crate::path::peak::{Piece, SAMPLES, peak};
use crate::path::rotary_path::RotaryPath;
use crate::{AxisKind, Joints, Leg, Limits, MAX_AXES, Machine};
use core::f64::consts::PI;
use trunnion_geometry::Vec3;
use trunnion_geometry::math::{angle_between, sin, sin_cos};

/// What a block does to the tip of the second machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AlongBlock {
    /// The worst value found; never above the true one.
    pub worst: TipDifference,
    /// Proven upper bound, mm; infinite where nothing is proven.
    pub bound_mm: f64,
    /// The effort ended before the bound was as close to the truth as it was asked to be.
    pub cut_short: bool,
}

/// How many pieces of blocks a run may bound: a number that grows with its motions and an allowance for the difficult ones. A block takes
/// at most a small part of what is left, so that those that turn a billion times leave enough for the others.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    left: u64,
}

impl Effort {
    /// Pieces that each motion adds.
    const EACH: u64 = 4;
    /// A block takes no more than this part of what is left.
    const PART: u64 = 200;

    /// An allowance of `pieces`.
    pub fn new(pieces: u64) -> Self {
        Self { left: pieces }
    }

    /// Pieces left.
    pub fn left(&self) -> u64 {
        self.left
    }

    /// What the next block may take.
    fn share(&mut self) -> u32 {
        self.left = self.left.saturating_add(Self::EACH);
        let part = (self.left / Self::PART).max(self.left.min(Self::EACH));
        u32::try_from(part).unwrap_or(u32::MAX).min(SAMPLES)
    }
}

/// Above the tolerance the bound is brought down to this multiple of the worst that was found.
const RATIO: f64 = 1.19;

/// Bounds over a piece of a block: rates and second derivatives of the joints.
struct Rates {
    rate: Joints,
    bend: Joints,
}

impl Comparison<'_> {
    /// The tip of the true machine along a whole block whose joints move as on the believed machine. `tolerance_mm`: the bound may be loose
    /// where it already proves this, or where `effort` ends. `None`: a stance or the path between the two is not known or not modelled.
    ///
    /// With both tip paths W1, W2 bending by at most Q1 and Q2 their difference is on a piece of length h at most its largest end +
    /// (Q1 + Q2) h^2 / 8; the piece with the largest bound is halved first. However often an axis turns, the bound of [`Self::everywhere`]
    /// holds for the block, with the travel of its joints. Source: docs/kinematics.md#between-the-ends-of-a-block.
    pub fn along(&self, leg: &Leg, tolerance_mm: f64, effort: &mut Effort) -> Option<AlongBlock> {
        if runs_dogleg(self.believed, leg) {
            return None;
        }
        let course = JointPath::new(self.believed, leg)?;
        let at = |t: f64| self.at(&course.joints(t), course.tool_length);
        let over = |piece: &Piece| {
            let rates = rates(&course, piece.from, piece.to);
            let ends = [course.joints(piece.from), course.joints(piece.to)];
            let length = piece.to - piece.from;
            let bend = |machine: &Machine, ends: [Joints; 2], rates: &Rates| {
                tip_bend(machine, &ends, rates, length, course.tool_length)
            };
            let first = bend(self.believed, ends, &rates);
            let second = bend(
                self.truth,
                ends.map(|joints| self.ordered(&joints)),
                &Rates {
                    rate: self.ordered(&rates.rate),
                    bend: self.ordered(&rates.bend),
                },
            );
            piece.below_parabola(first + second)
        };
        let whole = self.anywhere_on(&course);
        let most = effort.share();
        let settled = |bound: f64, sampled: f64| {
            let bound = bound.min(whole);
            bound <= tolerance_mm || (sampled > tolerance_mm && bound <= sampled * RATIO)
        };
        let found = peak(
            |t| at(t).tip_mm,
            over,
            |bound, sampled, samples| samples >= most || settled(bound, sampled),
        );
        effort.left = effort.left.saturating_sub(u64::from(found.samples));
        Some(AlongBlock {
            worst: at(found.at),
            bound_mm: found.bound.min(whole).max(found.sampled),
            cut_short: !settled(found.bound, found.sampled),
        })
    }

    /// A bound for a whole block that does not depend on how its joints move between the ends of their travel.
    fn anywhere_on(&self, course: &JointPath<'_>) -> f64 {
        // a great circle may leave the reach of the axes, which only its points show
        if matches!(course.spin, RotaryPath::GreatCircle(_)) {
            return f64::INFINITY;
        }
        let (rates, from, to) = (rates(course, 0.0, 1.0), course.joints(0.0), course.joints(1.0));
        // no farther from both ends than the fastest rate allows
        let travel = |joint: usize| {
            let (middle, half) = (0.5 * (from[joint] + to[joint]), 0.5 * rates.rate[joint]);
            if half.is_finite() {
                let room = 1e-9 * (1.0 + middle.abs() + half);
                (middle - half - room, middle + half + room)
            } else {
                (f64::NEG_INFINITY, f64::INFINITY)
            }
        };
        self.inside(course.tool_length.abs(), travel)
    }

    /// How far the tip can be off at any pose with the joints inside the believed machine's travel (an endless rotary axis anywhere) and
    /// tools of up to `longest_mm`; infinite where nothing is proven: other orders of axes, or an endless linear axis before one whose
    /// direction differs.
    ///
    /// Carried from the tool to the workpiece, the difference d of the two points grows by |g1 - g2| + L |k1 - k2| at the tool, by
    /// |e1 - e2| |q| at a linear axis, and at a rotary axis by 2 sin(q/2) times the part of c1 - c2 across it (the turn carries c1 - c2 as
    /// far as that) and, where the directions differ by g, by |R1 - R2| r <= 8 sin(q/2) sin(g/2) r: R2 = S R1 S^-1 with the turn S by g,
    /// hence |R1 - R2| = |(R1 - I)(S - I) - (S - I)(R1 - I)|. r is the largest distance of the point from the axis' point.
    pub fn everywhere(&self, longest_mm: f64) -> f64 {
        self.inside(longest_mm, |joint| {
            let axis = &self.believed.axes[joint];
            match (axis.extra.hold, axis.limits) {
                (Some(hold), _) => (hold, hold),
                (None, Limits::Range(low, high)) => (low, high),
                (None, Limits::Unbounded) => (f64::NEG_INFINITY, f64::INFINITY),
            }
        })
    }

    /// [`Self::everywhere`] with the travel of each joint.
    fn inside(&self, longest_mm: f64, travel: impl Fn(usize) -> (f64, f64)) -> f64 {
        let (believed, truth) = (self.believed, self.truth);
        let (a, b) = (&believed.home, &truth.home);
        if self.order.iter().enumerate().any(|(joint, from)| joint != *from) || longest_mm.is_nan() {
            return f64::INFINITY;
        }
        let mut ball = Ball {
            off: (a.gauge_point - b.gauge_point).norm() + longest_mm * (a.tool_axis - b.tool_axis).norm(),
            centre: b.gauge_point,
            radius: longest_mm,
        };
        for (joint, (first, second)) in believed.axes.iter().zip(&truth.axes).enumerate().rev() {
            if first.kind != second.kind || first.extra.hold != second.extra.hold {
                return f64::INFINITY;
            }
            let (low, high) = travel(joint);
            let directions = [first.direction * first.sign, second.direction * second.sign];
            match first.kind {
                AxisKind::Linear => ball.shift(&directions, (low, high)),
                AxisKind::Rotary => ball.turn(&directions, &[first.point, second.point], low.abs().max(high.abs())),
            }
        }
        ball.off * (1.0 + 1e-12)
    }

    /// Values of the believed machine's joints in the order of the true machine's.
    pub(super) fn ordered(&self, joints: &Joints) -> Joints {
        let mut other: Joints = [0.0; MAX_AXES];
        for (slot, from) in other.iter_mut().zip(&self.order) {
            *slot = joints[*from];
        }
        other
    }
}

/// Where the second machine's point can be, and how far the first machine's is from it.
struct Ball {
    off: f64,
    centre: Vec3,
    radius: f64,
}

impl Ball {
    fn shift(&mut self, directions: &[Vec3; 2], (low, high): (f64, f64)) {
        let differs = (directions[0] - directions[1]).norm();
        if differs > 0.0 {
            self.off += differs * low.abs().max(high.abs());
        }
        if low.is_finite() && high.is_finite() {
            self.centre += directions[1] * (0.5 * (low + high));
            self.radius += 0.5 * (high - low);
        } else {
            self.radius = f64::INFINITY;
        }
    }

    fn turn(&mut self, directions: &[Vec3; 2], points: &[Vec3; 2], most: f64) {
        let half = sin(0.5 * most.min(PI));
        self.off += 2.0 * half * directions[0].cross(&(points[0] - points[1])).norm();
        let reach = (self.centre - points[1]).norm() + self.radius;
        let angle = angle_between(&directions[0], &directions[1]);
        if angle > 0.0 && half > 0.0 {
            self.off += (8.0 * half * sin(0.5 * angle)).min(2.0) * reach;
        }
        // the point moves around the axis' point
        (self.centre, self.radius) = (points[1], reach);
    }
}

/// How fast the joints run on a piece of a block, and how much they bend.
fn rates(course: &JointPath<'_>, from: f64, to: f64) -> Rates {
    let (mut rate, mut bend): (Joints, Joints) = ([0.0; MAX_AXES], [0.0; MAX_AXES]);
    let constants = course.constants();
    for linear in constants.linear() {
        rate[linear.joint] = (course.end.joints[linear.joint] - course.start.joints[linear.joint]).abs();
    }
    let (solved_rates, solved_bends) = course.bends(from, to);
    for (slot, &index) in constants.solved.iter().enumerate() {
        let joint = constants.linear[index].joint;
        (rate[joint], bend[joint]) = (solved_rates[slot], solved_bends[slot]);
    }
    let spins = course.spin_bounds(from, to);
    for (slot, rotary) in constants.rotary().iter().enumerate() {
        (rate[rotary.joint], bend[rotary.joint]) = (spins.rate[slot], spins.bend[slot]);
    }
    Rates { rate, bend }
}

/// Q: bound of the second derivative of the tip path on a piece of length `length`, the point carried axis by axis from the tool.
fn tip_bend(machine: &Machine, ends: &[Joints; 2], rates: &Rates, length: f64, tool_length: f64) -> f64 {
    let tool = machine.home.gauge_point - machine.home.tool_axis * tool_length;
    let mut point = Carried {
        start: tool,
        end: tool,
        rate: 0.0,
        bend: 0.0,
        length,
    };
    for (joint, axis) in machine.axes.iter().enumerate().rev() {
        let [from, to] = [0, 1].map(|end| axis.sign * ends[end][joint]);
        match axis.kind {
            AxisKind::Linear => {
                point.shift(&Shift {
                    start: axis.direction * from,
                    end: axis.direction * to,
                    rate: rates.rate[joint],
                });
                point.bend += rates.bend[joint];
            }
            AxisKind::Rotary => {
                let turn = |angle: f64| {
                    let (sin, cos) = sin_cos(angle);
                    Turn {
                        axis: axis.direction,
                        sin,
                        cos,
                    }
                };
                let spin = (rates.rate[joint], rates.bend[joint]);
                point.turn(spin, &axis.point, &turn(from), &turn(to), Turn::apply);
            }
        }
    }
    point.bend * (1.0 + 1e-9)
}
