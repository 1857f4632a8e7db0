//! When no more motions of cycles are made.
use crate::core::Report;
use crate::iso::Iso;
use crate::words::Words;

impl Iso<'_> {
    /// Whether the current block, or the cycles of the run together, have made more motions than are computed. What makes many motions, or works
    /// much out, asks before.
    pub(crate) fn is_full(&self) -> bool {
        self.cycle_motions
            .is_full(self.memory.out.len(), self.core.setup.limits.blocks)
    }

    /// Why a block is full.
    pub(crate) fn full(&self) -> String {
        let why = self
            .cycle_motions
            .full(self.memory.out.len(), self.core.setup.limits.blocks);
        why.unwrap_or_else(|| "more motions than are computed".to_owned())
    }

    pub(super) fn too_many(&mut self, words: &Words, axis: usize, report: &mut Report<'_>) {
        let why = self.full();
        self.lost(words, axis, &why, report);
    }
}
