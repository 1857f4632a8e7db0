//! Blanks, line ends and columns of a text.
use trunnion_syntax::{Block, Program, TokenKind};

/// Whether a token's bytes are nothing but spaces and tabs. Other bytes that carry no meaning (NUL, form feed, a byte order mark,
/// the end-of-block mark of a listing) are not layout: lines that contain them stay as they are.
pub(crate) fn is_plain_blank(bytes: &[u8]) -> bool {
    bytes.iter().all(|byte| matches!(byte, b' ' | b'\t'))
}

/// Whether a block has no token but plain blanks.
pub(crate) fn is_empty(block: &Block<'_>) -> bool {
    let program = block.program();
    let table = program.tokens();
    block.tokens().all(|id| match table.kind(id) {
        TokenKind::Newline => true,
        TokenKind::Blank => is_plain_blank(program.bytes(table.range(id))),
        _ => false,
    })
}

/// The line end of a block as written; empty where it has none.
pub(crate) fn line_end<'p>(block: &Block<'p>) -> &'p [u8] {
    let program = block.program();
    let last = block.tokens().end - 1;
    match program.tokens().kind(last) {
        TokenKind::Newline => program.bytes(program.tokens().range(last)),
        _ => &[],
    }
}

/// The line end for the whole text; `None` if lone carriage returns are mixed with other line ends, so that it is unclear what
/// a line is.
pub(crate) fn common_line_end(program: &Program) -> Option<&'static [u8]> {
    let (mut lf, mut crlf, mut cr) = (0u32, 0u32, 0u32);
    for block in program.blocks() {
        match line_end(&block) {
            b"\n" => lf += 1,
            b"\r\n" => crlf += 1,
            b"\r" => cr += 1,
            _ => {}
        }
    }
    match (lf, crlf, cr) {
        (_, _, 0) if crlf > lf => Some(b"\r\n"),
        (_, _, 0) => Some(b"\n"),
        (0, 0, _) => Some(b"\r"),
        _ => None,
    }
}

/// Columns that a text takes on a screen, after column `from` (from 0): characters, tabs to the next multiple of 8. Bytes that are
/// not UTF-8 count one each.
pub(crate) fn columns(from: usize, text: &[u8]) -> usize {
    let mut at = from;
    for chunk in text.utf8_chunks() {
        for character in chunk.valid().chars() {
            at = if character == '\t' { (at / 8 + 1) * 8 } else { at + 1 };
        }
        at += chunk.invalid().len();
    }
    at
}
