//! How far a moving point deviates from a curve: set distance, sampled from below and proven from above.
use crate::path::peak::{Piece, peak_tagged};
use core::cell::Cell;
use core::cmp::Ordering;
use std::collections::BinaryHeap;
use trunnion_geometry::Vec3;

/// A point W(t) and a curve S(s), both from a common start at 0 to a common end at 1 (or near it), with bounds of their second
/// derivatives. Lengths in mm.
pub(crate) struct CurveDistance<W, S> {
    pub(crate) point: W,
    pub(crate) point_bend: f64,
    pub(crate) curve: S,
    pub(crate) curve_bend: f64,
}

/// The result; mm, and where in the block the largest sample is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found {
    /// Never above the truth.
    pub(crate) sampled: f64,
    /// Never below the truth.
    pub(crate) bound: f64,
    pub(crate) at: f64,
}

/// Where the nearest point of the curve was found for one sample.
#[derive(Clone, Copy)]
struct Radii {
    s: f64,
    point: Vec3,
    foot: Vec3,
}

/// How near to the true nearest point of the curve the search goes: mm, and as a share of the distance.
const NEAR_MM: f64 = 2e-6;
const NEAR_SHARE: f64 = 1e-6;

/// Most points of the curve that are examined for one sample.
const MOST_FEET: u32 = 1000;

/// Most samples of the point: each asks for its nearest point of the curve. The bound stays sound when they run out.
const MOST_SAMPLES: u32 = 1500;

/// A piece of the curve that may hold the nearest point, ordered so that the most hopeful comes first.
#[derive(Clone, Copy)]
struct Candidate {
    lowest: f64,
    from: f64,
    to: f64,
    ends: [Vec3; 2],
}

impl PartialEq for Candidate {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for Candidate {}

impl PartialOrd for Candidate {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Candidate {
    fn cmp(&self, other: &Self) -> Ordering {
        other.lowest.total_cmp(&self.lowest)
    }
}

impl<W: Fn(f64) -> Vec3, S: Fn(f64) -> Vec3> CurveDistance<W, S> {
    /// Largest over t of the smallest over s of |W(t) - S(s)|. The search ends when `enough(bound, sampled, samples)`.
    ///
    /// On a piece of t of length h any choice of s for each t gives an upper bound. Taken are s running evenly between the feet of both
    /// ends, |E''| <= point bend h^2 + curve bend ds^2 with E = W - S, and s standing at either foot: largest end + |E''| / 8
    /// (docs/kinematics.md#between-the-ends-of-a-block). The second closes where the nearest point jumps from one part of the curve to another.
    pub(crate) fn farthest(&self, enough: impl Fn(f64, f64, u32) -> bool) -> Found {
        let loose = Cell::new(0.0_f64);
        let found = peak_tagged(
            |t| self.nearest(t, &loose),
            |piece| self.over(piece),
            |bound, sampled, samples| samples >= MOST_SAMPLES || enough(bound, sampled, samples),
        );
        Found {
            // the nearest point that was found may be a little farther than the true one
            sampled: (found.sampled - slack(found.sampled).max(loose.get())).max(0.0),
            bound: found.bound,
            at: found.at,
        }
    }

    fn over(&self, piece: &Piece<Radii>) -> f64 {
        let h = piece.to - piece.from;
        let (from, to) = (&piece.tag_from, &piece.tag_to);
        let (run, step) = (self.point_bend * h * h, to.s - from.s);
        let slide = self.curve_bend * step * step;
        let even = piece.value_from.max(piece.value_to) + 0.125 * (run + slide);
        if slide <= run {
            return even;
        }
        let still = |near: f64, foot: &Vec3, far: &Vec3| near.max((far - foot).norm()) + 0.125 * run;
        even.min(still(piece.value_from, &from.foot, &to.point))
            .min(still(piece.value_to, &to.foot, &from.point))
    }

    /// Distance of W(t) from the curve, at most [`slack`] above the true value, and where the foot is: the piece of the curve whose lower
    /// bound (distance from its chord less bend ds^2 / 8) is smallest is halved first. Where that takes too long, `loose` grows to how far
    /// above the truth it may lie.
    fn nearest(&self, t: f64, loose: &Cell<f64>) -> (f64, Radii) {
        let point = (self.point)(t);
        let ends = [(self.curve)(0.0), (self.curve)(1.0)];
        let mut best = Radii {
            s: 0.0,
            point,
            foot: ends[0],
        };
        let mut least = (point - ends[0]).norm();
        let mut look = |s: f64, foot: Vec3, least: &mut f64| {
            let distance = (point - foot).norm();
            if distance < *least {
                *least = distance;
                best = Radii { s, point, foot };
            }
        };
        look(1.0, ends[1], &mut least);
        let candidate = |from: f64, to: f64, ends: [Vec3; 2]| {
            let sag = 0.125 * self.curve_bend * (to - from) * (to - from);
            Candidate {
                lowest: (from_segment(&point, &ends) - sag).max(0.0),
                from,
                to,
                ends,
            }
        };
        // if a parametric guess is near, most of the curve is never examined
        let guess = (self.curve)(t);
        look(t, guess, &mut least);
        let mut waiting = BinaryHeap::new();
        if t > 0.0 && t < 1.0 {
            waiting.push(candidate(0.0, t, [ends[0], guess]));
            waiting.push(candidate(t, 1.0, [guess, ends[1]]));
        } else {
            waiting.push(candidate(0.0, 1.0, ends));
        }
        let mut looked = 3;
        while let Some(next) = waiting.pop() {
            if next.lowest >= least - slack(least) {
                break;
            }
            if looked >= MOST_FEET || next.to - next.from < 1e-12 {
                loose.set(loose.get().max(least - next.lowest));
                break;
            }
            let middle = 0.5 * (next.from + next.to);
            let foot = (self.curve)(middle);
            looked += 1;
            look(middle, foot, &mut least);
            waiting.push(candidate(next.from, middle, [next.ends[0], foot]));
            waiting.push(candidate(middle, next.to, [foot, next.ends[1]]));
        }
        (least, best)
    }
}

/// How far above the true value a distance found by [`CurveDistance::nearest`] may be, mm.
fn slack(distance: f64) -> f64 {
    NEAR_MM + NEAR_SHARE * distance
}

/// Distance of a point from a segment.
fn from_segment(point: &Vec3, ends: &[Vec3; 2]) -> f64 {
    let (way, off) = (ends[1] - ends[0], point - ends[0]);
    let length2 = way.norm_squared();
    if length2 <= 0.0 {
        return off.norm();
    }
    (off - way * (off.dot(&way) / length2).clamp(0.0, 1.0)).norm()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn piece(feet: [f64; 2], far: [f64; 2]) -> Piece<Radii> {
        // W stands at the origin at both ends; the feet lie as far from it as `far` says
        let near = |s: f64, foot: f64| Radii {
            s,
            point: Vec3::zeros(),
            foot: Vec3::x() * foot,
        };
        Piece {
            from: 0.0,
            to: 0.5,
            value_from: 1.0,
            value_to: 2.0,
            tag_from: near(feet[0], far[0]),
            tag_to: near(feet[1], far[1]),
        }
    }

    /// W'' at most 8, so 2 on half a block; S'' at most 50.
    fn over(feet: [f64; 2], far: [f64; 2]) -> f64 {
        let stray = CurveDistance {
            point: |_: f64| Vec3::zeros(),
            point_bend: 8.0,
            curve: |_: f64| Vec3::zeros(),
            curve_bend: 50.0,
        };
        stray.over(&piece(feet, far))
    }

    #[test]
    fn the_least_of_three_ways_to_choose_the_foot_is_the_bound() {
        // feet 0.1 apart: 0.5 of the curve, less than the point's own 2
        assert!((over([0.2, 0.3], [0.0, 0.0]) - (2.0 + 2.5 / 8.0)).abs() < 1e-12);
        // 0.4 apart: 8; at the first foot the far end is 2.5 away, at the second the near end 2.6
        assert!((over([0.2, 0.6], [2.5, 2.6]) - 2.75).abs() < 1e-12);
        assert!((over([0.2, 0.6], [2.6, 2.5]) - 2.75).abs() < 1e-12);
        // standing feet are worse: 2 + 10 / 8
        assert!((over([0.2, 0.6], [9.0, 9.0]) - 3.25).abs() < 1e-12);
        // the end at which the foot is found counts too
        assert!((over([0.2, 0.6], [0.5, 9.0]) - 1.25).abs() < 1e-12);
        assert!((over([0.2, 0.6], [9.0, 0.5]) - 2.25).abs() < 1e-12);
    }

    /// A spike of the curve that a thousand samples miss comes within 0.01 mm of the point: the sampled value is not larger.
    #[test]
    fn a_foot_that_was_not_found_is_allowed_for() {
        let spike = |s: f64| {
            let off = (s - 0.712_345_6) * 1e7;
            Vec3::new(0.0, 4.99 / (1.0 + off * off), 0.0)
        };
        let stray = CurveDistance {
            point: |_: f64| Vec3::new(0.0, 5.0, 0.0),
            point_bend: 0.0,
            curve: spike,
            curve_bend: 1e15,
        };
        let found = stray.farthest(|_, _, samples| samples > 4);
        assert!(found.sampled <= 0.01 + 1e-9, "{found:?}");
    }
}
