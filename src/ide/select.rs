//! What "expand selection" takes: value, word, block, operation, program.
use crate::text::trimmed;
use crate::{Names, Node, outline};
use trunnion_dialect::Dialect;
use trunnion_syntax::{Item, Program, TextRange};

/// The ranges around a byte, from the smallest to the whole text; each holds the one before.
pub fn selections(program: &Program, dialect: &Dialect, names: &Names, offset: u32) -> Vec<TextRange> {
    let mut found = Vec::new();
    if let Some(name) = names.at(offset) {
        found.push(name.range);
    }
    if let Some(id) = program.block_at(offset) {
        let block = program.block(id);
        for item in block.items() {
            match item {
                Item::Word(word) => found.extend([word.value_range, word.range]),
                Item::Call(call) => found.extend(
                    [Some(call.name), call.arguments, Some(call.range)]
                        .into_iter()
                        .flatten(),
                ),
                Item::Comment(comment) => found.extend([comment.inner, comment.range]),
                Item::Skip(_, range) | Item::Percent(range) | Item::Label(range) | Item::Other(range) => {
                    found.push(range);
                }
            }
        }
        if let Some(record) = block.record() {
            found.extend([record.major, record.range]);
        }
        found.extend([trimmed(program, block.range()), block.range()]);
    }
    around(&outline(program, dialect, names), offset, &mut found);
    found.push(TextRange::new(0, program.source().len() as u32));
    found.retain(|range| range.start < range.end && range.start <= offset && offset <= range.end);
    found.sort_by_key(|range| range.end - range.start);
    let mut nested: Vec<TextRange> = Vec::new();
    for range in found {
        if nested
            .last()
            .is_none_or(|inner| range != *inner && range.start <= inner.start && inner.end <= range.end)
        {
            nested.push(range);
        }
    }
    nested
}

fn around(nodes: &[Node], offset: u32, found: &mut Vec<TextRange>) {
    for node in nodes.iter().filter(|node| node.range.touches(offset)) {
        found.push(node.range);
        around(&node.children, offset, found);
    }
}
