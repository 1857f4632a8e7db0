//! Folding: programs and operations, bodies of loops and subprograms, runs of comments.
use crate::{Names, Node, outline};
use trunnion_dialect::Dialect;
use trunnion_layout::depths;
use trunnion_syntax::{BlockId, Item, Program, TextRange};

/// A region that can be folded.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Fold {
    /// From the first block to the last one.
    pub range: TextRange,
    /// It is a run of comments.
    pub comment: bool,
}

/// The regions of a program.
pub fn folds(program: &Program, dialect: &Dialect, names: &Names) -> Vec<Fold> {
    let mut found = Vec::new();
    nodes(program, &outline(program, dialect, names), &mut found);
    bodies(program, &mut found);
    comments(program, &mut found);
    found.sort_unstable();
    found.dedup();
    found
}

fn lines(program: &Program, first: u32, last: u32, comment: bool, found: &mut Vec<Fold>) {
    if last > first {
        let range = program
            .block(BlockId(first))
            .range()
            .cover(program.block(BlockId(last)).range());
        found.push(Fold { range, comment });
    }
}

fn nodes(program: &Program, list: &[Node], found: &mut Vec<Fold>) {
    for node in list {
        let last = program.bytes(node.range).trim_ascii_end().len() as u32;
        let range = TextRange::new(node.range.start, node.range.start + last);
        if program.bytes(range).contains(&b'\n') {
            found.push(Fold { range, comment: false });
        }
        nodes(program, &node.children, found);
    }
}

/// Each body with the line that opens it.
fn bodies(program: &Program, found: &mut Vec<Fold>) {
    let depths = depths(program);
    let mut open: Vec<u32> = Vec::new();
    for (at, depth) in depths.iter().enumerate() {
        let at = at as u32;
        while open.len() > usize::from(*depth) {
            if let Some(first) = open.pop() {
                lines(program, first, at - 1, false, found);
            }
        }
        while open.len() < usize::from(*depth) {
            open.push(at.saturating_sub(1));
        }
    }
    let last = depths.len().saturating_sub(1) as u32;
    for first in open {
        lines(program, first, last, false, found);
    }
}

fn comments(program: &Program, found: &mut Vec<Fold>) {
    let mut first = None;
    for block in program.blocks() {
        let id = block.id().0;
        let begins = matches!(
            program
                .bytes(block.range())
                .iter()
                .find(|byte| !byte.is_ascii_whitespace()),
            Some(b'(' | b';' | b'$' | b'/')
        );
        let only =
            begins && block.comments().next().is_some() && block.items().all(|item| matches!(item, Item::Comment(_)));
        match (only, first) {
            (true, None) => first = Some(id),
            (false, Some(start)) => {
                lines(program, start, id - 1, true, found);
                first = None;
            }
            _ => {}
        }
    }
    if let Some(start) = first {
        lines(program, start, program.block_count() as u32 - 1, true, found);
    }
}
