//! How far the tip strays from the programmed segment inside a block: sampled value and proven bound.
use crate::bound::{Piece, peak};
use crate::follow::has_tip_words;
use crate::inverse::place;
use crate::{Leg, Machine, Stance};
use trunnion_geometry::Vec3;
use trunnion_geometry::math::sin_cos;
use trunnion_interp::MotionKind;

/// Deviation of the tip path from the programmed segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// Largest distance found at a sample, mm (never above the truth).
    pub sampled_mm: f64,
    /// Proven upper bound, mm (never below the truth).
    pub bound_mm: f64,
    /// Share of the block, 0..=1, where the largest sample lies.
    pub at: f64,
}

/// Where sample and bound are this near, mm, more samples say nothing more.
const CLOSE_MM: f64 = 2e-5;

/// Samples spent on closeness; beyond them a bound of [`RATIO`] times the sample is enough.
const CLOSE_SAMPLES: u32 = 256;

/// Above the tolerance the bound is at most this multiple of the truth.
const RATIO: f64 = 1.2;

/// Share of a coordinate that rounding may cost in a whole chain; the bound is padded by it.
const ROUNDING: f64 = 1e-13;

/// Set distance of the tip path to the programmed segment. `tolerance_mm`: the bound may be loose where it already proves
/// this; above it, it is at most 1.2 times the truth. `None`: not modelled (arc with moving rotary axes) or unknown stance.
///
/// The segment joins the tips at both ends in the workpiece frame. With TCP or vectors the control keeps the tip on the programmed
/// path, so the deviation is zero by construction, and so it is where no rotary axis moves. Without TCP the joints run linearly and
/// the tip on W(t); bound: largest sample + Q h^2 / 8 per piece of length h, Q >= |W''|. Source: kinematics notes 3.
pub fn tip_deviation(machine: &Machine, leg: &Leg, tolerance_mm: f64) -> Option<Deviation> {
    let none = Deviation {
        sampled_mm: 0.0,
        bound_mm: 0.0,
        at: 0.0,
    };
    let (start, end) = (leg.start.as_ref()?, leg.end.as_ref().ok()?);
    let is_arc = match leg.motion.kind {
        MotionKind::Dwell(_) | MotionKind::Unknown | MotionKind::Arc(None) => return None,
        MotionKind::Arc(Some(_)) => true,
        MotionKind::Rapid | MotionKind::Linear => false,
    };
    if leg.rotary_change == [0.0; 2] || has_tip_words(&leg.motion) {
        return Some(none);
    }
    if is_arc {
        return None;
    }
    let path = TipPath::new(machine, start, end);
    let tolerance = tolerance_mm.max(0.0);
    let at_once = path.bend * 0.125 + path.rounding;
    if at_once <= tolerance {
        return Some(Deviation {
            bound_mm: at_once,
            ..none
        });
    }
    let room = (tolerance - path.rounding).max(0.0);
    let found = peak(
        |t| path.distance(t),
        |piece: &Piece| piece.below_parabola(path.bend),
        |bound, sampled, samples| {
            bound <= room || bound <= sampled + CLOSE_MM || (samples > CLOSE_SAMPLES && bound <= sampled * RATIO)
        },
    );
    Some(Deviation {
        sampled_mm: found.sampled,
        bound_mm: found.bound + path.rounding,
        at: found.at,
    })
}

/// The tip path W(t) in the workpiece frame while all joints run linearly, and the segment it should follow.
struct TipPath<'a> {
    machine: &'a Machine,
    start: &'a Stance,
    tool: Vec3,
    /// Turns of the rotary axes at the start and what the block adds, rad.
    angles: [f64; 2],
    change: [f64; 2],
    shifts: [Vec3; 3],
    ways: [Vec3; 3],
    from: Vec3,
    chord: Vec3,
    per_chord: f64,
    /// Q: bound of |W''|, mm per block squared.
    bend: f64,
    /// Padding for rounding, mm.
    rounding: f64,
}

impl<'a> TipPath<'a> {
    fn new(machine: &'a Machine, start: &'a Stance, end: &Stance) -> Self {
        let constants = &machine.constants;
        let tool = machine.gauge_point - machine.tool_axis * end.tool_length;
        let (mut shifts, mut ways) = ([Vec3::zeros(); 3], [Vec3::zeros(); 3]);
        for linear in constants.linear() {
            let (from, to) = (start.joints[linear.joint], end.joints[linear.joint]);
            shifts[linear.segment] += linear.motion * from;
            ways[linear.segment] += linear.motion * (to - from);
        }
        let (mut angles, mut change) = ([0.0; 2], [0.0; 2]);
        for (index, rotary) in constants.rotary().iter().enumerate() {
            angles[index] = rotary.sign * start.joints[rotary.joint];
            change[index] = rotary.sign * end.joints[rotary.joint] - angles[index];
        }
        let from = start.point_with(end.tool_length);
        let chord = end.point - from;
        let length2 = chord.norm_squared();
        let mut path = Self {
            machine,
            start,
            tool,
            angles,
            change,
            shifts,
            ways,
            from,
            chord,
            per_chord: if length2 > 0.0 { 1.0 / length2 } else { 0.0 },
            bend: 0.0,
            rounding: 0.0,
        };
        path.bound();
        path
    }

    /// Works out `bend` and `rounding`, axis by axis from the tool to the workpiece: turning a point with rate v and second derivative at
    /// most a by D adds D r to v and 2 D v + D^2 r to a, r its largest distance from the axis: at an end, or above the chord by a / 8.
    /// Before the axis nearest the tool the point runs straight; after the axis nearest the workpiece it is the tip itself, and a turn
    /// keeps distances from its axis: with two rotary axes no point needs to be turned. Source: kinematics notes 3.
    fn bound(&mut self) {
        let rotary = self.machine.constants.rotary();
        let count = rotary.len();
        let (mut rate, mut bend) = (self.ways[count].norm(), 0.0);
        let arm = self.tool + self.shifts[count];
        let mut size = arm.abs().sum() + self.shifts[0].abs().sum() + self.from.abs().sum() + self.chord.abs().sum();
        for (index, axis) in rotary.iter().enumerate().rev() {
            let (from, way) = if index + 1 == count {
                (arm, self.ways[count])
            } else {
                (self.from - self.shifts[0], self.chord - self.ways[0])
            };
            let off = |arm: &Vec3| axis.direction.cross(arm).norm_squared();
            let radius = off(&(from - axis.point)).max(off(&(from - axis.point + way))).sqrt() + bend * 0.125;
            let turned = self.change[index].abs();
            bend += 2.0 * turned * rate + turned * turned * radius;
            rate += turned * radius + self.ways[index].norm();
            size += axis.point.abs().sum() + self.shifts[index].abs().sum() + self.ways[index].abs().sum();
        }
        self.bend = bend * (1.0 + 1e-9);
        self.rounding = size * ROUNDING;
    }

    /// Distance of W(t) from the segment, mm.
    fn distance(&self, t: f64) -> f64 {
        if t <= 0.0 || t >= 1.0 {
            return 0.0;
        }
        let mut shifts = self.shifts;
        for (shift, way) in shifts.iter_mut().zip(&self.ways) {
            *shift += way * t;
        }
        let mut turns = self.start.turns(self.machine);
        for (index, turn) in turns.iter_mut().enumerate() {
            if self.change[index] != 0.0 {
                (turn.sin, turn.cos) = sin_cos(self.angles[index] + self.change[index] * t);
            }
        }
        let off = place(&self.machine.constants, &turns, &shifts, &self.tool) - self.from;
        let share = (off.dot(&self.chord) * self.per_chord).clamp(0.0, 1.0);
        (off - self.chord * share).norm()
    }
}
