//! Posture sign and distance from the pole.
//!
//! With tau = s2 q2 + azimuth of k0 about e2: e1.u = c y + rho cos tau and S = -rho sin tau (from docs/kinematics.md#two-postures), so that the
//! angle to the pole depends on the second rotary joint alone and has its extremes where S is zero, at the multiples of pi of tau.
use crate::{Constants, Machine, PairConstants};
use core::f64::consts::{FRAC_PI_2, PI};
use trunnion_geometry::Vec3;
use trunnion_geometry::math::atan2;

/// Below this |S| a stance is at the pole (or at the edge of the reach) and has no posture sign.
pub(crate) const NO_SIGN: f64 = 1e-9;

/// S = e1 . (R1 e2 x u) = n . R2 k0 and its sign, 0 within [`NO_SIGN`].
#[inline]
pub(crate) fn posture(pair: &PairConstants, tool_axis_after_second: &Vec3) -> (f64, i8) {
    let s = pair.n.dot(tool_axis_after_second);
    let sign = if s > NO_SIGN {
        1
    } else if s < -NO_SIGN {
        -1
    } else {
        0
    };
    (s, sign)
}

/// Angle between tool axis and the nearer end of the first rotary axis, rad, 0..=pi/2, from w = R2 k0 and q2.
#[inline]
pub(crate) fn pole_angle(constants: &Constants, pair: &PairConstants, w: &Vec3, q2: f64) -> f64 {
    if is_orthogonal(pair) {
        // e1, e2, k0 at right angles in pairs: the angle is tau itself, without any rounding at the pole
        let tau = constants.rotary[1].sign * q2 + pair.k_azimuth;
        let halves = tau / PI;
        // mostly there is no half turn to subtract
        return if halves.abs() < 0.5 {
            tau.abs()
        } else {
            (tau - PI * halves.round()).abs()
        };
    }
    let x = constants.rotary[0].direction.dot(w);
    let across = pair.m.dot(w);
    let along = (pair.y - pair.c * x) * (pair.y - pair.c * x) / pair.d;
    atan2((across * across + along).sqrt(), x.abs())
}

/// Whether both pairs of directions are at right angles, so that the tool axis runs through the pole itself.
fn is_orthogonal(pair: &PairConstants) -> bool {
    pair.c == 0.0 && pair.y == 0.0
}

/// Whether an angle is certainly between two adjacent multiples of pi, one of them 0.
#[inline]
fn inside(tau: f64) -> bool {
    let size = tau.abs();
    size > 1e-9 && size < 3.0
}

/// Smallest pole angle, rad, while q2 moves linearly from `from.0` to `to.0`; the pole angles at the ends are `from.1` and `to.1`.
#[inline]
pub(crate) fn pole_angle_min(constants: &Constants, pair: &PairConstants, from: (f64, f64), to: (f64, f64)) -> f64 {
    let ends = from.1.min(to.1);
    if from.0 == to.0 {
        return ends;
    }
    let tau = |q: f64| constants.rotary[1].sign * q + pair.k_azimuth;
    let (a, b) = (tau(from.0), tau(to.0));
    // well inside, the quotients need not be known
    if inside(a) && inside(b) && (a > 0.0) == (b > 0.0) {
        return ends;
    }
    let (a, b) = (a / PI, b / PI);
    // most blocks stay between the same two multiples of pi, one of them 0
    if a.min(b) > 0.0 && a.max(b) < 1.0 || a.min(b) > -1.0 && a.max(b) < 0.0 {
        return ends;
    }
    let (first, last) = (a.min(b).ceil(), a.max(b).floor());
    if last < first {
        return ends;
    }
    // multiples of pi inside: an even one is the smallest reachable angle to +e1, an odd one the largest
    let fold = |angle: f64| if angle > FRAC_PI_2 { PI - angle } else { angle };
    let even = (last * 0.5).floor() * 2.0 >= first;
    let odd = ((last - 1.0) * 0.5).floor() * 2.0 + 1.0 >= first;
    let mut least = ends;
    if even {
        least = least.min(fold(pair.reach_min));
    }
    if odd {
        least = least.min(fold(pair.reach_max));
    }
    least
}

/// Smallest pole angle, rad, while the tool axis runs on the great circle from `u0` to `u1` (unit vectors).
pub(crate) fn pole_angle_min_great_circle(machine: &Machine, u0: &Vec3, u1: &Vec3, ends: f64) -> f64 {
    let pole = machine.constants.rotary[0].direction;
    let normal = u0.cross(u1);
    let length = normal.norm();
    if length < 1e-12 {
        return ends;
    }
    let normal = normal / length;
    let height = normal.dot(&pole);
    let nearest = pole - normal * height;
    let passes = |p: &Vec3| u0.cross(p).dot(&normal) >= 0.0 && p.cross(u1).dot(&normal) >= 0.0;
    if passes(&nearest) || passes(&-nearest) {
        ends.min(atan2(height.abs(), nearest.norm()))
    } else {
        ends
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{BUILTIN_MACHINES, builtin, tool_axis_at};
    use trunnion_geometry::math::{angle_between, cos, sin};

    /// Angle between a tool axis and the nearer end of the first rotary axis.
    fn from_pole(machine: &Machine, axis: &Vec3) -> f64 {
        let angle = angle_between(axis, &machine.constants.rotary[0].direction);
        angle.min(PI - angle)
    }

    /// Against many moments, on all machines with two rotary axes, over ranges with none, one and several multiples of half a turn.
    #[test]
    fn the_smallest_angle_on_a_straight_run_of_the_second_joint() {
        let mut judged = 0;
        for name in BUILTIN_MACHINES {
            let machine = builtin(name).expect("built in");
            let Some(pair) = &machine.constants.pair else { continue };
            for (from, to) in [
                (-0.3, 0.4),
                (0.2, 1.1),
                (2.8, 3.5),
                (-3.5, -2.9),
                (3.0, 3.1),
                (0.5, 3.6),
                (-4.0, -0.5),
                (2.0, 6.6),
                (1.0, -1.0),
                (4.0, 5.5),
                (-6.5, -6.0),
            ] {
                let angle = |q: f64| from_pole(machine, &tool_axis_at(machine, [0.7, q]));
                let found = pole_angle_min(&machine.constants, pair, (from, angle(from)), (to, angle(to)));
                let dense = (0..=4000).map(|i| angle(from + (to - from) * f64::from(i) / 4000.0));
                let truth = dense.fold(f64::INFINITY, f64::min);
                // between two moments the angle may be smaller by half a step
                assert!(
                    found <= truth + 1e-9 && found >= truth - (to - from).abs() / 8000.0 - 1e-9,
                    "{name} {from} {to}: {found}, not {truth}"
                );
                judged += 1;
            }
        }
        assert!(judged > 150, "{judged}");
    }

    #[test]
    fn the_smallest_angle_on_a_great_circle() {
        let machine = builtin("mikron-ucp710").expect("built in");
        let axis = |tilt: f64, azimuth: f64| Vec3::new(sin(tilt) * cos(azimuth), sin(tilt) * sin(azimuth), cos(tilt));
        for (from, to) in [
            // past the pole, past its other end, past neither, over it
            (axis(0.5, 0.0), axis(0.6, 2.5)),
            (axis(2.6, 0.3), axis(2.8, -2.2)),
            (axis(0.3, 0.0), axis(0.9, 0.2)),
            (axis(1.2, 0.0), axis(1.9, 0.1)),
            (axis(0.4, 0.0), axis(0.5, PI - 1e-4)),
            (axis(0.7, 1.0), axis(0.2, 1.1)),
        ] {
            let angle = angle_between(&from, &to);
            let side = (to - from * from.dot(&to)).normalize();
            let at = |t: f64| from_pole(machine, &(from * cos(angle * t) + side * sin(angle * t)));
            let found = pole_angle_min_great_circle(machine, &from, &to, at(0.0).min(at(1.0)));
            let truth = (0..=4000)
                .map(|i| at(f64::from(i) / 4000.0))
                .fold(f64::INFINITY, f64::min);
            assert!(
                found <= truth + 1e-9 && found >= truth - angle / 8000.0 - 1e-9,
                "{from:?} {to:?}: {found}, not {truth}"
            );
        }
    }
}
