//! Chains of calls that led to a line.
use super::labels::{Labels, NameId, Style};
use crate::{ChainId, FileId, Frame};
use foldhash::HashMap;
use std::sync::Arc;

#[derive(Clone, Debug)]
struct Link {
    parent: ChainId,
    file: FileId,
    line: u32,
    name: NameId,
    style: Style,
}

/// The key of a chain: the chain that led to the call, and the line of the call.
type Key = (ChainId, FileId, u32);

#[derive(Clone, Debug, Default)]
struct Table {
    /// The call that made chain n + 1.
    links: Vec<Link>,
    known: Known,
}

/// Chains by their keys. A program that calls as it continues meets them in order, and a list is enough.
#[derive(Clone, Debug, Default)]
struct Known {
    in_order: Vec<(Key, ChainId)>,
    /// Those that were met after a greater one.
    others: HashMap<Key, ChainId>,
}

impl Known {
    /// Whether a key is greater than all before: then it is new.
    fn is_next(&self, key: &Key) -> bool {
        self.in_order.last().is_none_or(|(last, _)| last < key)
    }
    fn get(&self, key: &Key) -> Option<ChainId> {
        if self.is_next(key) {
            return None;
        }
        match self.in_order.binary_search_by(|(own, _)| own.cmp(key)) {
            Ok(at) => Some(self.in_order[at].1),
            Err(_) => self.others.get(key).copied(),
        }
    }
    /// Adds a new one.
    fn add(&mut self, key: Key, id: ChainId) {
        if self.is_next(&key) {
            self.in_order.push((key, id));
        } else {
            self.others.insert(key, id);
        }
    }
}

/// Every chain of calls of a run, once. Cloning is cheap.
#[derive(Clone, Debug, Default)]
pub(crate) struct Chains(Arc<Table>);

impl Chains {
    /// The chain of a call made at a line that itself was reached by `parent`.
    pub(crate) fn call(&mut self, parent: ChainId, (file, line): (FileId, u32), name: NameId, style: Style) -> ChainId {
        let key = (parent, file, line);
        if let Some(id) = self.0.known.get(&key) {
            return id;
        }
        let table = Arc::make_mut(&mut self.0);
        table.links.push(Link {
            parent,
            file,
            line,
            name,
            style,
        });
        let id = ChainId(table.links.len() as u32);
        table.known.add(key, id);
        id
    }
    /// How many there are.
    pub(crate) fn count(&self) -> usize {
        self.0.links.len()
    }
    /// The calls of a chain, outermost first.
    pub(crate) fn frames(&self, id: ChainId, labels: &Labels) -> Vec<Frame> {
        let mut frames = Vec::new();
        let mut id = id;
        while let Some(link) = (id.0 as usize).checked_sub(1).and_then(|at| self.0.links.get(at)) {
            let text = labels.text(link.name);
            let what = match link.style {
                Style::Sub if text.parse::<i64>().is_ok() => format!("o{text} call"),
                Style::Sub => format!("o<{text}> call"),
                Style::Fanuc => format!("M98 P{text}"),
            };
            let (file, line) = (link.file, link.line);
            frames.push(Frame { file, line, what });
            id = link.parent;
        }
        frames.reverse();
        frames
    }
}

#[cfg(test)]
mod tests {
    use super::{Chains, HashMap};
    use crate::flow::labels::{NameId, Style};
    use crate::{ChainId, FileId};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn each_call_has_one_chain(calls in proptest::collection::vec((0..4_u32, 0..2_u32, 0..9_u32), 0..80), in_order: bool) {
            let mut calls = calls;
            if in_order {
                calls.sort_unstable();
            }
            let mut chains = Chains::default();
            let mut plain = HashMap::default();
            for (parent, file, line) in calls {
                let known = plain.len() as u32;
                let id = chains.call(ChainId(parent), (FileId(file), line), NameId::MAIN, Style::Sub);
                let expected = *plain.entry((parent, file, line)).or_insert(ChainId(known + 1));
                prop_assert_eq!(id, expected);
            }
        }
    }
}
