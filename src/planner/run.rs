//! From one stop to the next: backward and forward pass over the pieces, then times.
use crate::{Bounds, Limit, Piece, Ramp, s_curve};

/// The pieces between two stops.
#[derive(Clone, Debug, Default)]
pub struct Run {
    /// In order.
    pub pieces: Vec<Piece>,
    /// Blocks that the control looks ahead; `None`: all.
    pub lookahead: Option<u32>,
    /// Length of the control's own filter, s.
    pub filter: f64,
}

/// What a run takes.
#[derive(Clone, Debug, Default)]
pub struct Planned {
    /// Each piece as planned.
    pub ramps: Vec<Ramp>,
    /// Planned and optimistic time of each piece, s.
    pub seconds: Vec<[f64; 2]>,
    /// Length of the filter that limits the jerk, s; part of the last piece's time. 0 where the run is one move in closed form.
    pub filter: f64,
    /// Highest speed of a run that is one move with limited jerk, mm/s.
    pub top: Option<f64>,
}

/// Relative difference that is rounding.
const SAME: f64 = 1e-9;

impl Run {
    /// Plans it. Both ends are stops.
    pub fn plan(&self) -> Planned {
        if self.pieces.is_empty() {
            return Planned::default();
        }
        let free = self.speeds(|piece| piece.optimistic, 0, 1.0, None);
        let optimistic = self.ramps(|piece| piece.optimistic, &free, 1.0);
        if let Some(planned) = self.one_move(&optimistic) {
            return planned;
        }
        let jerk_time = self.pieces.iter().map(|piece| piece.jerk_time).fold(0.0, f64::max);
        let share = self.best_share(jerk_time);
        let speeds = self.speeds(|piece| piece.planned, 1, share, self.lookahead);
        let ramps = self.ramps(|piece| piece.planned, &speeds, share);
        let filter = self.filter.max(2.0 * jerk_time * share);
        let mut seconds: Vec<[f64; 2]> = ramps
            .iter()
            .zip(&optimistic)
            .map(|(own, free)| [own.seconds(), free.seconds()])
            .collect();
        // the filter runs empty at every stop
        for (seconds, ramp) in seconds.iter_mut().zip(&ramps) {
            if ramp.ends[1] <= 0.0 {
                seconds[0] += filter;
            }
        }
        Planned {
            ramps,
            seconds,
            filter,
            top: None,
        }
    }

    /// Time of the whole run with a share of the acceleration, s.
    fn total(&self, jerk_time: f64, share: f64) -> f64 {
        let speeds = self.speeds(|piece| piece.planned, 1, share, self.lookahead);
        let ramps = self.ramps(|piece| piece.planned, &speeds, share);
        let filter = self.filter.max(2.0 * jerk_time * share);
        ramps
            .iter()
            .map(|ramp| ramp.seconds() + if ramp.ends[1] <= 0.0 { filter } else { 0.0 })
            .sum()
    }

    /// The share of the acceleration with which the run is fastest: a filter that keeps the jerk within its limit is the shorter, the smaller
    /// the acceleration is. 1 for long runs, where the filter counts once for many blocks.
    fn best_share(&self, jerk_time: f64) -> f64 {
        const LONG: usize = 64;
        const GOLDEN: f64 = 0.618_033_988_749_894_8;
        if jerk_time == 0.0 || self.pieces.len() > LONG || self.total(jerk_time, 0.97) >= self.total(jerk_time, 1.0) {
            return 1.0;
        }
        // golden section on a function with one valley
        let (mut low, mut high) = (1e-3, 1.0);
        for _ in 0..28 {
            let (a, b) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
            if self.total(jerk_time, a) < self.total(jerk_time, b) {
                high = b;
            } else {
                low = a;
            }
        }
        high
    }

    /// Highest speeds at the ends of the pieces that every piece can brake from and accelerate to. `side` 0: optimistic, 1: planned.
    fn speeds(&self, of: impl Fn(&Piece) -> Bounds, side: usize, share: f64, lookahead: Option<u32>) -> Vec<f64> {
        let count = self.pieces.len();
        let mut speeds = vec![0.0; count + 1];
        // from the end backwards
        for index in (1..count).rev() {
            let (before, piece) = (of(&self.pieces[index - 1]), of(&self.pieces[index]));
            let next: f64 = speeds[index + 1];
            let reach = (next * next + 2.0 * share * piece.acceleration * self.pieces[index].length).sqrt();
            speeds[index] = self.pieces[index].entry[side].min(before.cap).min(piece.cap).min(reach);
        }
        if let Some(blocks) = lookahead {
            self.look(&of, share, blocks, &mut speeds);
        }
        for index in 0..count - 1 {
            let (piece, bounds) = (&self.pieces[index], of(&self.pieces[index]));
            let from: f64 = speeds[index];
            let reach = (from * from + 2.0 * share * bounds.acceleration * piece.length).sqrt();
            speeds[index + 1] = speeds[index + 1].min(reach);
        }
        speeds
    }

    /// Within the blocks that it sees, the control must be able to stop.
    fn look(&self, of: &impl Fn(&Piece) -> Bounds, share: f64, blocks: u32, speeds: &mut [f64]) {
        let count = self.pieces.len();
        let (mut end, mut sum, mut seen) = (count, 0.0, 0_u32);
        // how many pieces of each motion are inside the window [index, end)
        for index in (0..count).rev() {
            let piece = &self.pieces[index];
            sum += 2.0 * share * of(piece).acceleration * piece.length;
            if index + 1 == count || self.pieces[index + 1].motion != piece.motion {
                seen += 1;
            }
            while seen > blocks && end > index + 1 {
                end -= 1;
                sum -= 2.0 * share * of(&self.pieces[end]).acceleration * self.pieces[end].length;
                if self.pieces[end - 1].motion != self.pieces[end].motion {
                    seen -= 1;
                }
            }
            if sum.is_finite() {
                speeds[index] = speeds[index].min(sum.max(0.0).sqrt());
            }
        }
    }

    fn ramps(&self, of: impl Fn(&Piece) -> Bounds, speeds: &[f64], share: f64) -> Vec<Ramp> {
        let pieces = self.pieces.iter().zip(speeds.iter().zip(&speeds[1..]));
        pieces
            .map(|(piece, (from, to))| {
                let bounds = of(piece);
                Ramp::fastest(piece.length, bounds.cap, share * bounds.acceleration, [*from, *to])
            })
            .collect()
    }

    /// A run that is one straight move: all pieces have the same limits and go on without a corner. Its profile is known in closed form.
    fn one_move(&self, optimistic: &[Ramp]) -> Option<Planned> {
        let first = &self.pieces[0];
        if self.pieces.len() > 1
            && self
                .lookahead
                .is_some_and(|blocks| (blocks as usize) < self.pieces.len())
        {
            return None;
        }
        let near = |a: f64, b: f64| a == b || (a - b).abs() <= SAME * a.abs().max(b.abs());
        let alike = self.pieces.iter().enumerate().all(|(index, piece)| {
            let (own, wanted) = (&piece.planned, &first.planned);
            near(own.cap, wanted.cap)
                && near(own.acceleration, wanted.acceleration)
                && near(piece.jerk, first.jerk)
                && (index == 0 || piece.entry[1] >= own.cap)
        });
        // the jerk of a bend is not that of the path
        if !alike || matches!(first.planned.by, Limit::Bend(_)) {
            return None;
        }
        let length: f64 = self.pieces.iter().map(|piece| piece.length).sum();
        let bounds = &first.planned;
        if !bounds.cap.is_finite() {
            return None;
        }
        let (total, top) = s_curve(length, bounds.cap, bounds.acceleration, first.jerk);
        let whole = Ramp::fastest(length, top, bounds.acceleration, [0.0; 2]);
        // how far a move is after a time, in closed form: half of it, mirrored
        let move_ = Move::new(length, total, top, bounds.acceleration, first.jerk);
        let (mut seconds, mut ramps) = (
            Vec::with_capacity(self.pieces.len()),
            Vec::with_capacity(self.pieces.len()),
        );
        let (mut way, mut before) = (0.0, 0.0);
        for (index, (piece, free)) in self.pieces.iter().zip(optimistic).enumerate() {
            let from = whole.at(way).0;
            way += piece.length;
            let last = index + 1 == self.pieces.len();
            let now = if last { total } else { move_.time_at(way) };
            let ends = [
                if index == 0 { 0.0 } else { from },
                if last { 0.0 } else { whole.at(way).0 },
            ];
            ramps.push(Ramp::fastest(piece.length, top, bounds.acceleration, ends));
            seconds.push([(now - before).max(free.seconds()), free.seconds()]);
            before = now;
        }
        if let Some(last) = seconds.last_mut() {
            last[0] += self.filter;
        }
        Some(Planned {
            ramps,
            seconds,
            filter: 0.0,
            top: Some(top),
        })
    }
}

/// The course of one move from rest to rest.
struct Move {
    length: f64,
    total: f64,
    top: f64,
    /// Duration of the change of jerk, and of the whole change of speed, s.
    bend: f64,
    change: f64,
}

impl Move {
    fn new(length: f64, total: f64, top: f64, acceleration: f64, jerk: f64) -> Self {
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
