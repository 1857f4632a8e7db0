//! The contour with an allowance: every piece moved sideways, outer corners rounded, inner ones cut where the pieces meet.
use super::contour::is_fine;
use super::problems;
use super::segment::{NEAR, Point, Round, Segment, cross, distance};
use crate::Problem;

/// Distance from the contour.
#[derive(Clone, Copy, Debug)]
pub(super) struct Allowance {
    /// To its left; negative: to its right.
    pub(super) left: f64,
    /// The coordinate along which the cycle cuts: 0 is Z, 1 is X.
    pub(super) place: usize,
    /// Some of its ends come from a corner that is rounded or cut off.
    pub(super) corners: bool,
}

/// Most steps: small pieces grow, or vanish soon.
const STEPS: usize = 10_000;

/// The contour with an allowance. The control moves it in steps of at most half its smallest piece: which corners are rounded, and by how
/// much, decides between them (observed from `rs274`).
pub(super) fn offset(contour: &[Segment], allowance: Allowance) -> Result<Vec<Segment>, &'static Problem> {
    let mut contour = contour.to_vec();
    let mut left = allowance.left.abs();
    let mut dropped = false;
    // an arc with corners at its ends that is finer than the allowance: which steps the control takes is not known
    let joints = |at: usize| {
        contour
            .get(at.wrapping_sub(1)..at.saturating_add(2))
            .unwrap_or(&contour)
    };
    let cornered = |at: usize| {
        joints(at)
            .windows(2)
            .any(|pair| turn_between(&pair[0], &pair[1]).abs() > 1e-6)
    };
    let fine = |at: usize| contour[at].is_arc() && contour[at].size() < 2.0 * left && cornered(at);
    if (0..contour.len()).any(fine) {
        return Err(&problems::SWALLOWED);
    }
    for _ in 0..STEPS {
        if left <= 0.0 {
            break;
        }
        let smallest = contour.iter().map(Segment::size).fold(f64::INFINITY, f64::min);
        let step = left.min(smallest / 2.0);
        left -= step;
        let step = step.copysign(allowance.left);
        (contour, dropped) = moved(
            &contour,
            Allowance {
                left: step,
                ..allowance
            },
        )?;
    }
    // of arcs that are about to vanish the control refuses some
    let tiny = |piece: &Segment| piece.is_arc() && piece.size() < 2.0 * NEAR;
    if left > 0.0 || dropped || (allowance.left != 0.0 && contour.iter().any(tiny)) {
        return Err(&problems::SWALLOWED);
    }
    Ok(contour)
}

/// The contour moved sideways in one step, corner by corner. A piece that is too small once its start is where it belongs is left out.
fn moved(contour: &[Segment], allowance: Allowance) -> Result<(Vec<Segment>, bool), &'static Problem> {
    let mut done: Vec<Segment> = Vec::with_capacity(contour.len() + 4);
    let (mut gone, mut dropped) = (false, false);
    for piece in contour {
        gone = match piece.shifted(allowance.left) {
            Some(moved) => {
                corner(&mut done, moved, piece.from, allowance)?;
                let left_out = done.len() > 1 && done.last().is_some_and(|piece| is_tiny(piece, allowance.place));
                // of a line the control was seen to keep something of the order of its length
                if left_out && done.pop().is_some_and(|piece| !piece.is_arc()) {
                    return Err(&problems::SWALLOWED);
                }
                left_out
            }
            None if done.is_empty() => return Err(&problems::SWALLOWED),
            None => true,
        };
        dropped |= gone;
    }
    if gone {
        Err(&problems::SWALLOWED)
    } else {
        Ok((done, dropped))
    }
}

/// Whether the control leaves a piece out: by its length, arcs by how far they extend along the cut (observed by bisection, arcs at slopes of
/// 7 to 83 degrees).
fn is_tiny(piece: &Segment, place: usize) -> bool {
    let way = if piece.is_arc() {
        (piece.to[place] - piece.from[place]).abs()
    } else {
        distance(piece.from, piece.to)
    };
    way < NEAR
}

/// Sine of the angle by which the path turns between two pieces; positive: to the left.
fn turn_between(before: &Segment, piece: &Segment) -> f64 {
    cross(before.direction(before.to), piece.direction(piece.from))
}

/// Whether a corner turns away from the side of the offset.
fn is_outer(turn: f64, distance_left: f64) -> bool {
    turn.abs() >= 1e-6 && (turn > 0.0) != (distance_left > 0.0)
}

/// Joins a piece to the one before it; `at`: where its corner was before this step.
fn corner(done: &mut Vec<Segment>, moved: Segment, at: Point, allowance: Allowance) -> Result<(), &'static Problem> {
    let Some(last) = done.last().copied() else {
        done.push(moved);
        return Ok(());
    };
    let distance_left = allowance.left;
    let turn = turn_between(&last, &moved);
    if turn.abs() < 1e-6 && !last.is_arc() && !moved.is_arc() {
        let way = moved.direction(moved.from);
        let along_an_axis = !allowance.corners && (way[0] == 0.0 || way[1] == 0.0);
        // slanted lines, and lines after a corner, are parallel or not by the control's rounding
        return Err(if along_an_axis {
            &problems::PARALLEL
        } else {
            &problems::SHALLOW
        });
    }
    if turn.abs() < 1e-6 {
        let middle = [0, 1].map(|place| f64::midpoint(last.to[place], moved.from[place]));
        join(done, moved, middle);
        return Ok(());
    }
    let around = Segment {
        from: last.to,
        to: moved.from,
        round: Some(Round {
            centre: at,
            positive: distance_left < 0.0,
        }),
    };
    // the control leaves out short arcs
    if is_outer(turn, distance_left) && !is_fine(&around, allowance.place) {
        done.push(around);
        done.push(moved);
        return Ok(());
    }
    // of the two points at which they may meet the control was seen to take the far one
    if last.is_arc() && moved.is_arc() {
        return Err(&problems::ARC_CORNER);
    }
    let point = meeting(&last, &moved).ok_or(&problems::SWALLOWED)?;
    join(done, moved, point);
    Ok(())
}

/// The last piece ends at a point, and the next one begins there.
fn join(done: &mut Vec<Segment>, moved: Segment, point: Point) {
    if let Some(last) = done.last_mut() {
        last.to = point;
    }
    done.push(moved.with_ends(point, moved.to));
}

/// Where two pieces meet: inside both of them, or beyond the end of the first and the start of the second; `None` where that is not clear.
fn meeting(last: &Segment, next: &Segment) -> Option<Point> {
    let mut best: Option<(f64, Point, bool)> = None;
    for point in last.meets(next).into_iter().flatten() {
        let (a, b) = (last.share(point), next.share(point));
        let gap = distance(point, last.to).min(distance(point, next.from));
        let inside = a > 0.0 && b < 1.0 && a <= 1.0 + 1e-6 && b >= -1e-6;
        let rank = if inside { gap } else { 1e9 + gap };
        if best.is_none_or(|(other, ..)| rank < other) {
            best = Some((rank, point, a > 0.0 && b < 1.0));
        }
    }
    best.and_then(|(_, point, clear)| clear.then_some(point))
}
