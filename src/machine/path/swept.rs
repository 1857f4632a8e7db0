//! How far the body of the tool deviates inside a block while its tip is guided: the point at a distance above the tip.
use crate::path::curve_distance::CurveDistance;
use crate::path::deviation::{RATIO, runs_dogleg};
use crate::path::joint_path::Track;
use crate::path::orientation::{Circle, axis_bend, strays};
use crate::{Deviation, Leg, Machine, tool_axis_at};
use trunnion_interp::MotionKind;

/// If sample and bound are this near, mm or as a share, more samples are useless.
const CLOSE_MM: f64 = 1e-4;
const CLOSE_SHARE: f64 = 1e-3;

/// Samples spent on closeness; beyond them a bound within the ratio is enough.
const CLOSE_SAMPLES: u32 = 64;

/// Share of a coordinate that rounding may cost.
const ROUNDING: f64 = 1e-13;

/// Set distance of the point at `above_tip` mm above the tip, on the tool axis, to the path it should follow: the tip along its segment and
/// the tool axis evenly on the great circle. `tolerance_mm`: the bound may be loose where it already proves this; above it, it is at most
/// 1.2 times the truth. `None`: no path, an unknown stance, opposite tool axes at the ends, or a motion without tip coordinates, whose tip
/// itself deviates and the whole tool with it ([`crate::tip_deviation`]), or a rapid whose axes move independently.
///
/// Zero where the axis does not deviate ([`crate::orientation_deviation`]). At the same moment both points differ by at most
/// L (Q + angle^2) / 8 with |u''| <= Q, L the distance above the tip; closer bounds by bisection. Source: docs/kinematics.md#deviation-of-the-tool-body.
pub fn swept_deviation(machine: &Machine, leg: &Leg, above_tip: f64, tolerance_mm: f64) -> Option<Deviation> {
    if runs_dogleg(machine, leg) {
        return None;
    }
    let none = Deviation {
        sampled_mm: 0.0,
        bound_mm: 0.0,
        at: 0.0,
    };
    let (start, end) = (leg.start.as_ref()?, leg.end.as_ref().ok()?);
    let track = match &leg.motion.kind {
        MotionKind::Dwell(_) | MotionKind::Unknown | MotionKind::Arc(None) => return None,
        MotionKind::Arc(Some(arc)) => Track::Arc(*arc),
        MotionKind::Rapid | MotionKind::Linear => Track::Line(end.point - start.point_with(end.tool_length)),
    };
    if !crate::follow::follower::leads_path(&leg.motion) && leg.rotary_change != [0.0; 2] {
        return None;
    }
    if !strays(machine, leg) || above_tip <= 0.0 {
        return Some(none);
    }
    let circle = Circle::new(&start.axis, &end.axis)?;
    let axis_bend = above_tip * axis_bend(machine, start, end);
    let circle_bend = above_tip * circle.angle * circle.angle;
    let rounding = ROUNDING * (above_tip + start.point.abs().sum() + end.point.abs().sum());
    let at_once = 0.125 * (axis_bend + circle_bend) + rounding;
    if at_once <= tolerance_mm {
        return Some(Deviation {
            bound_mm: at_once,
            ..none
        });
    }
    let (from, to) = (start.rotary(machine), end.rotary(machine));
    let change = [to[0] - from[0], to[1] - from[1]];
    let (_, _, track_bend) = track.bounds();
    let stray = CurveDistance {
        point: |t: f64| {
            let axis = if t <= 0.0 {
                start.axis
            } else if t >= 1.0 {
                end.axis
            } else {
                tool_axis_at(machine, [from[0] + change[0] * t, from[1] + change[1] * t])
            };
            track.at(t).0 + axis * above_tip
        },
        point_bend: axis_bend + track_bend,
        curve: |s: f64| {
            let axis = if s >= 1.0 { end.axis } else { circle.at(s) };
            track.at(s).0 + axis * above_tip
        },
        curve_bend: circle_bend + track_bend,
    };
    let room = (tolerance_mm - rounding).max(0.0);
    let found = stray.farthest(|bound, sampled, samples| {
        bound <= room
            || bound <= sampled + CLOSE_MM.max(CLOSE_SHARE * sampled)
            || (samples > CLOSE_SAMPLES && bound <= sampled * RATIO)
    });
    Some(Deviation {
        sampled_mm: (found.sampled - rounding).max(0.0),
        bound_mm: found.bound.min(at_once) + rounding,
        at: found.at,
    })
}
