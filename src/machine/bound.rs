//! The largest value of a function on 0..=1 with a proof: samples from below, a curvature bound from above, bisection in between.

/// What is known of the largest value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Peak {
    /// Largest value at a sample: never above the truth.
    pub(crate) sampled: f64,
    /// Where that sample lies, 0..=1.
    pub(crate) at: f64,
    /// Never below the truth.
    pub(crate) bound: f64,
}

/// A piece of 0..=1 with the function's values at its ends.
#[derive(Clone, Copy)]
pub(crate) struct Piece {
    pub(crate) from: f64,
    pub(crate) to: f64,
    pub(crate) value_from: f64,
    pub(crate) value_to: f64,
}

impl Piece {
    /// Bound where the second derivative is at most `curvature` (of a function whose chord has no value above its ends, such as the
    /// distance to a convex set): ends + q h^2 / 8, kinematics notes 3.
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

/// Most pieces that wait at a time: each halving leaves one, and 2^-40 of a block is below any resolution.
const WAITING: usize = 44;

/// Most samples; the bound stays sound when they run out, but may be loose.
const SAMPLES: u32 = 50_000;

/// Finds the peak of `value` on 0..=1. `over` gives an upper bound on a piece; a piece is settled when `enough(its bound, largest
/// sample so far, samples so far)`. A value that is not a number counts as infinite.
pub(crate) fn peak(
    mut value: impl FnMut(f64) -> f64,
    over: impl Fn(&Piece) -> f64,
    enough: impl Fn(f64, f64, u32) -> bool,
) -> Peak {
    let mut value = |t: f64| {
        let v = value(t);
        if v.is_nan() { f64::INFINITY } else { v }
    };
    let whole = Piece {
        from: 0.0,
        to: 1.0,
        value_from: value(0.0),
        value_to: value(1.0),
    };
    let (mut sampled, mut at) = if whole.value_to > whole.value_from {
        (whole.value_to, 1.0)
    } else {
        (whole.value_from, 0.0)
    };
    let mut settled = sampled;
    let mut samples = 2;
    let mut waiting = [whole; WAITING];
    let mut count = 1;
    // once a piece has no finite bound the whole has none
    while count > 0 && settled < f64::INFINITY {
        count -= 1;
        let piece = waiting[count];
        let bound = over(&piece);
        let bound = if bound.is_nan() { f64::INFINITY } else { bound };
        if enough(bound, sampled, samples) || samples >= SAMPLES || count + 2 > WAITING || sampled == f64::INFINITY {
            settled = settled.max(bound);
            continue;
        }
        let middle = 0.5 * (piece.from + piece.to);
        let v = value(middle);
        samples += 1;
        if v > sampled {
            (sampled, at) = (v, middle);
        }
        let left = Piece {
            to: middle,
            value_to: v,
            ..piece
        };
        let right = Piece {
            from: middle,
            value_from: v,
            ..piece
        };
        // the more promising half first: a high sample settles the rest sooner
        let (later, sooner) = if piece.value_from > piece.value_to {
            (right, left)
        } else {
            (left, right)
        };
        waiting[count] = later;
        waiting[count + 1] = sooner;
        count += 2;
    }
    Peak {
        sampled,
        at,
        bound: settled.max(sampled),
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
    fn samples_run_out_but_the_bound_stays_sound() {
        let found = peak(|_| 0.0, |p| p.to - p.from, |_, _, _| false);
        assert!(found.bound >= 0.0);
        let found = peak(|_| f64::NAN, |_| 1.0, |_, _, _| false);
        assert_eq!(found.bound, f64::INFINITY);
    }
}
