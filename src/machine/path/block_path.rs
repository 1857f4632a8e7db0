//! Where the joints and the tool are inside a block: the real path between two blocks, for pictures and for surfaces.
use crate::kinematics::forward::Turn;
use crate::path::joint_path::{JointPath, Track};
use crate::path::rotary_path::RotaryPath;
use crate::{Joints, Leg, Machine, Pose, forward};
use trunnion_geometry::Vec3;

/// Joints and tool at one moment of a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moment {
    /// Joint values in chain order, mm or rad.
    pub joints: Joints,
    /// Tool tip in the workpiece frame without work offset, i.e. in programmed coordinates, mm.
    pub tip: Vec3,
    /// Unit tool axis in the workpiece frame.
    pub axis: Vec3,
}

/// The path of one leg, from 0 (its start) to 1 (its end): the tip moves along the programmed path (TCP), or the joints do (no TCP).
pub struct BlockPath<'a> {
    course: JointPath<'a>,
    zero: Vec3,
    bend: f64,
}

impl<'a> BlockPath<'a> {
    /// `None` where a stance or the path between the two is not known or not modelled (dwell, an arc without centre, a great circle
    /// that the joints cannot follow).
    pub fn new(machine: &'a Machine, leg: &'a Leg) -> Option<Self> {
        let course = JointPath::new(machine, leg)?;
        let zero = &leg.motion.zero;
        let mut way = Self {
            course,
            zero: Vec3::new(zero[0], zero[1], zero[2]),
            bend: 0.0,
        };
        way.bend = way.tip_bend_bound();
        Some(way)
    }

    /// Joints and tool after the share `t` of the block (held to 0..=1). Coordinates are NaN where a great circle leaves the reach.
    pub fn at(&self, t: f64) -> Moment {
        let course = &self.course;
        let t = t.clamp(0.0, 1.0);
        let joints = course.joints(t);
        let Pose { tip, axis } = forward(course.machine, &joints, course.tool_length);
        Moment {
            joints,
            tip: tip - self.zero,
            axis,
        }
    }

    /// Rates of the joints after the share `t` of the block (held to 0..=1), mm or rad per block.
    pub fn rates(&self, t: f64) -> Joints {
        let course = &self.course;
        let t = t.clamp(0.0, 1.0);
        let mut rates = course.end.joints;
        for (rate, from) in rates.iter_mut().zip(&course.start.joints) {
            *rate -= from;
        }
        let constants = course.constants();
        if matches!(course.spin, RotaryPath::GreatCircle(_)) {
            let turns = course.rates(t, &course.turns(t));
            for (rotary, turn) in constants.rotary().iter().zip(turns) {
                rates[rotary.joint] = rotary.sign * turn;
            }
        }
        let solved = course.solved_rates(t);
        for (&index, rate) in constants.solved.iter().zip(solved.iter()) {
            rates[constants.linear[index].joint] = *rate;
        }
        rates
    }

    /// Upper bound of the second derivative of the tip path, mm per block squared: between two moments that lie the share h apart the tip
    /// is no farther than `tip_bend() h^2 / 8` from where it would be on the straight line between them. Source: docs/kinematics.md#between-the-ends-of-a-block.
    pub fn tip_bend(&self) -> f64 {
        self.bend
    }

    /// Q of docs/kinematics.md#between-the-ends-of-a-block, axis by axis from the tool to the workpiece: turning a point with rate v and second derivative a by the
    /// even rate D gives at most v + D r and a + 2 D v + D^2 r, r its largest distance from the axis: at an end, or above the chord
    /// between them by a / 8.
    fn tip_bend_bound(&self) -> f64 {
        let course = &self.course;
        if course.tip {
            return match &course.track {
                Track::Line(_) => 0.0,
                Track::Arc(_) => course.track.bounds().2,
            };
        }
        let constants = course.constants();
        let count = constants.rotary_count;
        let (solved_rates, solved_bends) = course.bends(0.0, 1.0);
        let (mut rates, mut bends) = ([0.0; 3], [0.0; 3]);
        let (mut starts, mut ends) = ([Vec3::zeros(); 3], [Vec3::zeros(); 3]);
        for (index, linear) in constants.linear().iter().enumerate() {
            let (from, to) = (course.start.joints[linear.joint], course.end.joints[linear.joint]);
            let size = linear.motion.norm();
            let (rate, bend) = match constants.solved.iter().position(|&solved| solved == index) {
                Some(slot) => (solved_rates[slot], solved_bends[slot]),
                None => ((to - from).abs(), 0.0),
            };
            rates[linear.segment] += rate * size;
            bends[linear.segment] += bend * size;
            starts[linear.segment] += linear.motion * from;
            ends[linear.segment] += linear.motion * to;
        }
        let turns = course.spin_bounds(0.0, 1.0).rate;
        let (mut from, mut to) = (course.tool + starts[count], course.tool + ends[count]);
        let (mut rate, mut bend) = (rates[count], bends[count]);
        for index in (0..count).rev() {
            let axis = &constants.rotary[index];
            let off = |point: &Vec3| axis.direction.cross(&(point - axis.point)).norm();
            let radius = off(&from).max(off(&to)) + bend * 0.125;
            let turn = turns[index];
            bend += 2.0 * turn * rate + turn * turn * radius + bends[index];
            rate += turn * radius + rates[index];
            let turned = |stance: &crate::Stance, point: &Vec3| {
                Turn::new(constants, index, stance.joints[axis.joint]).apply(&(point - axis.point)) + axis.point
            };
            from = turned(course.start, &from) + starts[index];
            to = turned(course.end, &to) + ends[index];
        }
        bend * (1.0 + 1e-9)
    }
}
