//! Where the first rotary axis is at each station of a chain after smoothing, and in which posture.
use super::chain::{Station, half_turn, pin_far, travel};
use super::ends::free_ends;
use super::even::{Stretch, even_out};
use super::firm;
use super::reach::{Choice, Range, Reach};
use crate::survey::Point;
use crate::taut_string::taut_string;
use core::f64::consts::{PI, TAU};
use trunnion_machine::Machine;

/// How much steeper than the least slope a step may be for the sake of smoothness. More would make the changes of slope smaller, and cost feed.
const SLACK: f64 = 1.003;

/// Within this factor of the least slope the cheapest choice of postures is good enough.
const NEAR: f64 = 1.01;

/// So many steps on either side decide how steep a step may be.
const AROUND: usize = 8;

/// A chain with the new position of the first rotary axis at each station.
pub(crate) struct Plan {
    /// The chain.
    pub stations: Vec<Station>,
    /// Posture of each station: 0 as programmed, 1 the other one.
    pub postures: Vec<usize>,
    /// First rotary joint of each station, rad.
    pub q: Vec<f64>,
    /// Stretches that are to change, as ranges of stations; what is outside them stays as it is, and so do their ends where a chain goes on.
    pub stretches: Vec<(usize, usize)>,
    /// Why a stretch around a station that asked for it stays as it is: the station, the steepest step before and after, rad per mm.
    pub useless: Vec<(usize, f64, f64)>,
}

/// Smooths a chain. `steep`: whether the motion to a station asks for it.
pub(crate) fn plan(
    machine: &Machine,
    points: &[Point],
    mut stations: Vec<Station>,
    steep: &dyn Fn(&Station) -> bool,
) -> Option<Plan> {
    if stations.len() < 3 {
        return None;
    }
    let free_ends = free_ends(points, &stations);
    let travel = looked_at(&stations, travel(machine, 0))?;
    let ends_only = stations.clone();
    pin_far(machine, &mut stations);
    let mut choices = choose(&stations, travel, free_ends);
    let (lower, upper) = tubes(&stations, &choices, travel);
    let mut string = taut_string(&places(&stations), &lower, &upper);
    // what the pins cost, and what a choice gap by gap does
    let found = steepest(&stations, &string);
    if found > 0.0 && reach(&ends_only, travel, free_ends).allows(found / NEAR) {
        let pinned = exact(&reach(&stations, travel, free_ends), found);
        let open = exact(&reach(&ends_only, travel, free_ends), found);
        if let (Some((pinned, slope)), Some((open, least))) = (pinned, open) {
            if slope <= NEAR * least {
                choices = pinned;
            } else {
                (choices, stations) = (open, ends_only);
            }
            let (lower, upper) = tubes(&stations, &choices, travel);
            string = taut_string(&places(&stations), &lower, &upper);
        }
    }
    let (lower, upper) = tubes(&stations, &choices, travel);
    Some(finish(stations, &choices, (&lower, &upper), string, steep))
}

fn reach(stations: &[Station], travel: Range, free_ends: [bool; 2]) -> Reach<'_> {
    Reach {
        stations,
        travel,
        free_ends,
    }
}

/// Postures and turns of a way that is as little steep as possible, and how steep it is; not above `highest`.
fn exact(reach: &Reach<'_>, highest: f64) -> Option<(Vec<Choice>, f64)> {
    let least = reach.least(highest);
    Some((reach.choices(least * (1.0 + 1e-9) + 1e-12)?, least))
}

/// Postures and turns gap by gap; as programmed where nothing can be gained by others.
fn choose(stations: &[Station], travel: Range, free_ends: [bool; 2]) -> Vec<Choice> {
    let calm = stations
        .windows(2)
        .all(|pair| (pair[1].q[0] - pair[0].q[0]).abs() <= PI);
    let as_written = || {
        stations
            .iter()
            .map(|station| Choice {
                posture: 0,
                centre: station.q[0],
            })
            .collect()
    };
    if calm && !stations.iter().any(|station| station.free) {
        return as_written();
    }
    firm::cheapest(stations, travel, free_ends).unwrap_or_else(as_written)
}

/// The travel of the first rotary axis, of an endless one a turn more than is used; `None` where the program leaves it.
fn looked_at(stations: &[Station], (low, high): Range) -> Option<Range> {
    let values = || stations.iter().map(|station| station.q[0]);
    let (least, most) = (
        values().fold(f64::INFINITY, f64::min),
        values().fold(f64::NEG_INFINITY, f64::max),
    );
    let inside = least >= low && most <= high;
    inside.then_some((low.max(least - TAU), high.min(most + TAU)))
}

fn places(stations: &[Station]) -> Vec<f64> {
    stations.iter().map(|station| station.s).collect()
}

/// Walls of the tube; of a free station only those of the travel, and none where that is endless in effect.
fn tubes(stations: &[Station], choices: &[Choice], travel: Range) -> (Vec<f64>, Vec<f64>) {
    let room = |station: &Station| if station.pinned { 0.0 } else { station.room };
    let walls = |side: f64| {
        let pairs = stations.iter().zip(choices);
        pairs
            .map(|(station, choice)| (choice.centre + side * room(station)).clamp(travel.0, travel.1))
            .collect()
    };
    (walls(-1.0), walls(1.0))
}

/// Size of the slope of each step.
fn slopes(stations: &[Station], q: &[f64]) -> Vec<f64> {
    let steps = q.windows(2).zip(stations.windows(2));
    steps
        .map(|(q, at)| ((q[1] - q[0]) / (at[1].s - at[0].s)).abs())
        .collect()
}

fn steepest(stations: &[Station], q: &[f64]) -> f64 {
    slopes(stations, q).into_iter().fold(0.0, f64::max)
}

/// Which stretches change, and to what.
fn finish(
    stations: Vec<Station>,
    choices: &[Choice],
    (lower, upper): (&[f64], &[f64]),
    string: Vec<f64>,
    steep: &dyn Fn(&Station) -> bool,
) -> Plan {
    let last = stations.len() - 1;
    let pairs = stations.iter().zip(choices);
    let other: Vec<bool> = pairs
        .map(|(station, choice)| choice.posture != 0 || (choice.centre - station.q[0]).abs() > 1e-9)
        .collect();
    let written: Vec<f64> = stations.iter().map(|station| station.q[0]).collect();
    let before = slopes(&stations, &written);
    let mut plan = Plan {
        postures: choices.iter().map(|choice| choice.posture).collect(),
        q: string,
        stretches: Vec::new(),
        useless: Vec::new(),
        stations,
    };
    let taut = slopes(&plan.stations, &plan.q);
    let limits = allowed(&plan.stations, &taut, &before);
    let mut first = 0;
    while first < last {
        let mut end = first + 1;
        while end < last && !plan.stations[end].pinned {
            end += 1;
        }
        let asks = (first + 1..=end).find(|&at| steep(&plan.stations[at]));
        let turned = other[first..=end].contains(&true);
        let peak = |slopes: &[f64]| slopes[first..end].iter().copied().fold(0.0, f64::max);
        let (was, is) = (peak(&before), peak(&taut));
        let gains = is <= 0.99 * was;
        if end > first + 1 && asks.is_some() && gains || turned {
            let range = first..=end;
            let slope = |at: usize, q: &[f64]| (q[at + 1] - q[at]) / (plan.stations[at + 1].s - plan.stations[at].s);
            // the steps on both sides as they will be: those outside a stretch stay as they are
            let s = places(&plan.stations[range.clone()]);
            let stretch = Stretch {
                s: &s,
                lower: &lower[range.clone()],
                upper: &upper[range.clone()],
                limits: &limits[first..end],
                outside: [
                    first.checked_sub(1).map(|at| slope(at, &plan.q)),
                    (end < last).then(|| slope(end, &written)),
                ],
            };
            let even = even_out(&stretch, plan.q[range.clone()].to_vec());
            if travelled(&even) <= travelled(&written[range.clone()]) * (1.0 + 1e-9) || turned {
                plan.q[range].copy_from_slice(&even);
            }
            plan.stretches.push((first, end));
        } else {
            if let Some(asks) = asks {
                plan.useless.push((asks, was, is));
            }
            // an end that another stretch shares is pinned, so it has its programmed value
            plan.q[first..=end].copy_from_slice(&written[first..=end]);
            plan.postures[first..=end].fill(0);
        }
        first = end;
    }
    join(&mut plan, &other);
    plan
}

/// Puts stretches together where the station between them changes.
fn join(plan: &mut Plan, other: &[bool]) {
    let mut joined: Vec<(usize, usize)> = Vec::with_capacity(plan.stretches.len());
    for &(first, end) in &plan.stretches {
        match joined.last_mut() {
            Some(last) if last.1 == first && other[first] => last.1 = end,
            _ => joined.push((first, end)),
        }
    }
    plan.stretches = joined;
}

fn travelled(q: &[f64]) -> f64 {
    q.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum()
}

/// How steep each step may be: a little steeper than the steepest step of the taut string around it, but not than those of the program
/// around it, and by no more than half a turn where the program turns no farther.
fn allowed(stations: &[Station], taut: &[f64], before: &[f64]) -> Vec<f64> {
    let around = |slopes: &[f64], at: usize| {
        let (first, end) = (at.saturating_sub(AROUND), (at + AROUND + 1).min(slopes.len()));
        slopes[first..end].iter().copied().fold(0.0, f64::max)
    };
    let limit = |at: usize| {
        let least = around(taut, at);
        let local = (SLACK * least).min(0.995 * around(before, at)).max(least) + 1e-9;
        local.min(half_turn(&stations[at], &stations[at + 1]))
    };
    (0..taut.len()).map(limit).collect()
}
