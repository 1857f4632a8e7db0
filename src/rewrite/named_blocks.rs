//! Blocks that a program names by their number: a jump may lead there, whether the run takes it or not, so they keep all their words.
use std::collections::HashSet;
use trunnion_check::Settings;
use trunnion_layout::block_references;
use trunnion_syntax::{BlockId, LineIndex, Program};

/// The targets of jumps, returns and contours of a program, or why its blocks stay: a text or a word that is not followed may name one of them.
pub(crate) fn named_blocks(program: &Program, settings: &Settings<'_>) -> Result<HashSet<BlockId>, String> {
    let found = block_references(program, settings.dialect);
    if let Some(obstacle) = found.unread.first() {
        let (line, column) = LineIndex::new(program.source()).line_column(program.source(), obstacle.range.start);
        return Err(format!(
            "line {line}, column {column}: {}; that is not followed, so no block is changed",
            obstacle.why
        ));
    }
    let targets = found.references.iter().filter_map(|reference| reference.target);
    Ok(targets.map(|(block, _)| block).collect())
}
