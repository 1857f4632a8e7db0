//! The joints of a machine at the end of each move of a test piece.
use super::post::TOOL_LENGTH;
use super::{Posture, WindingChoice};
use crate::cli::failure::Failure;
use core::f64::consts::TAU;
use trunnion_geometry::{Vec3, deg};
use trunnion_interp::{Feed, Motion, Orientation, Position};
use trunnion_machine::{
    Follower, Joints, Limits, MAX_AXES, Machine, NoStance, Orientations, Solution, inverse, orientations,
};
use trunnion_pieces::{Move, Piece};

/// The position of the machine.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub(super) joints: Joints,
}

/// The joints for each move.
pub(super) fn places(
    piece: &Piece,
    machine: &Machine,
    posture: Posture,
    windings: WindingChoice,
) -> Result<Vec<Place>, Failure> {
    match posture {
        Posture::Control => as_the_control(piece, machine),
        Posture::Positive | Posture::Negative => one_posture(piece, machine, posture, windings),
    }
}

fn refusal(index: usize, step: &Move, why: &str) -> Failure {
    Failure::new(format!(
        "the machine cannot make this piece: move {index} with the tool axis ({:.6}, {:.6}, {:.6}): {why}",
        step.axis.x, step.axis.y, step.axis.z
    ))
}

/// What the machine does with the same motions programmed as vectors.
fn as_the_control(piece: &Piece, machine: &Machine) -> Result<Vec<Place>, Failure> {
    let mut follower = Follower::new(machine);
    let mut start = Position::default();
    let mut places = Vec::with_capacity(piece.moves.len());
    for (index, step) in piece.moves.iter().enumerate() {
        let mut end = start;
        (0..3).for_each(|axis| end.set(axis, step.tip[axis]));
        let leg = follower.follow(&Motion {
            orientation: Orientation::Vector(None, step.axis),
            tcp: true,
            feed: Feed::PerMinute(piece.feed_mm_min),
            spindle_on: Some(true),
            tool_length_mm: TOOL_LENGTH,
            ..Motion::line(start, end)
        });
        start = end;
        let stance = leg.end.map_err(|why| refusal(index, step, &words(&why)))?;
        places.push(Place { joints: stance.joints });
    }
    Ok(places)
}

fn words(why: &NoStance) -> String {
    match why {
        NoStance::Unreachable(off) => format!("outside its reach by {:.3} deg", deg(*off)),
        NoStance::OutsideLimits { axis, value, limit } => format!(
            "{} would be at {:.3} deg, its limit is {:.3} deg",
            char::from(*axis),
            deg(*value),
            deg(*limit)
        ),
        NoStance::PositionUnknown(letters) => format!("the position of {letters} is unknown"),
        _ => "it cannot be followed".to_owned(),
    }
}

/// All moves in the posture whose second rotary joint is the larger (or the smaller) one.
fn one_posture(
    piece: &Piece,
    machine: &Machine,
    posture: Posture,
    windings: WindingChoice,
) -> Result<Vec<Place>, Failure> {
    let mut q = [0.0; 2];
    let mut places = Vec::with_capacity(piece.moves.len());
    for (index, step) in piece.moves.iter().enumerate() {
        let solved = match orientations(machine, &step.axis) {
            Orientations::Unreachable(off) => {
                return Err(refusal(index, step, &words(&NoStance::Unreachable(off))));
            }
            // the first rotary axis is free: it stays, or (naive) is at zero, as atan2 of zeros gives
            Orientations::Pole(second) => [if windings == WindingChoice::Nearest { q[0] } else { 0.0 }, second],
            Orientations::Postures(postures) => pick(&postures, posture).q,
        };
        for (slot, value) in q.iter_mut().zip(solved) {
            *slot = match windings {
                WindingChoice::Nearest => value + TAU * ((*slot - value) / TAU).round(),
                WindingChoice::Naive => value,
            };
        }
        let joints =
            solve(machine, q, &step.tip).ok_or_else(|| refusal(index, step, "its linear axes cannot reach it"))?;
        places.push(Place { joints });
    }
    Ok(places)
}

fn pick(postures: &[Solution], posture: Posture) -> Solution {
    let mut best = postures[0];
    for other in &postures[1..] {
        if (other.q[1] > best.q[1]) == (posture == Posture::Positive) {
            best = *other;
        }
    }
    best
}

fn solve(machine: &Machine, q: [f64; 2], tip: &Vec3) -> Option<Joints> {
    let mut joints = [0.0; MAX_AXES];
    for (&joint, value) in machine.rotary.iter().zip(q) {
        joints[joint] = value;
    }
    inverse(machine, &mut joints, tip, TOOL_LENGTH)?;
    Some(joints)
}

/// From the middle on in the other posture: the fault of a postprocessor that swaps branches.
pub(super) fn swap_from_the_middle(piece: &Piece, machine: &Machine, places: &mut [Place]) -> Result<(), Failure> {
    let middle = places.len() / 2;
    let mut q = rotary(machine, &places[middle.saturating_sub(1)]);
    let mut swapped = 0;
    for (step, place) in piece.moves.iter().zip(places.iter_mut()).skip(middle) {
        let now = rotary(machine, place);
        let Orientations::Postures(postures) = orientations(machine, &step.axis) else {
            continue;
        };
        let away = |s: &Solution| {
            let off = s.q[1] - now[1];
            (off - TAU * (off / TAU).round()).abs()
        };
        let Some(other) = postures
            .iter()
            .max_by(|a, b| away(a).total_cmp(&away(b)))
            .filter(|s| away(s) > 1e-6)
        else {
            continue;
        };
        for (slot, value) in q.iter_mut().zip(other.q) {
            *slot = value + TAU * ((*slot - value) / TAU).round();
        }
        if let Some(joints) = solve(machine, q, &step.tip) {
            place.joints = joints;
            swapped += 1;
        }
    }
    if swapped == 0 {
        return Err(Failure::new(
            "--plant swap: this machine has no second posture for these tool axes",
        ));
    }
    Ok(())
}

/// The place where a rotary axis with limits comes nearest to one, moved 0.1 deg beyond it.
pub(super) fn break_a_limit(machine: &Machine, places: &mut [Place]) -> Result<(), Failure> {
    let mut nearest: Option<(f64, usize, usize, f64)> = None;
    for (index, place) in places.iter().enumerate() {
        for &joint in &machine.rotary {
            if let Limits::Range(low, high) = machine.axes[joint].limits {
                let value = place.joints[joint];
                for (room, beyond) in [
                    (value - low, low - 0.1_f64.to_radians()),
                    (high - value, high + 0.1_f64.to_radians()),
                ] {
                    if nearest.is_none_or(|(least, ..)| room < least) {
                        nearest = Some((room, index, joint, beyond));
                    }
                }
            }
        }
    }
    let (_, index, joint, beyond) =
        nearest.ok_or_else(|| Failure::new("--plant limit: no rotary axis of this machine has limits"))?;
    places[index].joints[joint] = beyond;
    Ok(())
}

/// The axis that turns the part (or the whole head) with the wrong sign.
pub(super) fn turn_the_wrong_way(machine: &Machine, places: &mut [Place]) -> Result<(), Failure> {
    let &first = machine
        .rotary
        .first()
        .ok_or_else(|| Failure::new("--plant wrong-sign: this machine has no rotary axis"))?;
    for place in places {
        place.joints[first] = -place.joints[first];
    }
    Ok(())
}

fn rotary(machine: &Machine, place: &Place) -> [f64; 2] {
    let mut q = [0.0; 2];
    for (slot, &joint) in q.iter_mut().zip(&machine.rotary) {
        *slot = place.joints[joint];
    }
    q
}
