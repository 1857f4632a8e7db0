//! G71 and G72: cuts along the travel at one level after the other, down to the contour with its allowance.
//!
//! All is described in one frame: the first coordinate falls along the cut, the second is the level, and the contour ends no deeper
//! than it begins. [`Frame`] converts in both directions.
use super::problems;
use super::segment::{Point, Round, Segment, distance};
use crate::Problem;

/// How the coordinates of the program (Z, X) become travel and level.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    /// X is the travel.
    pub(super) swapped: bool,
    /// Signs of travel and level.
    pub(super) signs: Point,
}

impl Frame {
    pub(super) fn to(self, point: Point) -> Point {
        let [z, x] = point;
        let [travel, level] = if self.swapped { [x, z] } else { [z, x] };
        [travel * self.signs[0], level * self.signs[1]]
    }
    pub(super) fn back(self, point: Point) -> Point {
        let [travel, level] = [point[0] * self.signs[0], point[1] * self.signs[1]];
        if self.swapped { [level, travel] } else { [travel, level] }
    }
    /// Whether arcs change their sense.
    fn mirrors(self) -> bool {
        self.swapped != (self.signs[0] * self.signs[1] < 0.0)
    }
    fn piece(self, piece: &Segment, point: impl Fn(Self, Point) -> Point) -> Segment {
        Segment {
            from: point(self, piece.from),
            to: point(self, piece.to),
            round: piece.round.map(|round| Round {
                centre: point(self, round.centre),
                positive: round.positive != self.mirrors(),
            }),
        }
    }
    pub(super) fn piece_to(self, piece: &Segment) -> Segment {
        self.piece(piece, Self::to)
    }
    pub(super) fn piece_back(self, piece: &Segment) -> Segment {
        self.piece(piece, Self::back)
    }
}

/// A move that a cycle makes.
#[derive(Clone, Copy, Debug)]
pub(super) enum Move {
    Rapid(Point),
    Cut(Segment),
}

/// Which of the three forms of the cycle it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pockets {
    /// G71, G72: cut like everything else.
    Cut,
    /// .1: passed over.
    Skip,
    /// .2: only the pockets.
    Only,
}

/// The values of the words.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rough {
    pub(super) pockets: Pockets,
    /// Depth of a cut.
    pub(super) depth: f64,
    /// Retract distance after a cut.
    pub(super) retract: f64,
    /// Most moves.
    pub(super) limit: u64,
}

/// Walks along a path: the approach to the contour, the contour, the retract.
struct Walk<'a> {
    rough: Rough,
    path: &'a [Segment],
    told: &'a mut dyn FnMut(Move) -> Result<(), crate::Error>,
    at: Point,
    count: u64,
}

/// Why a walk ended early.
pub(super) enum Stopped {
    Problem(&'static Problem),
    Refused(crate::Error),
}

impl From<&'static Problem> for Stopped {
    fn from(problem: &'static Problem) -> Self {
        Self::Problem(problem)
    }
}

/// Emits all moves of the cycle after the one to `start`. `contour` has its allowance.
pub(super) fn run(
    rough: Rough,
    start: Point,
    contour: &[Segment],
    told: &mut dyn FnMut(Move) -> Result<(), crate::Error>,
) -> Result<(), Stopped> {
    let (Some(first), Some(last)) = (contour.first(), contour.last()) else {
        return Ok(());
    };
    if contour.iter().any(Segment::is_unclear) {
        return Err((&problems::ARC).into());
    }
    // with several arcs the control was seen to leave and enter pockets where this does not
    if rough.pockets == Pockets::Only && contour.iter().filter(|piece| piece.is_arc()).count() > 1 {
        return Err((&problems::POCKET_ARCS).into());
    }
    let mut path = vec![Segment::line(start, first.from)];
    for piece in contour {
        piece.split(&mut path);
    }
    if last.to[1] < start[1] {
        path.push(Segment::line(last.to, [last.to[0], start[1]]));
    }
    let mut walk = Walk {
        rough,
        path: &path,
        told,
        at: start,
        count: 0,
    };
    walk.go(start)
}

/// A piece that an allowance made level up to rounding is level.
fn falls(piece: &Segment) -> bool {
    piece.to[1] < piece.from[1] - 1e-9
}

impl Walk<'_> {
    fn tell(&mut self, what: Move) -> Result<(), Stopped> {
        self.count += 1;
        if self.count > self.rough.limit {
            return Err((&problems::MANY).into());
        }
        self.at = match what {
            Move::Rapid(to) => to,
            Move::Cut(piece) => piece.to,
        };
        (self.told)(what).map_err(Stopped::Refused)
    }
    fn rapid(&mut self, to: Point) -> Result<(), Stopped> {
        self.tell(Move::Rapid(to))
    }
    fn feed(&mut self, to: Point) -> Result<(), Stopped> {
        let line = Segment::line(self.at, to);
        self.tell(Move::Cut(line))
    }
    /// Along a piece to a point of it; an empty arc is not emitted, an empty line is.
    fn along(&mut self, piece: &Segment, to: Point) -> Result<(), Stopped> {
        if piece.round.is_some() && distance(self.at, to) < 1e-9 {
            return Ok(());
        }
        self.tell(Move::Cut(piece.with_ends(self.at, to)))
    }
    fn go(&mut self, start: Point) -> Result<(), Stopped> {
        let path = self.path;
        let entry_falls = path.first().is_some_and(falls);
        // the first descent: the path to the contour and what goes down after it
        let descent = path.iter().take_while(|piece| falls(piece)).count();
        let anchor = start[1];
        let mut index = 0;
        while index < path.len() && (index < descent || self.rough.pockets == Pockets::Cut) {
            let piece = path[index];
            let rapid = index == 0 && entry_falls;
            if self.rough.pockets != Pockets::Only && falls(&piece) {
                self.descend(index, anchor, rapid)?;
            }
            if rapid {
                self.rapid(piece.to)?;
            } else {
                self.along(&piece, piece.to)?;
            }
            index += 1;
        }
        match self.rough.pockets {
            Pockets::Cut => Ok(()),
            Pockets::Skip => self.over_pockets(index),
            Pockets::Only => self.pockets_only(index),
        }
    }
    /// The cuts at the levels that a falling piece passes.
    fn descend(&mut self, index: usize, anchor: f64, rapid: bool) -> Result<(), Stopped> {
        let piece = self.path[index];
        let depth = self.rough.depth;
        let mut step = ((anchor - piece.from[1]) / depth - 1e-9).ceil().max(0.0);
        loop {
            let level = anchor - step * depth;
            if level <= piece.to[1] + 1e-9 {
                return Ok(());
            }
            let level = level.min(piece.from[1]);
            let begin = piece.at_level(level);
            if rapid {
                self.rapid(begin)?;
            } else {
                self.along(&piece, begin)?;
            }
            self.cut(index, level, rapid)?;
            step += 1.0;
        }
    }
    /// One cut from where the tool is to the next place where the path rises to the level, and back.
    fn cut(&mut self, index: usize, level: f64, rapid: bool) -> Result<(), Stopped> {
        let begin = self.at;
        let Some((_, end)) = self.touch(index + 1, level) else {
            return Err((&problems::ENDLESS).into());
        };
        let length = begin[0] - end[0];
        if length < -1e-9 {
            return Err((&problems::ENDLESS).into());
        }
        if length.abs() < 1e-9 {
            return Ok(());
        }
        self.feed([end[0], level])?;
        let half = length / 2.0;
        let retract = if self.rough.retract < 0.0 || self.rough.retract > half {
            half
        } else {
            self.rough.retract
        };
        self.rapid([end[0] + retract, level + retract])?;
        self.rapid([begin[0] - retract, level + retract])?;
        if rapid { self.rapid(begin) } else { self.feed(begin) }
    }
    /// The first piece from `index` on that reaches a level, and where.
    fn touch(&self, index: usize, level: f64) -> Option<(usize, Point)> {
        (index..self.path.len()).find_map(|at| {
            let piece = &self.path[at];
            (piece.to[1] >= level - 1e-9).then(|| {
                let inside = level.min(piece.to[1]);
                (
                    at,
                    if piece.from[1] >= inside {
                        piece.from
                    } else {
                        piece.at_level(inside)
                    },
                )
            })
        })
    }
    /// .1: every pocket is bridged; a bridge over nothing is emitted as well.
    fn over_pockets(&mut self, mut index: usize) -> Result<(), Stopped> {
        while index < self.path.len() {
            let level = self.at[1];
            if !falls(&self.path[index]) {
                let piece = self.path[index];
                let here = self.at;
                self.feed(here)?;
                self.along(&piece, piece.to)?;
                index += 1;
                continue;
            }
            let Some((next, point)) = self.touch(index + 1, level) else {
                return Ok(());
            };
            self.feed(point)?;
            let piece = self.path[next];
            self.along(&piece, piece.to)?;
            index = next + 1;
        }
        Ok(())
    }
    /// .2: the levels of a pocket start at its top.
    fn pockets_only(&mut self, mut index: usize) -> Result<(), Stopped> {
        let mut top: Option<f64> = None;
        while index < self.path.len() {
            let piece = self.path[index];
            if falls(&piece) {
                if top.is_none_or(|top| piece.from[1] >= top - 1e-9) {
                    top = Some(piece.from[1]);
                }
                self.descend(index, top.unwrap_or(piece.from[1]), false)?;
            }
            self.along(&piece, piece.to)?;
            index += 1;
        }
        Ok(())
    }
}
