//! How the rotary axes turn inside a block: evenly, or so that the tool axis runs on a great circle.
//!
//! Turns are sign times joint, rad; rates are per block.
mod bounds;

use crate::path::joint_path::on_great_circle;
use crate::{Leg, Machine, Orientations, PairConstants, Stance, orientations};
use core::f64::consts::{PI, TAU};
use trunnion_geometry::Vec3;
use trunnion_geometry::math::{angle_between, atan2, sin_cos};

pub(crate) use bounds::RotaryPathBounds;

/// Tool axes nearer than this are the same: nothing moves on a great circle, rad.
const SAME_AXIS: f64 = 1e-12;

/// A turn of a rotary axis up to this is rounding, rad.
pub const NO_TURN: f64 = 1e-9;

/// How near the great circle's end must come to the block's end, rad.
const ARRIVAL: f64 = 1e-6;

/// The course of the rotary axes.
#[derive(Clone, Copy, Debug)]
pub(crate) enum RotaryPath<'a> {
    /// At constant rates.
    Even,
    /// The tool axis runs on a great circle at a constant rate, in the start's posture.
    GreatCircle(GreatCircle<'a>),
}

/// A great circle from the start's to the end's tool axis.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GreatCircle<'a> {
    machine: &'a Machine,
    pair: &'a PairConstants,
    start: Vec3,
    /// Unit vector at right angles to `start` in the circle's plane.
    side: Vec3,
    /// Angle of the whole block, rad.
    angle: f64,
    branch: i8,
    /// [`GreatCircle::lead`] at the start, rad.
    lead: f64,
}

impl<'a> RotaryPath<'a> {
    /// `None` where the tool axis should run on a great circle but the joints cannot follow it from start to end (the posture sign
    /// changes, a joint arrives on another turn, the tool axis turns right round).
    pub(crate) fn new(machine: &'a Machine, leg: &Leg, start: &Stance, end: &Stance) -> Option<Self> {
        let Some(pair) = machine
            .constants
            .pair
            .as_ref()
            .filter(|_| on_great_circle(machine, &leg.motion))
        else {
            return Some(Self::Even);
        };
        let angle = angle_between(&start.axis, &end.axis);
        if angle < SAME_AXIS {
            return Some(Self::Even);
        }
        let side = end.axis - start.axis * start.axis.dot(&end.axis);
        if angle > PI - ARRIVAL || start.branch != end.branch {
            return None;
        }
        let circle = GreatCircle::new(machine, pair, [start.axis, side.normalize()], angle, start.branch);
        if circle.azimuth_turned(&end.axis).abs() > PI - ARRIVAL {
            // over the pole: the direction in which the first axis turns is unknown
            return None;
        }
        let (from, to) = (start.rotary(machine), end.rotary(machine));
        let arrives = circle.joints(1.0, from)?;
        let off = (arrives[0] - to[0]).abs().max((arrives[1] - to[1]).abs());
        (off < ARRIVAL).then_some(Self::GreatCircle(circle))
    }
}

/// How far the rotary axes get from where they start in a block, rad, workpiece side first: at its end, or half-way on a great circle,
/// where an axis may leave a value that it returns to. Never above the true value; zero only for an axis that does not move. `None` where a
/// stance or the path between them is not known.
pub fn rotary_turns(machine: &Machine, leg: &Leg) -> Option<[f64; 2]> {
    let (start, end) = (leg.start.as_ref()?, leg.end.as_ref().ok()?);
    let mut turns = leg.rotary_change;
    if let RotaryPath::GreatCircle(circle) = RotaryPath::new(machine, leg, start, end)? {
        let from = start.rotary(machine);
        let middle = circle.joints(0.5, from)?;
        for (turn, (from, middle)) in turns.iter_mut().zip(from.iter().zip(middle)) {
            *turn = turn.max((middle - from).abs());
        }
    }
    Some(turns)
}

impl<'a> GreatCircle<'a> {
    /// `axes`: tool axis at the start and the unit vector at right angles to it in the circle's plane.
    fn new(machine: &'a Machine, pair: &'a PairConstants, axes: [Vec3; 2], angle: f64, branch: i8) -> Self {
        let [start, side] = axes;
        let mut circle = Self {
            machine,
            pair,
            start,
            side,
            angle,
            branch,
            lead: 0.0,
        };
        circle.lead = circle.lead(&start);
        circle
    }

    /// By how much the azimuth of `u` about e1 is greater than the start's, rad: between -pi and pi, what a great circle that keeps off the
    /// pole turns by.
    fn azimuth_turned(&self, u: &Vec3) -> f64 {
        let e1 = self.machine.constants.rotary[0].direction;
        let from = self.start - e1 * e1.dot(&self.start);
        atan2(e1.dot(&from.cross(u)), from.dot(u))
    }

    /// By how much the azimuth of `u` about e1 leads that of the second axis in this posture, rad. S keeps its sign in a posture, so that it
    /// stays between 0 and pi, or between -pi and 0: gamma of docs/kinematics.md#two-postures with the posture's sign.
    fn lead(&self, u: &Vec3) -> f64 {
        let pair = self.pair;
        let x = self.machine.constants.rotary[0].direction.dot(u);
        let off = x - pair.c * pair.y;
        let s = (pair.d * (1.0 - pair.y * pair.y) - off * off).max(0.0).sqrt();
        f64::from(self.branch) * atan2(s, pair.y - pair.c * x)
    }

    /// Tool axis and its rate.
    fn axis(&self, t: f64) -> (Vec3, Vec3) {
        let (sin, cos) = sin_cos(self.angle * t);
        (
            self.start * cos + self.side * sin,
            (self.side * cos - self.start * sin) * self.angle,
        )
    }

    /// Rotary joints at t for a block that starts at `from`, without jumps of whole turns; `None` where there are none in this posture. The
    /// first axis turns by what the azimuth of the tool axis turns, less what it gains on the second axis: more than half a turn, at times.
    pub(crate) fn joints(&self, t: f64, from: [f64; 2]) -> Option<[f64; 2]> {
        let u = self.axis(t).0;
        let Orientations::Postures(postures) = orientations(self.machine, &u) else {
            return None;
        };
        let found = postures.iter().find(|solution| solution.branch == self.branch)?;
        let turned = self.azimuth_turned(&u) - (self.lead(&u) - self.lead);
        let near = [from[0] + self.machine.constants.rotary[0].sign * turned, from[1]];
        let turn = |i: usize| found.q[i] + TAU * ((near[i] - found.q[i]) / TAU).round();
        Some([turn(0), turn(1)])
    }

    /// Rates of the turns at t: with f = R1 e2, t1' = -(u'.f) / S and t2' = (u'.e1) / S. `f` is the second axis turned by the first.
    pub(crate) fn rates(&self, t: f64, f: &Vec3) -> [f64; 2] {
        let (u, rate) = self.axis(t);
        let e1 = self.machine.constants.rotary[0].direction;
        let s = e1.dot(&f.cross(&u));
        [-rate.dot(f) / s, rate.dot(&e1) / s]
    }
}

#[cfg(test)]
mod tests;
