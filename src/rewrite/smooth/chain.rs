//! A chain of tool poses: stations along the path, each with the room that its tool axis has.
use crate::survey::Point;
use core::f64::consts::PI;
use trunnion_geometry::math::{asin, sin};
use trunnion_geometry::rad;
use trunnion_machine::{Limits, Machine, Orientations, POLE_TOLERANCE, Stance, orientations};

/// Shortest step of the path length between stations, mm: a step without length would be infinitely steep.
const SHORTEST_STEP_MM: f64 = 1e-3;

/// Where the tube is wider than this to either side, the programmed azimuth says little, rad.
const WIDE: f64 = 30.0 * PI / 180.0;

/// Points that share one position of the rotary axes.
#[derive(Clone, Debug)]
pub(crate) struct Station {
    /// Indices of its points, consecutive.
    pub first: usize,
    /// The last of them.
    pub last: usize,
    /// Path length, mm; under G93 the time in units of 1/60 s (the time that 1 mm takes at 3600 mm/min).
    pub s: f64,
    /// Rotary joints as programmed, workpiece side first, rad.
    pub q: [f64; 2],
    /// The other posture, rad, where the second rotary axis reaches it.
    pub other: Option<[f64; 2]>,
    /// Angle between the tool axis and the rotary axis, 0..pi/2, rad.
    pub pole_angle: f64,
    /// By how much the first rotary joint may turn to either side, rad; infinite where the azimuth is free.
    pub room: f64,
    /// The tool axis is so near the pole that azimuth and posture are free.
    pub free: bool,
    /// It keeps its tool axis: far from the pole, or an end of the chain.
    pub pinned: bool,
}

impl Station {
    /// Whether its azimuth says where the first rotary axis must be.
    pub(crate) fn firm(&self) -> bool {
        !self.free && self.room < WIDE
    }

    /// The rotary joints in a posture: 0 as programmed, 1 the other one.
    pub(crate) fn in_posture(&self, posture: usize) -> Option<[f64; 2]> {
        if posture == 0 { Some(self.q) } else { self.other }
    }
}

/// Travel of a rotary axis, rad.
pub(crate) fn travel(machine: &Machine, axis: usize) -> (f64, f64) {
    match machine.axes[machine.rotary[axis]].limits {
        Limits::Unbounded => (f64::NEG_INFINITY, f64::INFINITY),
        Limits::Range(low, high) => (low, high),
    }
}

/// The slope at which the motion between two stations turns the first rotary axis by half a turn: a rotary word that is farther off may
/// be taken the other way round. Endless where the program itself turns farther.
pub(crate) fn half_turn(from: &Station, to: &Station) -> f64 {
    let half = PI * (1.0 - 1e-4);
    if (to.q[0] - from.q[0]).abs() > half {
        f64::INFINITY
    } else {
        half / (to.s - from.s)
    }
}

/// The unbroken chain of straight feed motions around the motion `index`, as stations: a motion that does not turn the tool joins
/// its ends in one station. `room`: how far a tool axis may turn, rad.
pub(crate) fn chain(machine: &Machine, points: &[Point], index: usize, room: f64) -> Vec<Station> {
    let mut first = index;
    while first > 0 && linked(&points[first - 1], &points[first]) {
        first -= 1;
    }
    let mut last = index;
    while last + 1 < points.len() && linked(&points[last], &points[last + 1]) {
        last += 1;
    }
    let mut stations: Vec<Station> = Vec::new();
    let mut s = 0.0;
    for (index, point) in points.iter().enumerate().take(last + 1).skip(first) {
        let Ok(stance) = &point.end else { continue };
        match stations.last_mut() {
            Some(station) if index > first && point.rotary_change == [0.0; 2] => station.last = index,
            _ => {
                if index > first {
                    s += point.extent().max(SHORTEST_STEP_MM);
                }
                stations.push(station(machine, point, stance, (index, s, room)));
            }
        }
    }
    for end in [0, stations.len().saturating_sub(1)] {
        if let Some(station) = stations.get_mut(end) {
            (station.pinned, station.free, station.room) = (true, false, 0.0);
        }
    }
    stations
}

fn station(machine: &Machine, point: &Point, stance: &Stance, (index, s, room): (usize, f64, f64)) -> Station {
    let q = [0, 1].map(|axis| machine.rotary.get(axis).map_or(0.0, |&joint| stance.joints[joint]));
    let half = half_width(room, stance.pole_angle);
    let free = stance.pole_angle <= 0.5 * room;
    Station {
        first: index,
        last: index,
        s,
        q,
        // the control chooses the posture where vectors are programmed
        other: if point.vector { None } else { other(machine, stance, q) },
        pole_angle: stance.pole_angle,
        room: if free { f64::INFINITY } else { half },
        free,
        pinned: false,
    }
}

/// The other posture at a stance, where the second rotary axis reaches it; at the pole the same position.
fn other(machine: &Machine, stance: &Stance, q: [f64; 2]) -> Option<[f64; 2]> {
    let (low, high) = travel(machine, 1);
    let inside = |q: &[f64; 2]| q[1] >= low && q[1] <= high;
    if stance.pole_angle <= POLE_TOLERANCE {
        return Some(q).filter(inside);
    }
    let Orientations::Postures(postures) = orientations(machine, &stance.axis) else {
        return None;
    };
    let found = postures.iter().find(|one| one.branch * stance.branch < 0)?;
    Some(found.q).filter(inside)
}

/// The motion from `a` to `b` belongs to a chain with `a`: a straight feed motion with TCP that keeps the posture, the tool and the
/// way in which the feed is given, and turns no axis by more than a whole turn.
fn linked(a: &Point, b: &Point) -> bool {
    let known = a.end.is_ok() && b.end.is_ok() && b.from_known;
    known
        && b.linear
        && b.tcp
        && !b.swap
        && !b.many_turns()
        && (!a.linear || a.time.is_some() == b.time.is_some())
        && a.vector == b.vector
        && a.tip == b.tip
        && a.unit_mm == b.unit_mm
        && a.block != b.block
}

/// Pins the stations far from the pole: their tube is narrower than a degree, and they lie outside twice the pole cone.
pub(crate) fn pin_far(machine: &Machine, stations: &mut [Station]) {
    let cone = 2.0 * machine.tolerances.pole_cone;
    for station in stations {
        station.pinned |= station.pole_angle > cone && station.room < rad(1.0);
    }
}

/// By how much the azimuth of a tool axis at the angle `pole_angle` from the pole may change so that the axis turns by at most `room`,
/// rad: 2 asin(sin(room/2) / sin theta), without limit where that has no solution (docs/kinematics.md#smoothing-at-the-pole).
pub(crate) fn half_width(room: f64, pole_angle: f64) -> f64 {
    if room <= 0.0 {
        return 0.0;
    }
    let ratio = sin(0.5 * room) / sin(pole_angle);
    if ratio < 1.0 { 2.0 * asin(ratio) } else { f64::INFINITY }
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
