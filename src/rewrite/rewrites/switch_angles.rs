//! Chooses posture and turns of the rotary axes for the whole program, so that they travel least, take the least time, or deviate least.
//!
//! # Why
//! Most tool axes can be reached in two postures, and each rotary value with any number of whole turns. Where the tool axis passes near the
//! pole, one posture spins the table by 115 degrees, and the other one tips over the pole in half of that. Without tool centre point
//! control a large turn in one block also takes the tip off its line. A choice made block by block runs into limits; this rewrite looks at
//! the whole program at once.
//!
//! # How
//! Each position of the rotary axes has a state for every posture and winding inside the travel of all axes. A motion costs the rotary
//! travel (`--cost travel`: the root of the sum of squares), the time of the slowest rotary axis (`--cost time`) or the deviation of the
//! tip from its line (`--cost deviation`). The cheapest path through the states is found exactly. Any posture may be
//! chosen at the first position.
//! A cut may change the posture only where the pole is inside the block (the tool axis passes it inside the pole cone, or the rotary
//! travel exceeds that of the same posture by no more than `swap_excess`), and never turns an axis by more than half a turn, unless the
//! program did so before.
//!
//! # Example
//! ```gcode before sinumerik-840d mikron-ucp710
//! TRAORI
//! G0 X-28.38197 Y-2.14469 Z59.86773 A2.042 C3.358 S8000 M3
//! N2920 G1 X-28.38474 Y-1.84041 Z59.90263 A1.047 C4.822 F2000
//! N2930 G1 X-28.38709 Y-1.53565 Z59.93222 A0.081 C52.595
//! N2940 G1 X-28.38873 Y-1.28023 Z59.95290 A0.79 C176.914
//! N2950 G1 X-28.39015 Y-1.01049 Z59.97066 A1.676 C179.095
//! M30
//! ```
//! ```gcode after
//! TRAORI
//! G0 X-28.38197 Y-2.14469 Z59.86773 A2.042 C3.358 S8000 M3
//! N2920 G1 X-28.38474 Y-1.84041 Z59.90263 A1.047 C4.822 F2000
//! N2930 G1 X-28.38709 Y-1.53565 Z59.93222 A0.081 C52.595
//! N2940 G1 X-28.38873 Y-1.28023 Z59.95290 A-0.79 C-3.086
//! N2950 G1 X-28.39015 Y-1.01049 Z59.97066 A-1.676 C-0.905
//! M30
//! ```
//!
//! # Claim
//! Every motion ends in the same pose of tool and part, after rounding to the digits of the program, and no other sequence of
//! postures and turns is cheaper. The certificate holds a label for every state that proves this without a search.
//!
//! # Traps
//! - Without tool centre point control X Y Z change with the posture. Tool length and work offset must be declared.
//! - Under feed per minute a motion without tool centre point control takes another time when its axes travel another distance.
//! - Between the ends of a block the tool takes another path: the certificate says how far apart the paths are, and the checker
//!   judges the result like any program.
//! - At the pole the first rotary axis is free: it takes one of the values of the neighbouring positions, not any value in between.
//! - Of an axis with more than 31 turns of travel only the turns nearest to the program are considered.
//! - Tool vectors, G91, tilted planes and cycles that turn an axis are kept as they are written, or the rewrite is refused.
//!
//! # Sources
//! Paper on tool-path optimisation for a five-axis machine (angle switching); docs/kinematics.md#two-postures; Bellman, Dynamic programming (1957).
use super::Body;
use crate::posed_words::{Move, PosedWords};
use crate::shortest_path::{Cheapest, cheapest};
use crate::{Known, Options, Place, Proposal, Proposed, Refusal};
use core::fmt::Write;
use trunnion_certify::Claim;
use trunnion_certify::postures::{Graph, PostureCost, Station, Stations, changes_of_posture};
use trunnion_check::{Assume, Settings};
use trunnion_geometry::deg;
use trunnion_interp::{AxisLetter, Fault, ModalState, Motion, MotionKind, Orientation, Sink, run};
use trunnion_machine::{Follower, Limits, Machine};
use trunnion_syntax::{LineIndex, Program};

pub(super) const REWRITE: Body = Body {
    cures: &[
        "angle-wrap",
        "axis-overspeed",
        "branch-swap",
        "excess-rotary-travel",
        "feed-drop",
        "path-deviation",
        "pole-crossing",
        "pole-flip",
    ],
    writes: Some("rotary words of blocks"),
    propose,
};

/// Bits of X, Y and Z among the axis letters.
const XYZ: u16 = 0b111;

/// Follows a program and keeps what the rewrite needs.
struct Collector<'m> {
    machine: &'m Machine,
    follower: Follower<'m>,
    assume: Assume,
    stations: Stations<'m>,
    moves: Vec<Move>,
    vector: Option<usize>,
}

impl Sink for Collector<'_> {
    fn motion(&mut self, motion: &Motion, state: &ModalState) {
        // such a program is refused
        if self.vector.is_some() {
            return;
        }
        let leg = self.follower.follow(motion);
        self.stations.add(&leg);
        if matches!(motion.orientation, Orientation::Vector(..)) {
            self.vector.get_or_insert(self.moves.len());
        }
        let letters = |index: usize| {
            let joint = *self.machine.rotary.get(index)?;
            Some(usize::from(AxisLetter::new(self.machine.axes[joint].letter)?.0))
        };
        let mut words = [None; 5];
        let mut rotary_zero = [0.0; 2];
        for (index, word) in words.iter_mut().enumerate() {
            let axis = if index < 3 { Some(index) } else { letters(index - 3) };
            *word = axis.and_then(|axis| motion.end.get(axis));
            if let (3.., Some(axis), false) = (index, axis, motion.machine_coordinates) {
                rotary_zero[index - 3] = motion.zero[axis];
            }
        }
        self.moves.push(Move {
            block: motion.block,
            words,
            rotary_zero,
            unit_mm: state.coordinates.unit_mm(),
            incremental: state.coordinates.incremental(),
            tip_words: motion.tcp,
            undeclared: {
                let left = self.assume.leaves(motion.undeclared);
                left.zero & XYZ != 0 || left.length
            },
            rests: matches!(motion.kind, MotionKind::Dwell(_)),
            joints: leg.end.as_ref().ok().map(|end| (end.joints, end.tool_length)),
        });
    }
    fn fault(&mut self, _: Fault) {}
    fn reads_faults(&self) -> bool {
        false
    }
}

fn propose(program: &Program, settings: &Settings<'_>, options: &Options, _: &Known) -> Proposed {
    let Some(machine) = settings.machine else {
        return Err("no machine is named, and postures depend on the machine (--machine)".into());
    };
    if machine.rotary.is_empty() || machine.rotary.len() > 2 {
        return Ok(None);
    }
    if let Some(letter) = options.cost.lacks(machine) {
        return Err(Refusal::missing(format!(
            "the machine file does not declare the highest speed of {letter}, and --cost time depends on it"
        )));
    }
    let mut collector = Collector {
        machine,
        follower: Follower::new(machine),
        assume: settings.assume,
        stations: Stations::new(machine),
        moves: Vec::new(),
        vector: None,
    };
    run(program, settings.dialect, &settings.setup, &mut collector);
    let Collector {
        stations,
        moves,
        vector,
        ..
    } = collector;
    let stations = stations.all();
    let lines = LineIndex::new(program.source());
    let line = |motion: usize| {
        lines
            .line_column(program.source(), program.block(moves[motion].block).range().start)
            .0
    };
    if let Some(motion) = vector {
        return Err(format!(
            "line {}: tool vectors are programmed, so the control chooses postures and turns",
            line(motion)
        )
        .into());
    }
    if stations.len() < 2 {
        return Ok(None);
    }
    let graph = Graph::new(machine, stations, options.cost).map_err(|station| {
        format!(
            "line {}: no posture reaches this tool axis inside the travel of the rotary axes",
            line(stations[station].first)
        )
    })?;
    let Some(found) = cheapest(&graph) else {
        return Err("no sequence of postures and turns stays inside the travel of the axes".into());
    };
    // costs are rounded to billionths: less is no gain
    let least = found.path.last().and_then(|&last| found.labels[last]).unwrap_or(0);
    let gains =
        graph.written_cost() > least + 2 * stations.len() as u64 && lowers_the_worst(&graph, &found.path, options);
    if graph.inside_travel() && !gains {
        return Ok(None);
    }
    let Some(edits) = write(program, machine, &graph, &moves, &found.path)
        .map_err(|(motion, why)| format!("line {}: {why}", line(motion)))?
    else {
        return Ok(None);
    };
    let summary = summary(machine, &graph, &found, options);
    Ok(Some(Proposal {
        // one place: the cheapest sequence is one of the whole program
        places: vec![Place::around(program, edits)],
        claim: Claim::LeastPostures {
            tolerance_mm: options.tolerance_mm,
            tolerance_deg: options.tolerance_deg,
            cost: options.cost,
            labels: found.labels,
        },
        summary,
    }))
}

/// Whether the largest deviation falls, by more than rounding: a smaller sum alone is no better part.
fn lowers_the_worst(graph: &Graph<'_>, path: &[usize], options: &Options) -> bool {
    let after = path
        .windows(2)
        .enumerate()
        .filter_map(|(index, pair)| graph.edge(index + 1, pair[0], pair[1]));
    let (was, is) = (graph.written_costs().max(), after.max());
    options.cost != PostureCost::Deviation || is.unwrap_or(0) + WORTH < was.unwrap_or(0)
}

/// By how much the largest deviation must fall, in billionths of a mm: 0.00001 mm, the digits of most programs.
const WORTH: u64 = 10_000;

/// The edits that write a path into the program; `Ok(None)`: it is the path as written. `Err`: index of a motion, and why it cannot be written.
fn write(
    program: &Program,
    machine: &Machine,
    graph: &Graph<'_>,
    moves: &[Move],
    path: &[usize],
) -> Result<Option<Vec<trunnion_syntax::TextEdit>>, (usize, String)> {
    let mut words = PosedWords::new(program, machine);
    let mut at = 0;
    for (index, (station, q)) in graph.stations().iter().zip(wound(machine, graph, path)).enumerate() {
        let changed = station.written.iter().zip(q).any(|(was, is)| (was - is).abs() > 1e-9);
        let end = graph.stations().get(index + 1).map_or(moves.len(), |next| next.first);
        for (motion, programmed) in moves.iter().enumerate().take(end).skip(at) {
            let inside = motion >= station.first && motion <= station.last;
            words
                .add(programmed, (inside && changed).then_some(q))
                .map_err(|why| (motion, why))?;
        }
        at = end;
    }
    let edits = words.finish();
    Ok((!edits.is_empty()).then_some(edits))
}

/// The rotary joints of a path, rad, with the turns of endless axes added up.
fn wound(machine: &Machine, graph: &Graph<'_>, path: &[usize]) -> Vec<[f64; 2]> {
    let mut all: Vec<[f64; 2]> = Vec::with_capacity(path.len());
    for (index, &state) in path.iter().enumerate() {
        let state = graph.state(state);
        let mut q = state.q;
        if let (Some(before), true) = (all.last().copied(), graph.stations()[index].from_known) {
            let steps = graph.steps(graph.state(path[index - 1]), state);
            for (axis, &joint) in machine.rotary.iter().enumerate() {
                if machine.axes[joint].limits == Limits::Unbounded {
                    let reached = before[axis] + steps[axis];
                    // the same number as written where no turn is added
                    let turns = ((reached - state.q[axis]) / core::f64::consts::TAU).round();
                    q[axis] = state.q[axis] + core::f64::consts::TAU * turns;
                }
            }
        }
        all.push(q);
    }
    all
}

/// What is gained, in one line.
fn summary(machine: &Machine, graph: &Graph<'_>, found: &Cheapest, options: &Options) -> String {
    let stations = graph.stations();
    let was = changes_of_posture(stations.iter().map(|station| station.sign));
    let is = changes_of_posture(found.path.iter().map(|&state| graph.state(state).sign));
    let after = wound(machine, graph, &found.path);
    let before: Vec<[f64; 2]> = stations.iter().map(|station| station.written).collect();
    let mut text = format!(
        "{} {:.3} -> {:.3} {}; {was} -> {is} changes of posture",
        options.cost.name(),
        graph.written_cost() as f64 / 1e9,
        found.path.last().and_then(|&last| found.labels[last]).unwrap_or(0) as f64 / 1e9,
        options.cost.unit(),
    );
    for (axis, &joint) in machine.rotary.iter().enumerate() {
        let [(travel_was, step_was), (travel_is, step_is)] = [&before, &after].map(|all| travel(stations, all, axis));
        let _ = write!(
            text,
            "; {} travels {travel_was:.2} -> {travel_is:.2} deg, largest step {step_was:.3} -> {step_is:.3} deg",
            char::from(machine.axes[joint].letter)
        );
    }
    text
}

/// Sum and largest of the steps of an axis, deg.
fn travel(stations: &[Station], values: &[[f64; 2]], axis: usize) -> (f64, f64) {
    let pairs = values
        .windows(2)
        .zip(&stations[1..])
        .filter(|(_, station)| station.from_known);
    pairs.fold((0.0, 0.0f64), |(sum, largest), (pair, _)| {
        let step = deg((pair[1][axis] - pair[0][axis]).abs());
        (sum + step, largest.max(step))
    })
}
