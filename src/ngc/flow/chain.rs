//! Chains of calls: how a line came to run.
use crate::{ChainId, FileId, Frame};
use foldhash::HashMap;
use std::sync::Arc;

#[derive(Clone, Debug)]
struct Link {
    parent: ChainId,
    frame: Frame,
}

#[derive(Clone, Debug, Default)]
struct Table {
    /// The call that made chain n + 1.
    links: Vec<Link>,
    known: HashMap<(ChainId, FileId, u32), ChainId>,
}

/// Every chain of calls of a run, once. Cloning is cheap.
#[derive(Clone, Debug, Default)]
pub(crate) struct Chains(Arc<Table>);

impl Chains {
    /// The chain of a call made at a line that itself was reached by `parent`.
    pub(crate) fn call(&mut self, parent: ChainId, file: FileId, line: u32, what: impl FnOnce() -> String) -> ChainId {
        let key = (parent, file, line);
        if let Some(&id) = self.0.known.get(&key) {
            return id;
        }
        let table = Arc::make_mut(&mut self.0);
        let frame = Frame {
            file,
            line,
            what: what(),
        };
        table.links.push(Link { parent, frame });
        let id = ChainId(table.links.len() as u32);
        table.known.insert(key, id);
        id
    }
    /// The calls of a chain, outermost first.
    pub(crate) fn frames(&self, id: ChainId) -> Vec<Frame> {
        let mut frames = Vec::new();
        let mut id = id;
        while let Some(link) = (id.0 as usize).checked_sub(1).and_then(|at| self.0.links.get(at)) {
            frames.push(link.frame.clone());
            id = link.parent;
        }
        frames.reverse();
        frames
    }
}
