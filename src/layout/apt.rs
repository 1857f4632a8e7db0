//! The layout of one APT statement or Klartext block: blanks at line ends and double blanks are removed, everything else stays. Texts, comments, case and continuations
//! (`$` with what follows it) are kept byte for byte, since post processors read columns, names and texts.
use crate::blanks::is_plain_blank;
use trunnion_syntax::{Block, Format, Program, TextRange, TokenKind};

/// Whether nothing of a statement may be touched: problems, and bytes without meaning.
pub(crate) fn stays(program: &Program, block: &Block<'_>) -> bool {
    let (table, range) = (program.tokens(), block.range());
    let errors = program.errors();
    let next = errors.partition_point(|error| error.range.end <= range.start);
    let broken = errors.get(next).is_some_and(|error| error.range.start < range.end);
    broken
        || block.tokens().any(|id| match table.kind(id) {
            TokenKind::Blank => !is_plain_blank(program.bytes(table.range(id))),
            TokenKind::Unknown | TokenKind::UnclosedComment => true,
            _ => false,
        })
}

/// Whether a statement ends with `$` and what follows it, so that a line end behind it would belong to that.
pub(crate) fn continues(program: &Program, block: &Block<'_>) -> bool {
    let table = program.tokens();
    let mut kinds = block.tokens().rev().map(|id| table.kind(id));
    kinds.find(|kind| *kind != TokenKind::Blank) == Some(TokenKind::Continuation)
}

/// Appends the statement without its line end.
pub(crate) fn write(program: &Program, block: &Block<'_>, out: &mut Vec<u8>) {
    if stays(program, block) {
        out.extend_from_slice(program.bytes(block.range()));
        return;
    }
    let table = program.tokens();
    let mut left: Option<TokenKind> = None;
    let mut blank: Option<TextRange> = None;
    for id in block.tokens() {
        let (kind, range) = (table.kind(id), table.range(id));
        match kind {
            TokenKind::Newline => {
                // without them the line end would be a part of the continuation
                if left == Some(TokenKind::Continuation)
                    && out.ends_with(b"\r")
                    && let Some(blank) = blank
                {
                    out.extend_from_slice(program.bytes(blank));
                }
                break;
            }
            TokenKind::Blank => {
                blank = Some(range);
                continue;
            }
            _ => {}
        }
        if let Some(blank) = blank.take() {
            // before a statement or the rest of one, and before a comment or text, blanks are indentation
            let kept = matches!(left, None | Some(TokenKind::Continuation))
                || matches!(kind, TokenKind::Comment | TokenKind::FreeText | TokenKind::Continuation);
            match kind {
                _ if kept => out.extend_from_slice(program.bytes(blank)),
                // in Klartext it is the decimal point
                TokenKind::Comma if program.options().format == Format::Apt => {}
                _ => out.push(b' '),
            }
        }
        out.extend_from_slice(program.bytes(range));
        left = Some(kind);
    }
}
