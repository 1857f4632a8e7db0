//! The contour with an allowance: every piece moved sideways, outer corners rounded, inner ones cut where the pieces meet.
use super::contour::is_fine;
use super::problems;
use super::segment::{NEAR, Point, Round, Segment, cross, distance};
use crate::Problem;

/// How far beside the contour.
#[derive(Clone, Copy, Debug)]
pub(super) struct Allowance {
    /// To its left; negative: to its right.
    pub(super) left: f64,
    /// The coordinate along which the cycle cuts: 0 is Z, 1 is X.
    pub(super) place: usize,
    /// The contour has rounded or chamfered corners.
    pub(super) corners: bool,
}

/// The contour with an allowance.
pub(super) fn offset(contour: &[Segment], allowance: Allowance) -> Result<Vec<Segment>, &'static Problem> {
    let distance_left = allowance.left;
    if distance_left == 0.0 {
        return Ok(contour.to_vec());
    }
    let mut done: Vec<Segment> = Vec::with_capacity(contour.len());
    let mut dropped = false;
    for (index, piece) in contour.iter().enumerate() {
        let Some(moved) = piece.shifted(distance_left) else {
            dropped = true;
            continue;
        };
        if let Some(before) = index.checked_sub(1).map(|at| &contour[at])
            && !dropped
            && !done.is_empty()
        {
            corner(&mut done, before, piece, moved, allowance, &mut dropped)?;
        } else if done.is_empty() {
            if dropped {
                return Err(&problems::SWALLOWED);
            }
            done.push(moved);
        } else {
            // an outer corner behind a piece that vanishes: the control was seen to cut the rounding there, and to leave it out
            let before = index.checked_sub(1).map(|at| &contour[at]);
            if before.is_some_and(|before| is_outer(turn_between(before, piece), distance_left)) {
                return Err(&problems::SWALLOWED);
            }
            dropped = !inner(&mut done, moved)?;
        }
    }
    let short = done.iter().any(|piece| distance(piece.from, piece.to) < 2.0 * NEAR);
    if dropped || short {
        return Err(&problems::SWALLOWED);
    }
    Ok(done)
}

/// Sine of the angle by which the way turns between two pieces; positive: to the left.
fn turn_between(before: &Segment, piece: &Segment) -> f64 {
    cross(before.direction(before.to), piece.direction(piece.from))
}

/// Whether a corner turns away from the side of the offset.
fn is_outer(turn: f64, distance_left: f64) -> bool {
    turn.abs() >= 1e-6 && (turn > 0.0) != (distance_left > 0.0)
}

/// Joins a piece to the one before it.
fn corner(
    done: &mut Vec<Segment>,
    before: &Segment,
    piece: &Segment,
    moved: Segment,
    allowance: Allowance,
    dropped: &mut bool,
) -> Result<(), &'static Problem> {
    let distance_left = allowance.left;
    let turn = turn_between(before, piece);
    if turn.abs() < 1e-6 {
        if before.round.is_none() && piece.round.is_none() {
            let way = piece.direction(piece.from);
            let along_an_axis = way[0] == 0.0 || way[1] == 0.0;
            // slanted lines are parallel or not by the control's rounding
            return Err(if along_an_axis {
                &problems::PARALLEL
            } else {
                &problems::SHALLOW
            });
        }
        done.push(moved);
        return Ok(());
    }
    if !is_outer(turn, distance_left) {
        *dropped = !inner(done, moved)?;
        return Ok(());
    }
    // with A or C in the contour the control was seen to leave out arcs of any length
    if allowance.corners {
        return Err(&problems::BESIDE_CORNER);
    }
    let Some(last) = done.last().copied() else {
        return Err(&problems::SWALLOWED);
    };
    let around = Segment {
        from: last.to,
        to: moved.from,
        round: Some(Round {
            centre: piece.from,
            positive: distance_left < 0.0,
        }),
    };
    // the control leaves out short arcs
    if is_fine(&around, allowance.place) {
        return Err(&problems::SHALLOW);
    }
    done.push(around);
    done.push(moved);
    Ok(())
}

/// Cuts off the last pieces where the next one meets them. `false`: the next piece vanishes.
fn inner(done: &mut Vec<Segment>, moved: Segment) -> Result<bool, &'static Problem> {
    while let Some(last) = done.last().copied() {
        // of the two points at which they may meet the control was seen to take the far one
        if last.is_arc() && moved.is_arc() {
            return Err(&problems::ARC_CORNER);
        }
        match meeting(&last, &moved) {
            Meeting::At(point) => {
                if let Some(end) = done.last_mut() {
                    end.to = point;
                }
                done.push(moved.with_ends(point, moved.to));
                return Ok(true);
            }
            Meeting::BeforeLast => {
                done.pop();
                // the control was seen to keep an arc whole, and to run the piece behind it backward
                if done.last().is_some_and(Segment::is_arc) {
                    return Err(&problems::SWALLOWED);
                }
            }
            Meeting::BehindNext => return Ok(false),
            Meeting::Unclear => return Err(&problems::SWALLOWED),
        }
    }
    Err(&problems::SWALLOWED)
}

enum Meeting {
    /// In both pieces, or beyond the end of the first and the start of the second.
    At(Point),
    /// The first piece is cut off whole.
    BeforeLast,
    /// The second piece is cut off whole.
    BehindNext,
    Unclear,
}

fn meeting(last: &Segment, next: &Segment) -> Meeting {
    let mut best: Option<(f64, Point, f64, f64)> = None;
    for point in last.meets(next).into_iter().flatten() {
        let (a, b) = (last.share(point), next.share(point));
        let gap = distance(point, last.to).min(distance(point, next.from));
        let inside = a > 0.0 && b < 1.0 && a <= 1.0 + 1e-6 && b >= -1e-6;
        let rank = if inside { gap } else { 1e9 + gap };
        if best.is_none_or(|(other, ..)| rank < other) {
            best = Some((rank, point, a, b));
        }
    }
    match best {
        None => Meeting::Unclear,
        Some((_, _, a, b)) if a <= 0.0 && b >= 1.0 => Meeting::Unclear,
        Some((_, _, a, _)) if a <= 0.0 => Meeting::BeforeLast,
        Some((_, _, _, b)) if b >= 1.0 => Meeting::BehindNext,
        Some((_, point, ..)) => Meeting::At(point),
    }
}
