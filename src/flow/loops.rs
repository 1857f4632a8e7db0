//! Loops and branches: which block closes what a block opens.

/// A loop or branch: the blocks that open and close it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Loop {
    /// `WHILE`, `DO`, `IF`, `FOR`.
    pub open: u32,
    /// `END`, `ENDWHILE`, `ENDIF`.
    pub close: u32,
    /// The `ELSE` of a branch.
    pub other: Option<u32>,
}

/// All complete loops and branches of a file.
#[derive(Clone, Debug, Default)]
pub struct Loops {
    /// Sorted by the opening block.
    pairs: Vec<Loop>,
    /// Place in `pairs` of the one around each.
    around: Vec<Option<usize>>,
    /// Closing block and place in `pairs`, sorted.
    ends: Vec<(u32, usize)>,
    /// `ELSE` and place in `pairs`, sorted.
    others: Vec<(u32, usize)>,
}

impl Loops {
    /// From pairs in any order that nest and do not cross.
    pub fn of(mut loops: Vec<Loop>) -> Self {
        loops.sort_unstable_by_key(|found| found.open);
        let mut around = Vec::with_capacity(loops.len());
        let mut stack: Vec<usize> = Vec::new();
        for (at, inner) in loops.iter().enumerate() {
            while stack.last().is_some_and(|&outer| loops[outer].close < inner.open) {
                stack.pop();
            }
            around.push(stack.last().copied());
            stack.push(at);
        }
        let mut ends: Vec<_> = loops.iter().enumerate().map(|(at, found)| (found.close, at)).collect();
        ends.sort_unstable();
        let other = |(at, found): (usize, &Loop)| found.other.map(|block| (block, at));
        let mut others: Vec<_> = loops.iter().enumerate().filter_map(other).collect();
        others.sort_unstable();
        Self {
            pairs: loops,
            around,
            ends,
            others,
        }
    }

    /// What a block opens.
    pub fn opened_by(&self, block: u32) -> Option<Loop> {
        let at = self.pairs.binary_search_by_key(&block, |found| found.open).ok()?;
        Some(self.pairs[at])
    }

    /// What a block closes.
    pub fn closed_by(&self, block: u32) -> Option<Loop> {
        let at = self.ends.binary_search_by_key(&block, |end| end.0).ok()?;
        Some(self.pairs[self.ends[at].1])
    }

    /// The branch whose `ELSE` a block is.
    pub fn divided_by(&self, block: u32) -> Option<Loop> {
        let at = self.others.binary_search_by_key(&block, |other| other.0).ok()?;
        Some(self.pairs[self.others[at].1])
    }

    /// What a jump enters from outside; `counts` chooses among loops and branches.
    pub fn entered(&self, from: u32, to: u32, counts: impl Fn(&Loop) -> bool) -> Option<Loop> {
        let mut at = self.pairs.partition_point(|found| found.open < to).checked_sub(1);
        while let Some(place) = at {
            let found = self.pairs[place];
            let inside = to <= found.close && !(found.open..=found.close).contains(&from);
            if inside && counts(&found) {
                return Some(found);
            }
            at = self.around[place];
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::{Loop, Loops};

    fn pair(open: u32, close: u32, other: Option<u32>) -> Loop {
        Loop { open, close, other }
    }

    #[test]
    fn partners_and_jumps_into_loops() {
        let loops = Loops::of(vec![
            pair(10, 12, None),
            pair(1, 20, None),
            pair(3, 8, Some(5)),
            pair(22, 24, None),
        ]);
        assert_eq!(loops.opened_by(3), Some(pair(3, 8, Some(5))));
        assert_eq!(loops.closed_by(12), Some(pair(10, 12, None)));
        assert_eq!(loops.divided_by(5), Some(pair(3, 8, Some(5))));
        assert_eq!(
            (loops.opened_by(8), loops.closed_by(3), loops.divided_by(6)),
            (None, None, None)
        );
        let entered = |from, to| loops.entered(from, to, |_| true).map(|found| found.open);
        assert_eq!(entered(2, 4), Some(3));
        assert_eq!(entered(2, 9), None);
        assert_eq!(entered(0, 9), Some(1));
        assert_eq!(entered(11, 2), None, "out of the inner loop");
        assert_eq!(entered(11, 23), Some(22));
        assert_eq!(entered(0, 1), None, "to the block that opens it");
        assert_eq!(
            loops
                .entered(0, 4, |found| found.other.is_none())
                .map(|found| found.open),
            Some(1)
        );
    }

    #[test]
    fn ten_thousand_nested_loops_are_quick() {
        let deep = Loops::of((0..10_000).map(|at| pair(at, 30_000 - at, None)).collect());
        assert_eq!(deep.entered(9_999, 15_000, |_| true), None);
        assert_eq!(deep.opened_by(5_000).map(|found| found.close), Some(25_000));
    }
}
