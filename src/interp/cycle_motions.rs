//! How many motions the cycles of a run have made: they count for the bound on executed blocks, as the passes of a loop do.

/// Motions of one block that are computed: they are held until the block is done.
const MOST_HELD: usize = 200_000;

/// What cycles have made so far, or worked out in vain.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct CycleMotions(u64);

impl CycleMotions {
    /// A motion of a cycle.
    pub(crate) fn add(&mut self) {
        self.0 += 1;
    }

    /// So many steps were worked out and become no motion, because they are too many or not understood. They count as motions do: in a loop, or
    /// in a file of many holes, each pass works them out again.
    pub(crate) fn add_in_vain(&mut self, steps: u64) {
        self.0 += steps;
    }

    /// All of them.
    pub(crate) fn count(self) -> u64 {
        self.0
    }

    /// Why no more are made; `blocks`: the bound on executed blocks. `None`: there is room.
    pub(crate) fn over(self, blocks: u64) -> Option<String> {
        (self.0 > blocks).then(|| format!("more than {blocks} motions in the cycles of the program ([limits] blocks)"))
    }

    /// Whether no more are made.
    pub(crate) fn is_over(self, blocks: u64) -> bool {
        self.0 > blocks
    }

    /// Why no more are made in a block that holds so many motions; `None`: there is room.
    pub(crate) fn full(self, held: usize, blocks: u64) -> Option<String> {
        let block = || (held > MOST_HELD).then(|| format!("more than {MOST_HELD} motions in one block"));
        self.over(blocks).or_else(block)
    }

    /// The same without the words.
    pub(crate) fn is_full(self, held: usize, blocks: u64) -> bool {
        held > MOST_HELD || self.is_over(blocks)
    }
}

#[cfg(test)]
mod tests {
    use super::CycleMotions;

    #[test]
    fn motions_and_steps_in_vain_count_alike() {
        let mut made = CycleMotions::default();
        made.add_in_vain(2);
        assert_eq!((made.is_over(2), made.over(2)), (false, None));
        made.add();
        assert!(made.is_over(2));
        assert!(made.over(2).is_some_and(|why| why.contains("more than 2 motions")));
        assert!(made.is_full(0, 2) && !made.is_full(200_000, 3) && made.is_full(200_001, 3));
        assert_eq!(made.full(200_000, 3), None);
        assert!(made.full(200_001, 3).is_some_and(|why| why.contains("in one block")));
    }
}
