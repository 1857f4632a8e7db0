//! A view of the tokens of one block, with the small steps of every grammar rule.
use crate::error::SyntaxErrorKind;
use crate::sink::Sink;
use crate::{Decimal, Format, LexOptions, TextRange, TokenId, TokenKind, TokenTable, Value};

/// The tokens up to `end`, and their text.
#[derive(Clone, Copy)]
pub(crate) struct Scan<'p> {
    pub(crate) source: &'p [u8],
    pub(crate) table: &'p TokenTable,
    pub(crate) options: LexOptions,
    /// One past the last token.
    pub(crate) end: TokenId,
}

/// The longest number that is tried without its blanks.
const LONGEST_NUMBER: usize = 64;

impl<'p> Scan<'p> {
    /// Kind of token `at`; a line end where there is none.
    #[inline]
    pub(crate) fn kind(&self, at: TokenId) -> TokenKind {
        if at < self.end {
            self.table.kinds[at as usize]
        } else {
            TokenKind::Newline
        }
    }

    /// Bytes of token `at`.
    #[inline]
    pub(crate) fn range(&self, at: TokenId) -> TextRange {
        self.table.range(at)
    }

    /// Bytes of the tokens `from..to`; empty at the start of `from` if there are none.
    pub(crate) fn span(&self, from: TokenId, to: TokenId) -> TextRange {
        let start = if from < self.end {
            self.range(from).start
        } else {
            self.block_end()
        };
        if to <= from {
            TextRange::new(start, start)
        } else {
            TextRange::new(start, self.range(to - 1).end)
        }
    }

    fn block_end(&self) -> u32 {
        if self.end == 0 { 0 } else { self.range(self.end - 1).end }
    }

    /// The text of a range.
    #[inline]
    pub(crate) fn bytes(&self, range: TextRange) -> &'p [u8] {
        &self.source[range.as_usize()]
    }

    /// The text of a token.
    pub(crate) fn text(&self, at: TokenId) -> &'p [u8] {
        self.bytes(self.range(at))
    }

    /// The next token from `at` on that is not a blank.
    #[inline]
    pub(crate) fn skip_blank(&self, mut at: TokenId) -> TokenId {
        while self.kind(at) == TokenKind::Blank || self.kind(at) == TokenKind::Continuation && self.is_osp() {
            at += 1;
        }
        at
    }

    /// Whether the words are those of OSP.
    pub(crate) fn is_osp(&self) -> bool {
        self.options.format == Format::Osp
    }

    /// After the last token of `from..to` that is neither blank nor comment nor line end.
    pub(crate) fn trim(&self, from: TokenId, mut to: TokenId) -> TokenId {
        while to > from {
            match self.kind(to - 1) {
                TokenKind::Blank
                | TokenKind::Comment
                | TokenKind::UnclosedComment
                | TokenKind::Continuation
                | TokenKind::Newline => to -= 1,
                _ => break,
            }
        }
        to
    }

    /// The token after a bracket group that opens at `at`. Without a partner the group ends with the block, and
    /// that is reported.
    pub(crate) fn group(&self, at: TokenId, sink: &mut impl Sink) -> TokenId {
        let (mut brackets, mut parens) = (0u32, 0u32);
        let mut before = at;
        for next in at..self.end {
            let kind = self.kind(next);
            match kind {
                TokenKind::BracketOpen => brackets += 1,
                TokenKind::ParenOpen => parens += 1,
                TokenKind::BracketClose if brackets > 0 => brackets -= 1,
                TokenKind::ParenClose if parens > 0 => parens -= 1,
                TokenKind::BracketClose | TokenKind::ParenClose => {
                    sink.report(SyntaxErrorKind::UnbalancedBracket, self.range(next));
                }
                TokenKind::Newline => break,
                TokenKind::Blank | TokenKind::Comment | TokenKind::Continuation => continue,
                _ => {}
            }
            let closes = matches!(kind, TokenKind::BracketClose | TokenKind::ParenClose);
            // `PO[]=(2,1)` of a Sinumerik is the common denominator
            let denominator = || {
                let named = before == at && at > 0 && self.text(at - 1).eq_ignore_ascii_case(b"PO");
                named && !self.options.paren_comment
            };
            let nothing =
                kind == TokenKind::BracketClose && self.kind(before) == TokenKind::BracketOpen && !denominator();
            if nothing || closes && self.lacks_operand(before) {
                sink.report(SyntaxErrorKind::MissingValue, self.range(before));
            }
            before = next;
            if brackets == 0 && parens == 0 {
                return next + 1;
            }
        }
        sink.report(SyntaxErrorKind::UnbalancedBracket, self.range(at));
        self.trim(at + 1, self.end)
    }

    /// Whether token `at` is an operator that needs a value after it.
    fn lacks_operand(&self, at: TokenId) -> bool {
        matches!(
            self.kind(at),
            TokenKind::Plus
                | TokenKind::Minus
                | TokenKind::Star
                | TokenKind::Slash
                | TokenKind::Equals
                | TokenKind::Hash
        ) && self.range(at).end - self.range(at).start == 1
    }

    /// The number written in `range`; anything else is reported.
    #[inline]
    pub(crate) fn number(&self, range: TextRange, sink: &mut impl Sink) -> Value {
        match Decimal::parse(self.bytes(range)) {
            Some(number) => Value::Number(number),
            None => self.odd_number(range, sink),
        }
    }

    #[cold]
    fn odd_number(&self, range: TextRange, sink: &mut impl Sink) -> Value {
        let mut joined = [0u8; LONGEST_NUMBER];
        let mut length = 0;
        for &byte in self.bytes(range).iter().filter(|byte| byte.is_ascii_graphic()) {
            let Some(slot) = joined.get_mut(length) else { break };
            *slot = byte;
            length += 1;
        }
        let number = Decimal::parse(&joined[..length]).filter(|_| length < LONGEST_NUMBER);
        match number {
            Some(number) if self.options.blanks_in_numbers => Value::Number(number),
            Some(_) => {
                sink.report(SyntaxErrorKind::BlankInNumber, range);
                Value::Bad
            }
            None => {
                sink.report(SyntaxErrorKind::BadNumber, range);
                Value::Bad
            }
        }
    }
}
