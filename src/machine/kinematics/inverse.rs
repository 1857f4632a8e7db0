//! Tool pose to joints: closed form for any pair of rotary axes.
use crate::kinematics::forward::{Turn, segment_shifts};
use crate::{Constants, Joints, Machine, PairConstants};
use core::f64::consts::{FRAC_PI_2, PI};
use trunnion_geometry::math::{angle_between, atan2};
use trunnion_geometry::{Mat3, Vec3};

/// How far outside the reachable cone a tool axis may be and still be taken as on its edge, rad (0.1 micrometre at 100 mm). It is also
/// how far the tool axis of a machine without rotary axes may be from the axis at home.
pub(crate) const REACH_TOLERANCE: f64 = 1e-6;

/// A tool axis nearer than this to the first rotary axis is at the pole, rad: its azimuth is rounding noise.
pub const POLE_TOLERANCE: f64 = 1e-9;

/// Below this value of |S| the two postures are the same: their sign has no meaning.
const MERGED: f64 = 1e-9;

/// One posture of the rotary axes for a tool axis, before windings.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Solution {
    /// Rotary joint values q1 (nearest the workpiece), q2, rad, in (-pi, pi]; zero for an axis the machine lacks.
    pub q: [f64; 2],
    /// Posture sign: sign of S = e1 . (R1 e2 x u); 0 at the pole or at the edge of the reach.
    pub branch: i8,
}

/// One or two postures; reads as a slice.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Postures {
    items: [Solution; 2],
    count: usize,
}

impl Postures {
    fn one(solution: Solution) -> Self {
        Self {
            items: [solution; 2],
            count: 1,
        }
    }
}

impl core::ops::Deref for Postures {
    type Target = [Solution];
    fn deref(&self) -> &[Solution] {
        &self.items[..self.count]
    }
}

impl<'a> IntoIterator for &'a Postures {
    type Item = &'a Solution;
    type IntoIter = core::slice::Iter<'a, Solution>;
    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

/// All orientations that reach a tool axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Orientations {
    /// No posture: the tool axis is outside the cone that the machine reaches; angle to it, rad.
    Unreachable(f64),
    /// One or two postures (one at the edge of the reach, and on machines with fewer than two rotary axes).
    Postures(Postures),
    /// The tool axis is parallel to the first rotary axis: q1 is free, q2 (rad) is the given one.
    Pole(f64),
}

/// Exact orientation solver, docs/kinematics.md#two-postures. `axis` must have length 1. Windings and limits are not applied.
pub fn orientations(machine: &Machine, axis: &Vec3) -> Orientations {
    let constants = &machine.constants;
    match (constants.rotary_count, &constants.pair) {
        (2, Some(pair)) => two_rotaries(constants, pair, axis),
        (1, _) => one_rotary(constants, &machine.tool_axis, axis),
        _ => no_rotary(&machine.tool_axis, axis),
    }
}

/// No rotary axis: the tool axis is the one at home.
fn no_rotary(tool_axis: &Vec3, axis: &Vec3) -> Orientations {
    let off = angle_between(tool_axis, axis);
    if off <= REACH_TOLERANCE {
        Orientations::Postures(Postures::one(Solution::default()))
    } else {
        Orientations::Unreachable(off)
    }
}

/// One rotary axis: u = Rot(e, q) k0 keeps its angle to e (docs/kinematics.md#fewer-rotary-axes).
fn one_rotary(constants: &Constants, tool_axis: &Vec3, axis: &Vec3) -> Orientations {
    let rotary = &constants.rotary[0];
    let e = rotary.direction;
    let off = (angle_between(&e, axis) - angle_between(&e, tool_axis)).abs();
    if off.is_nan() || off > REACH_TOLERANCE {
        return Orientations::Unreachable(off);
    }
    if e.cross(tool_axis).norm() <= REACH_TOLERANCE {
        return Orientations::Pole(0.0);
    }
    let across = e.cross(tool_axis);
    let t = atan2(across.dot(axis), across.cross(&e).dot(axis));
    Orientations::Postures(Postures::one(Solution {
        q: [joint_value(t, rotary.sign), 0.0],
        branch: 0,
    }))
}

/// Two rotary axes. With h the length of u's part orthogonal to e1, g^2 = h^2/D - b^2 and b written from h^2 lose no digits near the
/// pole; the azimuths of w about e1 and e2 are atan2(g, b) and atan2(g, a), so that three atan2 give both postures.
#[inline]
fn two_rotaries(constants: &Constants, pair: &PairConstants, u: &Vec3) -> Orientations {
    let [first, second] = &constants.rotary;
    let x = first.direction.dot(u);
    let (across, along) = (pair.m.dot(u), pair.f2.dot(u));
    let h2 = across * across + along * along;
    // y - c x, without cancellation where the pole can be reached
    let (end, gap) = if x >= 0.0 {
        (pair.c, pair.y_minus_c)
    } else {
        (-pair.c, pair.y_plus_c)
    };
    let b = (gap + end * h2 / (1.0 + x.abs())) / pair.d;
    let a = (x - pair.c * pair.y) / pair.d;
    let g2 = h2 / pair.d - b * b;
    let at_pole = h2 <= POLE_TOLERANCE * POLE_TOLERANCE;
    if g2.is_nan() || g2 < 0.0 {
        let angle = atan2(h2.sqrt(), x);
        let off = (pair.reach_min - angle).max(angle - pair.reach_max);
        if off.is_nan() || off > REACH_TOLERANCE {
            return Orientations::Unreachable(off);
        }
    }
    let g = g2.max(0.0).sqrt();
    let omega = atan2(g, a);
    if at_pole {
        return Orientations::Pole(joint_value(-pair.k_azimuth - omega, second.sign));
    }
    let phi = atan2(across, along);
    let gamma = if b == 0.0 && g > 0.0 { FRAC_PI_2 } else { atan2(g, b) };
    let posture = |sign: f64, branch: i8| Solution {
        q: [
            joint_value(phi - sign * gamma, first.sign),
            joint_value(-sign * omega - pair.k_azimuth, second.sign),
        ],
        branch,
    };
    if g * pair.d <= MERGED {
        return Orientations::Postures(Postures::one(posture(1.0, 0)));
    }
    Orientations::Postures(Postures {
        items: [posture(1.0, 1), posture(-1.0, -1)],
        count: 2,
    })
}

/// Joint value in (-pi, pi] for a turn `t` (|t| below 3 pi) of an axis with sign `s`.
#[inline]
fn joint_value(t: f64, s: f64) -> f64 {
    let q = s * t;
    if q > PI {
        q - 2.0 * PI
    } else if q <= -PI {
        q + 2.0 * PI
    } else {
        q
    }
}

/// Linear joints for a tip with given rotary joints: `joints` holds the rotary values in and all values out. A fourth or further linear
/// axis (a quill) keeps the value it has in `joints`, and so does a held axis. `None` when the linear axes do not span space at this posture.
pub fn inverse(machine: &Machine, joints: &mut Joints, tip: &Vec3, tool_length: f64) -> Option<()> {
    if let Some(other) = machine.held_elsewhere(joints) {
        return inverse(&other, joints, tip, tool_length);
    }
    let constants = &machine.constants;
    let mut turns = [Turn::NONE; 2];
    for (index, rotary) in constants.rotary().iter().enumerate() {
        turns[index] = Turn::new(constants, index, joints[rotary.joint]);
    }
    inverse_turned(machine, &turns, joints, tip, tool_length)
}

/// [`inverse`] with the turns of the rotary axes already known.
#[inline]
pub(crate) fn inverse_turned(
    machine: &Machine,
    turns: &[Turn; 2],
    joints: &mut Joints,
    tip: &Vec3,
    tool_length: f64,
) -> Option<()> {
    let constants = &machine.constants;
    let mut rest = [Vec3::zeros(); 3];
    if constants.linear_count > 3 {
        for &index in &constants.solved {
            joints[constants.linear[index].joint] = 0.0;
        }
        rest = segment_shifts(constants, joints);
    }
    let tool = machine.gauge_point - machine.tool_axis * tool_length;
    if let Some(segment) = constants.shared_segment {
        let shift = needed_shift(constants, turns, &rest, segment, tip, &tool);
        store(
            constants,
            &constants.inverse_motion,
            constants.cartesian.as_ref(),
            &shift,
            joints,
        );
        return Some(());
    }
    let at_rest = place(constants, turns, &rest, &tool);
    let columns = constants.solved.map(|index| {
        let linear = &constants.linear[index];
        turns[..linear.segment]
            .iter()
            .rev()
            .fold(linear.motion, |motion, turn| turn.apply(&motion))
    });
    let solve = Mat3::from_columns(&columns);
    // three unit vectors whose volume is below this span a plane rather than space
    if solve.determinant().abs() < 1e-9 {
        return None;
    }
    store(constants, &solve.try_inverse()?, None, &(tip - at_rest), joints);
    Some(())
}

/// The tool point carried through the chain by known turns and shifts.
#[inline]
pub(crate) fn place(constants: &Constants, turns: &[Turn; 2], shifts: &[Vec3; 3], tool: &Vec3) -> Vec3 {
    let count = constants.rotary_count;
    let mut point = tool + shifts[count];
    for index in (0..count).rev() {
        let centre = constants.rotary[index].point;
        point = turns[index].apply(&(point - centre)) + centre + shifts[index];
    }
    point
}

/// The shift that must be added in one segment of the chain so that the tool point arrives at `tip`: the chain is walked from the
/// workpiece to the segment and from the tool to the segment.
#[inline]
fn needed_shift(
    constants: &Constants,
    turns: &[Turn; 2],
    rest: &[Vec3; 3],
    segment: usize,
    tip: &Vec3,
    tool: &Vec3,
) -> Vec3 {
    let mut wanted = *tip;
    for index in 0..segment {
        let centre = constants.rotary[index].point;
        wanted = turns[index].undo(&(wanted - rest[index] - centre)) + centre;
    }
    let count = constants.rotary_count;
    let mut point = *tool;
    for index in (segment..count).rev() {
        let centre = constants.rotary[index].point;
        point = turns[index].apply(&(point + rest[index + 1] - centre)) + centre;
    }
    wanted - point - rest[segment]
}

/// Writes the three solved joints.
#[inline]
fn store(
    constants: &Constants,
    inverse: &Mat3,
    cartesian: Option<&[(usize, f64); 3]>,
    shift: &Vec3,
    joints: &mut Joints,
) {
    if let Some(rows) = cartesian {
        for (&index, &(coordinate, sign)) in constants.solved.iter().zip(rows) {
            joints[constants.linear[index].joint] = shift[coordinate] * sign;
        }
    } else {
        let values = inverse * shift;
        for (&index, value) in constants.solved.iter().zip(values.iter()) {
            joints[constants.linear[index].joint] = *value;
        }
    }
}
