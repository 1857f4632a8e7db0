//! A chain divided: whole circles, and the fewest lines and arcs between them.
use crate::pieces::{Limits, Piece, Pieces, Points};
use crate::whole_circle::whole_circles;
use std::collections::BTreeSet;
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
            if let Some((fewer, unrounded)) = chain.fewer(pieces.len() - 1)
                && again(points, limits, &fewer).is_empty()
            {
                return Pieces {
                    pieces: fewer,
                    unrounded,
                };
            }
            let unrounded = unrounded.unwrap_or(pieces.len());
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
