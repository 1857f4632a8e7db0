//! Postures and windings of a whole program: the cheapest sequence of rotary joint values in which no cut turns to the other posture or winds back.
//!
//! Forward search over the few best paths to each pose (a beam search): a path costs the time of the slowest rotary axis, a swap or a rewind inside a
//! cut costs more than any time. Angles in rad.
use core::f64::consts::PI;
use trunnion_geometry::Vec3;
use trunnion_machine::{Machine, Orientations, orientations, windings};

/// A pose to be reached.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TargetPose {
    /// Unit tool axis.
    pub(crate) axis: Vec3,
    /// It is reached in a cut.
    pub(crate) cuts: bool,
}

/// What was chosen for a pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Chosen {
    /// Rotary joints, workpiece side first.
    pub(crate) q: [f64; 2],
    /// The cut to this pose turns to the other posture, or winds a rotary axis back.
    pub(crate) swap: bool,
}

/// Why a pose cannot be reached.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum WhyUnreachable {
    /// By this angle, rad.
    Unreachable(f64),
    /// Every posture breaks the limits of a rotary axis.
    Limits,
}

/// Paths that are followed at once.
const BEAM: usize = 8;

/// Cost of a swap inside a cut, s: more than any program takes.
const SWAP: f64 = 1e9;

#[derive(Clone, Copy)]
struct State {
    q: [f64; 2],
    /// Sign of the last posture that had one.
    sign: i8,
    cost: f64,
    swap: bool,
    parent: u8,
}

/// Chooses for all poses in order.
///
/// # Errors
/// The index of the first pose that cannot be reached, and why.
pub(crate) fn choose(machine: &Machine, wishes: &[TargetPose]) -> Result<Vec<Chosen>, (usize, WhyUnreachable)> {
    let slowness = slowness(machine);
    let mut steps: Vec<Vec<State>> = Vec::with_capacity(wishes.len());
    let home = [State {
        q: [0.0; 2],
        sign: 0,
        cost: 0.0,
        swap: false,
        parent: 0,
    }];
    let ahead = ahead(machine, wishes);
    for (index, target_pose) in wishes.iter().enumerate() {
        let before: &[State] = steps.last().map_or(&home, Vec::as_slice);
        let found = successors(machine, before, target_pose, ahead[index], slowness).map_err(|never| (index, never))?;
        steps.push(found);
    }
    let mut chosen = Vec::with_capacity(wishes.len());
    let mut at = 0;
    for step in steps.iter().rev() {
        let state = &step[at];
        chosen.push(Chosen {
            q: state.q,
            swap: state.swap,
        });
        at = usize::from(state.parent);
    }
    chosen.reverse();
    Ok(chosen)
}

/// For each pose the first rotary axis of the postures at the next pose off the pole: at the pole the axis is free, and may turn there
/// already. None where no such pose follows.
fn ahead(machine: &Machine, wishes: &[TargetPose]) -> Vec<[Option<f64>; 2]> {
    let mut next = [None; 2];
    let mut all: Vec<[Option<f64>; 2]> = Vec::with_capacity(wishes.len());
    for target_pose in wishes.iter().rev() {
        all.push(next);
        if let Orientations::Postures(postures) = orientations(machine, &target_pose.axis) {
            next = [0, 1].map(|index| postures.get(index).map(|one| one.q[0]));
        }
    }
    all.reverse();
    all
}

/// Seconds per rad of the rotary axes; 1 for all where a speed is not declared.
fn slowness(machine: &Machine) -> [f64; 2] {
    let mut out = [1.0; 2];
    for (slot, &joint) in out.iter_mut().zip(&machine.rotary) {
        match machine.axes[joint].max_speed {
            Some(speed) if speed > 0.0 => *slot = 1.0 / speed,
            _ => return [1.0; 2],
        }
    }
    out
}

/// Rotary joints of a posture, `None` where one is free, and its sign.
type Posture = ([Option<f64>; 2], i8);

fn successors(
    machine: &Machine,
    before: &[State],
    target_pose: &TargetPose,
    ahead: [Option<f64>; 2],
    slowness: [f64; 2],
) -> Result<Vec<State>, WhyUnreachable> {
    let mut found: Vec<State> = Vec::new();
    let postures: Vec<Posture> = match orientations(machine, &target_pose.axis) {
        Orientations::Unreachable(off) => return Err(WhyUnreachable::Unreachable(off)),
        // at the pole the first axis is free: it stays, or turns to where it will be needed
        Orientations::Pole(q2) => {
            let early = ahead.into_iter().flatten().map(|q1| ([Some(q1), Some(q2)], 0));
            core::iter::once(([None, Some(q2)], 0)).chain(early).collect()
        }
        Orientations::Postures(postures) => {
            let both = postures.iter().map(|one| (one.q.map(Some), one.branch));
            both.collect()
        }
    };
    for (parent, from) in before.iter().enumerate() {
        for (q, branch) in &postures {
            for values in values(machine, *q, from.q) {
                let state = arrive(
                    machine,
                    from,
                    parent as u8,
                    values,
                    (*branch, &postures),
                    target_pose.cuts,
                    slowness,
                );
                match found.iter_mut().find(|known| same(known, &state)) {
                    Some(known) if known.cost <= state.cost => {}
                    Some(known) => *known = state,
                    None => found.push(state),
                }
            }
        }
    }
    // a stable sort: equal costs keep the order in which they were found, so that the choice is the same everywhere
    found.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    found.truncate(BEAM);
    if found.is_empty() {
        Err(WhyUnreachable::Limits)
    } else {
        Ok(found)
    }
}

fn same(a: &State, b: &State) -> bool {
    a.sign == b.sign && (a.q[0] - b.q[0]).abs() < 1e-9 && (a.q[1] - b.q[1]).abs() < 1e-9
}

/// The legal windings of a posture near the previous joints.
fn values(machine: &Machine, q: [Option<f64>; 2], from: [f64; 2]) -> Vec<[f64; 2]> {
    let near = |index: usize| -> Vec<f64> {
        match (machine.rotary.get(index), q[index]) {
            (None, _) => vec![0.0],
            (Some(&joint), Some(q)) => windings(machine, joint, q, from[index]).to_vec(),
            (Some(&joint), None) => windings(machine, joint, from[index], from[index]).to_vec(),
        }
    };
    let second = near(1);
    let first = near(0);
    first
        .iter()
        .flat_map(|a| second.iter().map(move |b| [*a, *b]))
        .collect()
}

fn arrive(
    machine: &Machine,
    from: &State,
    parent: u8,
    q: [f64; 2],
    (branch, postures): (i8, &[Posture]),
    cuts: bool,
    slowness: [f64; 2],
) -> State {
    let moves = [(q[0] - from.q[0]).abs(), (q[1] - from.q[1]).abs()];
    let near = |index: usize, value: f64| {
        let off = value - from.q[index];
        (off - 2.0 * PI * (off / (2.0 * PI)).round()).abs()
    };
    // the excess over the cheapest way in the same posture, as rule branch-swap counts it
    let swaps = from.sign * branch < 0 && {
        let cheapest = postures
            .iter()
            .find(|(_, other)| *other == from.sign)
            .map(|(q, _)| (0..2).filter_map(|i| q[i].map(|value| near(i, value))).sum::<f64>());
        cheapest.is_some_and(|cheapest| moves[0] + moves[1] - cheapest > machine.tolerances.swap_excess)
    };
    let rewinds = (0..2).any(|index| moves[index] - near(index, q[index]) > 1e-6);
    let swap = cuts && (swaps || rewinds);
    let time = (moves[0] * slowness[0]).max(moves[1] * slowness[1]);
    // rapids are cheap compared with cuts; the small terms break ties: shorter moves, then nearer zero
    let cost = time * if cuts { 1.0 } else { 0.1 }
        + 1e-6 * (moves[0] + moves[1])
        + 1e-9 * (q[0].abs() + q[1].abs())
        + if swap { SWAP } else { 0.0 };
    State {
        q,
        sign: if branch == 0 { from.sign } else { branch },
        cost: from.cost + cost,
        swap,
        parent,
    }
}

/// The rotary joints for a tool axis that lie nearest to others; `None`: not reachable inside the limits.
pub(crate) fn nearest(machine: &Machine, axis: &Vec3, from: [f64; 2]) -> Option<[f64; 2]> {
    let postures: Vec<[Option<f64>; 2]> = match orientations(machine, axis) {
        Orientations::Unreachable(_) => return None,
        Orientations::Pole(q2) => vec![[None, Some(q2)]],
        Orientations::Postures(postures) => postures.iter().map(|one| one.q.map(Some)).collect(),
    };
    let off = |q: &[f64; 2]| (q[0] - from[0]).abs() + (q[1] - from[1]).abs();
    let all = postures.iter().flat_map(|q| values(machine, *q, from));
    all.min_by(|a, b| off(a).total_cmp(&off(b)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use trunnion_geometry::{deg, rad};
    use trunnion_machine::{builtin, tool_axis_at};

    fn wishes(machine: &Machine, joints: &[[f64; 2]]) -> Vec<TargetPose> {
        let axis = |q: &[f64; 2]| tool_axis_at(machine, q.map(rad));
        joints
            .iter()
            .enumerate()
            .map(|(index, q)| TargetPose {
                axis: axis(q),
                cuts: index > 0,
            })
            .collect()
    }

    /// The greedy choice begins with the nearer posture and runs into the limit of A at -30 deg; the other one reaches the end.
    #[test]
    fn the_first_posture_is_chosen_for_what_comes() {
        let mikron = builtin("mikron-ucp710").expect("built in");
        let path: Vec<[f64; 2]> = (0..8).map(|i| [-170.0, 10.0 + 10.0 * f64::from(i)]).collect();
        let chosen = choose(mikron, &wishes(mikron, &path)).expect("reachable");
        assert!(chosen.iter().all(|one| !one.swap));
        assert!((deg(chosen[7].q[1]) - 80.0).abs() < 1e-9, "{chosen:?}");
        let greedy = nearest(mikron, &tool_axis_at(mikron, path[0].map(rad)), [0.0; 2]).expect("reachable");
        assert!(deg(greedy[1]) < 0.0, "the nearer posture has a negative A: {greedy:?}");
    }

    #[test]
    fn an_endless_axis_winds_on() {
        let mikron = builtin("mikron-ucp710").expect("built in");
        let path: Vec<[f64; 2]> = (0..60).map(|i| [20.0 * f64::from(i), 40.0]).collect();
        let chosen = choose(mikron, &wishes(mikron, &path)).expect("reachable");
        assert!((deg(chosen[59].q[0]) - 1180.0).abs() < 1e-6 && chosen.iter().all(|one| !one.swap));
    }

    #[test]
    fn a_swap_that_limits_force_is_told() {
        let text = trunnion_machine::builtin_source("mikron-ucp710").expect("built in");
        let narrow = text
            .split("[[check]]")
            .next()
            .expect("a machine")
            .replace("limits = \"unbounded\"", "limits = [-200, 200]");
        let machine = trunnion_machine::load("narrow", &narrow).expect("valid");
        let path: Vec<[f64; 2]> = (0..40).map(|i| [20.0 * f64::from(i), 40.0]).collect();
        let chosen = choose(&machine, &wishes(&machine, &path)).expect("reachable");
        assert!(chosen.iter().any(|one| one.swap));
    }

    #[test]
    fn what_is_out_of_reach_is_told_with_its_place() {
        let mikron = builtin("mikron-ucp710").expect("built in");
        let down = TargetPose {
            axis: -Vec3::z(),
            cuts: true,
        };
        let up = TargetPose {
            axis: Vec3::z(),
            cuts: true,
        };
        assert_eq!(choose(mikron, &[up, down]), Err((1, WhyUnreachable::Limits)));
        let mill = builtin("mill-3axis").expect("built in");
        let tilted = TargetPose {
            axis: Vec3::x(),
            cuts: true,
        };
        assert!(matches!(
            choose(mill, &[up, tilted]),
            Err((1, WhyUnreachable::Unreachable(_)))
        ));
    }
}
