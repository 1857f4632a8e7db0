//! Pieces of a leg on which the rates of the joints change, from samples of these rates.
use crate::Piece;
use crate::pieces::{BEND, Course, push};
use trunnion_interp::MotionKind;
use trunnion_machine::{BlockPath, Joints, Leg, Machine};

/// Turn of the rotary axes per piece, rad.
const TURN: f64 = 0.035;
/// Below this turn, rad, the rates change evenly over a leg: their second derivatives differ by about this share, which [`BETWEEN`] covers.
const EVEN: f64 = 0.005;
/// Most pieces of one leg.
const MOST: f64 = 24.0;
/// What a rate between two samples may exceed them by.
const BETWEEN: f64 = 1.02;

/// A leg on which the rates of the joints change.
pub(crate) fn sampled(
    machine: &Machine,
    leg: &Leg,
    motion: u32,
    course: &mut Course,
    pieces: &mut Vec<Piece>,
) -> Option<()> {
    let path = BlockPath::new(machine, leg)?;
    let turn = leg.rotary_change[0].max(leg.rotary_change[1]);
    let swept = match &leg.motion.kind {
        MotionKind::Arc(Some(arc)) => arc.sweep.abs() * 0.25,
        _ => 0.0,
    };
    let count = (turn / TURN).max(swept / TURN).ceil().clamp(1.0, MOST);
    let length = course.length;
    let at = |t: f64| path.rates(t).map(|rate| rate / length);
    let mut before = at(0.0);
    course.tangents[0] = before;
    let even = turn.max(swept * 4.0) < EVEN;
    for index in 0..count as u32 {
        let from = f64::from(index) / count;
        let after = at(from + 1.0 / count);
        let middle = if even {
            std::array::from_fn(|joint| 0.5 * (before[joint] + after[joint]))
        } else {
            at(from + 0.5 / count)
        };
        let (mut rates, mut bends): (Joints, Joints) = ([0.0; _], [0.0; _]);
        let samples = before.iter().zip(&middle).zip(&after);
        for ((rate, bend), ((a, m), b)) in rates.iter_mut().zip(&mut bends).zip(samples) {
            let change = (m - a).abs().max((b - m).abs());
            *rate = a.abs().max(m.abs()).max(b.abs()) + (BETWEEN - 1.0) * change;
            *bend = if change > 1e-9 * *rate {
                BETWEEN * change * 2.0 * count / length
            } else {
                0.0
            };
        }
        push(machine, course, motion, (length / count, &rates, &bends, BEND), pieces)?;
        before = after;
    }
    course.tangents[1] = before;
    Some(())
}
