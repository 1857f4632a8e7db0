//! How much the linear joints can bend inside a block: bounds of their rates and second derivatives, taken axis by axis along the chain
//! (kinematics notes 3).
use crate::kinematics::forward::Turn;
use crate::path::joint_path::{JointPath, Track, on_great_circle};
use crate::path::rotary_path::{RotaryPath, RotaryPathBounds};
use crate::{Leg, Machine};
use trunnion_geometry::{Mat3, Vec3};
use trunnion_interp::MotionKind;

impl JointPath<'_> {
    /// The bounds of [`JointPath::bends`] hold for the whole block at once and need not be computed piece by piece.
    pub(crate) fn bends_at_once(&self) -> bool {
        !self.tip || (self.constants().shared_segment.is_some() && matches!(self.spin, RotaryPath::Even))
    }

    /// Upper bounds of the rates and of the second derivatives of the three solved joints on a piece of the block, mm per block and mm
    /// per block squared; infinite where nothing is proven.
    pub(crate) fn bends(&self, from: f64, to: f64) -> (Vec3, Vec3) {
        let (fastest, _, bend) = self.track.bounds();
        if !self.tip {
            return match self.track {
                Track::Line(_) => (self.without_tip(0.0)[1].abs(), Vec3::zeros()),
                Track::Arc(_) => {
                    let straight = (self.solved(&self.end.joints) - self.solved(&self.start.joints)).abs();
                    (straight.map(|rate| rate.max(fastest)), Vec3::repeat(bend))
                }
            };
        }
        let piece = PieceOfCourse::new(self, from, to);
        match self.constants().shared_segment {
            Some(segment) => piece.shared_bends(segment, fastest, bend),
            None => piece.mixed_bends(fastest, bend),
        }
    }
}

/// Rough bounds of rate and second derivative of every solved joint under TCP along a line, mm per block: distances from the rotary axes
/// are bounded by distances from the origin, so that a block that is far from every limit is settled without turning a single point.
/// `None` where the finer bounds are needed (arcs, great circles, solved axes in different places, a quill).
pub(crate) fn rough_bends(machine: &Machine, leg: &Leg) -> Option<(f64, f64)> {
    let constants = &machine.constants;
    let is_line = matches!(leg.motion.kind, MotionKind::Linear | MotionKind::Rapid);
    if !is_line
        || constants.shared_segment.is_none()
        || constants.linear_count > 3
        || on_great_circle(machine, &leg.motion)
    {
        return None;
    }
    let (start, end) = (leg.start.as_ref()?, leg.end.as_ref().ok()?);
    let row = if constants.cartesian.is_some() {
        1.0
    } else {
        constants.inverse_motion.norm()
    };
    let tool = machine.gauge_point.norm() + end.tool_length.abs();
    let centres: f64 = constants.rotary().iter().map(|rotary| 2.0 * rotary.point.norm()).sum();
    let far = start
        .point_with(end.tool_length)
        .norm_squared()
        .max(end.point.norm_squared())
        .sqrt();
    let radius = far + tool + centres;
    let turned = leg.rotary_change[0] + leg.rotary_change[1];
    Some((
        row * (leg.length + turned * radius),
        row * turned * (2.0 * leg.length + turned * radius),
    ))
}

/// A piece of a course with what its bounds need: the turns at its ends and the bounds of their rates.
struct PieceOfCourse<'c, 'm> {
    course: &'c JointPath<'m>,
    ends: [f64; 2],
    turns: [[Turn; 2]; 2],
    spin: RotaryPathBounds,
}

impl<'c, 'm> PieceOfCourse<'c, 'm> {
    fn new(course: &'c JointPath<'m>, from: f64, to: f64) -> Self {
        let turns = [course.turns(from), course.turns(to)];
        Self {
            course,
            ends: [from, to],
            turns,
            spin: course.spin_bounds(from, to),
        }
    }

    /// Tip in the workpiece frame at both ends.
    fn tips(&self) -> [Vec3; 2] {
        let course = self.course;
        let start = course.start.point_with(course.tool_length);
        self.ends.map(|t| start + course.track.at(t).0)
    }

    fn carry(&self, start: Vec3, end: Vec3, rate: f64, bend: f64) -> Carried {
        Carried {
            start,
            end,
            rate,
            bend,
            length: self.ends[1] - self.ends[0],
        }
    }

    /// Shift of a segment by the idle linear axes at both ends, and its rate.
    fn idle(&self, shifts: &([Vec3; 3], [Vec3; 3]), segment: usize) -> Shift {
        let rate = shifts.1[segment] - shifts.0[segment];
        let [start, end] = self.ends.map(|t| shifts.0[segment] + rate * t);
        Shift {
            start,
            end,
            rate: rate.norm(),
        }
    }

    /// Turns a carried point about rotary axis `index`.
    fn turn(&self, point: &mut Carried, index: usize, apply: impl Fn(&Turn, &Vec3) -> Vec3) {
        let centre = self.course.constants().rotary[index].point;
        let (rate, bend) = (self.spin.rate[index], self.spin.bend[index]);
        point.turn(
            (rate, bend),
            &centre,
            &self.turns[0][index],
            &self.turns[1][index],
            apply,
        );
    }

    /// All solved axes in one segment: the chain is walked from the workpiece to it (Z = R^T (P - c) + c) and from the tool to it.
    fn shared_bends(&self, segment: usize, fastest: f64, bend: f64) -> (Vec3, Vec3) {
        let constants = self.course.constants();
        let idle = self.course.idle_shifts();
        let [from, to] = self.tips();
        let mut wanted = self.carry(from, to, fastest, bend);
        for index in 0..segment {
            wanted.shift(&self.idle(&idle, index).back());
            self.turn(&mut wanted, index, Turn::undo);
        }
        let tool = self.tool_at(&idle, segment);
        let rows = constants.inverse_motion;
        let row = |i: usize| rows.row(i).norm();
        let rows = Vec3::new(row(0), row(1), row(2));
        (rows * (wanted.rate + tool.rate), rows * (wanted.bend + tool.bend))
    }

    /// The tool point carried from the tool down to a segment.
    fn tool_at(&self, idle: &([Vec3; 3], [Vec3; 3]), segment: usize) -> Carried {
        let count = self.course.constants().rotary_count;
        let mut tool = self.carry(self.course.tool, self.course.tool, 0.0, 0.0);
        for index in (segment..count).rev() {
            tool.shift(&self.idle(idle, index + 1));
            self.turn(&mut tool, index, Turn::apply);
        }
        tool.shift(&self.idle(idle, segment));
        tool
    }

    /// Solved axes in different segments: J q = r gives |q'| <= k (|r'| + G |q|) and |q''| <= k (|r''| + 2 G |q'| + G2 |q|) with k the norm
    /// of J^-1, G and G2 bounds of |J'| and |J''|. Proven while J stays near its value at the piece's start, else infinite.
    fn mixed_bends(&self, fastest: f64, bend: f64) -> (Vec3, Vec3) {
        let nothing = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::INFINITY));
        let constants = self.course.constants();
        let (mut columns, mut spin2, mut bend2) = ([Vec3::zeros(); 3], 0.0, 0.0);
        for (slot, &solved) in constants.solved.iter().enumerate() {
            let linear = &constants.linear[solved];
            let turns = &self.turns[0][..linear.segment];
            columns[slot] = turns
                .iter()
                .rev()
                .fold(linear.motion, |motion, turn| turn.apply(&motion));
            let rate: f64 = self.spin.rate[..linear.segment].iter().sum();
            let bend: f64 = self.spin.bend[..linear.segment].iter().sum();
            spin2 += rate * rate;
            bend2 += (rate * rate + bend) * (rate * rate + bend);
        }
        let (spin, spin_bend) = (spin2.sqrt(), bend2.sqrt());
        let Some(inverse) = Mat3::from_columns(&columns).try_inverse() else {
            return nothing;
        };
        let change = inverse.norm() * spin * (self.ends[1] - self.ends[0]);
        // NaN proves nothing either
        if change.is_nan() || change >= 0.9 {
            return nothing;
        }
        let k = inverse.norm() / (1.0 - change);
        let point = self.tool_at(&self.course.idle_shifts(), 0);
        let [from, to] = self.tips();
        let mut wanted = self.carry(from, to, fastest, bend);
        wanted.shift(&Shift {
            start: -point.start,
            end: -point.end,
            rate: point.rate,
        });
        wanted.bend += point.bend;
        let reach = wanted.start.norm().max(wanted.end.norm()) + wanted.sag();
        let size = k * reach;
        let rate = k * (wanted.rate + spin * size);
        let bend = k * (wanted.bend + 2.0 * spin * rate + spin_bend * size);
        (Vec3::repeat(rate), Vec3::repeat(bend))
    }
}

/// A shift at both ends of a piece, and a bound of its rate.
pub(crate) struct Shift {
    pub(crate) start: Vec3,
    pub(crate) end: Vec3,
    pub(crate) rate: f64,
}

impl Shift {
    fn back(self) -> Self {
        Self {
            start: -self.start,
            end: -self.end,
            rate: self.rate,
        }
    }
}

/// A point that is carried through the chain: its ends, and bounds of its first and second derivative over a piece of a block.
///
/// Turning by an angle with rate at most D and second derivative at most E adds D r to the rate and 2 D v + (D^2 + E) r to the second
/// derivative, r being the largest distance from the axis (docs/kinematics.md#between-the-ends-of-a-block, taken axis by axis). r is largest at an end or above its
/// chord by bend h^2 / 8.
pub(crate) struct Carried {
    pub(crate) start: Vec3,
    pub(crate) end: Vec3,
    /// Bound of the rate.
    pub(crate) rate: f64,
    /// Bound of the second derivative.
    pub(crate) bend: f64,
    /// Length h of the piece, 0..=1.
    pub(crate) length: f64,
}

impl Carried {
    /// How far the point can deviate from its chord.
    fn sag(&self) -> f64 {
        self.bend * self.length * self.length * 0.125
    }
    /// Adds a shift that runs linearly.
    pub(crate) fn shift(&mut self, by: &Shift) {
        self.start += by.start;
        self.end += by.end;
        self.rate += by.rate;
    }
    /// Turns about an axis through `centre`; `spin` is the bound of rate and second derivative of the angle.
    pub(crate) fn turn(
        &mut self,
        spin: (f64, f64),
        centre: &Vec3,
        start: &Turn,
        end: &Turn,
        apply: impl Fn(&Turn, &Vec3) -> Vec3,
    ) {
        let (from, to) = (self.start - centre, self.end - centre);
        if spin.0 > 0.0 {
            let off = |arm: &Vec3| start.axis.cross(arm).norm();
            let radius = off(&from).max(off(&to)) + self.sag();
            self.bend += 2.0 * spin.0 * self.rate + (spin.0 * spin.0 + spin.1) * radius;
            self.rate += spin.0 * radius;
        }
        self.start = apply(start, &from) + centre;
        self.end = apply(end, &to) + centre;
    }
}

#[cfg(test)]
mod tests;
