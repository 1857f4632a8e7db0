//! The largest value of a function on 0..=1 with a proof: samples from below, a curvature bound from above, bisection in between.
use core::cmp::Ordering;
use std::collections::BinaryHeap;

/// What is known about the largest value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Peak {
    /// Largest value at a sample: never above the truth.
    pub(crate) sampled: f64,
    /// Where that sample is, 0..=1.
    pub(crate) at: f64,
    /// Never below the truth.
    pub(crate) bound: f64,
    /// How many samples were taken.
    pub(crate) samples: u32,
}

/// A piece of 0..=1 with the function's values at its ends, and other data computed there.
#[derive(Clone, Copy)]
pub(crate) struct Piece<T = ()> {
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) value_from: f64,
    pub(crate) value_to: f64,
    pub(crate) tag_from: T,
    pub(crate) tag_to: T,
}

impl<T> Piece<T> {
    /// Bound where the second derivative is at most `curvature` (of a function whose chord has no value above its ends, such as the
    /// distance to a convex set): ends + q h^2 / 8, docs/kinematics.md#between-the-ends-of-a-block.
    pub(crate) fn below_parabola(&self, curvature: f64) -> f64 {
        let h = self.to - self.from;
        self.value_from.max(self.value_to) + curvature * h * h * 0.125
    }
    /// Bound where the slope is at most `slope`: the two lines that fall from the ends meet there.
    pub(crate) fn below_roof(&self, slope: f64) -> f64 {
        let h = self.to - self.from;
        let roof = 0.5 * (self.value_from + self.value_to + slope * h);
        roof.max(self.value_from).max(self.value_to)
    }
}

/// Most samples; the bound stays sound when they run out, but may be loose.
pub(crate) const SAMPLES: u32 = 20_000;

/// A piece below this length is not halved further: beyond any resolution of a block.
const SHORTEST: f64 = 1e-12;

/// A pending piece, ordered by its bound.
#[derive(Clone, Copy)]
struct Waiting<T> {
    bound: f64,
    piece: Piece<T>,
}

impl<T> PartialEq for Waiting<T> {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl<T> Eq for Waiting<T> {}

impl<T> PartialOrd for Waiting<T> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<T> Ord for Waiting<T> {
    fn cmp(&self, other: &Self) -> Ordering {
        self.bound.total_cmp(&other.bound)
    }
}

/// NaN is taken as infinite: nothing is known about it.
fn known(value: f64) -> f64 {
    if value.is_nan() { f64::INFINITY } else { value }
}

/// Finds the peak of `value` on 0..=1. `over` gives an upper bound on a piece; the search ends when `enough(largest bound, largest
/// sample, samples so far)`. The piece with the largest bound is halved first, so that no piece is halved in vain.
pub(crate) fn peak(
    value: impl Fn(f64) -> f64,
    over: impl Fn(&Piece) -> f64,
    enough: impl Fn(f64, f64, u32) -> bool,
) -> Peak {
    peak_tagged(|t| (value(t), ()), over, enough)
}

/// [`peak`] of a function that stores something at each sample for the bounds of the adjacent pieces.
pub(crate) fn peak_tagged<T: Copy>(
    value: impl Fn(f64) -> (f64, T),
    over: impl Fn(&Piece<T>) -> f64,
    enough: impl Fn(f64, f64, u32) -> bool,
) -> Peak {
    let value = |t: f64| {
        let (value, tag) = value(t);
        (known(value), tag)
    };
    let bounded = |piece: Piece<T>| Waiting {
        bound: known(over(&piece)),
        piece,
    };
    let (start, end) = (value(0.0), value(1.0));
    let whole = Piece {
        from: 0.0,
        to: 1.0,
        value_from: start.0,
        value_to: end.0,
        tag_from: start.1,
        tag_to: end.1,
    };
    let (mut sampled, mut at) = if end.0 > start.0 { (end.0, 1.0) } else { (start.0, 0.0) };
    let mut top = bounded(whole);
    let mut samples = 2;
    // grows only where the first bound does not settle the question
    let mut waiting = BinaryHeap::new();
    while !enough(top.bound, sampled, samples) {
        let piece = top.piece;
        if samples >= SAMPLES || sampled == f64::INFINITY || piece.to - piece.from < SHORTEST {
            break;
        }
        let middle = 0.5 * (piece.from + piece.to);
        let (v, tag) = value(middle);
        samples += 1;
        if v > sampled {
            (sampled, at) = (v, middle);
        }
        waiting.push(bounded(Piece {
            to: middle,
            value_to: v,
            tag_to: tag,
            ..piece
        }));
        waiting.push(bounded(Piece {
            from: middle,
            value_from: v,
            tag_from: tag,
            ..piece
        }));
        match waiting.pop() {
            Some(next) => top = next,
            None => break,
        }
    }
    Peak {
        sampled,
        at,
        bound: top.bound.max(sampled),
        samples,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trunnion_geometry::math::sin;

    #[test]
    fn parabola_bound_closes_on_the_peak() {
        // peak of t - t^2 is 1/4 at 1/2, curvature 2; here shifted so that no sample hits it
        let f = |t: f64| 0.25 - (t - 0.37) * (t - 0.37);
        let found = peak(f, |p| p.below_parabola(2.0), |bound, best, _| bound <= best + 1e-6);
        assert!(
            found.sampled <= 0.25 && found.bound >= 0.25 && found.bound - found.sampled <= 1e-6,
            "{found:?}"
        );
        assert!((found.at - 0.37).abs() < 1e-2);
    }

    #[test]
    fn roof_bound_is_never_below_the_truth() {
        let f = |t: f64| sin(7.0 * t);
        let found = peak(f, |p| p.below_roof(7.0), |bound, best, _| bound <= best + 1e-4);
        assert!(found.bound >= 1.0 && found.sampled <= 1.0 && found.bound - found.sampled <= 1e-4);
    }

    #[test]
    fn both_bounds_are_exact_where_they_can_be() {
        let piece = Piece {
            from: 0.25,
            to: 0.75,
            value_from: 1.0,
            value_to: 2.0,
            tag_from: (),
            tag_to: (),
        };
        assert_eq!(piece.below_parabola(16.0), 2.5);
        // lines of slope 4 meet at 2.5
        assert_eq!(piece.below_roof(4.0), 2.5);
        // too flat to reach the other end: that end counts
        assert_eq!(piece.below_roof(0.5), 2.0);
    }

    #[test]
    fn samples_run_out_but_the_bound_stays_sound() {
        let found = peak(|_| 0.0, |p| p.to - p.from, |_, _, _| false);
        assert!(found.bound >= 0.0);
        let found = peak(|_| f64::NAN, |_| 1.0, |_, _, _| false);
        assert_eq!(found.bound, f64::INFINITY);
    }
}
