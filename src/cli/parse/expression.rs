//! The parts of an expression in order, each with its bracket depth. A list with depths and not a tree of
//! boxes, so that a hundred thousand brackets are as easy as one.
use trunnion_syntax::{Block, Program, TextRange, TokenKind};

/// One part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Part {
    /// Brackets around it, inside the expression.
    pub(super) depth: u32,
    pub(super) kind: &'static str,
    pub(super) range: TextRange,
}

/// The parts of the tokens of a block inside a range.
pub(super) fn parts(program: &Program, block: &Block<'_>, range: TextRange) -> Vec<Part> {
    let table = program.tokens();
    let tokens = block.tokens();
    let mut at = first_from(program, block, range.start);
    let (mut parts, mut depth) = (Vec::new(), 0u32);
    while at < tokens.end && table.range(at).start < range.end {
        let (kind, mut own) = (table.kind(at), table.range(at));
        let next = (at + 1 < tokens.end).then(|| table.kind(at + 1));
        let name = match kind {
            TokenKind::Blank | TokenKind::Newline => {
                at += 1;
                continue;
            }
            TokenKind::BracketClose | TokenKind::ParenClose => {
                depth = depth.saturating_sub(1);
                "close"
            }
            TokenKind::BracketOpen | TokenKind::ParenOpen => "open",
            TokenKind::Hash if own.end - own.start == 1 && next == Some(TokenKind::Number) => {
                at += 1;
                own = own.cover(table.range(at));
                "parameter"
            }
            TokenKind::Hash => "parameter",
            TokenKind::Number => "number",
            TokenKind::Text => "text",
            TokenKind::Comment | TokenKind::UnclosedComment => "comment",
            TokenKind::Name if matches!(next, Some(TokenKind::BracketOpen | TokenKind::ParenOpen)) => "function",
            TokenKind::Name => "name",
            TokenKind::Word | TokenKind::Letter => "word",
            TokenKind::Comma => "comma",
            TokenKind::Plus
            | TokenKind::Minus
            | TokenKind::Star
            | TokenKind::Slash
            | TokenKind::Equals
            | TokenKind::Less
            | TokenKind::Greater => "operator",
            _ => "other",
        };
        parts.push(Part {
            depth,
            kind: name,
            range: own,
        });
        depth += u32::from(name == "open");
        at += 1;
    }
    parts
}

/// The first token of the block that starts at or after `offset`.
fn first_from(program: &Program, block: &Block<'_>, offset: u32) -> u32 {
    let table = program.tokens();
    let tokens = block.tokens();
    let (mut low, mut high) = (tokens.start, tokens.end);
    while low < high {
        let middle = low + (high - low) / 2;
        if table.range(middle).start < offset {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    low
}
