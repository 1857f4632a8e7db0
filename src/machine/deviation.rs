//! How far the tip strays from the programmed segment inside a block: sampled value and proven bound.
use crate::bends::{Carried, Shift};
use crate::bound::{Piece, peak};
use crate::course::{Course, Track};
use crate::forward::Turn;
use crate::inverse::place;
use crate::{Leg, Machine};
use trunnion_geometry::Vec3;

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
const CLOSE_MM: f64 = 2e-4;

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
    let course = Course::new(machine, leg)?;
    if course.tip || !course.turns_at_all() {
        return Some(none);
    }
    if let Track::Arc(_) = course.track {
        return None;
    }
    let path = TipPath::new(&course);
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
struct TipPath<'c, 'm> {
    course: &'c Course<'m>,
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

impl<'c, 'm> TipPath<'c, 'm> {
    fn new(course: &'c Course<'m>) -> Self {
        let (start, end) = course.shifts();
        let constants = &course.machine.constants;
        let count = constants.rotary_count;
        let [turns_start, turns_end] = [course.start.turns(course.machine), course.end.turns(course.machine)];
        let mut tip = Carried {
            start: course.tool,
            end: course.tool,
            rate: 0.0,
            bend: 0.0,
            length: 1.0,
        };
        let shift = |i: usize| Shift {
            start: start[i],
            end: end[i],
            rate: (end[i] - start[i]).norm(),
        };
        let spin = course.spin_bounds(0.0, 1.0).rate;
        let mut size = course.tool.norm();
        tip.shift(&shift(count));
        for index in (0..count).rev() {
            let centre = constants.rotary[index].point;
            tip.turn(
                (spin[index], 0.0),
                &centre,
                &turns_start[index],
                &turns_end[index],
                Turn::apply,
            );
            tip.shift(&shift(index));
            size += centre.norm();
        }
        size += start.iter().chain(&end).map(Vec3::norm).sum::<f64>();
        let chord = tip.end - tip.start;
        let length2 = chord.norm_squared();
        Self {
            course,
            shifts: start,
            ways: [end[0] - start[0], end[1] - start[1], end[2] - start[2]],
            from: tip.start,
            chord,
            per_chord: if length2 > 0.0 { 1.0 / length2 } else { 0.0 },
            bend: tip.bend * (1.0 + 1e-9),
            rounding: size * ROUNDING,
        }
    }

    /// Distance of W(t) from the segment, mm.
    fn distance(&self, t: f64) -> f64 {
        if t <= 0.0 || t >= 1.0 {
            return 0.0;
        }
        let shifts = [
            self.shifts[0] + self.ways[0] * t,
            self.shifts[1] + self.ways[1] * t,
            self.shifts[2] + self.ways[2] * t,
        ];
        let course = self.course;
        let off = place(&course.machine.constants, &course.turns(t), &shifts, &course.tool) - self.from;
        let share = (off.dot(&self.chord) * self.per_chord).clamp(0.0, 1.0);
        (off - self.chord * share).norm()
    }
}
