//! Postures and turns of a chain by a shortest path over its firm stations: those whose azimuth says where the rotary axis must be.
//!
//! Each gap between two of them costs the square of what the axis must turn there at least, divided by the length. A sum, unlike the
//! largest slope of the chain, is least everywhere at once. What it leaves open ([`super::reach`] is exact) is checked afterwards.
use super::chain::Station;
use super::reach::{Choice, Range};
use core::f64::consts::TAU;

/// Turns beyond the programmed ones that are looked at.
const TURNS: f64 = 2.0;

/// Weight of the turn from middle to middle, where the tubes leave all open.
const MIDDLES: f64 = 1e-3;

/// A posture and a turn at a firm station, the least cost of getting there, and from which candidate of the firm station before.
struct Candidate {
    choice: Choice,
    cost: f64,
    from: usize,
}

/// Postures and turns of all stations; `None` where the path over the firm stations cannot be completed.
pub(super) fn cheapest(stations: &[Station], travel: Range, free_ends: [bool; 2]) -> Option<Vec<Choice>> {
    let last = stations.len() - 1;
    let firm: Vec<usize> = (0..=last)
        .filter(|&at| at == 0 || at == last || stations[at].firm())
        .collect();
    let mut layers: Vec<Vec<Candidate>> = Vec::with_capacity(firm.len());
    for (layer, &at) in firm.iter().enumerate() {
        let fixed = at == 0 && !free_ends[0] || at == last && !free_ends[1];
        let mut candidates = candidates(&stations[at], travel, fixed);
        if layer > 0 {
            let gap = &stations[firm[layer - 1]..=at];
            for candidate in &mut candidates {
                reach(gap, &layers[layer - 1], candidate);
            }
            candidates.retain(|candidate| candidate.cost.is_finite());
        }
        if candidates.is_empty() {
            return None;
        }
        layers.push(candidates);
    }
    let mut at = (0..layers.last()?.len()).min_by(|&a, &b| {
        let cost = |at: usize| layers[layers.len() - 1][at].cost;
        cost(a).total_cmp(&cost(b))
    })?;
    let mut chosen = Vec::with_capacity(firm.len());
    for layer in layers.iter().rev() {
        chosen.push(layer[at].choice);
        at = layer[at].from;
    }
    chosen.reverse();
    complete(stations, travel, &firm, &chosen)
}

fn candidates(station: &Station, travel: Range, fixed: bool) -> Vec<Candidate> {
    let mut found = Vec::new();
    for posture in 0..2 {
        let Some([q, _]) = station.in_posture(posture) else {
            continue;
        };
        let nearest = ((station.q[0] - q) / TAU).round();
        let mut turn = nearest - TURNS;
        while turn <= nearest + TURNS {
            let centre = q + TAU * turn;
            let written = posture == 0 && turn == 0.0;
            if (!fixed || written) && centre >= travel.0 && centre <= travel.1 {
                found.push(Candidate {
                    choice: Choice { posture, centre },
                    cost: if written { 0.0 } else { 1e-9 },
                    from: 0,
                });
            }
            turn += 1.0;
        }
    }
    found
}

/// Sets the least cost of a candidate at the end of a gap.
fn reach(gap: &[Station], before: &[Candidate], candidate: &mut Candidate) {
    let (first, last) = (&gap[0], &gap[gap.len() - 1]);
    let changes = gap[1..gap.len() - 1].iter().any(|station| station.free);
    let room = [first, last]
        .iter()
        .map(|station| if station.pinned { 0.0 } else { station.room })
        .sum::<f64>();
    let length = last.s - first.s;
    let own = candidate.cost;
    candidate.cost = f64::INFINITY;
    for (from, known) in before.iter().enumerate() {
        if known.choice.posture != candidate.choice.posture && !changes {
            continue;
        }
        let turn = (candidate.choice.centre - known.choice.centre).abs();
        let least = (turn - room).max(0.0);
        let cost = known.cost + own + (least * least + MIDDLES * turn * turn) / length;
        if cost < candidate.cost {
            (candidate.cost, candidate.from) = (cost, from);
        }
    }
}

/// The choices of all stations from those of the firm ones: a posture changes at the station nearest to the pole, and a wide tube takes
/// the turn that is nearest to the line between the firm stations around it.
fn complete(stations: &[Station], travel: Range, firm: &[usize], chosen: &[Choice]) -> Option<Vec<Choice>> {
    let mut choices = Vec::with_capacity(stations.len());
    for (pair, ends) in firm.windows(2).zip(chosen.windows(2)) {
        let (first, last) = (pair[0], pair[1]);
        choices.push(ends[0]);
        let nearer = |a: &usize, b: &usize| stations[*a].pole_angle.total_cmp(&stations[*b].pole_angle);
        let change = (first + 1..last).filter(|&at| stations[at].free).min_by(nearer);
        for (at, station) in stations.iter().enumerate().take(last).skip(first + 1) {
            let before = change.is_none_or(|change| at < change);
            let posture = if before { ends[0].posture } else { ends[1].posture };
            let share = (station.s - stations[first].s) / (stations[last].s - stations[first].s);
            let line = ends[0].centre + (ends[1].centre - ends[0].centre) * share;
            let [q, _] = station.in_posture(posture)?;
            let room = if station.pinned { 0.0 } else { station.room };
            let turn = ((line - q) / TAU).round();
            let turns = [turn, turn - 1.0, turn + 1.0].map(|turn| q + TAU * turn);
            let inside = |centre: &f64| centre + room >= travel.0 && centre - room <= travel.1;
            let centre = turns.into_iter().find(inside)?;
            choices.push(Choice { posture, centre });
        }
    }
    choices.push(*chosen.last()?);
    Some(choices)
}
