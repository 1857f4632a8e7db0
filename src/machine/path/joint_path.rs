//! The joints inside a block: where they are at any share t of it, how fast they go, and how much they can bend.
//!
//! t runs from 0 to 1 with the tip path (TCP) or with the joints (no TCP). Rates are per block (d/dt), mm or rad.
use crate::follow::follower::leads_path;
use crate::kinematics::forward::Turn;
use crate::path::rotary_path::{RotaryPath, RotaryPathBounds};
use crate::{Constants, Joints, Leg, Machine, Stance};
use trunnion_geometry::Vec3;
use trunnion_geometry::arc::Arc;
use trunnion_geometry::math::sin_cos;
use trunnion_interp::{Motion, MotionKind};

/// Whether the tool axis runs on a great circle in this motion (else the rotary joints run linearly).
#[inline]
pub(crate) fn on_great_circle(machine: &Machine, motion: &Motion) -> bool {
    leads_path(motion)
        && machine.constants.pair.is_some()
        && motion.great_circle.unwrap_or(machine.control.tcp_great_circle)
}

/// What moves along a line or an arc: the tip (TCP) or the joints X Y Z (no TCP).
#[derive(Clone, Copy, Debug)]
pub(crate) enum Track {
    /// From start to end in a straight line.
    Line(Vec3),
    /// Along an arc.
    Arc(Arc),
}

impl Track {
    /// Distance from the start after the share t, and its rate.
    pub(crate) fn at(&self, t: f64) -> (Vec3, Vec3) {
        match self {
            Self::Line(way) => (way * t, *way),
            Self::Arc(arc) => (arc.point_at(t) - arc.start, arc.derivative_at(t)),
        }
    }
    /// Largest rate, smallest rate and largest second derivative.
    pub(crate) fn bounds(&self) -> (f64, f64, f64) {
        match self {
            Self::Line(way) => (way.norm(), way.norm(), 0.0),
            Self::Arc(arc) => {
                let widening = arc.radius_end - arc.radius_start;
                let rest = widening * widening + arc.height() * arc.height();
                let rate = |radius: f64| (radius * radius * arc.sweep * arc.sweep + rest).sqrt();
                let (least, most) = (
                    arc.radius_start.min(arc.radius_end),
                    arc.radius_start.max(arc.radius_end),
                );
                let bend = most * arc.sweep * arc.sweep + 2.0 * (widening * arc.sweep).abs();
                (rate(most), rate(least), bend)
            }
        }
    }
}

/// Joints and rates at one moment.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moment {
    /// The three solved linear joints, in the order of `Constants::solved`, mm.
    pub(crate) solved: Vec3,
    /// Their rates, mm per block.
    pub(crate) rates: Vec3,
}

/// One block between two known stances.
pub(crate) struct JointPath<'a> {
    pub(crate) machine: &'a Machine,
    pub(crate) start: &'a Stance,
    pub(crate) end: &'a Stance,
    pub(crate) track: Track,
    /// The track is that of the tip; else of the joints.
    pub(crate) tip: bool,
    pub(crate) tool_length: f64,
    /// Tool tip at home with all joints zero, machine frame.
    pub(crate) tool: Vec3,
    /// Turns of the rotary axes (sign times joint) at the start, rad.
    from: [f64; 2],
    /// And what is added over the block.
    change: [f64; 2],
    /// How they turn in between.
    pub(crate) spin: RotaryPath<'a>,
}

impl<'a> JointPath<'a> {
    /// `None` where a stance or the path between them is not known or not modelled.
    pub(crate) fn new(machine: &'a Machine, leg: &'a Leg) -> Option<Self> {
        let (start, end) = (leg.start.as_ref()?, leg.end.as_ref().ok()?);
        let tip = leads_path(&leg.motion);
        let tool_length = end.tool_length;
        let track = match &leg.motion.kind {
            MotionKind::Dwell(_) | MotionKind::Unknown | MotionKind::Arc(None) => return None,
            MotionKind::Arc(Some(arc)) => Track::Arc(*arc),
            MotionKind::Rapid | MotionKind::Linear if tip => Track::Line(end.point - start.point_with(tool_length)),
            MotionKind::Rapid | MotionKind::Linear => Track::Line(Vec3::zeros()),
        };
        let (mut from, mut change) = ([0.0; 2], [0.0; 2]);
        for (index, rotary) in machine.constants.rotary().iter().enumerate() {
            from[index] = rotary.sign * start.joints[rotary.joint];
            change[index] = rotary.sign * end.joints[rotary.joint] - from[index];
        }
        let tool = machine.gauge_point - machine.tool_axis * tool_length;
        let spin = RotaryPath::new(machine, leg, start, end)?;
        Some(Self {
            machine,
            start,
            end,
            track,
            tip,
            tool_length,
            tool,
            from,
            change,
            spin,
        })
    }

    pub(crate) fn constants(&self) -> &'a Constants {
        &self.machine.constants
    }

    /// Turns of the rotary axes at t; NaN where a great circle leaves the reach.
    pub(crate) fn turns(&self, t: f64) -> [Turn; 2] {
        if t <= 0.0 {
            return self.start.turns(self.machine);
        }
        if t >= 1.0 {
            return self.end.turns(self.machine);
        }
        let mut turns = self.start.turns(self.machine);
        let mut angles = [self.from[0] + self.change[0] * t, self.from[1] + self.change[1] * t];
        if let RotaryPath::GreatCircle(circle) = &self.spin {
            let rotary = &self.constants().rotary;
            let joints = circle
                .joints(t, self.start.rotary(self.machine))
                .unwrap_or([f64::NAN; 2]);
            angles = [rotary[0].sign * joints[0], rotary[1].sign * joints[1]];
        }
        for (index, turn) in turns.iter_mut().enumerate() {
            if self.change[index] != 0.0 || matches!(self.spin, RotaryPath::GreatCircle(_)) {
                (turn.sin, turn.cos) = sin_cos(angles[index]);
            }
        }
        turns
    }

    /// Rates of the turns at t, rad per block.
    pub(crate) fn rates(&self, t: f64, turns: &[Turn; 2]) -> [f64; 2] {
        match &self.spin {
            RotaryPath::Even => self.change,
            RotaryPath::GreatCircle(circle) => circle.rates(t, &turns[0].apply(&turns[1].axis)),
        }
    }

    /// Bounds of the turns' rates and second derivatives on a piece of the block.
    pub(crate) fn spin_bounds(&self, from: f64, to: f64) -> RotaryPathBounds {
        match &self.spin {
            RotaryPath::Even => RotaryPathBounds {
                rate: [self.change[0].abs(), self.change[1].abs()],
                bend: [0.0; 2],
            },
            RotaryPath::GreatCircle(circle) => circle.bounds(from, to),
        }
    }

    /// Shifts by the linear axes that inverse kinematics does not solve for, at start and end.
    pub(crate) fn idle_shifts(&self) -> ([Vec3; 3], [Vec3; 3]) {
        let constants = self.constants();
        let (mut start, mut end) = ([Vec3::zeros(); 3], [Vec3::zeros(); 3]);
        if constants.linear_count > 3 {
            for (index, linear) in constants.linear().iter().enumerate() {
                if !constants.solved.contains(&index) {
                    start[linear.segment] += linear.motion * self.start.joints[linear.joint];
                    end[linear.segment] += linear.motion * self.end.joints[linear.joint];
                }
            }
        }
        (start, end)
    }

    /// All joints after the share `t` of the block, 0..=1; NaN where a great circle leaves the reach.
    pub(crate) fn joints(&self, t: f64) -> Joints {
        let (start, end) = (self.start, self.end);
        let mut joints: Joints = start.joints;
        for (value, (from, to)) in joints.iter_mut().zip(start.joints.iter().zip(&end.joints)) {
            *value = if t >= 1.0 { *to } else { from + (to - from) * t };
        }
        if t > 0.0 && t < 1.0 {
            if let RotaryPath::GreatCircle(circle) = &self.spin {
                let turned = circle.joints(t, start.rotary(self.machine)).unwrap_or([f64::NAN; 2]);
                for (rotary, value) in self.constants().rotary().iter().zip(turned) {
                    joints[rotary.joint] = value;
                }
            }
            let solved = self.moment(t).solved;
            for (&index, value) in self.constants().solved.iter().zip(solved.iter()) {
                joints[self.constants().linear[index].joint] = *value;
            }
        }
        joints
    }

    /// The three solved joints of a stance.
    pub(crate) fn solved(&self, joints: &Joints) -> Vec3 {
        let [a, b, c] = self
            .constants()
            .solved
            .map(|index| joints[self.constants().linear[index].joint]);
        Vec3::new(a, b, c)
    }

    /// Linear joints and their rates at t. Without TCP the joints follow the track, with TCP they are solved from the tip:
    /// J q = P - p0, J q' = P' - p0' - J' q (docs/kinematics.md#linear-axes-for-a-given-tip, differentiated).
    pub(crate) fn moment(&self, t: f64) -> Moment {
        if !self.tip {
            return self.joint_moment(t);
        }
        let constants = self.constants();
        let turns = self.turns(t);
        let spins = self.rates(t, &turns);
        let spin = |index: usize, v: &Vec3| turns[index].axis.cross(v) * spins[index];
        let (start, end) = self.idle_shifts();
        let count = constants.rotary_count;
        // p0: the tool point with the solved joints at zero, and its rate
        let (mut point, mut rate) = (self.tool + start[count], end[count] - start[count]);
        point += rate * t;
        for index in (0..count).rev() {
            let centre = constants.rotary[index].point;
            let arm = turns[index].apply(&(point - centre));
            let idle = end[index] - start[index];
            rate = turns[index].apply(&rate) + spin(index, &arm) + idle;
            point = arm + centre + start[index] + idle * t;
        }
        let (mut columns, mut column_rates) = ([Vec3::zeros(); 3], [Vec3::zeros(); 3]);
        for (slot, &solved) in constants.solved.iter().enumerate() {
            let linear = &constants.linear[solved];
            let (mut column, mut column_rate) = (linear.motion, Vec3::zeros());
            for index in (0..linear.segment).rev() {
                column = turns[index].apply(&column);
                column_rate = turns[index].apply(&column_rate) + spin(index, &column);
            }
            columns[slot] = column;
            column_rates[slot] = column_rate;
        }
        let (way, tip_rate) = self.track.at(t);
        let tip = self.start.point_with(self.tool_length) + way;
        let solved = solve(&columns, &(tip - point));
        let drift = column_rates[0] * solved.x + column_rates[1] * solved.y + column_rates[2] * solved.z;
        Moment {
            solved,
            rates: solve(&columns, &(tip_rate - rate - drift)),
        }
    }

    /// Without TCP: X Y Z words run along the track, other joints linearly.
    pub(crate) fn joint_moment(&self, t: f64) -> Moment {
        let (from, to) = (self.solved(&self.start.joints), self.solved(&self.end.joints));
        let mut moment = Moment {
            solved: from + (to - from) * t,
            rates: to - from,
        };
        if let Track::Arc(_) = self.track {
            let (way, rate) = self.track.at(t);
            for letter in 0..3 {
                let Some(joint) = self.machine.joint_of_letter[letter] else {
                    continue;
                };
                let solved = self.constants().solved;
                let slot = solved
                    .iter()
                    .position(|&i| self.constants().linear[i].joint == usize::from(joint));
                if let Some(slot) = slot {
                    moment.solved[slot] = from[slot] + way[letter];
                    moment.rates[slot] = rate[letter];
                }
            }
        }
        moment
    }
}

/// Solves a 3x3 system given by columns (Cramer's rule); not finite where they do not span space.
#[inline]
fn solve(columns: &[Vec3; 3], right: &Vec3) -> Vec3 {
    let [a, b, c] = columns;
    let (bc, ca, ab) = (b.cross(c), c.cross(a), a.cross(b));
    let volume = a.dot(&bc);
    Vec3::new(right.dot(&bc), right.dot(&ca), right.dot(&ab)) / volume
}
