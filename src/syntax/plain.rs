//! The tokens that programs are full of, words with a number, expressions, O words, comments, blanks and line ends, without the
//! lexer's general machinery.
//!
//! It takes only what the lexer's own rules would cut in the same way (a test compares both), and stops before all else.
use crate::builder::{Builder, HELD};
use crate::length::short;
use crate::straight::{Course, Sign};
use crate::{Format, LexOptions, TokenKind};

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
    /// A token of one byte, whatever its neighbours: its kind is in [`SIGNS`].
    Sign,
    /// What follows it decides.
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
            b'[' | b']' | b'=' | b'+' | b'-' | b'*' | b',' => Class::Sign,
            b'#' | b'/' | b'(' | b';' => Class::Mark,
            _ => Class::Other,
        };
        byte += 1;
    }
    classes
};

/// The tokens of one byte.
const SIGNS: [(TokenKind, Sign); 256] = {
    let mut signs = [(TokenKind::Unknown, Sign::Comma); 256];
    signs[b'[' as usize] = (TokenKind::BracketOpen, Sign::Open);
    signs[b']' as usize] = (TokenKind::BracketClose, Sign::Close);
    signs[b'=' as usize] = (TokenKind::Equals, Sign::Equals);
    signs[b'+' as usize] = (TokenKind::Plus, Sign::PlusMinus);
    signs[b'-' as usize] = (TokenKind::Minus, Sign::PlusMinus);
    signs[b'*' as usize] = (TokenKind::Star, Sign::StarSlash);
    signs[b',' as usize] = (TokenKind::Comma, Sign::Comma);
    signs
};

/// What a byte continues with, as bits.
const GOES_ON: [u8; 256] = {
    let mut goes_on = [0; 256];
    let mut byte = 0;
    while byte < 256 {
        goes_on[byte] = match byte as u8 {
            b'A'..=b'Z' | b'a'..=b'z' | b'_' => NAME,
            b' ' | b'\t' | 0..=8 | 0x0B | 0x0C | 0x0E..=0x1F | 0x7F => BLANK,
            _ => 0,
        };
        byte += 1;
    }
    goes_on
};
/// A name of letters.
const NAME: u8 = 1;
/// The lexer's blanks.
const BLANK: u8 = 2;

/// After the bytes from `at` on that continue with `what`.
#[inline]
fn behind(source: &[u8], mut at: usize, what: u8) -> usize {
    while at < source.len() && GOES_ON[usize::from(source[at])] & what != 0 {
        at += 1;
    }
    at
}

/// After the digits at `at`.
#[inline]
fn digits(source: &[u8], mut at: usize) -> usize {
    while at < source.len() && source[at].wrapping_sub(b'0') < 10 {
        at += 1;
    }
    at
}

/// The word at `at`, whose digits begin at `first`: pushed; returns the position after it; `None` if there is no number.
#[inline]
fn word(source: &[u8], at: usize, first: usize, cut: &mut Cut) -> Option<usize> {
    if let Some(end) = short(source, first) {
        cut.push(TokenKind::Word, Sign::Word, at);
        return Some(cut.blank(source, end));
    }
    let mut end = digits(source, first);
    let mut count = end - first;
    if source.get(end) == Some(&b'.') {
        let point = end + 1;
        end = digits(source, point);
        count += end - point;
        // `X1.` is cut by the lexer's own rules
        if end == point {
            return None;
        }
    }
    if count == 0 {
        return None;
    }
    cut.push(TokenKind::Word, Sign::word(end - at), at);
    Some(end)
}

/// The tokens that are cut and not in the table yet. It is passed by value, so that it stays in registers: each token's step of the course
/// depends on the one before.
struct Cut<'o> {
    out: &'o mut Builder,
    /// So many are held.
    count: usize,
    course: Course,
}

impl Cut<'_> {
    /// Adds a token.
    #[inline]
    fn push(&mut self, kind: TokenKind, sign: Sign, start: usize) {
        self.course.pass(sign);
        self.hold(kind, start);
    }

    /// Adds a token that the course knows.
    #[inline]
    fn hold(&mut self, kind: TokenKind, start: usize) {
        self.out.hold(self.count, kind, start as u32);
        self.count += 1;
    }

    /// The blank at `at`, if one alone stands there, as most often after a token; where it ends.
    #[inline]
    fn blank(&mut self, source: &[u8], at: usize) -> usize {
        match source.get(at..) {
            Some(&[b' ', next, ..]) if GOES_ON[usize::from(next)] & BLANK == 0 => {
                self.push(TokenKind::Blank, Sign::Blank, at);
                at + 1
            }
            _ => at,
        }
    }

    /// Whether a number here may belong to the word, letter or number before it.
    #[inline]
    fn may_go_on(&self) -> bool {
        let owns = |kind: TokenKind| matches!(kind, TokenKind::Word | TokenKind::Number | TokenKind::Letter);
        match self.count {
            // across the edge of what is held: rare enough
            0 | 1 => {
                self.out.table.kinds.iter().rev().take(2).any(|&kind| owns(kind))
                    || self.count == 1 && owns(self.out.held(0))
            }
            count => match self.out.held(count - 1) {
                TokenKind::Blank => owns(self.out.held(count - 2)),
                kind => owns(kind),
            },
        }
    }

    /// Gives what is held to the table.
    #[inline]
    fn release(&mut self) {
        self.out.release(self.count);
        self.count = 0;
    }

    /// A line end after `start`, and the end of its block.
    #[inline]
    fn line_end(&mut self, source: &[u8], options: LexOptions, start: usize, end: usize) {
        self.hold(TokenKind::Newline, start);
        let out = &mut *self.out;
        out.blocks.push(out.first);
        if !self.course.end() {
            self.release();
            self.out.check(source, options, end as u32);
        }
        self.out.first = (self.out.table.kinds.len() + self.count) as u32;
    }
}

/// Lexes from `at` as far as tokens are plain; after the last of them.
pub(crate) fn lex(source: &[u8], at: usize, options: LexOptions, out: &mut Builder) -> usize {
    let cut = Cut {
        course: out.course,
        out,
        count: 0,
    };
    let (end, mut cut) = lex_into(source, at, options, cut);
    cut.out.course = cut.course;
    cut.release();
    end
}

#[inline]
fn lex_into<'o>(source: &[u8], mut at: usize, options: LexOptions, mut cut: Cut<'o>) -> (usize, Cut<'o>) {
    while let Some(&byte) = source.get(at) {
        // a step adds four tokens at most
        if cut.count > HELD - 4 {
            cut.release();
        }
        let start = at;
        match CLASSES[usize::from(byte)] {
            Class::Letter => {
                let Some(end) = lettered(source, at, &mut cut) else {
                    break;
                };
                at = end;
            }
            Class::Blank => {
                at = behind(source, at + 1, BLANK);
                cut.push(TokenKind::Blank, Sign::Blank, start);
            }
            Class::LineFeed => {
                if goes_on(source, at + 1, options) {
                    break;
                }
                at += 1;
                cut.line_end(source, options, start, at);
            }
            Class::Return => {
                let end = at + 1 + usize::from(source.get(at + 1) == Some(&b'\n'));
                if goes_on(source, end, options) {
                    break;
                }
                at = end;
                cut.line_end(source, options, start, at);
            }
            Class::Sign => {
                let (kind, sign) = SIGNS[usize::from(byte)];
                cut.push(kind, sign, start);
                at = cut.blank(source, at + 1);
            }
            Class::Digit => {
                // where it continues with what precedes it, the lexer's own rules are asked
                if cut.may_go_on() {
                    break;
                }
                at = digits(source, at + 1);
                if source.get(at) == Some(&b'.') {
                    at = digits(source, at + 1);
                }
                cut.push(TokenKind::Number, Sign::number(at - start), start);
                at = cut.blank(source, at);
            }
            Class::Mark => {
                let Some((kind, sign, end)) = marked(source, at, options) else {
                    break;
                };
                cut.push(kind, sign, start);
                at = cut.blank(source, end);
            }
            Class::Other => break,
        }
    }
    (at, cut)
}

/// Whether the line that begins at `at` continues the block above (OSP).
#[inline]
pub(crate) fn goes_on(source: &[u8], at: usize, options: LexOptions) -> bool {
    options.format == Format::Osp && source.get(at) == Some(&b'$')
}

/// Kind and end of the token that begins with the `#`, `/`, `(` or `;` at `at`.
#[inline]
fn marked(source: &[u8], at: usize, options: LexOptions) -> Option<(TokenKind, Sign, usize)> {
    match source[at] {
        b'#' => match *source.get(at + 1)? {
            b'0'..=b'9' | b'#' | b'[' => Some((TokenKind::Hash, Sign::Hash, at + 1)),
            b'<' => Some((TokenKind::Hash, Sign::Parameter, angled(source, at + 1)?)),
            _ => None,
        },
        b'/' => (source.get(at + 1) != Some(&b'*')).then_some((TokenKind::Slash, Sign::StarSlash, at + 1)),
        b'(' => Some((TokenKind::Comment, Sign::Comment, comment(source, at, options)?)),
        _ if options.semicolon_comment => {
            let end = memchr::memchr2(b'\n', b'\r', &source[at..]).map_or(source.len(), |length| at + length);
            Some((TokenKind::Comment, Sign::Comment, end))
        }
        _ => None,
    }
}

/// The word, the name, the letter of a value in `[ ]` or `#`, or `o<name>` at `at`: pushed, and what is behind it.
#[inline]
fn lettered(source: &[u8], at: usize, cut: &mut Cut) -> Option<usize> {
    let end = at + 1;
    let next = *source.get(end)?;
    match next {
        b'0'..=b'9' | b'.' => return word(source, at, end, cut),
        b'[' | b'#' => {}
        b'+' | b'-' if matches!(source.get(at + 2), Some(b'#' | b'[')) => {}
        b'+' | b'-' => return word(source, at, end + 1, cut),
        b'<' if source[at].eq_ignore_ascii_case(&b'o') => {
            let behind = angled(source, end)?;
            cut.push(TokenKind::Letter, Sign::Letter, at);
            cut.push(TokenKind::Less, Sign::Called, end);
            return Some(behind);
        }
        _ => {
            let end = name(source, at)?;
            cut.course.name(&source[at..end]);
            cut.hold(TokenKind::Name, at);
            return Some(cut.blank(source, end));
        }
    }
    cut.push(TokenKind::Letter, Sign::Letter, at);
    Some(end)
}

/// After `<name>` at `at`.
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

/// After the comment that opens at `at` and is closed on its line, with no other inside.
#[inline]
fn comment(source: &[u8], at: usize, options: LexOptions) -> Option<usize> {
    if !options.paren_comment {
        return None;
    }
    let rest = &source[at + 1..];
    let length = memchr::memchr3(b')', b'(', b'\n', rest)?;
    (rest[length] == b')' && !rest[..length].contains(&b'\r')).then_some(at + length + 2)
}

/// After a name of letters at `at`; `None` where it is one letter, or digits follow and may belong to it.
#[inline]
fn name(source: &[u8], at: usize) -> Option<usize> {
    let end = behind(source, at + 1, NAME);
    let digit = source.get(end).is_some_and(u8::is_ascii_digit);
    (end > at + 1 && !digit).then_some(end)
}

#[cfg(test)]
mod tests;
