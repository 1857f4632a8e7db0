//! The tokens that programs are full of, words with a number, parts of expressions, blanks and line ends, without the
//! lexer's general machinery.
//!
//! It takes only what the lexer's own rules would cut in the same way (a test compares both), and stops before all else.
use crate::builder::Builder;
use crate::iso::SHORT_WORD;
use crate::{LexOptions, TokenKind};

/// What a byte may begin or go on with.
#[derive(Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
enum Class {
    Other,
    Letter,
    Digit,
    Blank,
    LineFeed,
}

const CLASSES: [Class; 256] = {
    let mut classes = [Class::Other; 256];
    let mut byte = 0;
    while byte < 256 {
        classes[byte] = match byte as u8 {
            b'A'..=b'Z' | b'a'..=b'z' => Class::Letter,
            b'0'..=b'9' => Class::Digit,
            b'\n' => Class::LineFeed,
            b' ' | b'\t' => Class::Blank,
            _ => Class::Other,
        };
        byte += 1;
    }
    classes
};

/// Whether the lexer's blanks go on with this byte.
fn goes_on_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | 0..=8 | 0x0B | 0x0C | 0x0E..=0x1F | 0x7F)
}

/// Behind the digits at `at`.
#[inline]
fn digits(source: &[u8], mut at: usize) -> usize {
    while at < source.len() && source[at].wrapping_sub(b'0') < 10 {
        at += 1;
    }
    at
}

/// Behind the letter at `at` with sign and number directly behind it; `None` if there is no number.
#[inline]
fn word(source: &[u8], at: usize) -> Option<usize> {
    let mut next = at + 1;
    let first = *source.get(next)?;
    if first == b'-' || first == b'+' {
        next += 1;
    }
    let whole = digits(source, next);
    if source.get(whole) != Some(&b'.') {
        return (whole > next).then_some(whole);
    }
    let end = digits(source, whole + 1);
    (end > next + 1).then_some(end)
}

/// Lexes from `at` as far as tokens are plain; behind the last of them.
pub(crate) fn lex(source: &[u8], mut at: usize, options: LexOptions, out: &mut Builder) -> usize {
    while at < source.len() {
        let start = at as u32;
        match CLASSES[usize::from(source[at])] {
            Class::Letter => {
                if let Some(end) = word(source, at) {
                    out.odd |= end - at > SHORT_WORD;
                    out.push(TokenKind::Word, start);
                    at = end;
                } else if let Some(end) = name(source, at) {
                    out.odd = true;
                    out.push(TokenKind::Name, start);
                    at = end;
                } else if followed_by_value(source, at) {
                    out.odd = true;
                    out.push(TokenKind::Letter, start);
                    at += 1;
                } else {
                    return at;
                }
            }
            Class::Blank => {
                at += 1;
                while at < source.len() && goes_on_blank(source[at]) {
                    at += 1;
                }
                out.push(TokenKind::Blank, start);
            }
            Class::LineFeed => {
                at += 1;
                out.push(TokenKind::Newline, start);
                out.end_block(source, options, at as u32);
            }
            Class::Digit | Class::Other => {
                let Some((kind, end)) = formula_part(source, at, out) else {
                    return at;
                };
                out.odd = true;
                out.push(kind, start);
                at = end;
            }
        }
    }
    at
}

/// A part of an expression at `at`: kind and end. `None` for all that needs a look at its surroundings.
#[inline]
fn formula_part(source: &[u8], at: usize, out: &Builder) -> Option<(TokenKind, usize)> {
    let kind = match source[at] {
        b'#' => {
            let next = *source.get(at + 1)?;
            return match next {
                b'0'..=b'9' | b'#' | b'[' => Some((TokenKind::Hash, at + 1)),
                b'<' => {
                    let stop = memchr::memchr3(b'>', b'\n', b'\r', &source[at + 2..])? + at + 2;
                    let name = &source[at + 2..stop];
                    (source[stop] == b'>' && !name.contains(&b'<')).then_some((TokenKind::Hash, stop + 1))
                }
                _ => None,
            };
        }
        b'0'..=b'9' => {
            let whole = digits(source, at);
            let end = if source.get(whole) == Some(&b'.') {
                digits(source, whole + 1)
            } else {
                whole
            };
            return stands_alone(out).then_some((TokenKind::Number, end));
        }
        b'[' => TokenKind::BracketOpen,
        b']' => TokenKind::BracketClose,
        b'=' => TokenKind::Equals,
        b'+' => TokenKind::Plus,
        b'-' => TokenKind::Minus,
        b'*' => TokenKind::Star,
        _ => return None,
    };
    Some((kind, at + 1))
}

/// Whether a number here belongs to nothing in front of it.
#[inline]
fn stands_alone(out: &Builder) -> bool {
    let kinds = &out.table.kinds[out.first as usize..];
    let ([.., before, TokenKind::Blank] | [.., before]) = kinds else {
        return true;
    };
    matches!(
        before,
        TokenKind::Hash
            | TokenKind::BracketOpen
            | TokenKind::Equals
            | TokenKind::Plus
            | TokenKind::Minus
            | TokenKind::Star
    )
}

/// Whether a single letter is followed directly by a parameter or an expression.
#[inline]
fn followed_by_value(source: &[u8], at: usize) -> bool {
    matches!(source.get(at + 1), Some(b'#' | b'['))
}

/// Behind a name of letters at `at`; `None` where it is one letter, or digits follow and may belong to it.
#[inline]
fn name(source: &[u8], at: usize) -> Option<usize> {
    let mut end = at + 1;
    while end < source.len() && (source[end].is_ascii_alphabetic() || source[end] == b'_') {
        end += 1;
    }
    let digit = source.get(end).is_some_and(u8::is_ascii_digit);
    (end > at + 1 && !digit).then_some(end)
}

#[cfg(test)]
mod tests {
    use crate::{LexOptions, iso, parse};
    use proptest::prelude::*;

    /// Tokens as the general rules alone cut them: a line end in front of every token keeps the fast way out.
    fn tokens(text: &[u8]) -> Vec<(crate::TokenKind, u32)> {
        let program = parse(text.to_vec(), LexOptions::default());
        let table = program.tokens();
        (0..table.len() as u32)
            .map(|at| (table.kind(at), table.range(at).start))
            .collect()
    }

    proptest! {
        #[test]
        fn the_fast_way_cuts_as_the_rules_do(text in "[GXYoO#<>a-c_0-9. \\t\n\r\\[\\]=+*/-]{0,40}") {
            let mut general = crate::builder::Builder::default();
            iso::lex_by_rules(text.as_bytes(), LexOptions::default(), true, &mut general);
            let rules: Vec<_> = (0..general.table.len() as u32)
                .map(|at| (general.table.kind(at), general.table.range(at).start))
                .collect();
            prop_assert_eq!(tokens(text.as_bytes()), rules);
        }
    }
}
