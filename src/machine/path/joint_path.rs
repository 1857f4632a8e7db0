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
    /// `None` where a stance or the path between them is not known or not modelled, and where the linear axes cannot follow.
    pub(crate) fn new(machine: &'a Machine, leg: &'a Leg) -> Option<Self> {
        Self::unproven(machine, leg).filter(|path| !path.passes_singular())
    }

    /// The same where the linear axes may not be able to follow.
    pub(crate) fn unproven(machine: &'a Machine, leg: &'a Leg) -> Option<Self> {
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
            let solved = self.solved_at(t);
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

    /// The three solved linear joints at t, in the order of `Constants::solved`, mm. Without TCP the joints follow the track, with TCP they are
    /// solved from the tip: J q = P - p0 (docs/kinematics.md#linear-axes-for-a-given-tip).
    pub(crate) fn solved_at(&self, t: f64) -> Vec3 {
        if !self.tip {
            return self.without_tip(t)[0];
        }
        if t <= 0.0 {
            return self.solved(&self.start.joints);
        }
        if t >= 1.0 {
            return self.solved(&self.end.joints);
        }
        self.solved_under(t, &self.turns(t))
    }

    /// The same inside the block with tool centre point control, under these turns.
    fn solved_under(&self, t: f64, turns: &[Turn; 2]) -> Vec3 {
        let constants = self.constants();
        let (start, end) = self.idle_shifts();
        let count = constants.rotary_count;
        // p0: the tool point with the solved joints at zero
        let mut point = self.tool + start[count] + (end[count] - start[count]) * t;
        for index in (0..count).rev() {
            let centre = constants.rotary[index].point;
            point = turns[index].apply(&(point - centre)) + centre + start[index] + (end[index] - start[index]) * t;
        }
        let (way, _) = self.track.at(t);
        let tip = self.start.point_with(self.tool_length) + way;
        self.joints_for(turns, tip - point)
    }

    /// The values of the solved joints that move the tip by `way`, mm, under these turns: J q = way. What turns all three is taken off both sides.
    fn joints_for(&self, turns: &[Turn; 2], mut way: Vec3) -> Vec3 {
        let constants = self.constants();
        let linear = constants.solved.map(|solved| &constants.linear[solved]);
        let shared = linear.iter().map(|linear| linear.segment).min().unwrap_or(0);
        for turn in &turns[..shared] {
            way = turn.undo(&way);
        }
        let columns = linear.map(|linear| {
            let turned = |column, index: usize| turns[index].apply(&column);
            (shared..linear.segment).rev().fold(linear.motion, turned)
        });
        solve(&columns, &way)
    }

    /// Rates of the three solved joints at t, mm per block: what the tip has to move beside what the other axes move it,
    /// J q' = P' - (p0' + J' q) (docs/kinematics.md#linear-axes-for-a-given-tip, differentiated). The bracket is the rate of the tip while the solved
    /// joints stand.
    pub(crate) fn solved_rates(&self, t: f64) -> Vec3 {
        if !self.tip {
            return self.without_tip(t)[1];
        }
        let constants = self.constants();
        let turns = self.turns(t);
        let spins = self.rates(t, &turns);
        let solved = if t <= 0.0 {
            self.solved(&self.start.joints)
        } else if t >= 1.0 {
            self.solved(&self.end.joints)
        } else {
            self.solved_under(t, &turns)
        };
        let (mut shifts, end) = self.idle_shifts();
        let mut rates = [Vec3::zeros(); 3];
        for ((shift, rate), end) in shifts.iter_mut().zip(&mut rates).zip(&end) {
            *rate = end - *shift;
            *shift += *rate * t;
        }
        for (&index, value) in constants.solved.iter().zip(solved.iter()) {
            let linear = &constants.linear[index];
            shifts[linear.segment] += linear.motion * *value;
        }
        let count = constants.rotary_count;
        let (mut point, mut rate) = (self.tool + shifts[count], rates[count]);
        for index in (0..count).rev() {
            let centre = constants.rotary[index].point;
            let arm = turns[index].apply(&(point - centre));
            rate = turns[index].apply(&rate) + turns[index].axis.cross(&arm) * spins[index] + rates[index];
            point = arm + centre + shifts[index];
        }
        let (_, tip_rate) = self.track.at(t);
        self.joints_for(&turns, tip_rate - rate)
    }

    /// Without TCP, the solved joints and their rates: X Y Z words run along the track, other joints linearly.
    pub(crate) fn without_tip(&self, t: f64) -> [Vec3; 2] {
        let (from, to) = (self.solved(&self.start.joints), self.solved(&self.end.joints));
        let (mut solved, mut rates) = (from + (to - from) * t, to - from);
        if let Track::Arc(_) = self.track {
            let (way, rate) = self.track.at(t);
            for letter in 0..3 {
                let Some(joint) = self.machine.joint_of_letter[letter] else {
                    continue;
                };
                let constants = self.constants();
                let slot = constants
                    .solved
                    .iter()
                    .position(|&i| constants.linear[i].joint == usize::from(joint));
                if let Some(slot) = slot {
                    solved[slot] = from[slot] + way[letter];
                    rates[slot] = rate[letter];
                }
            }
        }
        [solved, rates]
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
