//! Turning cycles: G70 (finish), G71 to G71.2 (rough along Z), G72 to G72.2 (rough along X). Q names the subprogram of the contour.
//!
//! The block of the cycle moves to its X and Z, then the subprogram is called and its motion becomes the contour; the cycle runs where
//! the subprogram returns. All of it was compared with `rs274`.
mod contour;
mod offset;
mod problems;
mod rough;
mod segment;

use super::Work;
use crate::{At, Block, DistanceMode, Engine, Error, Plane, Pose, Problem, Side, Sink, State, exec};
use contour::Contour;
use rough::{Frame, Move, Pockets, Rough, Stopped};
use segment::{NEAR, Point, Segment, cross};
use trunnion_syntax::TextRange;

/// A turning cycle from its block to the end of its contour.
#[derive(Clone, Debug)]
pub(crate) struct Turning {
    code: i16,
    subprogram: i64,
    /// Calls around the contour; `None`: it is still to be called.
    depth: Option<usize>,
    contour: Contour,
    start: Point,
    words: Words,
    at: At,
    /// A block of the contour was refused.
    spoiled: bool,
}

#[derive(Clone, Copy, Debug)]
struct Words {
    /// Allowance; for G70 that of the first pass, as far as E lets it.
    d: f64,
    e: f64,
    i: f64,
    p: f64,
    r: f64,
}

/// A code as the control writes it in its messages.
fn refuse(work: &Work<'_>, problem: &'static Problem, code: i16) -> Error {
    let name = format!("{}.{}", code / 10, code % 10);
    Error::with(problem, work.code_range(), problem.message.replace("{}", &name))
}

/// The block of the cycle: to its X and Z; the call of the subprogram is left to the flow.
pub(super) fn begin(work: &mut Work<'_>, code: i16) -> Result<(), Error> {
    let block = work.block;
    let Some(q) = block.word(b'Q') else {
        return Err(work.refuse(&problems::NO_Q));
    };
    if work.engine.state.plane != Plane::Xz {
        return Err(refuse(work, &problems::PLANE, code));
    }
    if work.engine.state.side != Side::Off && code != 700 {
        return Err(refuse(work, &problems::COMPENSATED, code));
    }
    if work.engine.state.side != Side::Off {
        lose(work.engine);
        return Err(refuse(work, &problems::FINISH_COMPENSATED, code));
    }
    // under G91 the control moves to X and Z as coordinates, and takes them as steps for the start of the contour
    let start = exec::end_of(&work.engine.state, block)?;
    let end = match work.engine.state.distance {
        DistanceMode::Absolute => start,
        DistanceMode::Incremental => {
            let mut state = work.engine.state.clone();
            state.distance = DistanceMode::Absolute;
            exec::end_of(&state, block)?
        }
    };
    work.engine.state.motion = 0;
    exec::traverse(work.engine, end, block, work.at, work.sink)?;
    if q.is_nan() {
        lose(work.engine);
        return Err(Error::new(&problems::UNKNOWN, block.range_of(b'Q')));
    }
    let whole = q.round();
    if (q - whole).abs() > 1e-4 {
        return Err(Error::new(&problems::NOT_INTEGER, block.range_of(b'Q')));
    }
    let word = |letter: u8, otherwise: f64| block.word(letter).unwrap_or(otherwise);
    let start = [start[2], start[0]];
    work.engine.turning = Some(Box::new(Turning {
        code,
        subprogram: whole as i64,
        depth: None,
        contour: Contour::new(start),
        start,
        words: Words {
            d: word(b'D', 0.0),
            e: word(b'E', 0.0),
            i: word(b'I', 1.0),
            p: word(b'P', 1.0),
            r: word(b'R', 0.5),
        },
        at: work.at,
        spoiled: false,
    }));
    Ok(())
}

/// The position of the tool in X and Z is unknown.
fn lose(engine: &mut Engine) {
    engine.state.current[0] = f64::NAN;
    engine.state.current[2] = f64::NAN;
}

/// Emits the moves of a cycle.
struct Out<'a> {
    engine: &'a mut Engine,
    block: Block,
    at: At,
    sink: &'a mut dyn Sink,
}

impl Out<'_> {
    fn pose(&self, point: Point) -> Pose {
        let mut pose = self.engine.state.current;
        (pose[2], pose[0]) = (point[0], point[1]);
        pose
    }
    fn rapid(&mut self, to: Point) -> Result<(), Error> {
        self.engine.flow.spend();
        let end = self.pose(to);
        exec::made_straight(self.engine, true, end, &self.block, self.at, self.sink)
    }
    fn cut(&mut self, piece: &Segment) -> Result<(), Error> {
        self.engine.flow.spend();
        let end = self.pose(piece.to);
        match piece.round {
            None => exec::made_straight(self.engine, false, end, &self.block, self.at, self.sink),
            Some(round) => {
                let turns = if round.positive { 1 } else { -1 };
                let arc = (end, round.centre, turns);
                exec::made_arc(self.engine, arc, &self.block, self.at, self.sink)
            }
        }
    }
}

impl Turning {
    /// The subprogram is still to be called.
    pub(crate) fn is_called(&self) -> bool {
        self.depth.is_none()
    }
    pub(crate) fn enter(&mut self, depth: usize) {
        self.depth = Some(depth);
    }
    /// Calls around that of the contour.
    pub(crate) fn depth(&self) -> usize {
        self.depth.unwrap_or(usize::MAX)
    }
    pub(crate) fn subprogram(&self) -> i64 {
        self.subprogram
    }
    /// Takes a block into the contour.
    pub(crate) fn add(&mut self, state: &State, block: &Block, motion: i16) -> Result<(), Error> {
        let added = self.contour.add(state, block, motion);
        self.spoiled |= added.is_err();
        added
    }
    /// Runs the cycle. `range`: the line where the subprogram returns.
    pub(crate) fn finish(self, engine: &mut Engine, range: TextRange, sink: &mut dyn Sink) -> Result<(), Error> {
        if self.spoiled {
            // already emitted
            lose(engine);
            return Ok(());
        }
        let refuse = |engine: &mut Engine, error: Error| {
            if error.problem.class == crate::Class::NotModelled {
                lose(engine);
            }
            error
        };
        let Words { d, e, i, p, r } = self.words;
        let known = [d, e, i, p, r].iter().chain(&self.start).all(|value| value.is_finite());
        let travels: &[usize] = match self.code / 10 {
            70 => &[0, 1],
            71 => &[0],
            _ => &[1],
        };
        let corners = self.contour.has_corners();
        let pieces = self.contour.finish(range, travels);
        let pieces = match pieces {
            Ok(pieces) if known || pieces.len() < 2 => pieces,
            Ok(_) => return Err(refuse(engine, Error::new(&problems::UNKNOWN, range))),
            Err(error) => return Err(refuse(engine, error)),
        };
        let [entry, contour @ ..] = &pieces[..] else {
            return Ok(());
        };
        if contour.is_empty() {
            return Ok(());
        }
        let entry_is_round = entry.round.is_some();
        let mut block = Block::new();
        block.range = range;
        let mut out = Out {
            engine,
            block,
            at: self.at,
            sink,
        };
        let result = if entry_is_round {
            Err(Stopped::Problem(&problems::CONTOUR))
        } else if self.code == 700 {
            finishing(&mut out, self.start, contour, corners, &self.words)
        } else {
            roughing(&mut out, self.code, self.start, contour, corners, &self.words)
        };
        result.map_err(|stopped| match stopped {
            Stopped::Problem(problem) => refuse(out.engine, Error::new(problem, range)),
            Stopped::Refused(error) => error,
        })
    }
}

/// Whether a contour never turns back along a coordinate: 0 is Z, 1 is X; its sense then. A very small step back was seen to be accepted by
/// the control.
fn monotonic(contour: &[Segment], place: usize) -> Result<Option<f64>, &'static Problem> {
    let exactly = goes_on(contour, place, [1e-9, 1e-6]);
    if exactly.is_none() && goes_on(contour, place, [2.0 * NEAR, 0.05]).is_some() {
        return Err(&problems::BACK);
    }
    Ok(exactly)
}

/// The same with a tolerance: a step back (program units), and the part of an arc's direction that goes back.
fn goes_on(contour: &[Segment], place: usize, [step_back, lean]: [f64; 2]) -> Option<f64> {
    let (first, last) = (contour.first()?, contour.last()?);
    let sign = if last.to[place] > first.from[place] { 1.0 } else { -1.0 };
    let goes_on = |piece: &Segment| {
        let step = (piece.to[place] - piece.from[place]) * sign;
        let ends = [piece.from, piece.to].map(|at| {
            if piece.round.is_some() {
                piece.direction(at)[place] * sign
            } else {
                0.0
            }
        });
        step >= -step_back && ends[0] > -lean && ends[1] > -lean
    };
    contour.iter().all(goes_on).then_some(sign)
}

/// The start, no further along the travel than the contour begins.
fn clipped(start: Point, contour: &[Segment], place: usize, sign: f64) -> Point {
    let mut start = start;
    let first = contour.first().map_or(start[place], |piece| piece.from[place]);
    start[place] = if sign < 0.0 {
        start[place].max(first)
    } else {
        start[place].min(first)
    };
    start
}

/// The contour at a distance on the side of the start. `place`: the coordinate along which it goes, 0 is Z, 1 is X; it decides where the
/// start is on neither side. `corners`: some are rounded or cut off.
fn with_allowance(
    start: Point,
    contour: &[Segment],
    allowance: f64,
    (place, corners): (usize, bool),
) -> Result<Vec<Segment>, Stopped> {
    let (Some(first), Some(last)) = (contour.first(), contour.last()) else {
        return Ok(Vec::new());
    };
    let from = first.from;
    let seen = |point: Point| [point[0] - from[0], point[1] - from[1]];
    let mut side = cross(seen(last.from), seen(start));
    if side == 0.0 {
        let along = if place == 0 { 1.0 } else { -1.0 };
        let forward = if last.to[place] > from[place] { along } else { -along };
        side = if last.to[1 - place] < from[1 - place] {
            -forward
        } else {
            forward
        };
    }
    let allowance = offset::Allowance {
        left: if side > 0.0 { allowance } else { -allowance },
        place,
        corners,
    };
    Ok(offset::offset(contour, allowance)?)
}

/// G70: along the contour, P times, each time nearer.
fn finishing(
    out: &mut Out<'_>,
    start: Point,
    contour: &[Segment],
    corners: bool,
    words: &Words,
) -> Result<(), Stopped> {
    let along = match (contour, monotonic(contour, 0)?) {
        // observed: a contour of one block against Z is taken along X only
        ([only], Some(sign)) if sign > 0.0 && only.round.is_some() => None,
        (_, Some(sign)) if sign < 0.0 || contour.len() > 1 => Some((0, sign)),
        _ => monotonic(contour, 1)?.map(|sign| (1, sign)),
    };
    let Some((place, sign)) = along else {
        return Err((&problems::MONOTONIC).into());
    };
    let start = clipped(start, contour, place, sign);
    let mut left = words.p.trunc();
    let mut count = 0_u64;
    while left > 0.0 {
        left -= 1.0;
        count += 1;
        if count > out.engine.setup.limits.blocks {
            return Err((&problems::MANY).into());
        }
        let allowance = words.e + (words.d - words.e) * left / words.p;
        let pass = with_allowance(start, contour, allowance, (place, corners))?;
        out.rapid(start).map_err(Stopped::Refused)?;
        if let Some(first) = pass.first() {
            out.rapid(first.from).map_err(Stopped::Refused)?;
        }
        for piece in &pass {
            out.cut(piece).map_err(Stopped::Refused)?;
        }
    }
    Ok(())
}

/// G71 and G72 with their forms.
fn roughing(
    out: &mut Out<'_>,
    code: i16,
    start: Point,
    contour: &[Segment],
    corners: bool,
    words: &Words,
) -> Result<(), Stopped> {
    let swapped = code >= 720;
    let place = usize::from(swapped);
    let Some(sign) = monotonic(contour, place)? else {
        return Err((&problems::MONOTONIC).into());
    };
    if words.i <= 0.0 {
        return Err((&problems::ZERO_I).into());
    }
    let (Some(first), Some(last)) = (contour.first(), contour.last()) else {
        return Ok(());
    };
    // a contour at one level is taken as falling for G72, as rising for G71
    let fall = first.from[1 - place] - last.to[1 - place];
    let deeper = fall > 0.0 || (swapped && fall == 0.0);
    let frame = Frame {
        swapped,
        signs: [-sign, if deeper { -1.0 } else { 1.0 }],
    };
    let start = clipped(start, contour, place, sign);
    let contour = with_allowance(start, contour, words.d, (place, corners))?;
    out.rapid(start).map_err(Stopped::Refused)?;
    let turned: Vec<Segment> = contour.iter().map(|piece| frame.piece_to(piece)).collect();
    let rough = Rough {
        pockets: match code % 10 {
            1 => Pockets::Skip,
            2 => Pockets::Only,
            _ => Pockets::Cut,
        },
        depth: words.i,
        retract: words.r,
        limit: out.engine.setup.limits.blocks,
    };
    let mut told = |what: Move| match what {
        Move::Rapid(to) => out.rapid(frame.back(to)),
        Move::Cut(piece) => out.cut(&frame.piece_back(&piece)),
    };
    rough::run(rough, frame.to(start), &turned, &mut told)
}
