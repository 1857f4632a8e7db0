//! Blocks with a `/`, which run or not as a switch of the control says.
use trunnion_dialect::Dialect;
use trunnion_syntax::{Block, Item, Program, TextRange};

/// The `/` of a block with its level, if it deletes anything: it begins the block, or is inside it in dialects that allow that.
pub fn slash(block: &Block<'_>, dialect: &Dialect) -> Option<(u8, TextRange)> {
    let mut items = block.items();
    let first = items.next()?;
    let found = if let Item::Skip(level, range) = first {
        (skip_level(level, &block.program().text(range), dialect), range)
    } else if dialect.quirks.delete_rest {
        let range = items.find_map(|item| match item {
            Item::Other(range) if block.program().bytes(range).starts_with(b"/") => Some(range),
            _ => None,
        })?;
        let digits = block.program().text(TextRange::new(range.start + 1, range.end));
        (digits.parse().unwrap_or(1), range)
    } else {
        return None;
    };
    items.any(|item| !matches!(item, Item::Comment(_))).then_some(found)
}

/// The level of a block delete as it is written: `/` alone is level 0 on a Sinumerik, which counts from 0 (Programming Manual, Fundamentals,
/// skipping blocks), and level 1 elsewhere.
pub(crate) fn skip_level(level: u8, written: &str, dialect: &Dialect) -> u8 {
    let bare = written.trim() == "/";
    if bare && dialect.quirks.declares_names() {
        0
    } else {
        level
    }
}

/// The levels of the blocks that have a `/` which deletes anything, ascending, each once, and how many blocks they are.
pub fn deleted_levels(program: &Program, dialect: &Dialect) -> (Vec<u8>, usize) {
    let (mut levels, mut count) = (Vec::new(), 0);
    for (level, _) in program.blocks().filter_map(|block| slash(&block, dialect)) {
        count += 1;
        levels.push(level);
    }
    levels.sort_unstable();
    levels.dedup();
    (levels, count)
}
