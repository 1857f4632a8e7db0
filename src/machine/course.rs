//! The joints inside a block: where they are at any share t of it, how fast they go, and how much they can bend.
//!
//! t runs from 0 to 1 with the tip path (TCP) or with the joints (no TCP). Rates are per block (d/dt), mm or rad.
use crate::follow::has_tip_words;
use crate::forward::{Turn, segment_shifts};
use crate::{Constants, Joints, Leg, Machine, Stance};
use trunnion_geometry::arc::Arc;
use trunnion_geometry::math::sin_cos;
use trunnion_geometry::{Mat3, Vec3};
use trunnion_interp::{Motion, MotionKind};

/// Whether the tool axis runs on a great circle in this motion (else the rotary joints run linearly).
#[inline]
pub(crate) fn on_great_circle(machine: &Machine, motion: &Motion) -> bool {
    has_tip_words(motion)
        && machine.constants.pair.is_some()
        && motion.great_circle.unwrap_or(machine.control.tcp_great_circle)
}

/// What runs along a line or an arc: the tip (TCP) or the joints X Y Z (no TCP).
#[derive(Clone, Copy, Debug)]
pub(crate) enum Track {
    /// From start to end in a straight line.
    Line(Vec3),
    /// Along an arc.
    Arc(Arc),
}

impl Track {
    /// Way from the start after the share t, and its rate.
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
                let (least, most) = (arc.radius_start.min(arc.radius_end), arc.radius_start.max(arc.radius_end));
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
pub(crate) struct Course<'a> {
    pub(crate) machine: &'a Machine,
    pub(crate) start: &'a Stance,
    pub(crate) end: &'a Stance,
    pub(crate) track: Track,
    /// The track is the tip's; else the joints'.
    pub(crate) tip: bool,
    pub(crate) tool_length: f64,
    /// Tool tip at home with all joints zero, machine frame.
    pub(crate) tool: Vec3,
    /// Turns of the rotary axes (sign times joint) at the start, rad.
    from: [f64; 2],
    /// And what is added over the block.
    change: [f64; 2],
}

impl<'a> Course<'a> {
    /// `None` where a stance or the path between them is not known or not modelled.
    pub(crate) fn new(machine: &'a Machine, leg: &'a Leg) -> Option<Self> {
        let (start, end) = (leg.start.as_ref()?, leg.end.as_ref().ok()?);
        let tip = has_tip_words(&leg.motion);
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
        Some(Self { machine, start, end, track, tip, tool_length, tool, from, change })
    }

    fn constants(&self) -> &'a Constants {
        &self.machine.constants
    }

    /// Absolute turns of the rotary axes over the block, rad.
    pub(crate) fn turned(&self) -> [f64; 2] {
        [self.change[0].abs(), self.change[1].abs()]
    }

    /// Whether some rotary axis moves.
    pub(crate) fn turns_at_all(&self) -> bool {
        self.change != [0.0; 2]
    }

    /// Turns of the rotary axes at t.
    pub(crate) fn turns(&self, t: f64) -> [Turn; 2] {
        let mut turns = self.start.turns(self.machine);
        for (index, turn) in turns.iter_mut().enumerate() {
            if self.change[index] != 0.0 {
                (turn.sin, turn.cos) = sin_cos(self.from[index] + self.change[index] * t);
            }
        }
        turns
    }

    /// Shifts of the segments by all linear axes at start and end (joints run linearly).
    pub(crate) fn shifts(&self) -> ([Vec3; 3], [Vec3; 3]) {
        let constants = self.constants();
        (segment_shifts(constants, &self.start.joints), segment_shifts(constants, &self.end.joints))
    }

    /// Shifts by the linear axes that inverse kinematics does not solve for, at start and end.
    fn idle_shifts(&self) -> ([Vec3; 3], [Vec3; 3]) {
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

    /// The three solved joints of a stance.
    pub(crate) fn solved(&self, joints: &Joints) -> Vec3 {
        let [a, b, c] = self.constants().solved.map(|index| joints[self.constants().linear[index].joint]);
        Vec3::new(a, b, c)
    }

    /// Linear joints and their rates at t. Without TCP the joints follow the track, with TCP they are solved from the tip:
    /// J q = P - p0, J q' = P' - p0' - J' q (kinematics notes 2.2, differentiated).
    pub(crate) fn moment(&self, t: f64) -> Moment {
        if !self.tip {
            return self.joint_moment(t);
        }
        let constants = self.constants();
        let turns = self.turns(t);
        let spin = |index: usize, v: &Vec3| turns[index].axis.cross(v) * self.change[index];
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
        Moment { solved, rates: solve(&columns, &(tip_rate - rate - drift)) }
    }

    /// Without TCP: X Y Z words run along the track, other joints linearly.
    fn joint_moment(&self, t: f64) -> Moment {
        let (from, to) = (self.solved(&self.start.joints), self.solved(&self.end.joints));
        let mut moment = Moment { solved: from + (to - from) * t, rates: to - from };
        if let Track::Arc(_) = self.track {
            let (way, rate) = self.track.at(t);
            for letter in 0..3 {
                let Some(joint) = self.machine.joint_of_letter[letter] else { continue };
                let solved = self.constants().solved;
                let slot = solved.iter().position(|&i| self.constants().linear[i].joint == usize::from(joint));
                if let Some(slot) = slot {
                    moment.solved[slot] = from[slot] + way[letter];
                    moment.rates[slot] = rate[letter];
                }
            }
        }
        moment
    }

    /// Upper bounds of the rates and of the second derivatives of the three solved joints over the block, mm per block and mm per
    /// block squared; infinite where nothing is proven.
    pub(crate) fn bends(&self) -> (Vec3, Vec3) {
        let (fastest, _, bend) = self.track.bounds();
        if !self.tip {
            return match self.track {
                Track::Line(_) => (self.joint_moment(0.0).rates.abs(), Vec3::zeros()),
                Track::Arc(_) => (Vec3::repeat(fastest), Vec3::repeat(bend)),
            };
        }
        let constants = self.constants();
        let Some(segment) = constants.shared_segment else { return self.mixed_bends(fastest, bend) };
        let turned = self.turned();
        let (start, end) = self.idle_shifts();
        let [turns_start, turns_end] = [self.start.turns(self.machine), self.end.turns(self.machine)];
        let (from, to) = (self.start.point_with(self.tool_length), self.end.point);
        // from the workpiece to the segment: Z = R^T (P - c) + c
        let mut wanted = Carried::new(from, to, fastest, bend);
        for index in 0..segment {
            wanted.shift(&-start[index], &-end[index]);
            let centre = constants.rotary[index].point;
            wanted.turn(turned[index], &centre, &turns_start[index], &turns_end[index], Turn::undo);
        }
        // from the tool to the segment
        let count = constants.rotary_count;
        let mut tool = Carried::new(self.tool, self.tool, 0.0, 0.0);
        for index in (segment..count).rev() {
            tool.shift(&start[index + 1], &end[index + 1]);
            let centre = constants.rotary[index].point;
            tool.turn(turned[index], &centre, &turns_start[index], &turns_end[index], Turn::apply);
        }
        tool.shift(&start[segment], &end[segment]);
        let rows = constants.inverse_motion;
        let row = |i: usize| rows.row(i).norm();
        let rows = Vec3::new(row(0), row(1), row(2));
        (rows * (wanted.rate + tool.rate), rows * (wanted.bend + tool.bend))
    }

    /// [`Course::bends`] where the solved axes lie in different segments: J q = r gives |q'| <= k (|r'| + G |q|) and
    /// |q''| <= k (|r''| + 2 G |q'| + G2 |q|) with k the norm of J^-1, G and G2 bounds of |J'| and |J''|. Proven while J stays near its
    /// value at the start, else infinite.
    fn mixed_bends(&self, fastest: f64, bend: f64) -> (Vec3, Vec3) {
        let nothing = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::INFINITY));
        let constants = self.constants();
        let turned = self.turned();
        let [turns_start, turns_end] = [self.start.turns(self.machine), self.end.turns(self.machine)];
        let (mut columns, mut spin2, mut spin4) = ([Vec3::zeros(); 3], 0.0, 0.0);
        for (slot, &solved) in constants.solved.iter().enumerate() {
            let linear = &constants.linear[solved];
            columns[slot] = turns_start[..linear.segment].iter().rev().fold(linear.motion, |m, turn| turn.apply(&m));
            let rate: f64 = turned[..linear.segment].iter().sum();
            spin2 += rate * rate;
            spin4 += rate * rate * rate * rate;
        }
        let (spin, spin_bend) = (spin2.sqrt(), spin4.sqrt());
        let Some(inverse) = Mat3::from_columns(&columns).try_inverse() else { return nothing };
        let at_start = inverse.norm();
        let k = at_start / (1.0 - at_start * spin);
        if !(at_start * spin < 0.9) {
            return nothing;
        }
        let (start, end) = self.idle_shifts();
        let count = constants.rotary_count;
        let mut point = Carried::new(self.tool, self.tool, 0.0, 0.0);
        point.shift(&start[count], &end[count]);
        for index in (0..count).rev() {
            let centre = constants.rotary[index].point;
            point.turn(turned[index], &centre, &turns_start[index], &turns_end[index], Turn::apply);
            point.shift(&start[index], &end[index]);
        }
        let (rate, bend) = (fastest + point.rate, bend + point.bend);
        let (from, to) = (self.start.point_with(self.tool_length), self.end.point);
        let reach = (from - point.start).norm().max((to - point.end).norm()) + bend * 0.125;
        let size = k * reach;
        let rate = k * (rate + spin * size);
        let bend = k * (bend + 2.0 * spin * rate + spin_bend * size);
        (Vec3::repeat(rate), Vec3::repeat(bend))
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

/// A point that is carried through the chain: its ends, and bounds of its first and second derivative over the block.
///
/// Turning by an angle whose rate is at most D and constant adds D r to the rate and 2 D v + D^2 r to the second derivative, r being the
/// largest distance from the axis (kinematics notes 3, taken axis by axis). r is largest at an end or above its chord by bend / 8.
pub(crate) struct Carried {
    pub(crate) start: Vec3,
    pub(crate) end: Vec3,
    /// Bound of the rate.
    pub(crate) rate: f64,
    /// Bound of the second derivative.
    pub(crate) bend: f64,
}

impl Carried {
    pub(crate) fn new(start: Vec3, end: Vec3, rate: f64, bend: f64) -> Self {
        Self { start, end, rate, bend }
    }
    /// Adds a shift that runs linearly.
    pub(crate) fn shift(&mut self, start: &Vec3, end: &Vec3) {
        self.start += start;
        self.end += end;
        self.rate += (end - start).norm();
    }
    /// Turns about an axis through `centre` by an angle that changes by `turned` over the block.
    pub(crate) fn turn(&mut self, turned: f64, centre: &Vec3, start: &Turn, end: &Turn, apply: impl Fn(&Turn, &Vec3) -> Vec3) {
        let (from, to) = (self.start - centre, self.end - centre);
        if turned > 0.0 {
            let off = |arm: &Vec3| start.axis.cross(arm).norm();
            let radius = off(&from).max(off(&to)) + self.bend * 0.125;
            self.bend += 2.0 * turned * self.rate + turned * turned * radius;
            self.rate += turned * radius;
        }
        self.start = apply(start, &from) + centre;
        self.end = apply(end, &to) + centre;
    }
}
