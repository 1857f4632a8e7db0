//! The fewest pieces of a chain: the shortest path over its points, layer by layer.

/// So many points after the last one that can be reached are tried too: one piece may fit where a shorter one with the same start does not. Where
/// a piece has many points they lie densely, and that is rare.
fn ahead(points: usize) -> usize {
    match points {
        0..=16 => 32,
        17..=64 => 8,
        _ => 3,
    }
}

/// Parts of up to so many points end at any point. Longer ones are tried at points that are farther apart the more points they have: to try all would
/// take work with the square of a long line.
const DENSE: usize = 128;

/// Where pieces have more points than four times that, only the farthest of their ends, so many, are where others begin.
const STARTS: usize = 64;

/// How far to go on from a part of so many points.
fn stride(points: usize) -> usize {
    if points < DENSE { 1 } else { points / 16 }
}

/// The points from which pieces begin, found layer by layer.
struct Reached {
    /// Where the piece that ends at a point begins: [`Reached::NONE`], or [`Reached::PASSED`] where it is not known that one ends there.
    from: Vec<usize>,
    /// The first point that is not reached yet.
    open: usize,
}

impl Reached {
    const NONE: usize = usize::MAX;
    /// Points between two that were tried.
    const PASSED: usize = usize::MAX - 1;

    fn is_open(&self, point: usize) -> bool {
        self.from[point] == Self::NONE
    }

    /// A piece from `start` ends at `end`, unless it was reached before. Between `tried` and `end` no point was tried, and none will be.
    fn reach(&mut self, start: usize, tried: usize, end: usize, next: &mut Vec<usize>) {
        for passed in &mut self.from[tried + 1..end] {
            if *passed == Self::NONE {
                *passed = Self::PASSED;
            }
        }
        if self.is_open(end) {
            self.from[end] = start;
            next.push(end);
        }
    }

    /// Goes as far as a piece from `start` goes, and adds where it may end to `next`.
    fn go(&mut self, start: usize, next: &mut Vec<usize>, fits: &mut impl FnMut(usize, usize) -> bool) {
        let last = self.from.len() - 1;
        let (mut tried, mut failed) = (self.open.max(start + 1) - 1, 0);
        let mut end = tried + 1;
        while end <= last {
            if !self.is_open(end) {
                self.reach(start, tried, end, next);
                (tried, end) = (end, end + 1);
            } else if fits(start, end) {
                failed = 0;
                self.reach(start, tried, end, next);
                tried = end;
                // the last point is always tried
                end = (end + stride(end - start)).min(last.max(end + 1));
            } else if end == tried + 1 {
                failed += 1;
                if failed > ahead(end - start) {
                    break;
                }
                (tried, end) = (end, end + 1);
            } else {
                // it ends between two points that were tried: halving
                let (mut near, mut beyond) = (tried, end);
                while beyond - near > 1 {
                    let middle = usize::midpoint(near, beyond);
                    if self.is_open(middle) && fits(start, middle) {
                        near = middle;
                    } else {
                        beyond = middle;
                    }
                }
                if near > tried {
                    self.reach(start, tried, near, next);
                }
                break;
            }
        }
        while self.open <= last && !self.is_open(self.open) {
            self.open += 1;
        }
    }
}

/// The joints of a division of `0..=last` into the fewest pieces, both ends included. `fits(i, j)` says whether the part from `i` to `j` is
/// one piece; `fits(i, i + 1)` must be true.
pub(crate) fn fewest(last: usize, fits: &mut impl FnMut(usize, usize) -> bool) -> Vec<usize> {
    let mut reached = Reached {
        from: vec![Reached::NONE; last + 1],
        open: 1,
    };
    reached.from[0] = 0;
    let mut layer = vec![0];
    while reached.is_open(last) {
        let mut next = Vec::new();
        // the farthest start first: it decides how far the layer reaches
        for &start in layer.iter().rev() {
            reached.go(start, &mut next, fits);
        }
        next.sort_unstable();
        let long = next
            .last()
            .zip(layer.last())
            .is_some_and(|(end, start)| end - start > 4 * DENSE);
        if long && next.len() > STARTS {
            next.drain(..next.len() - STARTS);
        }
        layer = next;
    }
    let mut joints = vec![last];
    while let Some(&at) = joints.last().filter(|at| **at > 0) {
        joints.push(reached.from[at]);
    }
    joints.reverse();
    joints
}

#[cfg(test)]
mod tests {
    use super::fewest;

    #[test]
    fn it_finds_what_a_greedy_choice_misses() {
        // pieces of at most 3, but from 3 only single steps: 0-2-5-8 takes three, the greedy 0-3-4-7-8 four
        let mut fits = |i: usize, j: usize| j == i + 1 || j - i <= 3 && i != 3;
        assert_eq!(fewest(8, &mut fits).len() - 1, 3);
        // a long piece may fit where a shorter one does not
        let mut holes = |i: usize, j: usize| j == i + 1 || i == 0 && j == 9;
        assert_eq!(fewest(10, &mut holes), [0, 9, 10]);
    }

    #[test]
    fn single_steps_are_the_way_out() {
        assert_eq!(fewest(3, &mut |i, j| j == i + 1), [0, 1, 2, 3]);
    }

    /// Points that `fewest` looks at, if a piece is looked at from end to end, and how many pieces there are.
    fn effort(last: usize, fits: impl Fn(usize, usize) -> bool) -> (usize, usize) {
        let mut seen = 0;
        let pieces = fewest(last, &mut |i, j| {
            seen += j - i;
            j == i + 1 || fits(i, j)
        });
        (seen, pieces.len() - 1)
    }

    #[test]
    fn a_long_line_does_not_take_work_with_its_square() {
        for last in [20_000, 80_000] {
            let (seen, pieces) = effort(last, |_, _| true);
            assert_eq!(pieces, 1);
            assert!(seen < 100 * last, "{seen} for {last} points");
            // lines of 5000 points: one more where a layer passes over a corner
            let corner = |i: usize, j: usize| i / 5000 == (j - 1) / 5000;
            let (seen, pieces) = effort(last, corner);
            assert_eq!(pieces, last / 5000);
            assert!(seen < 600 * last, "{seen} for {last} points");
            // pieces of any 3000 points
            let (seen, pieces) = effort(last, |i, j| j - i <= 3000);
            assert_eq!(pieces, last.div_ceil(3000));
            assert!(seen < 600 * last, "{seen} for {last} points");
        }
    }
}
