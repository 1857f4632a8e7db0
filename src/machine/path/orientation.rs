//! How far the tool axis deviates from the programmed great circle inside a block: sampled value and proven bound.
use crate::follow::follower::leads_path;
use crate::path::deviation::RATIO;
use crate::path::joint_path::on_great_circle;
use crate::path::peak::{Piece, peak};
use crate::{Leg, Machine, Stance, tool_axis_at};
use core::f64::consts::{FRAC_PI_2, PI};
use trunnion_geometry::Vec3;
use trunnion_geometry::math::{angle_between, asin, atan2, sin, sin_cos};
use trunnion_interp::{MotionKind, Orientation};

/// Deviation of the tool axis from the great circle between its directions at both ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrientationDeviation {
    /// Largest angle found at a sample, rad (never above the truth).
    pub sampled: f64,
    /// Proven upper bound, rad (never below the truth).
    pub bound: f64,
    /// Where in the block, 0..=1, the largest sample is.
    pub at: f64,
}

/// If sample and bound are this near, rad, more samples are useless: 1e-5 deg.
const CLOSE: f64 = 1.7e-7;

/// Samples spent on closeness; beyond them a bound within the ratio is enough.
const CLOSE_SAMPLES: u32 = 256;

/// Tool axes this near to opposite directions have no defined great circle between them, rad.
const OPPOSITE: f64 = 1e-6;

/// Room for rounding, rad.
const ROUNDING: f64 = 1e-13;

/// Whether the tool axis is programmed by vectors while the rotary joints run evenly: then it leaves the great circle. Rotary words that
/// run joint-linear, and vectors that run on the great circle, are what was programmed.
pub(crate) fn strays(machine: &Machine, leg: &Leg) -> bool {
    leg.rotary_change != [0.0; 2]
        && matches!(leg.motion.orientation, Orientation::Vector(..))
        && leads_path(&leg.motion)
        && !on_great_circle(machine, &leg.motion)
}

/// Set distance of the tool axis to the great-circle arc between its directions at both ends. `tolerance`, rad: the bound may be loose
/// where it already proves this; above it, it is at most 1.2 times the truth. `None`: no path, an unknown stance, opposite ends, or a
/// rapid whose axes move independently.
///
/// Zero by construction where no vectors are programmed, where the control runs them on the great circle, and where no rotary axis moves.
/// With |u''| <= Q (at most (D1 + D2)^2) the axis keeps within asin(Q / 8) of the arc; on a piece of length h the sine of the distance, which
/// is the distance of u from the convex cone over the arc, is at most its largest end + Q h^2 / 8. Source: docs/kinematics.md#between-the-ends-of-a-block.
pub fn orientation_deviation(machine: &Machine, leg: &Leg, tolerance: f64) -> Option<OrientationDeviation> {
    if crate::path::deviation::runs_dogleg(machine, leg) {
        return None;
    }
    let none = OrientationDeviation {
        sampled: 0.0,
        bound: 0.0,
        at: 0.0,
    };
    let (start, end) = (leg.start.as_ref()?, leg.end.as_ref().ok()?);
    if matches!(
        leg.motion.kind,
        MotionKind::Dwell(_) | MotionKind::Unknown | MotionKind::Arc(None)
    ) {
        return None;
    }
    if !strays(machine, leg) {
        return Some(none);
    }
    let bend = axis_bend(machine, start, end);
    let at_once = asin_or_pi(bend * 0.125) + ROUNDING;
    if at_once <= tolerance {
        return Some(OrientationDeviation { bound: at_once, ..none });
    }
    let circle = Circle::new(&start.axis, &end.axis)?;
    let (from, to) = (start.rotary(machine), end.rotary(machine));
    let change = [to[0] - from[0], to[1] - from[1]];
    let rate = change[0].abs() + change[1].abs();
    let value = |t: f64| {
        if t <= 0.0 || t >= 1.0 {
            return 0.0;
        }
        circle.distance(&tool_axis_at(
            machine,
            [from[0] + change[0] * t, from[1] + change[1] * t],
        ))
    };
    let over = |piece: &Piece| {
        let roof = piece.below_roof(rate).min(PI);
        if piece.value_from.max(piece.value_to) >= FRAC_PI_2 {
            return roof;
        }
        let sines = Piece {
            value_from: sin(piece.value_from),
            value_to: sin(piece.value_to),
            ..*piece
        };
        roof.min(asin_or_pi(sines.below_parabola(bend)))
    };
    let room = (tolerance - ROUNDING).max(0.0);
    let found = peak(value, over, |bound, sampled, samples| {
        bound <= room || bound <= sampled + CLOSE || (samples > CLOSE_SAMPLES && bound <= sampled * RATIO)
    });
    Some(OrientationDeviation {
        sampled: (found.sampled - ROUNDING).max(0.0),
        bound: found.bound + ROUNDING,
        at: found.at,
    })
}

/// The angle whose sine this is; pi where it is none.
fn asin_or_pi(sine: f64) -> f64 {
    if sine < 1.0 { asin(sine) } else { PI }
}

/// Q: bound of |u''| while the rotary joints run evenly, per block squared, taken axis by axis from the tool: turning a vector with rate v
/// and second derivative a by D adds D r and 2 D v + D^2 r, r its largest distance from the axis (docs/kinematics.md#between-the-ends-of-a-block).
pub(crate) fn axis_bend(machine: &Machine, start: &Stance, end: &Stance) -> f64 {
    let rotary = machine.constants.rotary();
    let (from, to) = (start.rotary(machine), end.rotary(machine));
    let (mut rate, mut bend) = (0.0, 0.0);
    for (index, axis) in rotary.iter().enumerate().rev() {
        let off = |v: &Vec3| axis.direction.cross(v).norm();
        let ends = if index + 1 == rotary.len() {
            off(&machine.tool_axis)
        } else {
            // the first axis keeps distances from itself
            off(&start.axis).max(off(&end.axis))
        };
        let radius = (ends + bend * 0.125).min(1.0);
        let turned = (to[index] - from[index]).abs();
        bend += 2.0 * turned * rate + turned * turned * radius;
        rate += turned * radius;
    }
    bend * (1.0 + 1e-9)
}

/// The shorter great-circle arc between two unit vectors.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Circle {
    from: Vec3,
    to: Vec3,
    /// Unit vector at right angles to `from`, towards `to`; zero if both are the same.
    side: Vec3,
    /// Unit normal of the plane; zero if both are the same.
    normal: Vec3,
    /// Angle of the arc, rad.
    pub(crate) angle: f64,
}

impl Circle {
    /// `None` between opposite directions.
    pub(crate) fn new(from: &Vec3, to: &Vec3) -> Option<Self> {
        let angle = angle_between(from, to);
        if angle > PI - OPPOSITE {
            return None;
        }
        let side = to - from * from.dot(to);
        let length = side.norm();
        let side = if length > 0.0 { side / length } else { Vec3::zeros() };
        Some(Self {
            from: *from,
            to: *to,
            side,
            normal: from.cross(&side),
            angle,
        })
    }

    /// Unit vector after the share t of the arc, at an even rate.
    pub(crate) fn at(&self, t: f64) -> Vec3 {
        let (sin, cos) = sin_cos(self.angle * t);
        self.from * cos + self.side * sin
    }

    /// Angle from a unit vector to the nearest direction of the arc, rad.
    pub(crate) fn distance(&self, u: &Vec3) -> f64 {
        let (along, across) = (self.from.dot(u), self.side.dot(u));
        let azimuth = atan2(across, along);
        if (0.0..=self.angle).contains(&azimuth) && self.angle > 0.0 {
            return atan2(self.normal.dot(u).abs(), (along * along + across * across).sqrt());
        }
        angle_between(u, &self.from).min(angle_between(u, &self.to))
    }
}
