//! A chain divided: whole circles, and the fewest lines and arcs between them.
use crate::pieces::{Limits, Piece, Pieces, Points, axes};
use crate::whole_circle::whole_circles;
use std::collections::BTreeSet;
use trunnion_dialect::Plane;
use trunnion_geometry::Vec3;

/// Rounds before a chain is left as it is.
const MOST_ROUNDS: usize = 40;

/// Divides the chain through `points` into the fewest pieces; whole circles are pieces of their own. Doing the same to the result changes nothing: lines that were put together, and
/// would be put together with their neighbours again because the points inside are gone, stay apart.
pub(crate) fn divide(points: &[Vec3], limits: &Limits<'_>) -> Pieces {
    let mut all = Pieces {
        pieces: Vec::new(),
        unrounded: 0,
    };
    let mut add = |range: core::ops::Range<usize>, found: Pieces| {
        all.unrounded += found.unrounded;
        all.pieces.extend(found.pieces.into_iter().map(|piece| Piece {
            from: piece.from + range.start,
            to: piece.to + range.start,
            ..piece
        }));
    };
    let mut begin = 0;
    for circle in whole_circles(points, limits) {
        if circle.from > begin {
            add(begin..circle.from, open(&points[begin..=circle.from], limits));
        }
        begin = circle.to;
        let pieces = vec![circle];
        add(0..0, Pieces { pieces, unrounded: 1 });
    }
    if begin + 1 < points.len() {
        add(begin..points.len(), open(&points[begin..], limits));
    }
    all
}

/// The same without whole circles.
fn open(points: &[Vec3], limits: &Limits<'_>) -> Pieces {
    let chain = Points::new(points, limits);
    let mut refused = BTreeSet::new();
    let mut unrounded = None;
    for _ in 0..MOST_ROUNDS {
        let pieces = chain.fewest(&mut refused, &mut unrounded);
        let unstable = again(points, limits, &pieces);
        if unstable.is_empty() {
            let unrounded = unrounded.unwrap_or(pieces.len());
            let fewer = beside(&chain, &pieces, unrounded);
            if fewer.pieces.len() < pieces.len() && again(points, limits, &fewer.pieces).is_empty() {
                return fewer;
            }
            return Pieces { pieces, unrounded };
        }
        refused.extend(unstable);
    }
    let pieces: Vec<Piece> = (1..points.len())
        .map(|to| Piece {
            from: to - 1,
            to,
            arc: None,
            beside: None,
        })
        .collect();
    let unrounded = pieces.len();
    Pieces { pieces, unrounded }
}

/// The pieces with fewer in their place wherever several in one plane may meet beside the points.
fn beside(chain: &Points<'_>, pieces: &[Piece], unrounded: usize) -> Pieces {
    let mut all = Pieces {
        pieces: Vec::with_capacity(pieces.len()),
        unrounded,
    };
    let level = |piece: &Piece| {
        let until = |plane: &Plane| chain.level_until[axes(*plane)[2]][piece.from] >= piece.to;
        chain.limits.planes.iter().position(until)
    };
    for run in pieces.chunk_by(|a, b| level(a).is_some() && level(a) == level(b)) {
        let (from, to) = (run[0].from, run[run.len() - 1].to);
        let points = &chain.all[from..=to];
        match Points::new(points, chain.limits).fewer(run.len() - 1) {
            Some((fewer, before)) => {
                all.unrounded = all.unrounded + before - run.len().min(all.unrounded + before);
                all.pieces.extend(fewer.into_iter().map(|piece| Piece {
                    from: piece.from + from,
                    to: piece.to + from,
                    ..piece
                }));
            }
            None => all.pieces.extend_from_slice(run),
        }
    }
    all
}

/// The lines that were put together beside others with which they would be put together again.
fn again(points: &[Vec3], limits: &Limits<'_>, pieces: &[Piece]) -> Vec<(usize, usize)> {
    let mut found = Vec::new();
    for lines in pieces.chunk_by(|a, b| a.arc.is_none() && b.arc.is_none()) {
        let joined = || {
            lines
                .iter()
                .filter(|piece| piece.arc.is_none() && piece.to > piece.from + 1)
        };
        if lines.len() < 2 || joined().next().is_none() {
            continue;
        }
        let joints: Vec<Vec3> = core::iter::once(points[lines[0].from])
            .chain(lines.iter().map(|piece| points[piece.to]))
            .collect();
        let next = Points::new(&joints, limits).fewest(&mut BTreeSet::new(), &mut None);
        if next.len() < lines.len() {
            found.extend(joined().map(|piece| (piece.from, piece.to)));
        }
    }
    found
}
