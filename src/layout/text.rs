//! The layout of a whole text: blocks, blank lines, line ends.
use crate::apt;
use crate::blanks::{common_line_end, is_empty, line_end};
use crate::iso::Blocks;
use crate::nesting::Nesting;
use crate::style::Style;
use trunnion_dialect::Dialect;
use trunnion_syntax::{Block, Format, Item, Program};

/// The text in the given style. A text in which lone carriage returns are mixed with other line ends stays as it is, and for LinuxCNC
/// each one with a lone carriage return, which does not end a line there. What follows the closing `%` is not part of the program
/// and stays byte for byte.
pub(crate) fn lay_out(program: &Program, dialect: &Dialect, style: &Style) -> Vec<u8> {
    let ending = common_line_end(program).filter(|ending| !(dialect.quirks.rs274() && *ending == b"\r"));
    let Some(ending) = ending else {
        return program.source().to_vec();
    };
    let blocks = Blocks {
        program,
        dialect,
        style,
    };
    let mut out = Vec::with_capacity(program.source().len() + program.source().len() / 8);
    let mut nesting = Nesting::default();
    let (mut blank_lines, mut percents, mut any) = (0, 0, false);
    for block in program.blocks() {
        if percents > 1 {
            out.extend_from_slice(&program.source()[block.range().start as usize..]);
            return out;
        }
        let own_ending = line_end(&block);
        if is_empty(&block) {
            blank_lines += u32::from(any);
            continue;
        }
        // a byte order mark would become significant
        let bom = !any && program.source()[block.range().as_usize()].starts_with(b"\xEF\xBB\xBF");
        if bom {
            out.extend_from_slice(&program.source()[..block.range().start as usize]);
        }
        for _ in 0..blank_lines.min(u32::from(style.blank_lines)) {
            out.extend_from_slice(ending);
        }
        (blank_lines, any) = (0, true);
        if program.options().format.has_words() {
            let depth = nesting.depth(&block);
            blocks.write(&block, depth, &mut out);
            percents += u32::from(is_bare_percent(&block));
        } else {
            apt::write(program, &block, &mut out);
        }
        let stays = || match program.options().format {
            Format::Apt | Format::Klartext => apt::stays(program, &block) || apt::continues(program, &block),
            Format::Iso | Format::Osp => blocks.stays(&block),
        };
        if !(own_ending.is_empty() && stays()) {
            // after a lone carriage return that ends a continuation, a line feed would belong to it
            let joins = ending == b"\n" && out.ends_with(b"\r");
            out.extend_from_slice(if joins { own_ending } else { ending });
        }
    }
    out
}

/// Whether a block is a `%` without a name.
fn is_bare_percent(block: &Block<'_>) -> bool {
    let Some(Item::Percent(range)) = block.items().next() else {
        return false;
    };
    range.end - range.start == 1
}
