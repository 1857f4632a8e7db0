//! Which blocks have run: one bit per block, so that a finding of a later pass is distinguished from one of the first.
use trunnion_syntax::BlockId;

/// A set of blocks.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Visited {
    bits: Vec<u64>,
}

impl Visited {
    /// Room for blocks `0..blocks`, none of them in.
    pub(crate) fn new(blocks: usize) -> Self {
        Self {
            bits: vec![0; blocks.div_ceil(64)],
        }
    }

    /// Whether the block is in.
    pub(crate) fn has(&self, block: BlockId) -> bool {
        self.bits
            .get(block.0 as usize / 64)
            .is_some_and(|word| word >> (block.0 % 64) & 1 == 1)
    }

    /// Puts in all that another set of the same program has.
    pub(crate) fn join(&mut self, other: &Self) {
        for (word, more) in self.bits.iter_mut().zip(&other.bits) {
            *word |= more;
        }
    }

    /// Puts a block in; whether it was new. Blocks there is no room for are not kept.
    pub(crate) fn add(&mut self, block: BlockId) -> bool {
        let Some(word) = self.bits.get_mut(block.0 as usize / 64) else {
            return false;
        };
        let bit = 1 << (block.0 % 64);
        let new = *word & bit == 0;
        *word |= bit;
        new
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_block_is_new_once() {
        let mut visited = Visited::new(65);
        for block in [0, 63, 64] {
            assert!(!visited.has(BlockId(block)));
            assert!(visited.add(BlockId(block)));
            assert!(!visited.add(BlockId(block)));
            assert!(visited.has(BlockId(block)));
        }
        assert!(!visited.has(BlockId(1)) && !visited.has(BlockId(9999)) && !visited.add(BlockId(9999)));
    }
}
