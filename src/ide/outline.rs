//! The outline: programs, and in them operations (from one tool change to the next), labels and macros.
use crate::names::{Kind, Names, Occurrence, Role};
use crate::text::{codes, trimmed};
use trunnion_dialect::Action;
use trunnion_dialect::Dialect;
use trunnion_syntax::{Address, AptArg, Block, BlockId, Item, Program, TextRange, Value};

/// What an entry is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NodeKind {
    /// A program or subprogram.
    Program,
    /// What one tool does.
    Operation,
    /// A label or a block that is jumped to.
    Label,
}

/// One entry.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Node {
    /// What people read.
    pub name: String,
    /// More about it.
    pub detail: String,
    /// What it is.
    pub kind: NodeKind,
    /// Everything that belongs to it.
    pub range: TextRange,
    /// Where its name stands.
    pub selection: TextRange,
    /// What is inside.
    pub children: Vec<Node>,
}

/// An operation: its first block, tool and name.
struct Operation {
    first: BlockId,
    last: BlockId,
    title: String,
    detail: String,
}

/// The outline of a program.
pub fn outline(program: &Program, dialect: &Dialect, names: &Names) -> Vec<Node> {
    let count = program.block_count() as u32;
    if count == 0 {
        return Vec::new();
    }
    let mut bounds: Vec<BlockId> = vec![BlockId(0)];
    bounds.extend(
        names
            .parts
            .iter()
            .map(|(first, _)| *first)
            .filter(|first| first.0 > 0 && first.0 < count),
    );
    bounds.dedup();
    let operations = operations(program, dialect, &bounds);
    let mut roots = Vec::new();
    let mut room = LISTED;
    for (at, first) in bounds.iter().enumerate() {
        let end = bounds.get(at + 1).map_or(count, |next| next.0);
        let last = BlockId(end - 1);
        let whole = program.block(*first).range().cover(program.block(last).range());
        let part = Part {
            operations: within(&operations, *first, BlockId(end)),
            names: names_in(names, whole),
        };
        let children = part.children(program, &mut room);
        match part.program() {
            Some(own) if take(&mut room) => {
                let block = program.block_at(own.range.start).unwrap_or(*first);
                roots.push(Node {
                    name: program.text(trimmed(program, mark(program, own.range))).into_owned(),
                    detail: comment(&program.block(block)).unwrap_or_default(),
                    kind: NodeKind::Program,
                    range: whole,
                    selection: own.range,
                    children,
                });
            }
            _ => roots.extend(children),
        }
    }
    roots
}

/// So many entries are listed: an editor shows no more, and each costs kilobytes on its way there.
const LISTED: u32 = 20_000;

/// Takes the room of one more entry, if there is some.
fn take(room: &mut u32) -> bool {
    let left = room.checked_sub(1);
    *room = left.unwrap_or_default();
    left.is_some()
}

/// The operations that begin in some blocks; all are in the order of the blocks.
fn within(all: &[Operation], from: BlockId, to: BlockId) -> &[Operation] {
    let place = |block| all.partition_point(|one| one.first < block);
    &all[place(from)..place(to)]
}

/// The names in a range; all names are in the order of their places.
fn names_in(names: &Names, whole: TextRange) -> &[Occurrence] {
    let from = names.all.partition_point(|one| one.range.start < whole.start);
    let to = names.all.partition_point(|one| one.range.start < whole.end);
    &names.all[from..to]
}

/// A program of a file.
struct Part<'a> {
    operations: &'a [Operation],
    names: &'a [Occurrence],
}

impl Part<'_> {
    /// Where its own name stands.
    fn program(&self) -> Option<&Occurrence> {
        let mut names = self.names.iter();
        names.find(|one| one.kind == Kind::Program && one.role == Role::Definition)
    }

    /// Its operations with their labels, and the labels outside of them.
    fn children(&self, program: &Program, room: &mut u32) -> Vec<Node> {
        let operation = |one: &Operation| Node {
            name: one.title.clone(),
            detail: one.detail.clone(),
            kind: NodeKind::Operation,
            range: program.block(one.first).range().cover(program.block(one.last).range()),
            selection: trimmed(program, program.block(one.first).range()),
            children: Vec::new(),
        };
        let listed = self.operations.iter().take_while(|_| take(room));
        let mut operations: Vec<Node> = listed.map(operation).collect();
        let mut loose = Vec::new();
        let is_label =
            |one: &&Occurrence| matches!(one.kind, Kind::Label | Kind::Block) && one.role == Role::Definition;
        for label in self.names.iter().filter(is_label) {
            let Some(block) = program.block_at(label.range.start) else {
                continue;
            };
            if !take(room) {
                break;
            }
            let node = Node {
                name: program.text(trimmed(program, mark(program, label.range))).into_owned(),
                detail: String::new(),
                kind: NodeKind::Label,
                range: program.block(block).range(),
                selection: label.range,
                children: Vec::new(),
            };
            let after = operations.partition_point(|one| one.range.start <= node.range.start);
            let around = operations[..after].last_mut();
            match around.filter(|one| node.range.end <= one.range.end) {
                Some(operation) => operation.children.push(node),
                None => loose.push(node),
            }
        }
        operations.append(&mut loose);
        operations.sort_by_key(|one| one.range.start);
        operations
    }
}

/// A name with the letter in front of it: `O100`, `N20`, `o<name>`.
fn mark(program: &Program, range: TextRange) -> TextRange {
    let before = &program.source()[..range.start as usize];
    let open = before.len() - usize::from(before.ends_with(b"<"));
    let letter = before[..open]
        .last()
        .is_some_and(|byte| matches!(byte, b'O' | b'o' | b'N' | b'n' | b':'));
    let start = if letter { open - 1 } else { open };
    let close = u32::from(open < before.len() && program.source().get(range.end as usize) == Some(&b'>'));
    TextRange::new(start as u32, range.end + close)
}

fn comment(block: &Block<'_>) -> Option<String> {
    let text = |range| block.program().text(range).trim().to_owned();
    block
        .comments()
        .map(|comment| text(comment.inner))
        .find(|text| !text.is_empty())
}

fn operations(program: &Program, dialect: &Dialect, bounds: &[BlockId]) -> Vec<Operation> {
    let mut found: Vec<Operation> = Vec::new();
    let (mut tool, mut said) = (None, None);
    for block in program.blocks() {
        let begins = bounds.binary_search(&block.id()).is_ok();
        if let (true, Some(last)) = (begins && block.id().0 > 0, found.last_mut()) {
            last.last = last.last.min(BlockId(block.id().0 - 1));
        }
        if begins {
            said = None;
        }
        let named = named_tool(dialect, &block);
        let change = changes(dialect, &block, named.is_some());
        let text = comment(&block);
        if let Some(named) = named {
            tool = Some(named);
        }
        if change {
            if let Some(last) = found.last_mut() {
                last.last = last.last.min(BlockId(block.id().0 - 1));
            }
            let detail = text.or_else(|| said.take()).unwrap_or_default();
            let title = tool.clone().unwrap_or_else(|| "tool change".to_owned());
            found.push(Operation {
                first: block.id(),
                last: BlockId(program.block_count() as u32 - 1),
                title,
                detail,
            });
            said = None;
        } else if let Some(text) = text {
            said = Some(text);
        }
    }
    found
}

/// The tool that a block names: `T5`, `T="DRILL"`, LOADTL/5.
fn named_tool(dialect: &Dialect, block: &Block<'_>) -> Option<String> {
    let program = block.program();
    if let Some(record) = block.record() {
        let code = dialect.name(&program.text(record.major))?;
        let number = record.args().find_map(|argument| match argument {
            AptArg::Number(_, range) => Some(program.text(range).into_owned()),
            _ => None,
        });
        return (code.action == Action::ToolChange).then(|| format!("T{}", number.unwrap_or_default()));
    }
    let bytes = program.bytes(block.range());
    if !bytes.iter().any(|byte| matches!(byte, b'T' | b't')) {
        return None;
    }
    block.items().find_map(|item| match item {
        Item::Word(word)
            if matches!(word.address, Address::Letter(b'T'))
                && dialect.role(b'T') == Some(trunnion_dialect::Role::Tool) =>
        {
            match word.value {
                Value::Number(number) => {
                    let number = number.to_integer().and_then(|number| u32::try_from(number).ok())?;
                    (number > 0).then(|| format!("T{}", dialect.quirks.tool_word.tool(number)))
                }
                Value::Text(range) => Some(format!("T {}", program.text(range).trim_matches('"'))),
                _ => Some(program.text(word.range).into_owned()),
            }
        }
        _ => None,
    })
}

/// Whether a block changes the tool.
fn changes(dialect: &Dialect, block: &Block<'_>, names_tool: bool) -> bool {
    if names_tool && (dialect.quirks.tool_word.changes() || block.record().is_some()) {
        return true;
    }
    let bytes = block.program().bytes(block.range());
    let possible = block.record().is_some() || bytes.iter().any(|byte| matches!(byte, b'M' | b'm'));
    possible
        && codes(dialect, block)
            .iter()
            .any(|(code, _)| code.action == Action::ToolChange)
}

#[cfg(test)]
mod tests {
    use super::{LISTED, Node, NodeKind, outline};
    use std::fmt::Write;

    fn of(text: String) -> Vec<Node> {
        let dialect = trunnion_dialect::builtin("linuxcnc").expect("built in");
        let program = trunnion_syntax::parse(text.into_bytes(), dialect.lex);
        let names = crate::names(&program, dialect);
        outline(&program, dialect, &names)
    }

    #[test]
    fn labels_stand_in_their_operations() {
        let found = of("o1 if [1]\no1 endif\nT1 M6\no2 if [1]\no2 endif\nT2 M6\no3 if [1]\no3 endif\nM2\n".into());
        let shape: Vec<(NodeKind, usize)> = found.iter().map(|node| (node.kind, node.children.len())).collect();
        let labels = |of: usize| found[of].children.len();
        assert_eq!(shape.len(), 3, "{shape:?}");
        assert_eq!(
            (found[0].kind, labels(1), labels(2)),
            (NodeKind::Label, 1, 1),
            "{found:?}"
        );
    }

    #[test]
    fn a_long_outline_ends() {
        let mut text = String::new();
        for label in 0..LISTED + 5000 {
            let _ = writeln!(text, "o{label} if [1]\no{label} endif");
        }
        let found = of(text);
        assert_eq!(found.len(), LISTED as usize);
    }
}
