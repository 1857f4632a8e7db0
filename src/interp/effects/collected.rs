//! Effects that a run has collected.
use crate::{Argument, Effect, Placed};

/// Effects of the block in hand, collected only where somebody asks for them.
#[derive(Clone, Debug, Default)]
pub(crate) struct Effects {
    /// Somebody asks for them.
    pub(crate) wanted: bool,
    /// How many there were so far in the run.
    pub(crate) count: u32,
    /// Words of blocks that shift or turn the coordinates and were held by known positions so far.
    pub(crate) frames: Vec<Vec<Argument>>,
    /// Not handed on yet.
    pub(crate) ready: Vec<Placed>,
}

impl Effects {
    pub(crate) fn add(&mut self, block: trunnion_syntax::BlockId, effect: Effect) {
        self.count += 1;
        self.ready.push(Placed { block, effect });
    }
}
