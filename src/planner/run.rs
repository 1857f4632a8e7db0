//! From one stop to the next: backward and forward pass over the pieces, then times.
use crate::{Bounds, Piece, Ramp, s_curve};
use trunnion_geometry::math::{exp, ln};

/// The pieces between two stops.
#[derive(Clone, Debug, Default)]
pub struct Run {
    /// In order.
    pub pieces: Vec<Piece>,
    /// Blocks that the control looks ahead; `None`: all.
    pub lookahead: Option<u32>,
    /// Length of the control's own filter, s.
    pub filter: f64,
    /// Where these are not the first pieces after the stop: how they begin.
    pub begun: Option<Begun>,
}

/// How the rest of a run begins whose first pieces are planned already.
#[derive(Clone, Copy, Debug, Default)]
pub struct Begun {
    /// Optimistic and planned speed, mm/s.
    pub speeds: [f64; 2],
    /// The length of the filter that limits the jerk, s.
    pub filter: f64,
}

/// The longest filter is taken without a search if it costs no more than this for each motion, s: half a servo cycle of 1 ms.
pub(crate) const WORTH: f64 = 0.0005;

/// What a run takes.
#[derive(Clone, Debug, Default)]
pub struct Planned {
    /// Each piece as planned.
    pub ramps: Vec<Ramp>,
    /// Planned and optimistic time of each piece, s.
    pub seconds: Vec<[f64; 2]>,
    /// Length of the filter that limits the jerk, s; part of the last piece's time. 0 where the run is one move in closed form.
    pub filter: f64,
    /// Of a run that is one move with limited jerk: how long it accelerates evenly, and how long the acceleration changes, s.
    pub one_move: Option<[f64; 2]>,
}

/// Highest speed (mm/s) and acceleration (mm/s^2) of each piece.
type Levels = Vec<[f64; 2]>;

/// A plan whose jerk a filter limits.
struct Filtered {
    ramps: Vec<Ramp>,
    /// s.
    filter: f64,
    /// Of the whole run, s.
    total: f64,
}

impl Run {
    /// Plans it. It ends with a stop, and begins with one where nothing is planned yet.
    ///
    /// Of two kinds of plan the faster one counts: accelerations that a filter smooths, of the best length, and one move with limited jerk under the
    /// lowest limits of all pieces. With a higher limit each plan of both kinds is still possible, so that the time does not grow.
    pub fn plan(&self) -> Planned {
        if self.pieces.is_empty() {
            return Planned::default();
        }
        let free = self.free_levels();
        let optimistic = Self::ramps(&self.pieces, &free, &self.speeds(&free, 0, None));
        let filtered = self.filtered();
        if let Some(move_) = self.one_move()
            && move_.total + self.filter <= filtered.total
        {
            return self.along(&move_, &optimistic);
        }
        let mut seconds: Vec<[f64; 2]> = filtered
            .ramps
            .iter()
            .zip(&optimistic)
            .map(|(own, free)| [own.seconds(), free.seconds()])
            .collect();
        // the filter runs empty at every stop
        for (seconds, ramp) in seconds.iter_mut().zip(&filtered.ramps) {
            if ramp.ends[1] <= 0.0 {
                seconds[0] += filtered.filter;
            }
        }
        Planned {
            ramps: filtered.ramps,
            seconds,
            filter: filtered.filter,
            one_move: None,
        }
    }

    fn levels(&self, of: impl Fn(&Piece) -> [f64; 2]) -> Levels {
        self.pieces.iter().map(of).collect()
    }

    /// The plan for a filter of this length, s: no axis accelerates by more than half of what its jerk gives in that time, along the path and in bends, so
    /// that a change from one acceleration to the opposite one keeps within the jerk.
    fn with_filter(&self, length: f64) -> Filtered {
        let levels = self.levels_with(length);
        let speeds = self.speeds(&levels, 1, self.lookahead);
        let ramps = Self::ramps(&self.pieces, &levels, &speeds);
        let filter = self.filter.max(length);
        let total = ramps
            .iter()
            .map(|ramp| ramp.seconds() + if ramp.ends[1] <= 0.0 { filter } else { 0.0 })
            .sum();
        Filtered { ramps, filter, total }
    }

    fn free_levels(&self) -> Levels {
        self.levels(|piece| [piece.optimistic.cap, piece.optimistic.acceleration])
    }

    fn levels_with(&self, length: f64) -> Levels {
        self.levels(|piece| {
            let Bounds { cap, acceleration, .. } = piece.planned;
            if length <= 0.0 {
                return [cap, acceleration];
            }
            let half = 0.5 * length;
            [
                cap.min((piece.bend_jerk * half).sqrt()),
                acceleration.min(piece.jerk * half),
            ]
        })
    }

    /// The plan with the filter that makes the run fastest: the shorter it is, the less may the axes accelerate.
    fn filtered(&self) -> Filtered {
        const GOLDEN: f64 = 0.618_033_988_749_894_8;
        const ROUNDS: u32 = 28;
        const SHORTEST: f64 = 1e-6;
        if let Some(begun) = self.begun {
            return self.with_filter(begun.filter);
        }
        let longest = 2.0 * self.pieces.iter().map(|piece| piece.jerk_time).fold(0.0, f64::max);
        let mut best = self.with_filter(longest);
        let ends = self.pieces.first().zip(self.pieces.last());
        let motions = ends.map_or(0, |(first, last)| last.motion.saturating_sub(first.motion) + 1);
        if longest <= WORTH * f64::from(motions) || self.with_filter(0.97 * longest).total >= best.total {
            return best;
        }
        // golden section on a function with one valley, over the logarithm: one axis may ask for a filter that is many times longer than the best one
        let (mut low, mut high) = (ln(SHORTEST * longest), ln(longest));
        let inside = |low: f64, high: f64| [high - GOLDEN * (high - low), low + GOLDEN * (high - low)];
        let mut at = inside(low, high);
        let mut found = at.map(|length| self.with_filter(exp(length)));
        for _ in 0..ROUNDS {
            if found[0].total < found[1].total {
                high = at[1];
                at = inside(low, high);
                found.swap(0, 1);
                found[0] = self.with_filter(exp(at[0]));
            } else {
                low = at[0];
                at = inside(low, high);
                found.swap(0, 1);
                found[1] = self.with_filter(exp(at[1]));
            }
        }
        for one in found {
            if one.total < best.total {
                best = one;
            }
        }
        best
    }

    /// Highest speeds at the ends of the pieces that every piece can brake from and accelerate to. `side` 0: optimistic, 1: planned.
    fn speeds(&self, levels: &Levels, side: usize, lookahead: Option<u32>) -> Vec<f64> {
        let mut speeds = self.braking(levels, side);
        if let Some(blocks) = lookahead {
            self.look(levels, blocks, &mut speeds);
        }
        for index in 0..self.pieces.len() - 1 {
            let from: f64 = speeds[index];
            let reach = (from * from + 2.0 * levels[index][1] * self.pieces[index].length).sqrt();
            speeds[index + 1] = speeds[index + 1].min(reach);
        }
        speeds
    }

    /// Highest speeds at the ends of the pieces that every piece can brake from, from the end backwards.
    fn braking(&self, levels: &Levels, side: usize) -> Vec<f64> {
        let count = self.pieces.len();
        let mut speeds = vec![0.0; count + 1];
        speeds[0] = self.begun.map_or(0.0, |begun| begun.speeds[side]);
        for index in (1..count).rev() {
            let [_, acceleration] = levels[index];
            let next: f64 = speeds[index + 1];
            let reach = (next * next + 2.0 * acceleration * self.pieces[index].length).sqrt();
            speeds[index] = self.allowed(levels, side, index).min(reach);
        }
        speeds
    }

    /// The highest speed at the start of a piece, whatever follows.
    fn allowed(&self, levels: &Levels, side: usize, index: usize) -> f64 {
        let ([before, _], [cap, _]) = (levels[index - 1], levels[index]);
        self.pieces[index].entry[side].min(before).min(cap)
    }

    /// How many pieces are planned as they will be whatever follows, up to `most`, and how the rest begins: before it lies a corner from which
    /// the control could even stop within what it knows. `None` where there is no such corner.
    pub(crate) fn settled(&self, filter: f64, most: usize) -> Option<(usize, Begun)> {
        let sides = [self.free_levels(), self.levels_with(filter)];
        let braking = [0, 1].map(|side| self.braking(&sides[side], side));
        let (mut index, mut seen) = (self.pieces.len(), 0);
        let begins = |index: usize| self.pieces[index - 1].motion != self.pieces[index].motion;
        let settled = |side: usize, index: usize| braking[side][index] >= self.allowed(&sides[side], side, index);
        loop {
            index = index.checked_sub(1).filter(|index| *index > 0)?;
            if !begins(index) {
                continue;
            }
            seen += 1;
            let looked = self.lookahead.is_none_or(|blocks| seen > blocks);
            if looked && index <= most && settled(0, index) && settled(1, index) {
                break;
            }
        }
        let speeds = [
            self.speeds(&sides[0], 0, None)[index],
            self.speeds(&sides[1], 1, self.lookahead)[index],
        ];
        Some((index, Begun { speeds, filter }))
    }

    /// Within the blocks that it sees, the control must be able to stop.
    fn look(&self, levels: &Levels, blocks: u32, speeds: &mut [f64]) {
        let count = self.pieces.len();
        let gain = |index: usize| 2.0 * levels[index][1] * self.pieces[index].length;
        let (mut end, mut sum, mut seen) = (count, 0.0, 0_u32);
        // how many pieces of each motion are inside the window [index, end)
        for index in (0..count).rev() {
            sum += gain(index);
            if index + 1 == count || self.pieces[index + 1].motion != self.pieces[index].motion {
                seen += 1;
            }
            while seen > blocks && end > index + 1 {
                end -= 1;
                sum -= gain(end);
                if self.pieces[end - 1].motion != self.pieces[end].motion {
                    seen -= 1;
                }
            }
            if sum.is_finite() {
                speeds[index] = speeds[index].min(sum.max(0.0).sqrt());
            }
        }
    }

    fn ramps(pieces: &[Piece], levels: &Levels, speeds: &[f64]) -> Vec<Ramp> {
        let pieces = pieces.iter().zip(levels).zip(speeds.iter().zip(&speeds[1..]));
        pieces
            .map(|((piece, [cap, acceleration]), (from, to))| {
                Ramp::fastest(piece.length, *cap, *acceleration, [*from, *to])
            })
            .collect()
    }

    /// The run as one move in closed form, under the lowest limits of all its pieces. `None` where it bends, because the jerk of a bend is not that of the
    /// path, and where the control does not see all of it.
    fn one_move(&self) -> Option<Move> {
        let unseen = |blocks: u32| (blocks as usize) < self.pieces.len();
        if self.begun.is_some() {
            return None;
        }
        if self.pieces.len() > 1 && self.lookahead.is_some_and(unseen) {
            return None;
        }
        let (mut length, mut cap, mut acceleration, mut jerk) = (0.0, f64::INFINITY, f64::INFINITY, f64::INFINITY);
        for (index, piece) in self.pieces.iter().enumerate() {
            if piece.bends {
                return None;
            }
            length += piece.length;
            cap = f64::min(cap, piece.planned.cap);
            if index > 0 {
                cap = cap.min(piece.entry[1]);
            }
            acceleration = f64::min(acceleration, piece.planned.acceleration);
            jerk = f64::min(jerk, piece.jerk);
        }
        (cap > 0.0 && cap.is_finite()).then(|| Move::new(length, cap, acceleration, jerk))
    }

    /// The times of the pieces along one move.
    fn along(&self, move_: &Move, optimistic: &[Ramp]) -> Planned {
        let whole = Ramp::fastest(move_.length, move_.top, move_.acceleration, [0.0; 2]);
        let (mut seconds, mut ramps) = (
            Vec::with_capacity(self.pieces.len()),
            Vec::with_capacity(self.pieces.len()),
        );
        let (mut way, mut before) = (0.0, 0.0);
        for (index, (piece, free)) in self.pieces.iter().zip(optimistic).enumerate() {
            let from = whole.at(way).0;
            way += piece.length;
            let last = index + 1 == self.pieces.len();
            let now = if last { move_.total } else { move_.time_at(way) };
            let ends = [
                if index == 0 { 0.0 } else { from },
                if last { 0.0 } else { whole.at(way).0 },
            ];
            ramps.push(Ramp::fastest(piece.length, move_.top, move_.acceleration, ends));
            seconds.push([(now - before).max(free.seconds()), free.seconds()]);
            before = now;
        }
        if let Some(last) = seconds.last_mut() {
            last[0] += self.filter;
        }
        Planned {
            ramps,
            seconds,
            filter: 0.0,
            one_move: Some([move_.change - move_.bend, move_.bend + self.filter]),
        }
    }
}

/// The course of one move from rest to rest.
struct Move {
    length: f64,
    /// s.
    total: f64,
    /// mm/s.
    top: f64,
    /// mm/s^2.
    acceleration: f64,
    /// Duration of the change of jerk, and of the whole change of speed, s.
    bend: f64,
    change: f64,
}

impl Move {
    /// The fastest within these limits.
    fn new(length: f64, cap: f64, acceleration: f64, jerk: f64) -> Self {
        let (total, top) = s_curve(length, cap, acceleration, jerk);
        let reached = acceleration.is_finite() && (!jerk.is_finite() || top >= acceleration * acceleration / jerk);
        let bend = match (jerk.is_finite(), reached) {
            (false, _) => 0.0,
            (true, true) => acceleration / jerk,
            (true, false) => (top / jerk).sqrt(),
        };
        let change = match (reached, acceleration.is_finite()) {
            (true, _) => top / acceleration + bend,
            (false, false) if !jerk.is_finite() => 0.0,
            _ => 2.0 * bend,
        };
        Self {
            length,
            total,
            top,
            acceleration,
            bend,
            change,
        }
    }

    /// Way after a time of the first half, mm.
    fn way(&self, t: f64) -> f64 {
        if t >= self.change {
            return 0.5 * self.top * self.change + self.top * (t - self.change);
        }
        // the speed is a trapezoid of acceleration: rising for `bend`, even, falling for `bend`
        let even = self.change - self.bend;
        let a = if even > 0.0 { self.top / even } else { 0.0 };
        if self.bend == 0.0 {
            return 0.5 * a * t * t;
        }
        let rise = a / self.bend;
        if t < self.bend {
            rise * t * t * t / 6.0
        } else if t < even {
            let u = t - self.bend;
            rise * self.bend.powi(3) / 6.0 + 0.5 * a * self.bend * u + 0.5 * a * u * u
        } else {
            let left = self.change - t;
            0.5 * self.top * self.change - self.top * left + rise * left * left * left / 6.0
        }
    }

    /// When it has gone a way, s.
    fn time_at(&self, way: f64) -> f64 {
        if way > 0.5 * self.length {
            return self.total - self.time_at(self.length - way);
        }
        let (mut low, mut high) = (0.0, 0.5 * self.total);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.way(middle) < way {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    }
}
