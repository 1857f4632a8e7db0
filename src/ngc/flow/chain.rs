//! Chains of calls: how a line came to run.
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
    pub(crate) fn call(&mut self, parent: ChainId, (file, line): (FileId, u32), name: NameId, style: Style) -> ChainId {
        let key = (parent, file, line);
        if let Some(&id) = self.0.known.get(&key) {
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
        table.known.insert(key, id);
        id
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
