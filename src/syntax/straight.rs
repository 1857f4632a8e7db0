//! Blocks of expressions that show by the kinds of their tokens that nothing is wrong with them: most of every macro.
//!
//! A block that passes here has no problem by the grammar of the items, which need not read it then (a test compares both); any
//! other is read.
use crate::expression::{is_function, is_one_of};
use crate::names::{CONDITIONS, NUMBERED};
use crate::scan::Scan;
use crate::{TokenId, TokenKind};

/// The longest number, its sign counted, that surely has no more digits than a decimal holds.
const SHORT_NUMBER: u32 = 18;

/// Whether the block that starts at token `first`, all of it cut the fast way, surely has no problem.
pub(crate) fn is_sound(scan: Scan<'_>, first: TokenId) -> bool {
    let mut at = first;
    while at < scan.end {
        let behind = match scan.kind(at) {
            TokenKind::Blank | TokenKind::Comment | TokenKind::Newline => Some(at + 1),
            TokenKind::Word => word(scan, at),
            TokenKind::Letter => letter(scan, at),
            TokenKind::Hash => assignment(scan, at),
            TokenKind::Name => name(scan, at),
            _ => None,
        };
        let Some(behind) = behind else { return false };
        at = behind;
    }
    true
}

/// A word with its number that is not assigned to and has no comma behind it.
#[inline]
fn word(scan: Scan<'_>, at: TokenId) -> Option<TokenId> {
    let next = scan.kind(at + 1);
    let behind = if next == TokenKind::Blank {
        scan.kind(at + 2)
    } else {
        next
    };
    (behind != TokenKind::Equals && next != TokenKind::Comma).then_some(at + 1)
}

/// A letter whose value is a parameter, an expression, or one of them behind a sign; the `o` of `o<name>`.
fn letter(scan: Scan<'_>, at: TokenId) -> Option<TokenId> {
    let next = scan.skip_blank(at + 1);
    match scan.kind(next) {
        TokenKind::BracketOpen => unassigned(scan, group(scan, next)?),
        TokenKind::Hash => parameter(scan, next),
        TokenKind::Plus | TokenKind::Minus => {
            let value = scan.skip_blank(next + 1);
            match scan.kind(value) {
                TokenKind::BracketOpen => group(scan, value),
                TokenKind::Hash => parameter(scan, value),
                _ => None,
            }
        }
        TokenKind::Less => (!is_one_byte(scan, next)).then_some(next + 1),
        _ => None,
    }
}

/// `end`, unless a `=` follows there.
fn unassigned(scan: Scan<'_>, end: TokenId) -> Option<TokenId> {
    (scan.kind(scan.skip_blank(end)) != TokenKind::Equals).then_some(end)
}

fn is_one_byte(scan: Scan<'_>, at: TokenId) -> bool {
    let range = scan.range(at);
    range.end - range.start == 1
}

/// Behind a parameter: `#1`, `##2`, `#[1+2]`, `#<name>`.
fn parameter(scan: Scan<'_>, at: TokenId) -> Option<TokenId> {
    let mut next = at;
    while scan.kind(next) == TokenKind::Hash {
        if !is_one_byte(scan, next) {
            return Some(next + 1);
        }
        next = scan.skip_blank(next + 1);
    }
    match scan.kind(next) {
        TokenKind::Number => Some(next + 1),
        TokenKind::BracketOpen => group(scan, next),
        _ => None,
    }
}

/// Behind a bracket and its partner, with a value in front of every closing one.
fn group(scan: Scan<'_>, at: TokenId) -> Option<TokenId> {
    let mut depth = 0u32;
    let mut before = TokenKind::BracketOpen;
    let kinds = scan.table.kinds.get(at as usize..scan.end as usize)?;
    for (behind, &kind) in (at + 1..).zip(kinds) {
        match kind {
            TokenKind::BracketOpen => depth += 1,
            TokenKind::BracketClose => {
                depth -= 1;
                let lacks = matches!(
                    before,
                    TokenKind::BracketOpen
                        | TokenKind::Plus
                        | TokenKind::Minus
                        | TokenKind::Star
                        | TokenKind::Slash
                        | TokenKind::Equals
                );
                // cut the fast way, a `#` alone has its value behind it
                if lacks {
                    return None;
                }
                if depth == 0 {
                    return Some(behind);
                }
            }
            TokenKind::Blank | TokenKind::Comment => continue,
            TokenKind::Newline | TokenKind::ParenOpen | TokenKind::ParenClose => return None,
            _ => {}
        }
        before = kind;
    }
    None
}

/// `#1 = value`, with one operand.
fn assignment(scan: Scan<'_>, at: TokenId) -> Option<TokenId> {
    let equals = scan.skip_blank(parameter(scan, at)?);
    if !scan.assigns(equals) {
        return None;
    }
    let value = scan.skip_blank(equals + 1);
    let signed = matches!(scan.kind(value), TokenKind::Plus | TokenKind::Minus);
    let operand = if signed { value + 1 } else { value };
    let end = match scan.kind(operand) {
        TokenKind::Number => {
            let length = scan.range(operand).end - scan.range(operand).start;
            let alone = !matches!(scan.kind(operand + 1), TokenKind::Comma | TokenKind::Name);
            (alone && length < SHORT_NUMBER).then_some(operand + 1)?
        }
        TokenKind::Hash => parameter(scan, operand)?,
        TokenKind::BracketOpen => group(scan, operand)?,
        TokenKind::Name if scan.kind(operand + 1) == TokenKind::BracketOpen && is_function(scan.text(operand)) => {
            group(scan, operand + 1)?
        }
        _ => return None,
    };
    ends_value(scan, end)
}

/// `end`, where a value ends there: no operator follows.
fn ends_value(scan: Scan<'_>, end: TokenId) -> Option<TokenId> {
    matches!(
        scan.kind(scan.skip_blank(end)),
        TokenKind::Newline | TokenKind::Comment | TokenKind::Hash | TokenKind::Word | TokenKind::Letter
    )
    .then_some(end)
}

/// A name that stands alone, or has brackets behind it: `endif`, `while [..]`, `call [..] [..]`.
fn name(scan: Scan<'_>, at: TokenId) -> Option<TokenId> {
    let next = scan.skip_blank(at + 1);
    let text = scan.text(at);
    match scan.kind(next) {
        TokenKind::Newline | TokenKind::Comment => (!is_one_of(text, &CONDITIONS)).then_some(at + 1),
        TokenKind::BracketOpen if !is_one_of(text, &NUMBERED) => {
            let mut end = group(scan, next)?;
            while text.eq_ignore_ascii_case(b"call") && scan.kind(scan.skip_blank(end)) == TokenKind::BracketOpen {
                end = group(scan, scan.skip_blank(end))?;
            }
            ends_value(scan, end)
        }
        _ => None,
    }
}
