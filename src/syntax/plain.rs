//! The tokens that programs are full of, words with a number, expressions, O words, comments, blanks and line ends, without the
//! lexer's general machinery.
//!
//! It takes only what the lexer's own rules would cut in the same way (a test compares both), and stops before all else.
use crate::builder::Builder;
use crate::iso::SHORT_WORD;
use crate::{LexOptions, TokenKind};

/// What a byte may begin.
#[derive(Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
enum Class {
    Other,
    Letter,
    Digit,
    Blank,
    LineFeed,
    Return,
    /// A token of one byte, whatever stands around it.
    Sign(TokenKind),
    /// What stands behind it decides.
    Mark,
}

const CLASSES: [Class; 256] = {
    let mut classes = [Class::Other; 256];
    let mut byte = 0;
    while byte < 256 {
        classes[byte] = match byte as u8 {
            b'A'..=b'Z' | b'a'..=b'z' => Class::Letter,
            b'0'..=b'9' => Class::Digit,
            b'\n' => Class::LineFeed,
            b'\r' => Class::Return,
            b' ' | b'\t' => Class::Blank,
            b'[' => Class::Sign(TokenKind::BracketOpen),
            b']' => Class::Sign(TokenKind::BracketClose),
            b'=' => Class::Sign(TokenKind::Equals),
            b'+' => Class::Sign(TokenKind::Plus),
            b'-' => Class::Sign(TokenKind::Minus),
            b'*' => Class::Sign(TokenKind::Star),
            b',' => Class::Sign(TokenKind::Comma),
            b'#' | b'/' | b'(' | b';' => Class::Mark,
            _ => Class::Other,
        };
        byte += 1;
    }
    classes
};

/// Whether the lexer's blanks go on with this byte.
#[inline]
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
                    continue;
                }
                let Some(end) = letters(source, at, out) else {
                    return at;
                };
                out.formula = true;
                at = end;
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
            Class::Return => {
                at += 1 + usize::from(source.get(at + 1) == Some(&b'\n'));
                out.push(TokenKind::Newline, start);
                out.end_block(source, options, at as u32);
            }
            Class::Sign(kind) => {
                out.formula = true;
                out.push(kind, start);
                at += 1;
            }
            Class::Digit => {
                if !stands_alone(out) {
                    return at;
                }
                let whole = digits(source, at);
                out.formula = true;
                out.push(TokenKind::Number, start);
                at = if source.get(whole) == Some(&b'.') {
                    digits(source, whole + 1)
                } else {
                    whole
                };
            }
            Class::Mark => {
                let Some((kind, end)) = marked(source, at, options) else {
                    return at;
                };
                // comments are no problem wherever they stand
                out.formula |= kind != TokenKind::Comment;
                out.push(kind, start);
                at = end;
            }
            Class::Other => return at,
        }
    }
    at
}

/// Kind and end of the token that begins with the `#`, `/`, `(` or `;` at `at`.
#[inline]
fn marked(source: &[u8], at: usize, options: LexOptions) -> Option<(TokenKind, usize)> {
    match source[at] {
        b'#' => Some((TokenKind::Hash, hash(source, at)?)),
        b'/' => (source.get(at + 1) != Some(&b'*')).then_some((TokenKind::Slash, at + 1)),
        b'(' => Some((TokenKind::Comment, comment(source, at, options)?)),
        _ if options.semicolon_comment => {
            let end = memchr::memchr2(b'\n', b'\r', &source[at..]).map_or(source.len(), |length| at + length);
            Some((TokenKind::Comment, end))
        }
        _ => None,
    }
}

/// A name, the letter of a value in `[ ]` or `#`, or `o<name>` at `at`: pushed, and what is behind it.
#[inline]
fn letters(source: &[u8], at: usize, out: &mut Builder) -> Option<usize> {
    let start = at as u32;
    let next = *source.get(at + 1)?;
    if next == b'<' {
        if !source[at].eq_ignore_ascii_case(&b'o') {
            return None;
        }
        let end = angled(source, at + 1)?;
        out.push(TokenKind::Letter, start);
        out.push(TokenKind::Less, start + 1);
        return Some(end);
    }
    let signed = matches!(next, b'+' | b'-') && matches!(source.get(at + 2), Some(b'#' | b'['));
    if signed || matches!(next, b'#' | b'[') {
        out.push(TokenKind::Letter, start);
        return Some(at + 1);
    }
    let end = name(source, at)?;
    out.push(TokenKind::Name, start);
    Some(end)
}

/// Behind the `#` at `at`, or behind the whole of `#<name>`.
#[inline]
fn hash(source: &[u8], at: usize) -> Option<usize> {
    match *source.get(at + 1)? {
        b'0'..=b'9' | b'#' | b'[' => Some(at + 1),
        b'<' => angled(source, at + 1),
        _ => None,
    }
}

/// Behind `<name>` at `at`.
#[inline]
fn angled(source: &[u8], at: usize) -> Option<usize> {
    let mut end = at + 1;
    loop {
        match *source.get(end)? {
            b'>' => return Some(end + 1),
            b'<' | b'\n' | b'\r' => return None,
            _ => end += 1,
        }
    }
}

/// Behind the comment that opens at `at` and is closed on its line, with no other inside.
#[inline]
fn comment(source: &[u8], at: usize, options: LexOptions) -> Option<usize> {
    if !options.paren_comment {
        return None;
    }
    let rest = &source[at + 1..];
    let length = memchr::memchr3(b')', b'(', b'\n', rest)?;
    (rest[length] == b')' && !rest[..length].contains(&b'\r')).then_some(at + length + 2)
}

/// Whether a number here belongs to nothing in front of it.
#[inline]
fn stands_alone(out: &Builder) -> bool {
    let owns = |kind: &TokenKind| matches!(kind, TokenKind::Word | TokenKind::Number);
    match &out.table.kinds[out.first as usize..] {
        [.., before, TokenKind::Blank] => !owns(before),
        [.., before] => !owns(before) && *before != TokenKind::Letter,
        [] => true,
    }
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
    use crate::{LexOptions, SyntaxError, TokenKind, iso, parse};
    use proptest::prelude::*;

    const OPTIONS: [LexOptions; 2] = [
        LexOptions {
            format: crate::Format::Iso,
            paren_comment: true,
            semicolon_comment: true,
            slash_star_comment: true,
            blanks_in_numbers: true,
        },
        LexOptions {
            format: crate::Format::Iso,
            paren_comment: false,
            semicolon_comment: false,
            slash_star_comment: false,
            blanks_in_numbers: false,
        },
    ];

    /// Tokens, blocks and problems of a text.
    type Read = (Vec<(TokenKind, u32)>, Vec<u32>, Vec<SyntaxError>);

    fn fast(text: &str, options: LexOptions) -> Read {
        let program = parse(text.into(), options);
        let table = program.tokens();
        let tokens = (0..table.len() as u32).map(|at| (table.kind(at), table.range(at).start));
        let blocks = program.blocks().map(|block| block.tokens().start);
        (tokens.collect(), blocks.collect(), program.errors().to_vec())
    }

    /// The same by the general rules alone, with every odd block read by the grammar.
    fn general(text: &str, options: LexOptions) -> Read {
        let mut out = crate::builder::Builder::default();
        iso::lex_by_rules(text.as_bytes(), options, true, &mut out);
        let tokens = (0..out.table.len() as u32).map(|at| (out.table.kind(at), out.table.range(at).start));
        (tokens.collect(), out.blocks, out.errors)
    }

    fn same(text: &str) {
        for options in OPTIONS {
            assert_eq!(fast(text, options), general(text, options), "{text:?}");
        }
    }

    fn pieces() -> impl Strategy<Value = String> {
        let piece = proptest::sample::select(vec![
            "#<a>",
            "#1",
            "##2",
            "#[",
            "[",
            "]",
            "[1]",
            "[#1+2]",
            "=",
            "+",
            "-",
            "*",
            "**",
            "/",
            " ",
            "  ",
            "\t",
            "G1",
            "X",
            "Y-",
            "X1.5",
            "Z-.5",
            "1",
            "2.5",
            ".5",
            "123456789012345678901",
            "SIN",
            "ATAN[1]/[2]",
            "GT",
            "MOD",
            "AND",
            "o1",
            "O<s>",
            "o",
            "sub",
            "call",
            "if",
            "IF",
            "while",
            "endif",
            "DO",
            "END",
            "GOTO",
            "DEF",
            "EX",
            "AC",
            "XSIN",
            "(c)",
            "(",
            ")",
            ";d",
            "\n",
            "\n",
            "\r\n",
            "\r",
            ",",
            "<",
            ">",
            "%",
            "N10",
            ":",
            "\"t\"",
            "_A",
            "EXISTS[#<_x>]",
            "#1=",
            "#<b> = ",
            "/*",
            "*/",
        ]);
        proptest::collection::vec(piece, 0..14).prop_map(|pieces| pieces.concat())
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4000))]

        #[test]
        fn the_fast_way_cuts_as_the_rules_do(text in "[GXYoO#<>a-c_0-9. \\t\n\r\\[\\]=+*/(),;-]{0,40}") {
            same(&text);
        }

        #[test]
        fn the_fast_way_reads_macros_as_the_rules_do(text in pieces()) {
            same(&text);
        }
    }
}
