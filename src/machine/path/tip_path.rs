//! The path of the tip in the workpiece while the joints run without tool centre point control, and how much it can bend.
use crate::kinematics::inverse::place;
use crate::{Machine, Stance};
use trunnion_geometry::Vec3;
use trunnion_geometry::arc::Arc;
use trunnion_geometry::math::sin_cos;

/// Share of a coordinate that rounding may cost in a whole chain; the bound is padded by it.
pub(crate) const ROUNDING: f64 = 1e-13;

/// What the joints do between two stances while all of them run linearly.
pub(crate) struct Run<'a> {
    machine: &'a Machine,
    start: &'a Stance,
    tool: Vec3,
    /// Turns of the rotary axes at the start and what the block adds, rad.
    angles: [f64; 2],
    change: [f64; 2],
    shifts: [Vec3; 3],
    ways: [Vec3; 3],
    /// Tip at the start, mm.
    from: Vec3,
    /// Displacement of the tip from start to end, mm.
    chord: Vec3,
}

/// The tip path W(t) in the workpiece frame while all joints run linearly (X Y Z perhaps along an arc), and the chord of its ends.
pub(crate) struct TipPath<'a> {
    run: Run<'a>,
    /// Words that move along an arc.
    bulge: Option<Bulge>,
    /// Displacement of the tip from start to end, mm.
    pub(crate) chord: Vec3,
    /// Q: bound of |W''|, mm per block squared.
    pub(crate) bend: f64,
    /// Padding for rounding, mm.
    pub(crate) rounding: f64,
}

/// What an arc in the words X Y Z adds to a straight run of their joints.
pub(crate) struct Bulge {
    arc: Arc,
    /// For X, Y, Z: place in the chain and motion of the joint per mm of word, machine frame.
    motions: [Option<(usize, Vec3)>; 3],
}

impl Bulge {
    fn new(machine: &Machine, arc: &Arc) -> Self {
        let mut motions = [None; 3];
        for linear in machine.constants.linear() {
            for (letter, motion) in motions.iter_mut().enumerate() {
                if machine.joint_of_letter[letter].map(usize::from) == Some(linear.joint) {
                    *motion = Some((linear.segment, linear.motion));
                }
            }
        }
        Self { arc: *arc, motions }
    }

    /// Offset of the words from their chord at t, mm; zero at both ends.
    fn at(&self, t: f64) -> Vec3 {
        self.arc.point_at(t) - self.arc.start - (self.arc.end - self.arc.start) * t
    }

    /// Largest rate of the path relative to the chord, and largest second derivative.
    fn bounds(&self) -> (f64, f64) {
        let (fastest, _, bend) = crate::path::joint_path::Track::Arc(self.arc).bounds();
        (fastest + (self.arc.end - self.arc.start).norm(), bend)
    }
}

/// How much longer than v the vector sum of v's components along `columns` can be: the root of the largest row sum of their products
/// (Gershgorin), exactly 1 for orthonormal columns.
fn gain(columns: &[Vec3]) -> f64 {
    let row = |a: &Vec3| columns.iter().map(|b| a.dot(b).abs()).sum::<f64>();
    columns.iter().map(row).fold(0.0, f64::max).sqrt() * (1.0 + 1e-12)
}

impl<'a> Run<'a> {
    /// From `start` to `end`.
    #[inline]
    pub(crate) fn new(machine: &'a Machine, start: &'a Stance, end: &Stance) -> Self {
        let constants = &machine.constants;
        let tool = machine.gauge_point - machine.tool_axis * end.tool_length;
        let (mut shifts, mut ways) = ([Vec3::zeros(); 3], [Vec3::zeros(); 3]);
        if let Some(segment) = constants.only_segment {
            let (mut shift, mut way) = (Vec3::zeros(), Vec3::zeros());
            for linear in constants.linear() {
                let (from, to) = (start.joints[linear.joint], end.joints[linear.joint]);
                shift += linear.motion * from;
                way += linear.motion * (to - from);
            }
            (shifts[segment], ways[segment]) = (shift, way);
        } else {
            for linear in constants.linear() {
                let (from, to) = (start.joints[linear.joint], end.joints[linear.joint]);
                shifts[linear.segment] += linear.motion * from;
                ways[linear.segment] += linear.motion * (to - from);
            }
        }
        let (mut angles, mut change) = ([0.0; 2], [0.0; 2]);
        for (index, rotary) in constants.rotary().iter().enumerate() {
            angles[index] = rotary.sign * start.joints[rotary.joint];
            change[index] = rotary.sign * end.joints[rotary.joint] - angles[index];
        }
        let from = start.point_with(end.tool_length);
        Self {
            machine,
            start,
            tool,
            angles,
            change,
            shifts,
            ways,
            from,
            chord: end.point - from,
        }
    }

    /// Bounds of rate and second derivative of the linear shift at a place of the chain.
    #[inline]
    fn shift_bounds(&self, bulge: Option<&Bulge>, segment: usize) -> (f64, f64) {
        if !self.machine.constants.occupied[segment] {
            return (0.0, 0.0);
        }
        let way = self.ways[segment].norm();
        let Some(bulge) = bulge else { return (way, 0.0) };
        let mut columns = [Vec3::zeros(); 3];
        for (column, motion) in columns.iter_mut().zip(&bulge.motions) {
            if let Some((at, motion)) = motion
                && *at == segment
            {
                *column = *motion;
            }
        }
        let gain = gain(&columns);
        let (rate, bend) = bulge.bounds();
        (way + gain * rate, gain * bend)
    }

    /// `bend` and `rounding` of a path, axis by axis from the tool to the workpiece: turning a point with rate v and second derivative at
    /// most a by D adds D r to v and 2 D v + D^2 r to a, r its largest distance from the axis: at an end, or above the chord by a / 8.
    /// Before the axis nearest the tool the point runs straight or along an arc; after the axis nearest the workpiece it is the tip itself,
    /// and a turn keeps distances from its axis: with two rotary axes no point needs to be turned. Source: docs/kinematics.md#between-the-ends-of-a-block.
    #[inline]
    pub(crate) fn bound(&self, bulge: Option<&Bulge>) -> (f64, f64) {
        let rotary = self.machine.constants.rotary();
        let count = rotary.len();
        let (mut rate, mut bend) = self.shift_bounds(bulge, count);
        let arm = self.tool + self.shifts[count];
        let mut size = arm.abs().sum() + self.shifts[0].abs().sum() + self.from.abs().sum() + self.chord.abs().sum();
        if let Some(bulge) = bulge {
            size += bulge.arc.start.abs().sum() + bulge.arc.centre.abs().sum() + bulge.arc.radius_end;
        }
        for (index, axis) in rotary.iter().enumerate().rev() {
            let (from, way) = if index + 1 == count {
                (arm, self.ways[count])
            } else {
                (self.from - self.shifts[0], self.chord - self.ways[0])
            };
            let off = |arm: &Vec3| axis.direction.cross(arm).norm_squared();
            let radius = off(&(from - axis.point)).max(off(&(from - axis.point + way))).sqrt() + bend * 0.125;
            let turned = self.change[index].abs();
            let shift = self.shift_bounds(bulge, index);
            bend += 2.0 * turned * rate + turned * turned * radius + shift.1;
            rate += turned * radius + shift.0;
            size += axis.point.abs().sum() + self.shifts[index].abs().sum() + self.ways[index].abs().sum();
        }
        (bend * (1.0 + 1e-9), size * ROUNDING)
    }
}

/// Bound of the distance between the tip's path and its chord while all joints run straight from `start` to `end`, mm: the eighth of the
/// largest second derivative, and rounding. Source: docs/kinematics.md#between-the-ends-of-a-block.
#[inline]
pub(crate) fn straight_stray(machine: &Machine, start: &Stance, end: &Stance) -> f64 {
    let (bend, rounding) = Run::new(machine, start, end).bound(None);
    bend * 0.125 + rounding
}

impl<'a> TipPath<'a> {
    /// `arc`: what the words X Y Z run along, if not a line.
    pub(crate) fn new(run: Run<'a>, arc: Option<&Arc>) -> Self {
        let bulge = arc.map(|arc| Bulge::new(run.machine, arc));
        let (bend, rounding) = run.bound(bulge.as_ref());
        Self {
            chord: run.chord,
            run,
            bulge,
            bend,
            rounding,
        }
    }

    /// W(t) less the tip at the start, mm; exactly zero and the chord at the ends.
    pub(crate) fn way(&self, t: f64) -> Vec3 {
        if t <= 0.0 {
            return Vec3::zeros();
        }
        if t >= 1.0 {
            return self.chord;
        }
        let run = &self.run;
        let mut shifts = run.shifts;
        for (shift, way) in shifts.iter_mut().zip(&run.ways) {
            *shift += way * t;
        }
        if let Some(bulge) = &self.bulge {
            let off = bulge.at(t);
            for (value, motion) in off.iter().zip(&bulge.motions) {
                if let Some((segment, motion)) = motion {
                    shifts[*segment] += motion * *value;
                }
            }
        }
        let mut turns = run.start.turns(run.machine);
        for (index, turn) in turns.iter_mut().enumerate() {
            if run.change[index] != 0.0 {
                (turn.sin, turn.cos) = sin_cos(run.angles[index] + run.change[index] * t);
            }
        }
        place(&run.machine.constants, &turns, &shifts, &run.tool) - run.from
    }

    /// The segment that an arc programs, in the workpiece: the arc in its position in the workpiece at the start of the block, its end carried
    /// evenly to where the tip ends. Without rotary motion it is the arc itself.
    pub(crate) fn laid_arc(&self) -> Option<LaidArc<'_>> {
        let bulge = self.bulge.as_ref()?;
        let turns = self.run.start.turns(self.run.machine);
        let columns = bulge.motions.map(|motion| {
            let Some((segment, motion)) = motion else {
                return Vec3::zeros();
            };
            turns[..segment].iter().rev().fold(motion, |v, turn| turn.apply(&v))
        });
        let bend = gain(&columns) * bulge.bounds().1;
        Some(LaidArc {
            bulge,
            columns,
            chord: self.chord,
            bend,
        })
    }
}

/// See [`TipPath::laid_arc`].
pub(crate) struct LaidArc<'p> {
    bulge: &'p Bulge,
    columns: [Vec3; 3],
    chord: Vec3,
    /// Bound of the second derivative, mm per block squared.
    pub(crate) bend: f64,
}

impl LaidArc<'_> {
    /// Displacement from the start after the share s, mm.
    pub(crate) fn way(&self, s: f64) -> Vec3 {
        if s <= 0.0 {
            return Vec3::zeros();
        }
        if s >= 1.0 {
            return self.chord;
        }
        let off = self.bulge.at(s);
        self.chord * s + self.columns[0] * off.x + self.columns[1] * off.y + self.columns[2] * off.z
    }
}
