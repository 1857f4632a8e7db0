//! Facts about a posture: its sign, its distance from the pole, its windings inside the limits.
use crate::{Limits, Machine};
use core::f64::consts::{FRAC_PI_2, TAU};
use trunnion_geometry::Vec3;
use trunnion_geometry::math::{atan2, rotate};

/// How far outside a limit a rotary value may be and still be taken as on it, rad: 1e-5 deg. Posts write tool vectors with seven digits;
/// what they round away turns a tool axis by up to 5e-8 rad per component, and must not drive the machine to another posture. A value
/// taken so is set to the limit itself.
const LIMIT_SLACK: f64 = 1e-5 * core::f64::consts::PI / 180.0;

/// The windings of a rotary value that lie inside the limits and nearest to a wanted value; reads as a slice, nearest first.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Windings {
    values: [f64; 3],
    count: usize,
}

impl core::ops::Deref for Windings {
    type Target = [f64];
    fn deref(&self) -> &[f64] {
        &self.values[..self.count]
    }
}

/// The values q + 2 pi m inside the limits of axis `axis` (joint index), nearest to `near` first, at most three; empty when no winding
/// is legal or when the axis is missing. A value 1e-5 deg or less beyond a limit becomes the limit. All in rad. Source: docs/kinematics.md#two-postures.
pub fn windings(machine: &Machine, axis: usize, q: f64, near: f64) -> Windings {
    match machine.axes.get(axis) {
        Some(axis) => windings_in(axis.limits, q, near),
        None => Windings {
            values: [0.0; 3],
            count: 0,
        },
    }
}

/// [`windings`] inside given limits, rad; none where the lower limit is above the upper one.
pub(crate) fn windings_in(limits: Limits, q: f64, near: f64) -> Windings {
    let mut found = Windings {
        values: [0.0; 3],
        count: 0,
    };
    let (lowest, highest) = match limits {
        Limits::Unbounded => (f64::NEG_INFINITY, f64::INFINITY),
        Limits::Range(min, max) => (
            ((min - LIMIT_SLACK - q) / TAU).ceil(),
            ((max + LIMIT_SLACK - q) / TAU).floor(),
        ),
    };
    let nearest = ((near - q) / TAU).round();
    if nearest.is_nan() || lowest > highest || matches!(limits, Limits::Range(min, max) if min > max) {
        return found;
    }
    // NaN and contradictory ranges were refused above, so clamp cannot panic
    let centre = nearest.clamp(lowest, highest);
    for turns in [centre, centre - 1.0, centre + 1.0] {
        if turns >= lowest && turns <= highest {
            let value = if turns == 0.0 { q } else { q + TAU * turns };
            found.values[found.count] = match limits {
                Limits::Unbounded => value,
                // refused above: min > max
                Limits::Range(min, max) => value.clamp(min, max),
            };
            found.count += 1;
        }
    }
    let count = found.count;
    found.values[..count].sort_by(|a, b| (a - near).abs().total_cmp(&(b - near).abs()));
    found
}

/// S = e1 . (R1 e2 x u) of a posture, signed; |S| = sqrt(g2) D. It depends on q2 alone (rad), since R1 keeps e1: S = (e1 x e2) . R2 k0.
/// 0 for machines with fewer than two rotary axes. Source: docs/kinematics.md#two-postures.
pub fn solution_s(machine: &Machine, q2: f64) -> f64 {
    let (Some(pair), [_, second]) = (&machine.constants.pair, &machine.constants.rotary) else {
        return 0.0;
    };
    pair.n
        .dot(&rotate(&second.direction, second.sign * q2, &machine.tool_axis))
}

/// Angle between a unit tool axis (workpiece frame) and the nearer end of the first rotary axis, rad, 0..=pi/2; pi/2 for machines with
/// fewer than two rotary axes, which have no pole.
pub fn pole_angle(machine: &Machine, axis: &Vec3) -> f64 {
    if machine.constants.pair.is_none() {
        return FRAC_PI_2;
    }
    let e1 = machine.constants.rotary[0].direction;
    atan2(e1.cross(axis).norm(), e1.dot(axis).abs())
}
