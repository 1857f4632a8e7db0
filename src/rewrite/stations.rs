//! A chain of tool poses near the pole, as the taut string sees it: stations along the path, each with room to turn.
use crate::survey::Point;
use crate::taut_string::taut_string;
use trunnion_geometry::math::{asin, sin};
use trunnion_machine::{Limits, Machine, POLE_TOLERANCE, Stance};

/// Shortest step of the path length between stations, mm: a step without length would be infinitely steep.
const SHORTEST_STEP_MM: f64 = 1e-3;

/// Points that share one value of the rotary axis nearest the workpiece.
#[derive(Clone, Debug)]
pub(crate) struct Station {
    /// Indices of its points, consecutive.
    pub first: usize,
    /// The last of them.
    pub last: usize,
    /// Path length, mm.
    s: f64,
    /// Rotary joint as programmed, rad.
    pub q: f64,
    /// Angle between the tool axis and the rotary axis, 0..pi/2, rad.
    pub pole_angle: f64,
}

/// The unbroken chain of straight feed motions around the motion `flip`, as stations: a motion that does not turn the tool joins
/// its ends in one station, and so does a motion onto the pole where vectors are programmed (the rotary axis then rests).
pub(crate) fn chain(machine: &Machine, points: &[Point], flip: usize) -> Vec<Station> {
    let joint = machine.rotary[0];
    let mut first = flip;
    while first > 0 && linked(&points[first - 1], &points[first]) {
        first -= 1;
    }
    let mut last = flip;
    while last + 1 < points.len() && linked(&points[last], &points[last + 1]) {
        last += 1;
    }
    let mut stations: Vec<Station> = Vec::new();
    let mut s = 0.0;
    for (index, point) in points.iter().enumerate().take(last + 1).skip(first) {
        let Ok(stance) = &point.end else { continue };
        let joined =
            index > first && (point.rotary_change == [0.0; 2] || point.vector && stance.pole_angle <= POLE_TOLERANCE);
        match stations.last_mut() {
            Some(station) if joined => station.last = index,
            _ => {
                if index > first {
                    s += point.length.max(SHORTEST_STEP_MM);
                }
                let (q, pole_angle) = (stance.joints[joint], stance.pole_angle);
                stations.push(Station {
                    first: index,
                    last: index,
                    s,
                    q,
                    pole_angle,
                });
            }
        }
    }
    stations
}

/// The motion from `a` to `b` belongs to a chain with `a`: a straight feed motion with TCP that keeps the posture and the tool.
fn linked(a: &Point, b: &Point) -> bool {
    let known = a.end.is_ok() && b.end.is_ok() && b.from_known;
    known
        && b.linear
        && b.tcp
        && !b.swap
        && a.vector == b.vector
        && a.tip == b.tip
        && a.unit_mm == b.unit_mm
        && a.block != b.block
}

/// The stations that may turn, around the motion `flip`: those inside the cone around the pole, and one fixed station at each end.
/// `None` if there is nothing between the ends.
pub(crate) fn window(stations: &[Station], flip: usize, cone: f64) -> Option<(usize, usize)> {
    let at = stations
        .iter()
        .position(|station| station.first <= flip && flip <= station.last)?;
    let (mut left, mut right) = (at.checked_sub(1)?, at);
    while left > 0 && stations[left].pole_angle < cone {
        left -= 1;
    }
    while right + 1 < stations.len() && stations[right].pole_angle < cone {
        right += 1;
    }
    (right > left + 1).then_some((left, right))
}

/// New values of the rotary joint for the stations of a window, rad; the ends keep theirs. `room`: how far a tool axis
/// may turn, rad. `None` where a station is outside the limits of the axis.
pub(crate) fn straighten(machine: &Machine, window: &[Station], room: f64) -> Option<Vec<f64>> {
    let limits = match machine.axes[machine.rotary[0]].limits {
        Limits::Unbounded => (f64::NEG_INFINITY, f64::INFINITY),
        Limits::Range(low, high) => (low, high),
    };
    let last = window.len().checked_sub(1)?;
    let (mut lower, mut upper) = (Vec::new(), Vec::new());
    for (i, station) in window.iter().enumerate() {
        let half = if i == 0 || i == last {
            0.0
        } else {
            half_width(room, station.pole_angle)
        };
        if station.q < limits.0 || station.q > limits.1 {
            return None;
        }
        lower.push((station.q - half).max(limits.0));
        upper.push((station.q + half).min(limits.1));
    }
    let s: Vec<f64> = window.iter().map(|station| station.s).collect();
    Some(taut_string(&s, &lower, &upper))
}

/// By how much the azimuth of a tool axis at the angle `pole_angle` from the pole may change so that the axis turns by at most `room`,
/// rad: 2 asin(sin(room/2) / sin theta), without limit where that has no solution (docs/kinematics.md#smoothing-at-the-pole).
fn half_width(room: f64, pole_angle: f64) -> f64 {
    if room <= 0.0 {
        return 0.0;
    }
    let ratio = sin(0.5 * room) / sin(pole_angle);
    if ratio < 1.0 { 2.0 * asin(ratio) } else { f64::INFINITY }
}

/// Largest step of the joint between stations, rad.
pub(crate) fn largest_step(values: impl Iterator<Item = f64> + Clone) -> f64 {
    values
        .clone()
        .zip(values.skip(1))
        .map(|(a, b)| (b - a).abs())
        .fold(0.0, f64::max)
}

/// The stance at a point that is known to have one.
pub(crate) fn stance(point: &Point) -> Option<&Stance> {
    point.end.as_ref().ok()
}

#[cfg(test)]
mod tests {
    use super::half_width;
    use trunnion_geometry::{deg, rad};

    #[test]
    fn the_tube_is_as_wide_as_the_notes_say() {
        assert!(
            half_width(rad(0.16), rad(0.079)).is_infinite(),
            "the tool axis may turn right over the pole"
        );
        assert_eq!(half_width(rad(0.1), 0.0), f64::INFINITY);
        assert_eq!(half_width(0.0, 0.0), 0.0);
        assert!((deg(half_width(rad(0.02), rad(0.79))) - 1.4506).abs() < 1e-3);
    }
}
