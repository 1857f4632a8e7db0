//! Lexer of APT / CL records.
//!
//! A statement ends with its line unless `$` continues it; a statement whose major word takes text (`PARTNO`,
//! `PPRINT`) is that text to the end of its line.
use crate::builder::Builder;
use crate::error::SyntaxErrorKind;
use crate::expression::is_one_of;
use crate::lines::character;
use crate::sink::Sink;
use crate::{LexOptions, TextRange, TokenKind};
use logos::Logos;

#[derive(Logos, Clone, Copy, Debug, PartialEq, Eq)]
#[logos(utf8 = false)]
enum Raw {
    #[regex(b"[ \t\x00-\x08\x0B\x0C\x0E-\x1F\x7F]+")]
    Blank,
    #[regex(b"\r\n|\n|\r")]
    Newline,
    #[regex(br"[+-]?([0-9]+(\.[0-9]*)?|\.[0-9]+)", priority = 10)]
    Plain,
    #[regex(br"[+-]?([0-9]+(\.[0-9]*)?|\.[0-9]+)[Ee][+-]?[0-9]+", priority = 10)]
    #[regex(br"[+-][ \t]+([0-9]+(\.[0-9]*)?|\.[0-9]+)([Ee][+-]?[0-9]+)?", priority = 10)]
    #[token(b".")]
    Number,
    #[regex(b"[0-9]*[A-Za-z_][A-Za-z0-9_]*", priority = 4)]
    Name,
    #[regex(b"\"[^\"\r\n]*\"")]
    #[regex(b"'[^'\r\n]*'")]
    Text,
    #[token(b"\"")]
    #[token(b"'")]
    Quote,
    #[token(b"$$")]
    Comment,
    #[token(b"$")]
    Dollar,
    #[token(b"=")]
    Equals,
    #[token(b"[")]
    BracketOpen,
    #[token(b"]")]
    BracketClose,
    #[token(b"(")]
    ParenOpen,
    #[token(b")")]
    ParenClose,
    #[token(b",")]
    Comma,
    #[token(b"/")]
    Slash,
    #[token(b"*")]
    Star,
    #[token(b"+")]
    Plus,
    #[token(b"-")]
    Minus,
    #[token(b"<")]
    Less,
    #[token(b">")]
    Greater,
    #[token(b":")]
    Colon,
}

/// Major words whose record is text to the end of the line.
const TEXT_WORDS: [&str; 8] = [
    "PARTNO", "PPRINT", "REMARK", "INSERT", "TEXT", "TITLES", "LETTER", "COMMENT",
];

/// How far a statement is a word, a slash and plain numbers with commas, as most are: with as many numbers as a GOTO may have it has no problem,
/// and the grammar need not read it.
#[derive(Clone, Copy, Default, PartialEq)]
enum Points {
    /// Nothing but blanks so far.
    #[default]
    Begin,
    Major,
    /// A number must follow the slash or comma; so many are before it.
    Wants(u8),
    /// After so many numbers.
    Has(u8),
    Odd,
}

/// The longest number that certainly has no more digits than a decimal holds.
const SHORT_NUMBER: usize = 18;

impl Points {
    /// After a token of so many bytes that is no blank.
    #[inline]
    fn pass(self, raw: Raw, length: usize) -> Self {
        match (self, raw) {
            (Self::Begin, Raw::Name) => Self::Major,
            (Self::Major, Raw::Slash) => Self::Wants(0),
            (Self::Wants(count), Raw::Plain) if length <= SHORT_NUMBER => Self::Has(count + 1),
            (Self::Has(count @ ..7), Raw::Comma) => Self::Wants(count),
            _ => Self::Odd,
        }
    }

    /// Whether a statement that ends here must be read by the grammar.
    fn is_odd(self) -> bool {
        !matches!(self, Self::Begin | Self::Has(3 | 4 | 6 | 7))
    }
}

/// Lexes `source`, whose first byte is at offset 0 of the file if `at_start`, into `out`.
pub(crate) fn lex(source: &[u8], options: LexOptions, at_start: bool, out: &mut Builder) {
    let mut lexer = Raw::lexer(source);
    if at_start && source.starts_with(b"\xEF\xBB\xBF") {
        out.push(TokenKind::Blank, 0);
        lexer.bump(3);
    }
    let mut points = Points::default();
    while let Some(raw) = lexer.next() {
        let span = lexer.span();
        let start = span.start as u32;
        let mut special = Special {
            source,
            start: span.start,
            end: span.end,
            out,
        };
        let end = match raw {
            Ok(Raw::Newline) => {
                out.push(TokenKind::Newline, start);
                if core::mem::take(&mut points).is_odd() {
                    out.course.odd();
                }
                out.end_block(source, options, span.end as u32);
                continue;
            }
            Ok(Raw::Blank) => {
                out.push(TokenKind::Blank, start);
                continue;
            }
            Ok(Raw::Name) => special.name(),
            Ok(Raw::Plain | Raw::Number) => special.number(),
            Ok(Raw::Comment) => special.comment(),
            Ok(Raw::Dollar) => special.dollar(),
            Ok(Raw::Quote) => special.unclosed_text(),
            Ok(raw) => {
                special.push(plain(raw));
                span.end
            }
            Err(()) => {
                special.push(TokenKind::Unknown);
                span.end.max(span.start + character(&source[span.start..]))
            }
        };
        points = raw.map_or(Points::Odd, |raw| points.pass(raw, span.len()));
        lexer.bump(end - span.end);
    }
    if points.is_odd() {
        out.course.odd();
    }
    out.finish(source, options, source.len() as u32);
}

fn plain(raw: Raw) -> TokenKind {
    match raw {
        Raw::Blank => TokenKind::Blank,
        Raw::Newline => TokenKind::Newline,
        Raw::Plain | Raw::Number => TokenKind::Number,
        Raw::Name => TokenKind::Name,
        Raw::Text | Raw::Quote => TokenKind::Text,
        Raw::Comment => TokenKind::Comment,
        Raw::Dollar => TokenKind::Continuation,
        Raw::Equals => TokenKind::Equals,
        Raw::BracketOpen => TokenKind::BracketOpen,
        Raw::BracketClose => TokenKind::BracketClose,
        Raw::ParenOpen => TokenKind::ParenOpen,
        Raw::ParenClose => TokenKind::ParenClose,
        Raw::Comma => TokenKind::Comma,
        Raw::Slash => TokenKind::Slash,
        Raw::Star => TokenKind::Star,
        Raw::Plus => TokenKind::Plus,
        Raw::Minus => TokenKind::Minus,
        Raw::Less => TokenKind::Less,
        Raw::Greater => TokenKind::Greater,
        Raw::Colon => TokenKind::Colon,
    }
}

/// A token that may reach further than its first match. Each method pushes it and returns its end.
struct Special<'a> {
    source: &'a [u8],
    start: usize,
    end: usize,
    out: &'a mut Builder,
}

impl Special<'_> {
    fn push(&mut self, kind: TokenKind) {
        self.out.push(kind, self.start as u32);
    }

    fn line_end(&self, from: usize) -> usize {
        memchr::memchr2(b'\n', b'\r', &self.source[from..]).map_or(self.source.len(), |at| from + at)
    }

    /// After the line end at `at`, if one is there.
    fn behind_newline(&self, at: usize) -> usize {
        match &self.source[at..] {
            [b'\r', b'\n', ..] => at + 2,
            [b'\r' | b'\n', ..] => at + 1,
            _ => at,
        }
    }

    /// An identifier; a text word at the start of its statement takes the rest of the line with it.
    fn name(&mut self) -> usize {
        let text = &self.source[self.start..self.end];
        let opens = text.len() <= 7 && is_one_of(text, &TEXT_WORDS) && self.out.block_is_empty();
        self.push(TokenKind::Name);
        if !opens {
            return self.end;
        }
        let line_end = self.line_end(self.end);
        let slash = self.behind_blanks(self.end);
        let mut at = self.end;
        if self.source.get(slash) == Some(&b'/') {
            self.blank(at, slash);
            self.out.push(TokenKind::Slash, slash as u32);
            at = slash + 1;
        }
        let text = self.behind_blanks(at);
        self.blank(at, text);
        if text < line_end {
            self.out.push(TokenKind::FreeText, text as u32);
        }
        line_end
    }

    fn behind_blanks(&self, at: usize) -> usize {
        at + self.source[at..]
            .iter()
            .take_while(|&&byte| byte == b' ' || byte == b'\t')
            .count()
    }

    fn blank(&mut self, from: usize, to: usize) {
        if from < to {
            self.out.push(TokenKind::Blank, from as u32);
        }
    }

    /// `1.2.3` is one broken number, not two.
    fn number(&mut self) -> usize {
        let inside = self.out.table.kinds.len() > self.out.first as usize;
        let joins = self.source[self.start] == b'.' && self.out.table.kinds.last() == Some(&TokenKind::Number);
        if !(inside && joins) {
            self.push(TokenKind::Number);
        }
        self.end
    }

    /// `$$` to the end of the line. Records of a Pro/CLfile after `$$->` may be continued by `$`.
    fn comment(&mut self) -> usize {
        self.push(TokenKind::Comment);
        let mut end = self.line_end(self.end);
        if self.source[self.end..].starts_with(b"->") {
            while self.source[self.start..end].trim_ascii_end().ends_with(b"$") && end < self.source.len() {
                let next = self.behind_newline(end);
                end = self.line_end(next);
                if next == self.source.len() || self.source[next..end].trim_ascii().is_empty() {
                    break;
                }
            }
        }
        end
    }

    /// `$` and what follows it on the line: the statement continues.
    fn dollar(&mut self) -> usize {
        let end = self.behind_newline(self.line_end(self.end));
        self.push(TokenKind::Continuation);
        if end == self.source.len() {
            let range = TextRange::new(self.start as u32, self.end as u32);
            self.out.errors.report(SyntaxErrorKind::DanglingContinuation, range);
        }
        end
    }

    fn unclosed_text(&mut self) -> usize {
        self.push(TokenKind::Text);
        let end = self.line_end(self.end);
        self.out.errors.report(
            SyntaxErrorKind::UnclosedText,
            TextRange::new(self.start as u32, end as u32),
        );
        end
    }
}

#[cfg(test)]
mod tests {
    use crate::scan::Scan;
    use crate::{Format, LexOptions, parse, record};

    const PIECES: [&str; 14] = [
        "GOTO",
        "/",
        ",",
        "1",
        "-2.5",
        "3,4,5",
        " ",
        ".",
        "1E5",
        "+ 3",
        "1234567890123456789",
        "$\n",
        "\n",
        ")",
    ];

    /// A statement that is not read by the grammar has no problem by it.
    #[test]
    fn points_are_not_read_twice_without_loss() {
        let options = LexOptions {
            format: Format::Apt,
            ..LexOptions::default()
        };
        let count = PIECES.len();
        for number in 0..count.pow(5) {
            let piece = |place: u32| PIECES[number / count.pow(place) % count];
            let text: String = (0..5).map(piece).collect();
            for text in [format!("GOTO/{text}"), text] {
                let program = parse(text.clone().into_bytes(), options);
                let mut found = Vec::new();
                for block in program.blocks() {
                    let tokens = block.tokens();
                    let scan = Scan {
                        source: program.source(),
                        table: program.tokens(),
                        options,
                        end: tokens.end,
                    };
                    record::check(scan, tokens.start, &mut found);
                }
                let unseen = found.iter().find(|error| !program.errors().contains(error));
                assert!(unseen.is_none(), "{text:?} {unseen:?}");
            }
        }
    }
}
