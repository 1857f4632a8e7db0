//! Lexer of HEIDENHAIN Klartext, and the view of one of its blocks.
//!
//! A block is a line with a number in front, which may be absent, and the lines that `~` at its end adds. `;` opens a comment, `*` after the
//! number a heading; both reach to the end of the line, before a `~`. Numbers have a decimal point or a comma. Sources: HEIDENHAIN TNC 640
//! user's manuals 34059x; programs of several shops.
use crate::builder::{Builder, HELD};
use crate::error::SyntaxErrorKind;
use crate::iso::on_line;
use crate::lines::character;
use crate::scan::Scan;
use crate::sink::Sink;
use crate::{LexOptions, Program, TextRange, TokenId, TokenKind};
use std::borrow::Cow;

/// Lexes `source`, whose first byte is at offset 0 of the file if `at_start`, into `out`.
pub(crate) fn lex(source: &[u8], options: LexOptions, at_start: bool, out: &mut Builder) {
    let mut at = 0;
    let mut cut = Cut { out, count: 0 };
    if at_start && source.starts_with(b"\xEF\xBB\xBF") {
        cut.push(TokenKind::Blank, 0);
        at = 3;
    }
    while at < source.len() {
        at = line(source, at, &mut cut);
    }
    cut.release();
    out.finish(source, options, source.len() as u32);
}

/// The tokens that are cut and not in the table yet.
struct Cut<'o> {
    out: &'o mut Builder,
    /// So many are held.
    count: usize,
}

impl Cut<'_> {
    #[inline]
    fn push(&mut self, kind: TokenKind, start: usize) {
        if self.count == HELD {
            self.release();
        }
        self.out.hold(self.count, kind, start as u32);
        self.count += 1;
    }

    fn release(&mut self) {
        self.out.release(self.count);
        self.count = 0;
    }

    /// The block ends after the last token.
    #[inline]
    fn end_block(&mut self) {
        self.out.blocks.push(self.out.first);
        self.out.first = (self.out.table.len() + self.count) as u32;
    }
}

/// One block, its line end included; returns where the next one starts.
fn line(source: &[u8], mut at: usize, cut: &mut Cut<'_>) -> usize {
    // nothing but blanks, the mark of a skipped block and the number so far
    let mut opens = true;
    let mut before = TokenKind::Blank;
    while at < source.len() {
        let byte = source[at];
        let (kind, end) = match byte {
            b'\n' | b'\r' => {
                cut.push(TokenKind::Newline, at);
                cut.end_block();
                return behind_newline(source, at);
            }
            b' ' | b'\t' | 0..=8 | 0x0B | 0x0C | 0x0E..=0x1F | 0x7F => (
                TokenKind::Blank,
                run(
                    source,
                    at,
                    |byte| matches!(byte, b' ' | b'\t' | 0..=8 | 0x0B | 0x0C | 0x0E..=0x1F | 0x7F),
                ),
            ),
            b';' => (TokenKind::Comment, comment_end(source, at, opens)),
            b'*' if opens => (TokenKind::Comment, comment_end(source, at, false)),
            b'~' => continuation(source, at, cut.out),
            b'"' => text(source, at, cut.out),
            b'A'..=b'Z' | b'a'..=b'z' | b'_' | 0x80.. => (
                TokenKind::Name,
                run(
                    source,
                    at,
                    |byte| matches!(byte, b'A'..=b'Z' | b'a'..=b'z' | b'_' | 0x80..),
                ),
            ),
            b'0'..=b'9' => (TokenKind::Number, number_end(source, at)),
            b'+' | b'-' if signs(source, at, before) => (TokenKind::Number, number_end(source, at + 1)),
            b'.' | b',' if source.get(at + 1).is_some_and(u8::is_ascii_digit) => {
                (TokenKind::Number, number_end(source, at))
            }
            _ => match plain(byte) {
                Some(kind) => (kind, at + 1),
                None => (TokenKind::Unknown, at + character(&source[at..]).max(1)),
            },
        };
        opens &= kind == TokenKind::Blank
            || opens && (kind == TokenKind::Slash || kind == TokenKind::Number && before != TokenKind::Number);
        cut.push(kind, at);
        before = kind;
        at = end;
    }
    at
}

fn plain(byte: u8) -> Option<TokenKind> {
    Some(match byte {
        b'=' => TokenKind::Equals,
        b'[' => TokenKind::BracketOpen,
        b']' => TokenKind::BracketClose,
        b'(' => TokenKind::ParenOpen,
        b')' => TokenKind::ParenClose,
        b',' => TokenKind::Comma,
        b'/' => TokenKind::Slash,
        b'*' => TokenKind::Star,
        b'+' | b'|' => TokenKind::Plus,
        b'-' => TokenKind::Minus,
        b'<' => TokenKind::Less,
        b'>' => TokenKind::Greater,
        b'%' => TokenKind::Percent,
        b':' => TokenKind::Colon,
        b'#' => TokenKind::Hash,
        b'^' => TokenKind::Letter,
        _ => return None,
    })
}

fn run(source: &[u8], at: usize, takes: impl Fn(u8) -> bool) -> usize {
    let rest = &source[at..];
    at + rest.iter().position(|byte| !takes(*byte)).unwrap_or(rest.len())
}

/// Whether a sign belongs to the number after it: it is not an operator between two operands.
fn signs(source: &[u8], at: usize, before: TokenKind) -> bool {
    let digit = |at: usize| source.get(at).is_some_and(u8::is_ascii_digit);
    let number = digit(at + 1) || matches!(source.get(at + 1), Some(b'.' | b',')) && digit(at + 2);
    number && !matches!(before, TokenKind::Number | TokenKind::ParenClose)
}

/// Digits with at most one point or comma that is followed by a digit or ends the number.
fn number_end(source: &[u8], at: usize) -> usize {
    let digits = |at: usize| run(source, at, |byte| byte.is_ascii_digit());
    let whole = digits(at);
    if matches!(source.get(whole), Some(b'.' | b',')) {
        digits(whole + 1)
    } else {
        whole
    }
}

fn line_end(source: &[u8], from: usize) -> usize {
    memchr::memchr2(b'\n', b'\r', &source[from..]).map_or(source.len(), |at| from + at)
}

fn behind_newline(source: &[u8], at: usize) -> usize {
    match &source[at..] {
        [b'\r', b'\n', ..] => at + 2,
        [b'\r' | b'\n', ..] => at + 1,
        _ => at,
    }
}

/// The end of a comment: that of its line, or the `~` at the end of the line. A block that is nothing but a comment takes the next lines with it
/// where they are indented.
fn comment_end(source: &[u8], at: usize, alone: bool) -> usize {
    let mut end = line_end(source, at);
    loop {
        let text = source[at..end].trim_ascii_end();
        let Some(before) = text.strip_suffix(b"~") else {
            return end;
        };
        if !alone {
            return at + before.len();
        }
        let next = behind_newline(source, end);
        if next == end || !matches!(source.get(next), Some(b' ' | b'\t')) {
            return end;
        }
        end = line_end(source, next);
    }
}

/// `~`, what is behind it on its line, and the line end: the block continues. Elsewhere it is a stray character.
fn continuation(source: &[u8], at: usize, out: &mut Builder) -> (TokenKind, usize) {
    let end = run(source, at + 1, |byte| {
        byte.is_ascii_whitespace() && !matches!(byte, b'\n' | b'\r')
    });
    if !matches!(source.get(end), None | Some(b'\n' | b'\r')) {
        return (TokenKind::Unknown, at + 1);
    }
    let next = behind_newline(source, end);
    if next == source.len() {
        let range = TextRange::new(at as u32, at as u32 + 1);
        out.errors.report(SyntaxErrorKind::DanglingContinuation, range);
    }
    (TokenKind::Continuation, next)
}

fn text(source: &[u8], at: usize, out: &mut Builder) -> (TokenKind, usize) {
    let end = match on_line(source, at + 1, b'"') {
        Ok(close) => return (TokenKind::Text, close + 1),
        Err(end) => end,
    };
    let range = TextRange::new(at as u32, end as u32);
    out.errors.report(SyntaxErrorKind::UnclosedText, range);
    (TokenKind::Text, end)
}

/// A block of a Klartext program.
#[derive(Clone, Copy)]
pub struct Sentence<'p> {
    program: &'p Program,
    /// The number in front.
    pub number: Option<TextRange>,
    /// `/`: the control may skip it.
    pub skips: bool,
    /// From its first to its last word, without comments around it.
    pub range: TextRange,
    /// Its tokens.
    tokens: (TokenId, TokenId),
}

impl<'p> Sentence<'p> {
    /// Reads the block that starts at token `first`; `None` for one without words.
    pub(crate) fn read(program: &'p Program, scan: Scan<'p>, first: TokenId) -> Option<Self> {
        let (number, skips, start) = head(&scan, first);
        let end = scan.trim(start, scan.end);
        (start < end).then(|| Self {
            program,
            number: number.map(|token| scan.range(token)),
            skips,
            range: scan.span(start, end),
            tokens: (start, end),
        })
    }

    /// Its words. Comments and line ends inside it are blanks.
    pub fn text(&self) -> Cow<'p, [u8]> {
        let table = &self.program.tokens;
        let (first, end) = self.tokens;
        let inside = |kind: TokenKind| matches!(kind, TokenKind::Comment | TokenKind::Continuation);
        if !table.kinds[first as usize..end as usize]
            .iter()
            .any(|kind| inside(*kind))
        {
            return Cow::Borrowed(self.program.bytes(self.range));
        }
        let mut joined = Vec::with_capacity((self.range.end - self.range.start) as usize);
        for id in first..end {
            if inside(table.kind(id)) {
                joined.push(b' ');
            } else {
                joined.extend_from_slice(self.program.bytes(table.range(id)));
            }
        }
        Cow::Owned(joined)
    }
}

/// The number of a block, whether it may be skipped, and its first word.
pub(crate) fn head(scan: &Scan<'_>, first: TokenId) -> (Option<TokenId>, bool, TokenId) {
    let (mut number, mut skips, mut at) = (None, false, scan.skip_blank(first));
    loop {
        match scan.kind(at) {
            TokenKind::Slash if !skips => skips = true,
            TokenKind::Number if number.is_none() && scan.text(at).iter().all(u8::is_ascii_digit) => number = Some(at),
            TokenKind::Comment => {}
            _ => return (number, skips, at),
        }
        if at >= scan.end {
            return (number, skips, at);
        }
        at = scan.skip_blank(at + 1);
    }
}
