//! The words of one stretch of a smoothed chain.
use super::chain::{Station, stance};
use super::ends::{lead_in, lead_out};
use super::obstacles::{refused, tool_obstacle};
use super::plan::Plan;
use crate::Change;
use crate::reposition::{Aim, Writer};
use crate::survey::Point;
use trunnion_geometry::deg;
use trunnion_syntax::TextEdit;

/// What was done in one window.
pub(crate) struct Smoothed {
    pub edits: Vec<TextEdit>,
    /// Indices of the first and the last motion that change.
    pub changed: (usize, usize),
    /// Indices of its first and last point.
    pub points: (usize, usize),
    /// Largest slope of the rotary axis before and after, rad per mm.
    pub slopes: (f64, f64),
    /// Changes of posture before and after.
    pub crossings: (usize, usize),
}

/// Changes of posture of stations: of the sign of the second rotary joint about the pole. `posture`: of each station.
fn changes_of_posture(stations: &[Station], posture: impl Fn(usize) -> usize) -> usize {
    let pole = pole_second(stations);
    let (mut last, mut count) = (0.0, 0);
    for (at, station) in stations.iter().enumerate().filter(|(_, station)| !station.free) {
        let side = station.in_posture(posture(at)).unwrap_or(station.q)[1] - pole;
        count += usize::from(last * side < 0.0);
        if side != 0.0 {
            last = side;
        }
    }
    count
}

/// The motions that change, as first and one past the last. An end of the chain may change too; then all motions that share its position do.
fn span(points: &[Point], [first, end]: [&Station; 2], changes: [bool; 2]) -> (usize, usize) {
    let begin = if changes[0] {
        lead_in(points, first.first)
    } else {
        first.last + 1
    };
    let stop = if changes[1] {
        lead_out(points, end.last)
    } else {
        end.first
    };
    (begin, stop)
}

/// Edits for all points of a stretch that change, and for what the motion after them takes over.
pub(crate) fn write(
    points: &[Point],
    writer: &Writer<'_>,
    plan: &Plan,
    (first, end): (usize, usize),
) -> Result<Smoothed, Change> {
    let unknown = || refused("a position inside the window is unknown");
    let stations = &plan.stations;
    let changes = |at: usize| plan.postures[at] != 0 || (plan.q[at] - stations[at].q[0]).abs() > 1e-9;
    let (begin, stop) = span(points, [&stations[first], &stations[end]], [first, end].map(changes));
    let start = begin.checked_sub(1).and_then(|at| stance(&points[at]));
    let mut current = start.map_or([f64::NAN; 5], |start| writer.programmed(start));
    let mut edits = Vec::new();
    let mut written: Vec<f64> = stations[first..=end].iter().map(|station| station.q[0]).collect();
    let mut at = first;
    for (index, point) in points.iter().enumerate().take(stop).skip(begin) {
        while at < end && stations[at].last < index {
            at += 1;
        }
        let station = &stations[at];
        if let Some(obstacle) = tool_obstacle(point) {
            return Err(obstacle);
        }
        if point.rotary_zero != writer.rotary_zero {
            return Err(refused("the work offset of a rotary axis changes inside the window"));
        }
        let other = station.in_posture(plan.postures[at]).ok_or_else(unknown)?;
        let side = at.checked_sub(1).map_or(1.0, |before| {
            if stations[before].q[1] < stations[at].q[1] {
                -1.0
            } else {
                1.0
            }
        });
        let aim = Aim {
            q: plan.q[at],
            second: (plan.postures[at] != 0).then_some(other[1]),
            side,
        };
        let stance = stance(point).ok_or_else(unknown)?;
        let q = writer
            .turn(point.block, stance, aim, &mut current, &mut edits)
            .map_err(refused)?;
        written[at - first] = q;
    }
    if let Some(next) = points.get(stop) {
        let stance = stance(next).ok_or_else(unknown)?;
        writer
            .restore(next.block, stance, &mut current, &mut edits)
            .map_err(refused)?;
    }
    let slopes = (
        steepest(plan, (first, end), |at| stations[at].q[0]),
        steepest(plan, (first, end), |at| written[at - first]),
    );
    if slopes.1 > slopes.0 {
        return Err(refused(format!(
            "with the number of digits in this program the slope of the table would grow from {:.3} to {:.3} deg/mm",
            deg(slopes.0),
            deg(slopes.1)
        )));
    }
    Ok(Smoothed {
        edits,
        changed: (begin, stop.min(points.len() - 1)),
        points: (stations[first].last, stations[end].first),
        slopes,
        crossings: (
            changes_of_posture(&stations[first..=end], |_| 0),
            changes_of_posture(&stations[first..=end], |at| plan.postures[first + at]),
        ),
    })
}

/// Largest slope of the first rotary joint in a stretch, rad per mm.
pub(crate) fn steepest(plan: &Plan, (first, end): (usize, usize), q: impl Fn(usize) -> f64) -> f64 {
    let length = |at: usize| plan.stations[at + 1].s - plan.stations[at].s;
    let slopes = (first..end).map(|at| ((q(at + 1) - q(at)) / length(at)).abs());
    slopes.fold(0.0, f64::max)
}

/// The second rotary joint at the pole that is nearest to a chain, rad: halfway between the two postures of its first station that has both.
fn pole_second(stations: &[Station]) -> f64 {
    let both = stations
        .iter()
        .filter(|station| !station.free)
        .find_map(|station| Some((station.q[1], station.other?[1])));
    both.map_or(0.0, |(a, b)| 0.5 * (a + b))
}
