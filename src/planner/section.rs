//! From one planned stop to the next: the plan that is fastest with limited jerk.
use crate::one_move::Move;
use crate::passes::Passes;
use crate::run::{Planned, Smooth};
use crate::{Bounds, Piece, Ramp};

/// How much the time may be above that of the best filter, for each motion, s: half a servo cycle of 1 ms.
pub(crate) const WORTH: f64 = 0.0005;
/// Or by this share of it: it bounds the steps of the search where a motion takes more than 500 s.
const SHARE: f64 = 1e-6;

/// The pieces from one planned stop to the next.
pub(crate) struct Section<'a> {
    pub(crate) pieces: &'a [Piece],
    /// Blocks that the control looks ahead; `None`: all.
    pub(crate) lookahead: Option<u32>,
    /// Length of the control's own filter, s.
    pub(crate) own_filter: f64,
    /// The filter that limits the jerk, s; `None`: the one that makes the section fastest.
    pub(crate) filter: Option<f64>,
    /// Where its first pieces are planned already: the speed at its start, mm/s.
    pub(crate) begins: Option<f64>,
}

/// A plan whose jerk a filter limits.
struct Filtered {
    ramps: Vec<Ramp>,
    /// s.
    filter: f64,
    /// Stops, each of which costs the length of the filter.
    stops: f64,
    /// Of the whole section, s.
    total: f64,
}

impl Section<'_> {
    /// Plans it, beside the optimistic plan of its pieces. Of two kinds of plan the faster one counts: accelerations that a filter smooths, of the best
    /// length, and one move with limited jerk under the lowest limits of all pieces. With a higher limit each plan of both kinds is still possible, so that
    /// the time does not grow, but for what the search of the best length leaves.
    pub(crate) fn plan(&self, optimistic: &[Ramp], out: &mut Planned) {
        let filtered = self.filtered();
        if let Some(move_) = self.one_move()
            && move_.total + self.own_filter <= filtered.total
        {
            return self.along(&move_, optimistic, out);
        }
        for (own, free) in filtered.ramps.iter().zip(optimistic) {
            // the filter runs empty at every stop
            let empties = if own.ends[1] <= 0.0 { filtered.filter } else { 0.0 };
            out.seconds.push([own.seconds() + empties, free.seconds()]);
            out.smooth.push(Smooth::Filter(filtered.filter));
        }
        out.ramps.extend(filtered.ramps);
    }

    /// How many motions it has.
    pub(crate) fn motions(&self) -> u32 {
        let ends = self.pieces.first().zip(self.pieces.last());
        ends.map_or(0, |(first, last)| last.motion.saturating_sub(first.motion) + 1)
    }

    /// Its passes for a filter of this length, s: no axis accelerates by more than half of what its jerk gives in that time, along the path and in bends, so
    /// that a change from one acceleration to the opposite one keeps within the jerk.
    pub(crate) fn passes(&self, length: f64) -> Passes<'_> {
        let half = 0.5 * length;
        let level = |piece: &Piece| {
            let Bounds { cap, acceleration, .. } = piece.planned;
            if length <= 0.0 {
                return [cap, acceleration];
            }
            [
                cap.min((piece.bend_jerk * half).sqrt()),
                acceleration.min(piece.jerk * half),
            ]
        };
        Passes {
            pieces: self.pieces,
            levels: self.pieces.iter().map(level).collect(),
            side: 1,
            lookahead: self.lookahead,
            first: self.begins.unwrap_or(0.0),
        }
    }

    fn with_filter(&self, length: f64) -> Filtered {
        let ramps = self.passes(length).ramps();
        let filter = self.own_filter.max(length);
        let (mut stops, mut total) = (0.0, 0.0);
        for ramp in &ramps {
            total += ramp.seconds();
            if ramp.ends[1] <= 0.0 {
                stops += 1.0;
            }
        }
        Filtered {
            ramps,
            filter,
            stops,
            total: total + stops * filter,
        }
    }

    /// The plan with the filter that makes the section fastest, to within [`WORTH`] for each motion or [`SHARE`]: the shorter it is, the less may the axes accelerate.
    ///
    /// The time has several valleys, as different axes bind the pieces. But the ramps alone take no less time with a shorter filter: between the lengths
    /// a < b no plan is faster than the ramps of b with the filter a. So the search goes down from the longest filter in the largest steps that cannot pass
    /// over a faster plan.
    fn filtered(&self) -> Filtered {
        if let Some(filter) = self.filter {
            return self.with_filter(filter);
        }
        let longest = 2.0 * self.pieces.iter().map(|piece| piece.jerk_time).fold(0.0, f64::max);
        let mut best = self.with_filter(longest);
        let worth = (WORTH * f64::from(self.motions())).max(SHARE * best.total);
        if !best.total.is_finite() || longest * best.stops <= worth {
            return best;
        }
        // a good plan first: it makes the steps longer
        let mut length = 0.5 * longest;
        loop {
            let one = self.with_filter(length);
            let is_better = one.total < best.total;
            if !is_better {
                break;
            }
            best = one;
            length *= 0.5;
        }
        // a plan takes longer than its filter
        length = longest.min(best.total);
        while length > 0.0 {
            let one = self.with_filter(length);
            if !one.total.is_finite() {
                break;
            }
            length -= ((one.total - best.total).max(0.0) + worth) / one.stops.max(1.0);
            if one.total < best.total {
                best = one;
            }
        }
        best
    }

    /// The section as one move in closed form, under the lowest limits of all its pieces. `None` where it bends, because the jerk of a bend is not that of
    /// the path, and where the control does not see all of it.
    fn one_move(&self) -> Option<Move> {
        let unseen = |blocks: u32| (blocks as usize) < self.pieces.len();
        if self.begins.is_some() || self.pieces.len() > 1 && self.lookahead.is_some_and(unseen) {
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
    fn along(&self, move_: &Move, optimistic: &[Ramp], out: &mut Planned) {
        let whole = Ramp::fastest(move_.length, move_.top, move_.acceleration, [0.0; 2]);
        let smooth = Smooth::OneMove([move_.change - move_.bend, move_.bend + self.own_filter]);
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
            out.ramps
                .push(Ramp::fastest(piece.length, move_.top, move_.acceleration, ends));
            out.seconds.push([(now - before).max(free.seconds()), free.seconds()]);
            out.smooth.push(smooth);
            before = now;
        }
        if let Some(last) = out.seconds.last_mut() {
            last[0] += self.own_filter;
        }
    }
}
