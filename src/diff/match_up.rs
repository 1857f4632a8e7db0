//! Which events of two stretches that differ belong together: the pairing of least cost, in order (Needleman and Wunsch, "A general method
//! applicable to the search for similarities in the amino acid sequence of two proteins", 1970).
use crate::event::{Body, Event};
use crate::point::Point;

/// Larger tables are not filled: the events are then taken in order.
const MOST_CELLS: usize = 4_000_000;

/// The cost of an event without a partner. A pair costs less than two of them, so that a motion to another position is one change.
const ALONE: f32 = 1.0;

/// A distance at which half the cost of a pair is reached: mm and degrees, added up.
const HALF: f64 = 1.0;

/// The pairs, in order; `None` on one side: the event is only in the other program.
pub(crate) fn match_up(a: &[Event], b: &[Event]) -> Vec<(Option<usize>, Option<usize>)> {
    if a.is_empty() || b.is_empty() || a.len().saturating_mul(b.len()) > MOST_CELLS {
        let longest = a.len().max(b.len());
        return (0..longest)
            .map(|at| (Some(at).filter(|at| *at < a.len()), Some(at).filter(|at| *at < b.len())))
            .collect();
    }
    let width = b.len() + 1;
    // the lowest cost of everything after each pair of places, filled from the end
    let mut least = vec![0.0_f32; (a.len() + 1) * width];
    for x in (0..=a.len()).rev() {
        for y in (0..=b.len()).rev() {
            if (x, y) != (a.len(), b.len()) {
                let best = steps(a, b, (x, y), &least, width).map(|(cost, ..)| cost);
                least[x * width + y] = best.into_iter().fold(f32::INFINITY, f32::min);
            }
        }
    }
    let (mut x, mut y) = (0, 0);
    let mut out = Vec::new();
    while (x, y) != (a.len(), b.len()) {
        let all = steps(a, b, (x, y), &least, width);
        let (_, left, right) = all
            .into_iter()
            .min_by(|one, other| one.0.total_cmp(&other.0))
            .expect("three steps");
        out.push((Some(x).filter(|_| left), Some(y).filter(|_| right)));
        x += usize::from(left);
        y += usize::from(right);
    }
    out
}

/// The three steps from a place: both events, the first one alone, the second one alone; cost with all that follows, and which events.
fn steps(a: &[Event], b: &[Event], (x, y): (usize, usize), least: &[f32], width: usize) -> [(f32, bool, bool); 3] {
    let after = |left: bool, right: bool| {
        let (x, y) = (x + usize::from(left), y + usize::from(right));
        if x > a.len() || y > b.len() {
            f32::INFINITY
        } else {
            least[x * width + y]
        }
    };
    let both = match (a.get(x), b.get(y)) {
        (Some(a), Some(b)) => cost(&a.body, &b.body) + after(true, true),
        _ => f32::INFINITY,
    };
    [
        (both, true, true),
        (ALONE + after(true, false), true, false),
        (ALONE + after(false, true), false, true),
    ]
}

/// How different two events are: 0 to 2 for those that may be one that was changed, else infinite.
fn cost(a: &Body, b: &Body) -> f32 {
    match (a, b) {
        (Body::Statement(a), Body::Statement(b)) if a == b => 0.0,
        (Body::Motion(a, _), Body::Motion(b, _)) => {
            let distance = distance(a, b);
            let share = (distance / (distance + HALF)) as f32;
            let unlike = if a.way.name() == b.way.name() { 0.0 } else { 0.9 };
            (unlike + 1.9 * share).min(1.99)
        }
        _ => f32::INFINITY,
    }
}

/// How far apart two ends are: mm and degrees of their axes, added up; each axis that only one of them knows counts 1.
fn distance(a: &Point, b: &Point) -> f64 {
    let apart: f64 = a.moved(b).iter().map(|(_, from, to)| (from - to).abs()).sum();
    apart + f64::from((a.known ^ b.known).count_ones())
}
