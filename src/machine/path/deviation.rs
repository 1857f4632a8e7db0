//! How far the tip deviates from the programmed segment inside a block: sampled value and proven bound.
use crate::follow::follower::leads_path;
use crate::path::curve_distance::CurveDistance;
use crate::path::peak::{Piece, SAMPLES, peak};
use crate::path::tip_path::{Run, TipPath};
use crate::{Leg, Machine, RapidPath, Stance};
use trunnion_interp::MotionKind;

/// Deviation of the tip path from the programmed segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// Largest distance found at a sample, mm (never above the truth).
    pub sampled_mm: f64,
    /// Proven upper bound, mm (never below the truth).
    pub bound_mm: f64,
    /// Where in the block, 0..=1, the largest sample is.
    pub at: f64,
}

/// A rapid whose axes run each at its own speed: where anything is between the ends is not known, nor is it programmed.
#[inline]
pub(crate) fn runs_dogleg(machine: &Machine, leg: &Leg) -> bool {
    matches!(leg.motion.kind, MotionKind::Rapid) && machine.control.rapid == RapidPath::Dogleg
}

/// If sample and bound are this near, mm, more samples are useless.
const CLOSE_MM: f64 = 2e-5;

/// Samples spent on closeness; beyond them a bound of [`RATIO`] times the sample is enough.
const CLOSE_SAMPLES: u32 = 256;

/// Samples spent where even the most samples would prove nothing.
const VAIN_SAMPLES: u32 = 16;

/// Above the tolerance the bound is brought down to this multiple of the largest sample: 1.2 times the truth is promised.
pub(crate) const RATIO: f64 = 1.19;

/// Set distance of the tip path to the programmed segment. `tolerance_mm`: the bound may be loose where it already proves
/// this; above it, it is at most 1.2 times the truth. `None`: not modelled, an unknown stance, or a rapid whose axes move independently.
///
/// The segment of a line joins the tips at both ends in the workpiece frame; that of an arc is the arc in its position in the workpiece at the
/// start of the block, its end carried evenly to where the tip ends. With TCP or vectors the control keeps the tip on the programmed
/// path, so the deviation is zero by construction, and so it is where no rotary axis moves. Without TCP the joints run linearly (X Y Z
/// along the arc) and the tip on W(t); bound: largest sample + Q h^2 / 8 per piece of length h, Q >= |W''|. Source: docs/kinematics.md#between-the-ends-of-a-block.
pub fn tip_deviation(machine: &Machine, leg: &Leg, tolerance_mm: f64) -> Option<Deviation> {
    if runs_dogleg(machine, leg) {
        return None;
    }
    let none = Deviation {
        sampled_mm: 0.0,
        bound_mm: 0.0,
        at: 0.0,
    };
    let (start, end) = (leg.start.as_ref()?, leg.end.as_ref().ok()?);
    let arc = match &leg.motion.kind {
        MotionKind::Dwell(_) | MotionKind::Unknown | MotionKind::Arc(None) => return None,
        MotionKind::Arc(Some(arc)) => Some(arc),
        MotionKind::Rapid | MotionKind::Linear => None,
    };
    if leg.rotary_change == [0.0; 2] || leads_path(&leg.motion) {
        return Some(none);
    }
    let run = Run::new(machine, start, end);
    let tolerance = tolerance_mm.max(0.0);
    if arc.is_none() {
        // most lines are decided here, without a path
        let (bend, rounding) = run.bound(None);
        let at_once = bend * 0.125 + rounding;
        if at_once <= tolerance {
            return Some(Deviation {
                bound_mm: at_once,
                ..none
            });
        }
    }
    let path = TipPath::new(run, arc);
    let arc = path.laid_arc();
    // both run evenly from a common start to a common end: at the same moment they differ by at most the eighth of both bends
    let at_once = (path.bend + arc.as_ref().map_or(0.0, |arc| arc.bend)) * 0.125 + path.rounding;
    if at_once <= tolerance {
        return Some(Deviation {
            bound_mm: at_once,
            ..none
        });
    }
    let room = (tolerance - path.rounding).max(0.0);
    // what remains open after the most samples, spread evenly: if an axis winds thousands of times within a block, they prove nothing
    let open = (path.bend + arc.as_ref().map_or(0.0, |arc| arc.bend)) * 0.125 / f64::from(SAMPLES).powi(2);
    let search = Search { room, open };
    let enough = |bound: f64, sampled: f64, samples: u32| search.ends(bound, sampled, samples);
    let (sampled, bound, at) = if let Some(arc) = arc {
        let stray = CurveDistance {
            point: |t| path.way(t),
            point_bend: path.bend,
            curve: |s| arc.way(s),
            curve_bend: arc.bend,
        };
        let found = stray.farthest(enough);
        (found.sampled, found.bound, found.at)
    } else {
        let found = peak(
            |t| from_chord(&path, t),
            |piece: &Piece| piece.below_parabola(path.bend),
            enough,
        );
        (found.sampled, found.bound, found.at)
    };
    Some(Deviation {
        sampled_mm: (sampled - path.rounding).max(0.0),
        bound_mm: bound + path.rounding,
        at,
    })
}

/// Largest distance found of the tip from the segment between its ends, mm, while all joints run linearly from one stance to the other:
/// what [`tip_deviation`] samples of a line without tool centre point control.
pub fn joint_line_deviation(machine: &Machine, start: &Stance, end: &Stance) -> f64 {
    let path = TipPath::new(Run::new(machine, start, end), None);
    let search = Search { room: 0.0, open: 0.0 };
    let found = peak(
        |t| from_chord(&path, t),
        |piece: &Piece| piece.below_parabola(path.bend),
        |bound, sampled, samples| search.ends(bound, sampled, samples),
    );
    found.sampled
}

/// When the search for the largest distance ends.
struct Search {
    /// A bound up to this proves the tolerance, mm.
    room: f64,
    /// What the most samples leave open, mm.
    open: f64,
}

impl Search {
    fn ends(&self, bound: f64, sampled: f64, samples: u32) -> bool {
        let in_vain = self.open > self.room && self.open > sampled * (RATIO - 1.0);
        bound <= self.room
            || bound <= sampled + CLOSE_MM
            || (samples > CLOSE_SAMPLES && bound <= sampled * RATIO)
            || (samples > VAIN_SAMPLES && in_vain)
    }
}

/// Distance of W(t) from the segment between the tips, mm.
fn from_chord(path: &TipPath<'_>, t: f64) -> f64 {
    if t <= 0.0 || t >= 1.0 {
        return 0.0;
    }
    let (off, chord) = (path.way(t), path.chord);
    let length2 = chord.norm_squared();
    let share = if length2 > 0.0 {
        (off.dot(&chord) / length2).clamp(0.0, 1.0)
    } else {
        0.0
    };
    (off - chord * share).norm()
}

#[cfg(test)]
mod tests {
    use super::Search;
    use crate::path::peak::{Piece, SAMPLES, peak};
    use core::cell::Cell;

    /// Samples spent on a point that winds so often around a circle of 100 mm within a block.
    fn spent(turns: f64) -> (u32, f64) {
        let angle = core::f64::consts::TAU * turns;
        let bend = angle * angle * 100.0;
        let search = Search {
            room: 0.01,
            open: bend * 0.125 / f64::from(SAMPLES).powi(2),
        };
        let samples = Cell::new(0);
        let value = |t: f64| {
            samples.set(samples.get() + 1);
            200.0 * trunnion_geometry::math::sin(0.5 * angle * t).abs()
        };
        let found = peak(
            value,
            |piece: &Piece| piece.below_parabola(bend),
            |bound, sampled, samples| search.ends(bound, sampled, samples),
        );
        assert!(found.bound >= 199.9, "{found:?}");
        (samples.get(), found.bound)
    }

    #[test]
    fn where_no_sample_proves_anything_few_are_spent() {
        let (few, _) = spent(278_000.3);
        assert!(few < 32, "{few} samples");
        // and where they do, the bound closes
        let (many, bound) = spent(30.3);
        assert!(
            (256..SAMPLES).contains(&many) && bound < 200.0 * 1.2,
            "{many} samples, {bound} mm"
        );
    }
}
