//! Text in a block that does not belong to a word or name.
use crate::error::SyntaxErrorKind;
use crate::items::Items;
use crate::sink::Sink;
use crate::{Item, TokenId, TokenKind};

impl Items<'_> {
    /// The text at `at`, which belongs to no word and no name; reported unless some dialect knows it.
    pub(crate) fn stray(&mut self, at: TokenId, sink: &mut impl Sink) -> Item {
        let scan = self.scan;
        match scan.kind(at) {
            TokenKind::Number => self.number(at, at, sink),
            TokenKind::Plus | TokenKind::Minus if scan.kind(scan.skip_blank(at + 1)) == TokenKind::Number => {
                self.number(at, scan.skip_blank(at + 1), sink)
            }
            // Block delete in the middle of a block: from here on, on controls that know it.
            TokenKind::Slash => {
                let end = if scan.kind(at + 1) == TokenKind::Number {
                    at + 2
                } else {
                    at + 1
                };
                self.silent(at, end)
            }
            // A checksum at the end of the block, as printers send it: `*57`.
            TokenKind::Star
                if scan.kind(at + 1) == TokenKind::Number
                    && matches!(
                        scan.kind(scan.skip_blank(at + 2)),
                        TokenKind::Newline | TokenKind::Comment
                    ) =>
            {
                self.silent(at, at + 2)
            }
            TokenKind::BracketOpen | TokenKind::ParenOpen => {
                let end = scan.group(at, sink);
                self.other(at, end, SyntaxErrorKind::UnexpectedCharacter, sink)
            }
            // The program that a call names, on controls that know it: `M98 <SUB>`.
            TokenKind::Less if let Some(end) = self.bracketed_name(at) => self.silent(at, end),
            TokenKind::ParenClose if self.closes_nested(at) => self.silent(at, at + 1),
            TokenKind::BracketClose | TokenKind::ParenClose => {
                self.other(at, at + 1, SyntaxErrorKind::UnbalancedBracket, sink)
            }
            TokenKind::Text if is_unclosed(scan.text(at)) => self.silent(at, at + 1),
            _ => {
                // One problem for a run of them, such as the dashes after a comment that ended too early.
                let mut end = at + 1;
                while self.is_stray(end) {
                    end += 1;
                }
                sink.report(SyntaxErrorKind::UnexpectedCharacter, scan.span(at, end));
                self.silent(at, end)
            }
        }
    }

    /// After `<NAME>` at `at`: only letters, digits and `-+_.` between.
    fn bracketed_name(&self, at: TokenId) -> Option<TokenId> {
        let scan = self.scan;
        let mut end = at + 1;
        while scan.kind(end) != TokenKind::Greater {
            let name = |byte: &u8| byte.is_ascii_alphanumeric() || b"-+_.".contains(byte);
            if end >= scan.end || !scan.text(end).iter().all(name) {
                return None;
            }
            end += 1;
        }
        (end > at + 1).then_some(end + 1)
    }

    /// The tokens `from..to` as text that fits nowhere; the first one is reported.
    fn other(&mut self, from: TokenId, to: TokenId, kind: SyntaxErrorKind, sink: &mut impl Sink) -> Item {
        sink.report(kind, self.scan.range(from));
        self.silent(from, to)
    }

    /// Whether the token at `at` can only be out of place, directly after another one.
    fn is_stray(&self, at: TokenId) -> bool {
        match self.scan.kind(at) {
            TokenKind::Plus | TokenKind::Minus => self.scan.kind(at + 1) != TokenKind::Number,
            TokenKind::Unknown
            | TokenKind::Star
            | TokenKind::Equals
            | TokenKind::Less
            | TokenKind::Greater
            | TokenKind::Colon => true,
            _ => false,
        }
    }

    /// The tokens `from..to`, which are correct or are reported already.
    pub(crate) fn silent(&mut self, from: TokenId, to: TokenId) -> Item {
        self.at = to;
        Item::Other(self.scan.span(from, to))
    }

    /// A number without a letter, from its sign at `from`.
    fn number(&mut self, from: TokenId, digits: TokenId, sink: &mut impl Sink) -> Item {
        let mut end = digits + 1;
        while self.scan.kind(end) == TokenKind::Comma && self.scan.kind(end + 1) == TokenKind::Number {
            end += 2;
        }
        let range = self.scan.span(from, end);
        let digits = self.scan.bytes(range).iter().any(u8::is_ascii_digit);
        let kind = if digits {
            SyntaxErrorKind::NumberWithoutLetter
        } else {
            SyntaxErrorKind::UnexpectedCharacter
        };
        sink.report(kind, range);
        self.silent(from, end)
    }

    /// Whether the `)` at `at` belongs to a comment that was opened inside a comment: reported there.
    fn closes_nested(&self, at: TokenId) -> bool {
        for before in (0..at).rev() {
            match self.scan.kind(before) {
                TokenKind::Newline | TokenKind::ParenClose => return false,
                TokenKind::Comment => {
                    let text = self.scan.text(before);
                    if text.starts_with(b"(") {
                        return text[1..].contains(&b'(');
                    }
                }
                _ => {}
            }
        }
        false
    }
}

/// Whether a quoted text lacks its closing mark, which the lexer reports.
fn is_unclosed(text: &[u8]) -> bool {
    text.len() < 2 || text.first() != text.last()
}
