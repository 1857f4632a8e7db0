//! The contour as the blocks of a subprogram describe it: only their motion is used.
use super::problems;
use super::segment::{NEAR, Point, Round, Segment, cross, distance};
use crate::{Block, DistanceMode, Error, Problem, State};
use trunnion_geometry::math;
use trunnion_syntax::TextRange;

/// The treatment of the corner after a piece.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Corner {
    Sharp,
    /// A: rounded with this radius.
    Round(f64),
    /// C: cut off where the radius would begin and end.
    Chamfer(f64),
}

/// A contour that is being built.
#[derive(Clone, Debug)]
pub(crate) struct Contour {
    at: Point,
    pieces: Vec<(Segment, Corner)>,
}

impl Contour {
    /// Begins at Z, X.
    pub(super) fn new(at: Point) -> Self {
        Self { at, pieces: Vec::new() }
    }
    /// Takes a block in. `motion`: ten times the code that applies to it.
    pub(super) fn add(&mut self, state: &State, block: &Block, motion: i16) -> Result<(), Error> {
        if !matches!(motion, 0 | 10 | 20 | 30) || !describes(block) {
            return match motion {
                50..=53 | 60..=63 if describes(block) => Err(Error::new(&problems::CONTOUR, block.range)),
                _ => Ok(()),
            };
        }
        if block.g[0] >= 0 && block.g[0] != 40 {
            return Err(Error::new(&problems::CONTOUR, block.g_range(0)));
        }
        let to = self.end(state, block)?;
        let round = match motion {
            20 | 30 => Some(self.round(block, to, motion == 30)?),
            _ => None,
        };
        let corner = match (block.word(b'A'), block.word(b'C')) {
            (None, None) => Corner::Sharp,
            (Some(radius), None) => Corner::Round(radius.abs()),
            (None, Some(size)) => Corner::Chamfer(size.abs()),
            (Some(_), Some(_)) => return Err(Error::new(&problems::BOTH_CORNERS, block.range_of(b'C'))),
        };
        let piece = Segment {
            from: self.at,
            to,
            round,
        };
        self.at = to;
        // too short pieces are left out; the first one is the path to the contour
        let short = distance(piece.from, to) < NEAR;
        if !short || self.pieces.is_empty() {
            self.pieces.push((piece, corner));
        }
        Ok(())
    }
    /// The end of a block.
    fn end(&self, state: &State, block: &Block) -> Result<Point, Error> {
        let radius = if state.lathe_diameter { 0.5 } else { 1.0 };
        let incremental = state.distance == DistanceMode::Incremental;
        let mut to = self.at;
        let axes = [
            (b'Z', b'W', [&problems::BOTH_Z, &problems::STEPS_W], 1.0),
            (b'X', b'U', [&problems::BOTH_X, &problems::STEPS_U], radius),
        ];
        for (place, (letter, step, [both, steps], scale)) in axes.into_iter().enumerate().rev() {
            match (block.word(letter), block.word(step)) {
                (_, Some(_)) if incremental => return Err(Error::new(steps, block.range_of(step))),
                (Some(_), Some(_)) => return Err(Error::new(both, block.range_of(step))),
                (Some(value), None) if incremental => to[place] += value * scale,
                (Some(value), None) => to[place] = value * scale,
                (None, Some(value)) => to[place] += value * scale,
                (None, None) => {}
            }
        }
        Ok(to)
    }
    /// Centre and sense of an arc: I and K are relative to its start whatever G90.1 says.
    fn round(&self, block: &Block, to: Point, counter: bool) -> Result<Round, Error> {
        let centre_given = block.has(b'I') || block.has(b'K');
        let centre = match block.word(b'R') {
            Some(_) if centre_given => return Err(Error::new(&problems::BOTH_CENTRES, block.range_of(b'R'))),
            Some(radius) => by_radius(self.at, to, radius, counter),
            None if centre_given => [
                self.at[0] + block.word(b'K').unwrap_or(0.0),
                self.at[1] + block.word(b'I').unwrap_or(0.0),
            ],
            None => return Err(Error::new(&problems::NO_CENTRE, block.range)),
        };
        Ok(Round {
            centre,
            positive: counter,
        })
    }
    /// Whether a corner after its first piece is rounded or cut off.
    pub(super) fn has_corners(&self) -> bool {
        self.pieces.iter().any(|(_, corner)| *corner != Corner::Sharp)
    }
    /// Its pieces; the first is the path to the contour. `travels`: coordinates along which the cycle may cut, 0 is Z, 1 is X.
    pub(super) fn finish(self, range: TextRange, travels: &[usize]) -> Result<Vec<Segment>, Error> {
        let unknown = self.pieces.iter().any(|(piece, _)| {
            let centre = piece.round.map_or([0.0; 2], |round| round.centre);
            let numbers = [piece.from, piece.to];
            numbers.iter().flatten().any(|value| !value.is_finite()) || centre.iter().any(|value| value.is_infinite())
        });
        if unknown {
            return Err(Error::new(&problems::UNKNOWN, range));
        }
        // the control crashes here
        if let [(_, corner)] = &self.pieces[..]
            && *corner != Corner::Sharp
        {
            return Err(Error::new(&problems::CORNER_ALONE, range));
        }
        let nowhere = |(piece, _): &(Segment, Corner)| {
            piece
                .round
                .is_some_and(|round| round.centre.iter().any(|value| value.is_nan()))
        };
        if self.pieces.iter().any(nowhere) {
            return Err(Error::new(&problems::MONOTONIC, range));
        }
        let mut done: Vec<Segment> = Vec::with_capacity(self.pieces.len());
        let mut before = Corner::Sharp;
        // pieces after a rounding, and how much of them it takes
        let mut rounded = Vec::new();
        for (piece, corner) in self.pieces {
            let mut piece = piece;
            if let Some(last) = done.pop() {
                match fillet(&last, &piece, before) {
                    Ok(Some((start, middle, end))) => {
                        if travels.iter().any(|&place| is_fine(&middle, place)) {
                            return Err(Error::new(&problems::FINE, range));
                        }
                        // next to arcs the control was seen to take some for a step back that are none
                        if last.is_arc() || piece.is_arc() {
                            return Err(Error::new(&problems::DOUBTFUL, range));
                        }
                        if middle.is_arc() {
                            rounded.push((done.len() + 2, distance(piece.from, end)));
                        }
                        done.push(last.with_ends(last.from, start));
                        done.push(middle);
                        piece = piece.with_ends(end, piece.to);
                    }
                    Ok(None) => done.push(last),
                    Err(problem) => return Err(Error::new(problem, range)),
                }
            }
            done.push(piece);
            before = corner;
        }
        let doubtful = rounded.iter().any(|&(at, taken)| {
            done.get(at)
                .is_some_and(|piece| leaves_little_across(piece, taken, travels))
        });
        if doubtful {
            return Err(Error::new(&problems::DOUBTFUL, range));
        }
        // either coordinate may be the travel: which one the control takes depends on arcs that go there and back
        let back = |piece: &Segment| travels.iter().any(|&place| piece.turns_back(place));
        if travels.len() > 1 && done.iter().any(back) {
            return Err(Error::new(&problems::ARC, range));
        }
        Ok(done)
    }
}

/// Whether a block has coordinates.
fn describes(block: &Block) -> bool {
    block.g[1] >= 0 || b"XZUWIKR".iter().any(|&letter| block.has(letter))
}

/// The centre of the short arc of a radius; NaN where the radius is too small.
fn by_radius(from: Point, to: Point, radius: f64, counter: bool) -> Point {
    let way = [to[0] - from[0], to[1] - from[1]];
    let chord = math::hypot(way[0], way[1]);
    let height = (radius * radius - chord * chord / 4.0).sqrt() / chord;
    let side = if counter { height } else { -height };
    [
        f64::midpoint(from[0], to[0]) - side * way[1],
        f64::midpoint(from[1], to[1]) + side * way[0],
    ]
}

/// The control leaves out corners that go less than this along the cut, or takes them as steps back: observed from `rs274` by bisection,
/// program units (0.01 mm under G21, 0.01 inch under G20).
const FINE: f64 = 0.01;

/// Whether the piece of a corner goes so little along a coordinate that the control does not take it as it is.
pub(super) fn is_fine(piece: &Segment, place: usize) -> bool {
    (piece.to[place] - piece.from[place]).abs() < FINE * (1.0 + 1e-6)
}

/// Whether a line across the cut keeps no more than the rounding before it takes: the control was seen to take it for a step back.
fn leaves_little_across(piece: &Segment, taken: f64, travels: &[usize]) -> bool {
    let across = |&place: &usize| (piece.to[place] - piece.from[place]).abs() < 1e-9;
    !piece.is_arc() && travels.iter().any(across) && distance(piece.from, piece.to) < taken * (1.0 + 1e-6) + 1e-6
}

type Fillet = (Point, Segment, Point);

/// The piece in a corner, and where its neighbours end and begin.
fn fillet(one: &Segment, two: &Segment, corner: Corner) -> Result<Option<Fillet>, &'static Problem> {
    let (Corner::Round(size) | Corner::Chamfer(size)) = corner else {
        return Ok(None);
    };
    let turn = cross(one.direction(one.to), two.direction(two.from));
    if turn.abs() < 1e-6 || size.is_nan() || size < NEAR {
        return Err(&problems::CORNER);
    }
    let side = if turn > 0.0 { size } else { -size };
    let (Some(a), Some(b)) = (one.shifted(side), two.shifted(side)) else {
        return Err(&problems::CORNER);
    };
    let near = |p: &Point| distance(*p, one.to);
    let centre = a
        .meets(&b)
        .into_iter()
        .flatten()
        .min_by(|p, q| near(p).total_cmp(&near(q)));
    let Some(centre) = centre else {
        return Err(&problems::CORNER);
    };
    let foot = |piece: &Segment| {
        let way = match piece.round {
            None => piece.direction(piece.from),
            Some(round) => {
                let radius = distance(centre, round.centre);
                let scale = piece.radius() / radius;
                return [
                    round.centre[0] + (centre[0] - round.centre[0]) * scale,
                    round.centre[1] + (centre[1] - round.centre[1]) * scale,
                ];
            }
        };
        [centre[0] + side * way[1], centre[1] - side * way[0]]
    };
    let (start, end) = (foot(one), foot(two));
    let room = one.share(start) > 1e-6 && one.share(start) < 1.0 && two.share(end) > 0.0 && two.share(end) < 1.0 - 1e-6;
    if !room {
        return Err(&problems::CORNER);
    }
    let round = matches!(corner, Corner::Round(_)).then_some(Round {
        centre,
        positive: turn > 0.0,
    });
    Ok(Some((
        start,
        Segment {
            from: start,
            to: end,
            round,
        },
        end,
    )))
}
