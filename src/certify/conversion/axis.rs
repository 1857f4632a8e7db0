//! How far two tool axes are apart while both run: a proven bound, as tight as what is known of both allows.
use super::Track;
use core::f64::consts::TAU;
use trunnion_geometry::math::asin;

/// Most moments at which two axes are compared.
const MOST_SAMPLES: f64 = 512.0;

/// Bound on the angle between the tool axes at the same moment, rad, while the second runs and the first runs over its share `from..to`.
pub(super) fn axes_apart(track: &Track<'_>, (from, to): (f64, f64), made: &Track<'_>) -> f64 {
    let by_joints = by_joints(track, (from, to), made).unwrap_or(f64::INFINITY);
    let share = to - from;
    let (was, is) = (track.bend().1 * share * share, made.bend().1);
    // so many that the bound is at most 1e-6 rad above the samples, if that is affordable
    let steps = ((was + is) / 8e-6).sqrt().ceil().clamp(1.0, MOST_SAMPLES);
    if by_joints <= 1e-9 {
        return by_joints;
    }
    let mut chord = 0.0f64;
    for step in 0..=(steps as u32) {
        let t = f64::from(step) / steps;
        chord = chord.max((track.at(from + share * t).axis - made.at(t).axis).norm());
    }
    let between = 1.0 / (8.0 * steps * steps);
    let mut bound = chord + (was + is) * between;
    if let (Some(one), Some(other)) = (track.circle_angle(), made.circle_angle()) {
        // on a great circle W'' = -a^2 W. So the difference D of two has |D''| <= a^2 |D| + |a^2 - b^2|, and its largest value M is at
        // most the largest sample + (a^2 M + |a^2 - b^2|) / (8 n^2)
        let (one, other) = (one * one * share * share, other * other);
        let room = 1.0 - one * between;
        if room > 0.0 {
            bound = bound.min((chord + (one - other).abs() * between) / room);
        }
    }
    (2.0 * asin((0.5 * bound).min(1.0))).min(by_joints)
}

/// On one machine: joints run linearly in both, and an axis turned by an angle turns the tool by no more.
fn by_joints(track: &Track<'_>, (from, to): (f64, f64), made: &Track<'_>) -> Option<f64> {
    let (one, other) = (track.rotary_machine()?, made.rotary_machine()?);
    if one.axes != other.axes || one.home != other.home {
        return None;
    }
    let ends = [
        (track.rotary_at(from)?, made.rotary_at(0.0)?),
        (track.rotary_at(to)?, made.rotary_at(1.0)?),
    ];
    let mut sums = [0.0f64; 2];
    for axis in 0..2 {
        let off = ends.map(|(was, is)| is[axis] - was[axis]);
        // the same whole turns at both ends change nothing
        let turns = TAU * (off[0] / TAU).round();
        for (sum, off) in sums.iter_mut().zip(off) {
            *sum += (off - turns).abs();
        }
    }
    Some(sums[0].max(sums[1]))
}
