//! The least steep way through the tubes of all postures and turns, exactly: where the first rotary axis can be at each station under a
//! limit of its slope, and the postures and turns that get there.
use super::chain::{Station, half_turn};
use core::f64::consts::TAU;

/// Rounding in comparisons of angles, rad.
const ROUNDING: f64 = 1e-12;

/// An unbroken range of the first rotary joint, rad.
pub(super) type Range = (f64, f64);

/// The choice at a station.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Choice {
    /// 0: as programmed; 1: the other posture.
    pub posture: usize,
    /// Middle of the tube: the first rotary joint of the programmed tool axis, with its turns, rad.
    pub centre: f64,
}

/// What the search depends on.
pub(super) struct Reach<'a> {
    /// The chain.
    pub stations: &'a [Station],
    /// Travel of the first rotary joint, rad; of an endless axis as far as it is looked at.
    pub travel: Range,
    /// Whether posture and turns of the ends are free.
    pub free_ends: [bool; 2],
}

/// Ranges at one station in both postures.
type Sets = [Vec<Range>; 2];

impl Reach<'_> {
    /// The tubes of a station in a posture that meet a range, rad, as far as they are inside the travel, with the turns of each.
    fn tubes(&self, index: usize, posture: usize, range: Range, mut each: impl FnMut(f64, Range)) {
        let station = &self.stations[index];
        let Some([centre, _]) = station.in_posture(posture) else {
            return;
        };
        let (low, high) = (range.0.max(self.travel.0), range.1.min(self.travel.1));
        let room = if station.pinned { 0.0 } else { station.room };
        let last = self.stations.len() - 1;
        let fixed = index == 0 && !self.free_ends[0] || index == last && !self.free_ends[1];
        if fixed && posture == 1 || low > high + ROUNDING {
            return;
        }
        if room.is_infinite() {
            return each(centre, (low, high));
        }
        let (mut turn, end) = if fixed {
            (0.0, 0.0)
        } else {
            (
                ((low - room - centre - ROUNDING) / TAU).ceil(),
                ((high + room - centre + ROUNDING) / TAU).floor(),
            )
        };
        while turn <= end {
            let middle = centre + TAU * turn;
            let inside = (low.max(middle - room), high.min(middle + room));
            if inside.0 <= inside.1 + ROUNDING {
                each(middle, inside);
            }
            turn += 1.0;
        }
    }

    /// How far the joint may turn from a station to the next, rad.
    fn farthest(&self, from: usize, limit: f64) -> f64 {
        let (from, to) = (&self.stations[from], &self.stations[from + 1]);
        limit.min(half_turn(from, to)) * (to.s - from.s)
    }

    /// Where the joint can be at the first station.
    fn begin(&self) -> Sets {
        let mut sets = Sets::default();
        for (posture, set) in sets.iter_mut().enumerate() {
            self.tubes(0, posture, self.travel, |_, range| set.push(range));
        }
        sets
    }

    /// Sets `sets` to where it can be at the next station, no steeper than `limit` (rad per length).
    fn step(&self, index: usize, before: &Sets, limit: f64, sets: &mut Sets) {
        let reach = self.farthest(index - 1, limit);
        let changes = self.stations[index].free || self.stations[index - 1].free;
        for (posture, set) in sets.iter_mut().enumerate() {
            set.clear();
            for (from, ranges) in before.iter().enumerate() {
                if from == posture || changes {
                    for range in ranges {
                        self.tubes(index, posture, (range.0 - reach, range.1 + reach), |_, inside| {
                            set.push(inside);
                        });
                    }
                }
            }
            unite(set);
        }
    }

    /// Whether the chain can be run no steeper than `limit`.
    pub(super) fn allows(&self, limit: f64) -> bool {
        let (mut sets, mut next) = (self.begin(), Sets::default());
        for index in 1..self.stations.len() {
            self.step(index, &sets, limit, &mut next);
            core::mem::swap(&mut sets, &mut next);
            if sets.iter().all(Vec::is_empty) {
                return false;
            }
        }
        true
    }

    /// Postures and turns of a way no steeper than `limit`, as programmed where that is open; `None`: there is none.
    pub(super) fn choices(&self, limit: f64) -> Option<Vec<Choice>> {
        let mut all = vec![self.begin()];
        for index in 1..self.stations.len() {
            let mut sets = Sets::default();
            self.step(index, &all[index - 1], limit, &mut sets);
            if sets.iter().all(Vec::is_empty) {
                return None;
            }
            all.push(sets);
        }
        let mut choices = Vec::with_capacity(all.len());
        let (mut target, mut posture): (Vec<Range>, Option<usize>) = (vec![(f64::NEG_INFINITY, f64::INFINITY)], None);
        for index in (0..all.len()).rev() {
            let station = &self.stations[index];
            let changes =
                posture.is_none() || station.free || self.stations.get(index + 1).is_some_and(|next| next.free);
            let open = |at: usize| changes || posture == Some(at);
            let reach = if index + 1 < all.len() {
                self.farthest(index, limit)
            } else {
                0.0
            };
            // (off the programmed posture, off the programmed turns), what is chosen
            let mut best: Option<((bool, f64), Choice, Range)> = None;
            for at in [posture.unwrap_or(0), 1 - posture.unwrap_or(0)] {
                for have in all[index][at].iter().filter(|_| open(at)) {
                    for want in &target {
                        let both = (have.0.max(want.0 - reach), have.1.min(want.1 + reach));
                        if both.0 > both.1 + ROUNDING {
                            continue;
                        }
                        self.tubes(index, at, both, |centre, inside| {
                            let away = ((inside.0 + inside.1) * 0.5 - station.q[0]).abs();
                            let rank = (Some(at) != posture && !(posture.is_none() && at == 0), away);
                            let better = best.as_ref().is_none_or(|(known, ..)| {
                                (rank.0, rank.1.is_nan()) < (known.0, known.1.is_nan())
                                    || rank.0 == known.0 && rank.1 < known.1
                            });
                            if better {
                                best = Some((rank, Choice { posture: at, centre }, inside));
                            }
                        });
                    }
                }
            }
            let (_, choice, inside) = best?;
            target = vec![inside];
            posture = Some(choice.posture);
            choices.push(choice);
        }
        choices.reverse();
        Some(choices)
    }

    /// The least slope (rad per length, within a ten-thousandth), not above `highest`.
    pub(super) fn least(&self, highest: f64) -> f64 {
        let (mut low, mut high) = (0.0, highest);
        while high - low > 1e-4 * high + 1e-12 {
            let middle = 0.5 * (low + high);
            if self.allows(middle) {
                high = middle;
            } else {
                low = middle;
            }
        }
        high
    }
}

/// Sorts ranges and puts those together that overlap.
fn unite(ranges: &mut Vec<Range>) {
    ranges.sort_by(|a, b| a.0.total_cmp(&b.0));
    ranges.dedup_by(|range, last| {
        let meets = range.0 <= last.1 + ROUNDING;
        if meets {
            last.1 = last.1.max(range.1);
        }
        meets
    });
}
