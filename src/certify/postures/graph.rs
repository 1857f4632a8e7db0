//! The states of all stations, the cost of each edge, and the check of labels.
use super::cost::deviation;
use super::station::{posed, windings};
use super::{Freedom, PostureCost, Station};
use core::f64::consts::{PI, TAU};
use core::ops::Range;
use trunnion_geometry::deg;
use trunnion_machine::{Limits, Machine, Stance};

/// A rotary step in a cut may be this much above half a turn, rad: rounding.
const ROUNDING: f64 = 1e-9;

/// A posture and winding at a station.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State {
    /// Rotary joints, workpiece side first, rad. Of an endless axis any whole number of turns may be added.
    pub q: [f64; 2],
    /// Sign of the posture; 0 at the pole.
    pub sign: i8,
    /// It is the position as written (of an endless axis: but for whole turns).
    pub written: bool,
}

/// Changes of posture in a sequence of posture signs; the pole (0) has none.
pub fn changes_of_posture(signs: impl Iterator<Item = i8>) -> u64 {
    let mut last = 0;
    signs.filter(|&sign| sign != 0).fold(0, |count, sign| {
        let changes = last * sign < 0;
        last = sign;
        count + u64::from(changes)
    })
}

/// The graph of a program.
pub struct Graph<'a> {
    machine: &'a Machine,
    stations: &'a [Station],
    cost: PostureCost,
    states: Vec<State>,
    /// Where the states of each station begin, and the end of the last one.
    begins: Vec<usize>,
}

impl<'a> Graph<'a> {
    /// All states. At the pole the first rotary axis takes the values that it has at the neighbouring stations, beside the one as written.
    ///
    /// # Errors
    /// The index of the first station that has no state inside the travel of the rotary axes.
    pub fn new(machine: &'a Machine, stations: &'a [Station], cost: PostureCost) -> Result<Self, usize> {
        let mut states = Vec::with_capacity(stations.len() * 4);
        let mut begins = Vec::with_capacity(stations.len() + 1);
        let neighbours = off_pole(stations);
        for index in 0..stations.len() {
            begins.push(states.len());
            push_states(machine, stations, (index, neighbours[index]), &mut states);
            if states.len() == begins[index] {
                return Err(index);
            }
        }
        begins.push(states.len());
        Ok(Self {
            machine,
            stations,
            cost,
            states,
            begins,
        })
    }

    /// The stations.
    pub fn stations(&self) -> &'a [Station] {
        self.stations
    }

    /// Whether the program as written stays inside the travel of the rotary axes.
    pub fn inside_travel(&self) -> bool {
        (0..self.stations.len()).all(|station| self.states[self.begins[station]].written)
    }

    /// Number of states of all stations.
    pub fn len(&self) -> usize {
        self.states.len()
    }

    /// Whether the program has no station.
    pub fn is_empty(&self) -> bool {
        self.stations.is_empty()
    }

    /// Indices of the states of a station; the one as written comes first, where it is inside the travel.
    pub fn states_of(&self, station: usize) -> Range<usize> {
        self.begins[station]..self.begins[station + 1]
    }

    /// A state.
    pub fn state(&self, index: usize) -> &State {
        &self.states[index]
    }

    /// How the rotary axes move from one state to another, rad: an endless axis takes the shorter direction, but keeps a half turn
    /// as it is written.
    pub fn steps(&self, from: &State, to: &State) -> [f64; 2] {
        let mut steps = [to.q[0] - from.q[0], to.q[1] - from.q[1]];
        for (step, &joint) in steps.iter_mut().zip(&self.machine.rotary) {
            let kept = from.written && to.written && step.abs() <= PI + ROUNDING;
            if self.machine.axes[joint].limits == Limits::Unbounded && !kept {
                *step -= TAU * (*step / TAU).round();
            }
        }
        steps
    }

    /// Cost of the motion that reaches `station` between two of its states (indices), in billionths; `None` where it is not allowed: a cut
    /// may change the posture only where the pole lies inside it or where its rotary excess is at most `swap_excess`, and may not turn an axis by more than half a turn, unless the program as
    /// written does so.
    pub fn edge(&self, station: usize, from: usize, to: usize) -> Option<u64> {
        let at = &self.stations[station];
        let (from, to) = (&self.states[from], &self.states[to]);
        if !at.from_known {
            // the start is unknown: nothing is known of the motion, and nothing is chosen there
            return Some(0);
        }
        let steps = self.steps(from, to);
        let far = steps.iter().any(|step| step.abs() > PI + ROUNDING);
        let swaps = from.sign * to.sign < 0;
        if at.cut
            && !(from.written && to.written)
            && (far
                || swaps && !at.over_pole && self.excess(station, from, steps) > self.machine.tolerances.swap_excess)
        {
            return None;
        }
        Some(match self.cost {
            PostureCost::Deviation if at.in_joints => self.deviation(station, from, to, steps)?,
            cost => cost.of_steps(self.machine, steps),
        })
    }

    /// By how much rotary steps (their sum, rad) exceed those of the cheapest move in the posture of `from`: what the machine's measure of a
    /// posture swap is. Endless where that posture does not reach the station, or only by more than half a turn: a swap is then forced, and never chosen in a cut.
    fn excess(&self, station: usize, from: &State, steps: [f64; 2]) -> f64 {
        let sum = |steps: [f64; 2]| steps[0].abs() + steps[1].abs();
        let same = self.states_of(station).map(|index| &self.states[index]);
        let same = same.filter(|state| state.sign == from.sign);
        // a step of more than half a turn is no alternative in a cut
        let moves = same.map(|state| self.steps(from, state));
        let moves = moves.filter(|steps| steps.iter().all(|step| step.abs() <= PI + ROUNDING));
        let cheapest = moves.map(sum).min_by(f64::total_cmp);
        cheapest.map_or(f64::INFINITY, |cheapest| sum(steps) - cheapest)
    }

    /// Rotary travel of the motion that reaches `station` between two of its states, billionths of a degree.
    pub fn travel(&self, station: usize, from: usize, to: usize) -> u64 {
        if !self.stations[station].from_known {
            return 0;
        }
        let steps = self.steps(&self.states[from], &self.states[to]);
        PostureCost::Travel.of_steps(self.machine, steps)
    }

    /// Cost of the program as it is written, in billionths.
    pub fn written_cost(&self) -> u64 {
        self.written_costs().fold(0, u64::saturating_add)
    }

    /// Cost of each motion that turns a rotary axis as it is written, in billionths; without those from an unknown position.
    pub fn written_costs(&self) -> impl Iterator<Item = u64> + '_ {
        let pairs = self.stations.windows(2).enumerate();
        pairs.filter(|(_, pair)| pair[1].from_known).map(|(index, pair)| {
            let at = |station: &Station| State {
                q: station.written,
                sign: station.sign,
                written: true,
            };
            let (from, to) = (at(&pair[0]), at(&pair[1]));
            let steps = [to.q[0] - from.q[0], to.q[1] - from.q[1]];
            match self.cost {
                PostureCost::Deviation if pair[1].in_joints => {
                    self.deviation(index + 1, &from, &to, steps).unwrap_or(u64::MAX)
                }
                cost => cost.of_steps(self.machine, steps),
            }
        })
    }

    /// Deviation of the motion to `station` in these states.
    fn deviation(&self, station: usize, from: &State, to: &State, steps: [f64; 2]) -> Option<u64> {
        let (before, at) = (&self.stations[station - 1], &self.stations[station]);
        let (tip, length) = before.tips[1];
        let start = posed(self.machine, &before.joints[1], from.q, &tip, length)?;
        let (tip, length) = at.tips[0];
        let mut end = posed(self.machine, &at.joints[0], to.q, &tip, length)?;
        for (index, &joint) in self.machine.rotary.iter().enumerate() {
            end[joint] = from.q[index] + steps[index];
        }
        let zero = trunnion_geometry::Vec3::zeros();
        let stance = |joints| Stance::at(self.machine, joints, length, &zero);
        Some(deviation(self.machine, &stance(&start), &stance(&end)))
    }

    /// The state of a station whose rotary joints are `q` (rad), each axis within `tolerance` rad.
    pub fn find(&self, station: usize, q: [f64; 2], tolerance: f64) -> Option<usize> {
        let off = |index: &usize| {
            let state = &self.states[*index];
            let mut worst = 0.0f64;
            for (axis, &joint) in self.machine.rotary.iter().enumerate() {
                let mut off = q[axis] - state.q[axis];
                if self.machine.axes[joint].limits == Limits::Unbounded {
                    off -= TAU * (off / TAU).round();
                }
                worst = worst.max(off.abs());
            }
            worst
        };
        let best = self.states_of(station).min_by(|a, b| off(a).total_cmp(&off(b)))?;
        (off(&best) <= tolerance).then_some(best)
    }

    /// Proves that `path` (a state of each station) is the cheapest path, by labels of all states (`None`: not reachable): no label is
    /// above the label of a state before it plus the cost of the edge between them, those of the first station are zero, and the path
    /// costs the smallest label of the last station. Returns that cost, in billionths.
    ///
    /// # Errors
    /// The station, and what does not hold there.
    pub fn prove_least(&self, path: &[usize], labels: &[Option<u64>]) -> Result<u64, (usize, String)> {
        let count = self.stations.len();
        if path.len() != count || labels.len() != self.states.len() || count == 0 {
            let (states, given) = (self.states.len(), labels.len());
            return Err((
                0,
                format!("the program has {states} postures and turns, and {given} labels are given"),
            ));
        }
        if self.states_of(0).any(|index| labels[index] != Some(0)) {
            return Err((0, "a label of the first position of the rotary axes is not zero".into()));
        }
        let mut spent = 0u64;
        for station in 1..count {
            let (before, here) = (self.states_of(station - 1), self.states_of(station));
            for from in before {
                let Some(label) = labels[from] else { continue };
                for to in here.clone() {
                    let Some(cost) = self.edge(station, from, to) else {
                        continue;
                    };
                    let reached = label.saturating_add(cost);
                    if labels[to].is_none_or(|claimed| claimed > reached) {
                        return Err((
                            station,
                            "a cheaper sequence of postures leads here than the labels say".into(),
                        ));
                    }
                    if from == path[station - 1] && to == path[station] {
                        spent = spent.saturating_add(cost);
                    }
                }
            }
            if self.edge(station, path[station - 1], path[station]).is_none() {
                let why =
                    "this cut changes the posture away from the pole, or turns a rotary axis by more than half a turn";
                return Err((station, why.into()));
            }
        }
        let least = self.states_of(count - 1).filter_map(|index| labels[index]).min();
        match least {
            Some(least) if least == spent => Ok(spent),
            _ => {
                let least = least.map_or("none".into(), |least| (least as f64 / 1e9).to_string());
                let (spent, unit) = (spent as f64 / 1e9, self.cost.unit());
                Err((
                    count - 1,
                    format!("the postures up to here cost {spent} {unit}, and the labels say {least}"),
                ))
            }
        }
    }
}

/// For each station the nearest ones before and after it that are not at the pole.
fn off_pole(stations: &[Station]) -> Vec<[Option<usize>; 2]> {
    let mut found = vec![[None; 2]; stations.len()];
    let mut last = None;
    for (index, station) in stations.iter().enumerate() {
        found[index][0] = last;
        last = if station.at_pole { last } else { Some(index) };
    }
    let mut next = None;
    for (index, station) in stations.iter().enumerate().rev() {
        found[index][1] = next;
        next = if station.at_pole { next } else { Some(index) };
    }
    found
}

/// States of one station, the one as written first. `index`: its index, and those of its neighbours off the pole.
fn push_states(
    machine: &Machine,
    stations: &[Station],
    (index, neighbours): (usize, [Option<usize>; 2]),
    out: &mut Vec<State>,
) {
    let station = &stations[index];
    let written = State {
        q: station.written,
        sign: station.sign,
        written: true,
    };
    let turns = |q: [f64; 2], sign: i8, out: &mut Vec<State>| {
        let axis = |at: usize| match machine.rotary.get(at) {
            Some(&joint) => windings(machine.axes[joint].limits, q[at], station.written[at]),
            None => vec![0.0],
        };
        let seconds = axis(1);
        for first in axis(0) {
            for &second in &seconds {
                let state = State {
                    q: [first, second],
                    sign,
                    written: false,
                };
                if !near(&state, &written) {
                    out.push(state);
                }
            }
        }
    };
    if legal(machine, &written) {
        out.push(written);
    }
    // where axes are endless, whole turns are free even there
    if station.freedom == Freedom::AsWritten {
        return;
    }
    turns(station.written, station.sign, out);
    if station.freedom == Freedom::Windings {
        return;
    }
    if let Some((q, sign)) = station.other {
        turns(q, sign, out);
    }
    if station.at_pole {
        let begin = out.len();
        for neighbour in neighbours.into_iter().flatten().map(|at| &stations[at]) {
            let firsts = core::iter::once(neighbour.written[0]).chain(neighbour.other.map(|(q, _)| q[0]));
            for first in firsts {
                turns([first, station.written[1]], 0, out);
            }
        }
        // two neighbours may have one value
        let mut kept = begin;
        for at in begin..out.len() {
            if !out[begin..kept].iter().any(|other| near(other, &out[at])) {
                out[kept] = out[at];
                kept += 1;
            }
        }
        out.truncate(kept);
    }
}

/// The same position, but for rounding.
fn near(a: &State, b: &State) -> bool {
    (a.q[0] - b.q[0]).abs() < 1e-9 && (a.q[1] - b.q[1]).abs() < 1e-9
}

/// Inside the travel of the rotary axes.
fn legal(machine: &Machine, state: &State) -> bool {
    machine
        .rotary
        .iter()
        .zip(state.q)
        .all(|(&joint, value)| match machine.axes[joint].limits {
            Limits::Unbounded => true,
            Limits::Range(low, high) => deg(value) >= deg(low) - 1e-5 && deg(value) <= deg(high) + 1e-5,
        })
}
