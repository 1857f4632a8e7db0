//! The largest value of a function along one block with a proof, given what is already known to be reached elsewhere.
use core::cmp::Ordering;
use std::collections::BinaryHeap;

/// A function on a block: its value never changes faster than the path allows.
pub(crate) trait Climb {
    /// What is kept of a sample.
    type Sample: Copy;
    /// The sample at `t`, 0..=1, and its value.
    fn sample(&self, t: f64) -> (Self::Sample, f64);
    /// The largest distance that the path covers from one sample to another `h` later; and how much more a value between them may be than a
    /// straight path explains.
    fn way(&self, from: &Self::Sample, to: &Self::Sample, h: f64) -> (f64, f64);
    /// Whether no more samples are to be taken than those of the first pieces.
    fn is_spent(&self) -> bool {
        false
    }
}

/// What is known about the largest value on a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Top {
    /// Largest value at a sample.
    pub(crate) sampled: f64,
    /// Where.
    pub(crate) at: f64,
    /// Never below the truth.
    pub(crate) bound: f64,
    /// Samples that it took.
    pub(crate) samples: usize,
}

struct Piece<S> {
    from: (f64, S, f64),
    to: (f64, S, f64),
    bound: f64,
}

impl<S> PartialEq for Piece<S> {
    fn eq(&self, other: &Self) -> bool {
        self.bound.total_cmp(&other.bound) == Ordering::Equal
    }
}

impl<S> Eq for Piece<S> {}

impl<S> PartialOrd for Piece<S> {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<S> Ord for Piece<S> {
    fn cmp(&self, other: &Self) -> Ordering {
        self.bound.total_cmp(&other.bound)
    }
}

/// Most samples of a block; the bound stays sound when they run out, but may be loose.
pub(crate) const SAMPLES: usize = 50_000;

fn piece<C: Climb>(climb: &C, from: (f64, C::Sample, f64), to: (f64, C::Sample, f64)) -> Piece<C::Sample> {
    let (way, more) = climb.way(&from.1, &to.1, to.0 - from.0);
    let bound = (0.5 * (from.2 + to.2 + way)).max(from.2).max(to.2) + more;
    // not a number: nothing is known
    let bound = if bound.is_nan() { f64::INFINITY } else { bound };
    Piece { from, to, bound }
}

/// Halves the piece with the largest bound until no bound is above `reached` (or the largest sample) by more than `close`. Between two
/// samples a value is at most where the two slopes of 1 that fall from them meet. `most`: the largest number of samples, apart from those of the first pieces.
pub(crate) fn top<C: Climb>(climb: &C, first_pieces: usize, most: usize, reached: f64, close: f64) -> Top {
    let at = |t: f64| {
        let (sample, value) = climb.sample(t);
        (t, sample, value)
    };
    let mut best = (f64::NEG_INFINITY, 0.0);
    let mut note = |sample: &(f64, C::Sample, f64)| {
        if sample.2 > best.0 {
            best = (sample.2, sample.0);
        }
    };
    let mut heap = BinaryHeap::new();
    let mut last = at(0.0);
    note(&last);
    for i in 1..=first_pieces {
        let next = at(i as f64 / first_pieces as f64);
        note(&next);
        heap.push(piece(climb, last, next));
        last = next;
    }
    let mut samples = first_pieces + 1;
    while let Some(open) = heap.peek() {
        if open.bound <= best.0.max(reached) + close
            || samples >= most
            || climb.is_spent()
            || open.bound == f64::INFINITY
        {
            break;
        }
        let Some(open) = heap.pop() else { break };
        let middle = at(0.5 * (open.from.0 + open.to.0));
        samples += 1;
        if middle.2 > best.0 {
            best = (middle.2, middle.0);
        }
        heap.push(piece(climb, open.from, middle));
        heap.push(piece(climb, middle, open.to));
    }
    Top {
        sampled: best.0,
        at: best.1,
        bound: heap.peek().map_or(best.0, |open| open.bound.max(best.0)),
        samples,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A hill of slope 1 with its top at 1/3.
    struct Hill;

    impl Climb for Hill {
        type Sample = f64;
        fn sample(&self, t: f64) -> (f64, f64) {
            (t, 2.0 - (t - 1.0 / 3.0).abs())
        }
        fn way(&self, from: &f64, to: &f64, _h: f64) -> (f64, f64) {
            (to - from, 0.0)
        }
    }

    /// The same hill, of which nobody may take more samples.
    struct Spent;

    impl Climb for Spent {
        type Sample = f64;
        fn sample(&self, t: f64) -> (f64, f64) {
            Hill.sample(t)
        }
        fn way(&self, from: &f64, to: &f64, h: f64) -> (f64, f64) {
            Hill.way(from, to, h)
        }
        fn is_spent(&self) -> bool {
            true
        }
    }

    #[test]
    fn the_bound_of_the_first_pieces_holds() {
        let found = top(&Spent, 4, SAMPLES, 0.0, 1e-6);
        assert_eq!(found.samples, 5);
        assert!(found.sampled < 2.0 && found.bound >= 2.0, "{found:?}");
    }

    #[test]
    fn the_top_lies_between_sample_and_bound() {
        let found = top(&Hill, 1, SAMPLES, 0.0, 1e-6);
        assert!(
            found.sampled <= 2.0 && found.bound >= 2.0 && found.bound - found.sampled < 2e-6,
            "{found:?}"
        );
        assert!((found.at - 1.0 / 3.0).abs() < 1e-5);
        // a value that is reached elsewhere need not be searched here
        let found = top(&Hill, 1, SAMPLES, 5.0, 1e-6);
        assert!(found.bound < 5.0 && found.bound >= 2.0);
    }
}
