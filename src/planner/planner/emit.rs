//! What is planned becomes times: at a stop all of it, and of a long run what is settled.
use super::{Open, Planner};
use crate::section::WORTH;
use crate::timed::Crawl;
use crate::{Limit, Long, Planned, Run, Smooth, Timed};
use trunnion_machine::Machine;

/// Share of F below which a block is slow, and below which it crawls.
const SLOW: f64 = 0.8;
const CRAWL: f64 = 0.05;

impl Planner<'_> {
    pub(super) fn flush(&mut self, out: &mut impl FnMut(Timed)) {
        self.last = None;
        let planned = self.run.plan();
        #[cfg(test)]
        self.seen.push((self.run.clone(), planned.clone()));
        let all = self.open.len();
        self.emit(all, &planned, out);
        self.run.pieces.clear();
        self.run.begun = None;
        self.enough = self.chunk;
    }

    /// Emits what is settled of a long run, so that neither memory nor the time of a plan grows with it.
    pub(super) fn settle(&mut self, out: &mut impl FnMut(Timed)) {
        if self.open.len() < self.enough {
            return;
        }
        self.enough = 2 * self.open.len();
        let count = self.last.as_ref().map_or(0, |last| last.count);
        let most = self.run.pieces.len().saturating_sub(count);
        let Some((settled, begun)) = self.run.settled(most) else {
            return;
        };
        let planned = self.run.plan();
        let (mut pieces, mut motions) = (0, 0);
        for open in &self.open {
            if pieces == settled {
                break;
            }
            pieces += open.count;
            motions += 1;
        }
        self.emit(motions, &planned, out);
        self.run.pieces.drain(..settled);
        self.run.begun = Some(begun);
        self.enough = self.chunk.max(2 * self.open.len());
    }

    /// Emits the first motions.
    fn emit(&mut self, motions: usize, planned: &Planned, out: &mut impl FnMut(Timed)) {
        let mut next = 0;
        for open in self.open.drain(..motions) {
            let end = next + open.count;
            out(if open.count == 0 {
                open.timed
            } else {
                finished(&open, &self.run, planned, next..end)
            });
            next = end;
        }
    }
}

/// The filter of long sections: the one in which every axis of a machine changes its acceleration within its jerk. Of many motions it costs too little for
/// a search of a better one; `None` where it does not.
pub(super) fn long(machine: &Machine, motions: usize) -> Option<Long> {
    let times = machine
        .axes
        .iter()
        .filter_map(|axis| Some(axis.max_acceleration? / axis.extra.max_jerk?));
    let filter = 2.0 * times.fold(0.0, f64::max);
    let motions = u32::try_from(motions).unwrap_or(u32::MAX);
    (filter <= WORTH * f64::from(motions)).then_some(Long { motions, filter })
}

/// Puts the pieces of a motion together.
fn finished(open: &Open, run: &Run, planned: &Planned, pieces: core::ops::Range<usize>) -> Timed {
    let Open { timed, complete, .. } = *open;
    let mut seconds = [0.0; 2];
    let (mut reached, mut lowest, mut below) = (0.0_f64, f64::INFINITY, 0.0);
    let mut crawl = Crawl::default();
    let mut slowest = pieces.start;
    for index in pieces.clone() {
        let (ramp, [own, free]) = (&planned.ramps[index], planned.seconds[index]);
        seconds[0] += free;
        seconds[1] += own;
        reached = reached.max(ramp.top);
        lowest = lowest.min(ramp.ends[0]).min(ramp.ends[1]);
        let feed = run.pieces[index].feed;
        if feed.is_finite() {
            let smooth = match planned.smooth[index] {
                Smooth::OneMove(smooth) => smooth,
                Smooth::Filter(filter) => [ramp.top / ramp.acceleration, filter],
            };
            let slow = |speed: f64| (ramp.top >= speed).then(|| ramp.seconds_below(speed, smooth));
            // the filter runs on into the next piece: what it adds at a start is part of the time at the stop
            below += slow(SLOW * feed).map_or(own, |[enters, leaves]| own.min(enters + leaves));
            match slow(CRAWL * feed) {
                None => crawl.goes_on(own),
                Some(ends) => crawl.breaks(ends),
            }
        }
        if ramp.top < planned.ramps[slowest].top {
            slowest = index;
        }
    }
    seconds[1] = (seconds[1] - open.overlap).max(seconds[0]);
    let below = f64::min(below, seconds[1]);
    let (piece, ramp) = (&run.pieces[slowest], &planned.ramps[slowest]);
    let near = |a: f64, b: f64| a >= b * (1.0 - 1e-6);
    let limit = if near(ramp.top, piece.planned.cap) {
        piece.planned.by
    } else if matches!(planned.smooth[slowest], Smooth::OneMove(_))
        && piece.jerk.is_finite()
        && ramp.top < piece.planned.acceleration * piece.jerk_time
    {
        Limit::Jerk
    } else if near(ramp.ends[0].min(ramp.ends[1]), ramp.top) && ramp.top > 0.0 {
        Limit::Corner
    } else {
        Limit::Acceleration(piece.slowest)
    };
    // it is as fast as F, but not for long
    let slow = seconds[1] * piece.feed * SLOW > timed.length;
    let limit = match limit {
        Limit::Feed if slow && lowest <= 0.0 => Limit::Stop,
        Limit::Feed if slow => Limit::Corner,
        limit => limit,
    };
    let last = planned.ramps[pieces.end - 1].ends[1];
    Timed {
        seconds: [Some(seconds[0]), complete.then_some(seconds[1])],
        reached: complete.then_some(reached * 60.0),
        lowest: complete.then_some(lowest * 60.0),
        leaves: complete.then_some(last * 60.0),
        limit,
        below,
        crawl,
        ..timed
    }
}
