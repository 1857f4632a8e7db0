//! Lexer of ISO words.
//!
//! The lexer alone decides where tokens end; what they mean together is decided by the items. Where a comment ends
//! depends on the options, so the regular part stops at its mark and the loop takes the rest by hand.
use crate::builder::Builder;
use crate::error::SyntaxErrorKind;
use crate::lines::character;
use crate::sink::Sink;
use crate::straight::Sign;
use crate::{Format, LexOptions, TextRange, TokenKind, plain};
use logos::Logos;

#[derive(Logos, Clone, Copy, Debug, PartialEq, Eq)]
#[logos(utf8 = false)]
enum Raw {
    #[regex(b"[ \t\x00-\x08\x0B\x0C\x0E-\x1F\x7F]+")]
    Blank,
    #[regex(b"\r\n|\n|\r")]
    Newline,
    #[regex(br"[A-Za-z@^$][ \t]*[+-]?([0-9]+(\.[0-9]*)?|\.[0-9]+)", priority = 10)]
    Word,
    #[regex(br"[A-Za-z@^][ \t]*[+-][ \t]+([0-9]+(\.[0-9]*)?|\.[0-9]+)", priority = 9)]
    SpacedWord,
    #[regex(b"[A-Za-z@^$]", priority = 8)]
    Letter,
    #[regex(b"[A-Za-z][A-Za-z_]+|[_$][A-Za-z_][A-Za-z0-9_]*|[A-Za-z][A-Za-z_]+[A-Za-z0-9]{0,30}_[A-Za-z0-9_]*")]
    Name,
    #[regex(b"[Oo][ \t]*<[^<>\r\n]*>")]
    NamedO,
    #[regex(b"#[ \t]*<[^<>\r\n]*>")]
    #[token(b"#")]
    Hash,
    #[regex(br"[0-9]+(\.[0-9]*)?|\.[0-9]+")]
    #[token(b".")]
    Number,
    #[regex(b"\"[^\"\r\n]*\"")]
    #[regex(b"'[^'\r\n]*'")]
    Text,
    #[token(b"\"")]
    Quote,
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
    #[token(b"/*")]
    SlashStar,
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
    #[token(b"%")]
    Percent,
    #[token(b":")]
    Colon,
    #[token(b";")]
    Semicolon,
}

/// Lexes `source`, whose first byte is at offset 0 of the file if `at_start`, into `out`.
pub(crate) fn lex(source: &[u8], options: LexOptions, at_start: bool, out: &mut Builder) {
    lex_with(source, options, at_start, out, plain::lex);
}

/// The same by the general rules alone: what the fast path is compared with.
#[cfg(test)]
pub(crate) fn lex_by_rules(source: &[u8], options: LexOptions, at_start: bool, out: &mut Builder) {
    lex_with(source, options, at_start, out, |_, at, _, _| at);
}

fn lex_with(
    source: &[u8],
    options: LexOptions,
    at_start: bool,
    out: &mut Builder,
    fast: impl Fn(&[u8], usize, LexOptions, &mut Builder) -> usize,
) {
    let mut lexer = Raw::lexer(source);
    if at_start && source.starts_with(b"\xEF\xBB\xBF") {
        out.push(TokenKind::Blank, 0);
        lexer.bump(3);
    }
    if let Some(length) = header(&source[lexer.span().end..], options).filter(|_| at_start) {
        out.course.odd();
        out.push(TokenKind::Percent, lexer.span().end as u32);
        lexer.bump(length);
    }
    // no mark that closes a text lies between here and where one was last sought in vain
    let mut unclosed = 0;
    loop {
        let behind = lexer.span().end;
        lexer.bump(fast(source, behind, options, out) - behind);
        let Some(raw) = lexer.next() else { break };
        let span = lexer.span();
        let start = span.start as u32;
        let kind = match raw {
            Ok(Raw::Blank) => {
                out.course.pass(Sign::Blank);
                TokenKind::Blank
            }
            Ok(Raw::Word) => {
                out.course.pass(Sign::word(span.len()));
                TokenKind::Word
            }
            Ok(Raw::Newline) if plain::goes_on(source, span.end, options) => {
                out.course.odd();
                lexer.bump(1);
                TokenKind::Continuation
            }
            Ok(Raw::Newline) => {
                out.push(TokenKind::Newline, start);
                out.end_block(source, options, span.end as u32);
                continue;
            }
            Ok(raw) => {
                out.course.odd();
                let Some(kind) = settled(raw) else {
                    let (start, end) = (span.start, span.end);
                    let length = Special {
                        source,
                        options,
                        start,
                        end,
                        out,
                    }
                    .lex(raw);
                    lexer.bump(length - span.len());
                    continue;
                };
                kind
            }
            Err(()) => {
                out.course.odd();
                let text = typographic(source, span.start, options, &mut unclosed);
                let (kind, length) = text.map_or_else(
                    || (TokenKind::Unknown, character(&source[span.start..])),
                    |length| (TokenKind::Text, length),
                );
                lexer.bump(length.saturating_sub(span.len()));
                kind
            }
        };
        out.push(kind, start);
    }
    out.finish(source, options, source.len() as u32);
}

/// The length of the name of an OSP file in its first line: `$PART-1.MIN%`.
fn header(source: &[u8], options: LexOptions) -> Option<usize> {
    let first = options.format == Format::Osp && source.first() == Some(&b'$');
    let end = memchr::memchr2(b'\n', b'\r', source).unwrap_or(source.len());
    first.then(|| source[..end].trim_ascii_end().len())
}

/// The length of a text in the quotation marks of a word processor, which messages of OSP programs have where they were written with one.
/// Before `unclosed` no mark closes it.
fn typographic(source: &[u8], at: usize, options: LexOptions, unclosed: &mut usize) -> Option<usize> {
    let rest = &source[at..];
    if options.format != Format::Osp || at < *unclosed || !matches!(rest, [0xE2, 0x80, 0x98 | 0x99, ..]) {
        return None;
    }
    let mut from = 3;
    loop {
        let Ok(mark) = on_line(rest, from, 0xE2) else {
            *unclosed = at + from;
            return None;
        };
        if rest[mark..].starts_with(b"\xE2\x80\x99") {
            return Some(mark + 3);
        }
        from = mark + 1;
    }
}

/// Where the next such byte of the line is; `Err`: it has none, and ends there. What is looked at is no longer than what is found.
pub(crate) fn on_line(source: &[u8], from: usize, byte: u8) -> Result<usize, usize> {
    match memchr::memchr3(byte, b'\n', b'\r', &source[from..]) {
        Some(length) if source[from + length] == byte => Ok(from + length),
        Some(length) => Err(from + length),
        None => Err(source.len()),
    }
}

/// The kinds that need no further check.
fn settled(raw: Raw) -> Option<TokenKind> {
    Some(match raw {
        Raw::Blank => TokenKind::Blank,
        Raw::Newline => TokenKind::Newline,
        Raw::Word | Raw::SpacedWord => TokenKind::Word,
        Raw::Letter => TokenKind::Letter,
        Raw::Name => TokenKind::Name,
        Raw::Hash => TokenKind::Hash,
        Raw::Text => TokenKind::Text,
        Raw::Equals => TokenKind::Equals,
        Raw::BracketOpen => TokenKind::BracketOpen,
        Raw::BracketClose => TokenKind::BracketClose,
        Raw::ParenClose => TokenKind::ParenClose,
        Raw::Comma => TokenKind::Comma,
        Raw::Slash => TokenKind::Slash,
        Raw::Star => TokenKind::Star,
        Raw::Plus => TokenKind::Plus,
        Raw::Minus => TokenKind::Minus,
        Raw::Less => TokenKind::Less,
        Raw::Greater => TokenKind::Greater,
        Raw::Colon => TokenKind::Colon,
        Raw::NamedO | Raw::Number | Raw::Quote | Raw::ParenOpen | Raw::SlashStar | Raw::Percent | Raw::Semicolon => {
            return None;
        }
    })
}

/// A token whose end or kind depends on its neighbours, or on the options.
struct Special<'a> {
    source: &'a [u8],
    options: LexOptions,
    start: usize,
    end: usize,
    out: &'a mut Builder,
}

impl Special<'_> {
    /// Pushes the token (or tokens) and returns how many bytes they are.
    fn lex(&mut self, raw: Raw) -> usize {
        let end = match raw {
            Raw::NamedO => self.named_o(),
            Raw::Number => self.number(),
            Raw::Quote => self.unclosed_text(),
            Raw::ParenOpen => self.paren(),
            Raw::SlashStar => self.slash_star(),
            Raw::Percent => self.percent(),
            _ => self.semicolon(),
        };
        end - self.start
    }

    fn push(&mut self, kind: TokenKind) {
        self.out.push(kind, self.start as u32);
    }

    fn report(&mut self, kind: SyntaxErrorKind, start: usize, end: usize) {
        self.out.errors.report(kind, TextRange::new(start as u32, end as u32));
    }

    fn line_end(&self) -> usize {
        memchr::memchr2(b'\n', b'\r', &self.source[self.end..]).map_or(self.source.len(), |at| self.end + at)
    }

    /// `o<name>`: the letter and the name are tokens of their own.
    fn named_o(&mut self) -> usize {
        self.push(TokenKind::Letter);
        let name = self.start + memchr::memchr(b'<', &self.source[self.start..self.end]).unwrap_or(1);
        if name > self.start + 1 {
            self.out.push(TokenKind::Blank, self.start as u32 + 1);
        }
        self.out.push(TokenKind::Less, name as u32);
        self.end
    }

    /// A number after a word or number, with or without blanks between, belongs to it: `X1 2`, `X1.2.3`.
    fn number(&mut self) -> usize {
        let kinds = &mut self.out.table.kinds;
        let spaced = kinds.ends_with(&[TokenKind::Word, TokenKind::Blank])
            || kinds.ends_with(&[TokenKind::Number, TokenKind::Blank]);
        if spaced && kinds.len() >= self.out.first as usize + 2 {
            kinds.pop();
            self.out.table.starts.pop();
            return self.end;
        }
        let inside = kinds.len() > self.out.first as usize;
        match kinds.last_mut() {
            Some(TokenKind::Word | TokenKind::Number) if inside => {}
            // `X.`, and `X.` with a blank between, is a word whose number is broken.
            Some(last @ TokenKind::Letter) if inside => *last = TokenKind::Word,
            _ => self.push(TokenKind::Number),
        }
        self.end
    }

    fn unclosed_text(&mut self) -> usize {
        let end = self.line_end();
        self.push(TokenKind::Text);
        self.report(SyntaxErrorKind::UnclosedText, self.start, end);
        end
    }

    fn paren(&mut self) -> usize {
        if !self.options.paren_comment {
            self.push(TokenKind::ParenOpen);
            return self.end;
        }
        let close = on_line(self.source, self.end, b')');
        if let Some(at) = close
            .ok()
            .and_then(|close| memchr::memchr(b'(', &self.source[self.end..close]))
        {
            self.report(SyntaxErrorKind::NestedComment, self.end + at, self.end + at + 1);
        }
        self.comment(close.map(|at| at + 1))
    }

    fn slash_star(&mut self) -> usize {
        if self.options.slash_star_comment {
            let close = memchr::memmem::find(&self.source[self.end..], b"*/").map(|at| self.end + at + 2);
            return self.comment(close.ok_or(self.source.len()));
        }
        // Not a comment in this dialect, but nothing else either: one problem instead of one per word.
        self.report(SyntaxErrorKind::UnexpectedCharacter, self.start, self.end);
        let mut star = on_line(self.source, self.end, b'*');
        while let Ok(at) = star {
            if self.source.get(at + 1) == Some(&b'/') {
                return self.comment(Ok(at + 2));
            }
            star = on_line(self.source, at + 1, b'*');
        }
        self.comment(star)
    }

    /// A comment up to its close, or (`Err`) one that is not closed, up to where it reaches.
    fn comment(&mut self, close: Result<usize, usize>) -> usize {
        match close {
            Ok(close) => {
                self.push(TokenKind::Comment);
                close
            }
            Err(limit) => {
                self.push(TokenKind::UnclosedComment);
                self.report(SyntaxErrorKind::UnclosedComment, self.start, limit);
                limit
            }
        }
    }

    /// `%` at the start of a line, with the program name after it as one token: the name may hold anything.
    fn percent(&mut self) -> usize {
        let first = self.out.block_is_empty();
        self.push(TokenKind::Percent);
        if !first {
            return self.end;
        }
        let line = &self.source[self.end..self.line_end()];
        let stop = memchr::memchr2(b'(', b';', line).unwrap_or(line.len());
        let name = line[..stop].trim_ascii();
        if name.is_empty() {
            return self.end;
        }
        let lead = line.iter().position(|byte| !byte.is_ascii_whitespace()).unwrap_or(0);
        if lead > 0 {
            self.out.push(TokenKind::Blank, self.end as u32);
        }
        self.out.push(TokenKind::Name, (self.end + lead) as u32);
        self.end + lead + name.len()
    }

    fn semicolon(&mut self) -> usize {
        let line_end = self.line_end();
        if !self.options.semicolon_comment {
            let rest = self.source[self.end..line_end].trim_ascii();
            let is_comment = || {
                rest.strip_prefix(b"(")
                    .is_some_and(|rest| rest.iter().position(|&byte| byte == b')') == rest.len().checked_sub(1))
            };
            if rest.is_empty() || is_comment() {
                // The end-of-block mark of a printed listing; a comment may follow it.
                self.push(TokenKind::Blank);
                return self.end;
            }
            self.report(SyntaxErrorKind::UnexpectedCharacter, self.start, self.end);
        }
        self.push(TokenKind::Comment);
        line_end
    }
}
