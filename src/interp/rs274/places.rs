//! Where lines of called files are: the calls that led there, the line itself, and the block of the main program that represents it.
use std::collections::HashMap;
use std::sync::Arc;
use trunnion_ngc::{At, ChainId, FileId};
use trunnion_syntax::BlockId;

/// Places kept; motions of lines beyond them are emitted with their calls alone.
const KEPT: usize = 1 << 16;

#[derive(Clone, Debug, Default)]
struct Table {
    /// The place of chain n + 1.
    places: Vec<At>,
    known: HashMap<At, crate::ChainId>,
    /// The block of the main program where a chain of calls starts.
    callers: HashMap<ChainId, BlockId>,
}

/// See the module. Cloning is cheap.
#[derive(Clone, Debug, Default)]
pub(super) struct Places {
    table: Arc<Table>,
    /// The block of the main program that ran last.
    last: BlockId,
}

impl Places {
    /// How many entries the first change after a copy copies.
    pub(super) fn copied(&self) -> usize {
        self.table.places.len() + self.table.callers.len()
    }
    /// A line has run: `block` where it is one of the main program.
    #[inline]
    pub(super) fn ran(&mut self, chain: ChainId, block: Option<BlockId>) {
        match block {
            Some(block) => self.last = block,
            None => self.ran_elsewhere(chain),
        }
    }
    #[inline(never)]
    fn ran_elsewhere(&mut self, chain: ChainId) {
        if !self.table.callers.contains_key(&chain) {
            let last = self.last;
            Arc::make_mut(&mut self.table).callers.insert(chain, last);
        }
    }
    /// The block of the main program where the chain of calls starts: for a new chain, the one that ran last.
    pub(super) fn caller(&self, chain: ChainId) -> BlockId {
        self.table.callers.get(&chain).copied().unwrap_or(self.last)
    }
    /// The chain with which a motion at a line is emitted: in a called file it ends with the line itself.
    #[inline]
    pub(super) fn chain(&mut self, at: At) -> crate::ChainId {
        if at.file == FileId::MAIN && at.chain == ChainId::default() {
            crate::ChainId::MAIN
        } else {
            self.called(at)
        }
    }
    /// The same elsewhere than in the main program itself.
    fn called(&mut self, at: At) -> crate::ChainId {
        let mut at = at;
        if at.file == FileId::MAIN {
            at.line = 0;
        }
        if let Some(known) = self.table.known.get(&at) {
            return *known;
        }
        if self.table.places.len() >= KEPT && at.file != FileId::MAIN {
            // its calls alone, as a line of the main program has them
            at.file = FileId::MAIN;
            return self.chain(at);
        }
        let table = Arc::make_mut(&mut self.table);
        table.places.push(at);
        let id = crate::ChainId(table.places.len() as u32);
        table.known.insert(at, id);
        id
    }
    /// The place of a chain.
    pub(super) fn place(&self, chain: crate::ChainId) -> At {
        let place = (chain.0 as usize).checked_sub(1);
        place
            .and_then(|place| self.table.places.get(place))
            .copied()
            .unwrap_or_default()
    }
}
