//! The chains of calls of motions, each stored once.
use std::collections::HashMap;
use trunnion_vocabulary::{ChainId, Frame};

/// See the module.
#[derive(Clone, Debug, Default)]
pub struct Chains {
    calls: Vec<(ChainId, Frame)>,
    known: HashMap<(ChainId, u16, u32), ChainId>,
}

/// Chains kept; calls beyond them belong to the chain that made them.
const KEPT: usize = 1 << 16;

impl Chains {
    /// The chain of a call at `block` of `file`, made in the chain `parent`.
    pub fn enter(&mut self, parent: ChainId, file: u16, block: u32, frame: impl FnOnce() -> Frame) -> ChainId {
        let key = (parent, file, block);
        if let Some(known) = self.known.get(&key) {
            return *known;
        }
        if self.calls.len() >= KEPT {
            return parent;
        }
        self.calls.push((parent, frame()));
        let id = ChainId(self.calls.len() as u32);
        self.known.insert(key, id);
        id
    }

    /// The chain of the block `block` of the called file `file`, whose calls are those of `parent`.
    pub fn stand(&mut self, parent: ChainId, file: u16, block: u32, frame: impl FnOnce() -> Frame) -> ChainId {
        // no file has that many blocks: the place is not a call at the same block
        self.enter(parent, file, block | 1 << 31, frame)
    }

    /// How many there are.
    pub(crate) fn count(&self) -> usize {
        self.calls.len()
    }

    /// Its calls, outermost first.
    pub fn frames(&self, chain: ChainId) -> Vec<Frame> {
        let mut frames = Vec::new();
        let mut at = chain;
        while let Some((parent, frame)) = (at.0 as usize).checked_sub(1).and_then(|place| self.calls.get(place)) {
            frames.push(frame.clone());
            at = *parent;
        }
        frames.reverse();
        frames
    }
}
