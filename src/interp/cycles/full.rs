//! When no more motions of cycles are made.
use crate::core::Report;
use crate::iso::Iso;
use crate::words::Words;

/// Motions of one block that are computed: they are held until the block is done.
const MOST_MOTIONS: usize = 200_000;

impl Iso<'_> {
    /// Whether the current block, or the cycles of the run together, have made more motions than are computed. What makes many motions, or works
    /// much out, asks before.
    pub(crate) fn is_full(&self) -> bool {
        self.memory.out.len() > MOST_MOTIONS || self.cycle_motions.is_over(self.core.setup.limits.blocks)
    }

    /// Why a block is full.
    pub(crate) fn full(&self) -> String {
        let all = self.cycle_motions.over(self.core.setup.limits.blocks);
        all.unwrap_or_else(|| format!("more than {MOST_MOTIONS} motions in one block"))
    }

    pub(super) fn too_many(&mut self, words: &Words, axis: usize, report: &mut Report<'_>) {
        let why = self.full();
        self.lost(words, axis, &why, report);
    }
}
