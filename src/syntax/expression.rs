//! The extent of an expression. It is not evaluated here: the floor above needs only the range of its text.
use crate::error::SyntaxErrorKind;
use crate::scan::Scan;
use crate::sink::Sink;
use crate::{Format, TextRange, TokenId, TokenKind, Value};

/// Operators that are written as words, of all dialects.
const BINARY: [&str; 17] = [
    "AND", "OR", "XOR", "EOR", "MOD", "DIV", "EQ", "NE", "LT", "LE", "GT", "GE", "B_AND", "B_OR", "B_XOR", "B_NOT",
    "NAND",
];

/// Ways to write a rotary or incremental target around one number (Sinumerik).
const TARGETS: [&str; 10] = ["AC", "IC", "DC", "ACP", "ACN", "CAC", "CIC", "CDC", "CACP", "CACN"];

/// Functions of one bracket that may follow a letter directly (`X SQRT[2]`).
const FUNCTIONS: [&str; 20] = [
    "SIN", "COS", "TAN", "ASIN", "ACOS", "ATAN", "ATAN2", "ABS", "SQRT", "SQR", "ROUND", "RND", "FIX", "FUP", "LN",
    "EXP", "EXISTS", "BIN", "BCD", "POW",
];

/// Whether `text` is one of `words`, in upper or lower case.
pub(crate) fn is_one_of(text: &[u8], words: &[&str]) -> bool {
    words.iter().any(|word| text.eq_ignore_ascii_case(word.as_bytes()))
}

/// Whether `text` is a function that may follow a letter directly.
pub(crate) fn is_function(text: &[u8]) -> bool {
    is_one_of(text, &FUNCTIONS)
}

impl Scan<'_> {
    /// The token after the name that starts at `at`: `CYCLE800` and `VAR5B` are one name each.
    pub(crate) fn name_end(&self, at: TokenId) -> TokenId {
        let mut next = at + 1;
        while matches!(
            self.kind(next),
            TokenKind::Number | TokenKind::Name | TokenKind::Letter | TokenKind::Word
        ) && self
            .text(next)
            .iter()
            .all(|&byte| byte.is_ascii_alphanumeric() || byte == b'_')
        {
            next += 1;
        }
        next
    }

    /// The token after a binary operator at `at`, if there is one.
    pub(crate) fn binary(&self, at: TokenId) -> Option<TokenId> {
        let next = self.kind(at + 1);
        let length = match (self.kind(at), next) {
            (TokenKind::Star, TokenKind::Star)
            | (TokenKind::Equals | TokenKind::Less | TokenKind::Greater, TokenKind::Equals)
            | (TokenKind::Less, TokenKind::Greater | TokenKind::Less) => 2,
            (
                TokenKind::Plus
                | TokenKind::Minus
                | TokenKind::Star
                | TokenKind::Slash
                | TokenKind::Less
                | TokenKind::Greater,
                _,
            ) => 1,
            (TokenKind::Name, _) if is_one_of(self.text(at), &BINARY) => 1,
            // frames of a Sinumerik are chained: `CTRANS(X,10):CROT(Z,30)`, `F1:$P_PFRAME`
            (TokenKind::Colon, next) if self.chains(at, next) => 1,
            _ => return None,
        };
        Some(at + length)
    }

    /// Whether `<<` stands at `at`.
    pub(crate) fn joins(&self, at: TokenId) -> bool {
        [at, at + 1].into_iter().all(|at| self.kind(at) == TokenKind::Less)
    }

    /// Whether a colon stands between a bracket or a name and another name.
    fn chains(&self, at: TokenId, next: TokenKind) -> bool {
        let before = self.trim(0, at);
        let is_frame = |kind| {
            matches!(
                kind,
                TokenKind::ParenClose | TokenKind::BracketClose | TokenKind::Name | TokenKind::Word
            )
        };
        let next = if next == TokenKind::Blank {
            self.kind(self.skip_blank(at + 1))
        } else {
            next
        };
        before > 0 && is_frame(self.kind(before - 1)) && matches!(next, TokenKind::Name | TokenKind::Word)
    }

    /// The token after the parameter that starts with `#` at `at`: `#1`, `##2`, `#[1+2]`, `#<name>`.
    pub(crate) fn parameter(&self, at: TokenId, sink: &mut impl Sink) -> TokenId {
        let mut next = at;
        while self.kind(next) == TokenKind::Hash {
            let range = self.range(next);
            if range.end - range.start > 1 {
                return next + 1;
            }
            next = self.skip_blank(next + 1);
        }
        match self.kind(next) {
            TokenKind::Number => next + 1,
            TokenKind::BracketOpen => self.group(next, sink),
            TokenKind::Name => {
                let end = self.name_end(next);
                if self.kind(end) == TokenKind::BracketOpen {
                    self.group(end, sink)
                } else {
                    end
                }
            }
            _ => {
                sink.report(SyntaxErrorKind::MissingValue, self.range(at));
                self.trim(at + 1, next)
            }
        }
    }

    /// The token after one operand at `at`, signs not included; `None` if there is none.
    pub(crate) fn operand(&self, at: TokenId, sink: &mut impl Sink) -> Option<TokenId> {
        Some(match self.kind(at) {
            TokenKind::Number => self.exponent(at + 1).unwrap_or(at + 1),
            TokenKind::Text => at + 1,
            TokenKind::Hash if self.is_osp() => self.hexadecimal(at)?,
            TokenKind::Hash => self.parameter(at, sink),
            TokenKind::BracketOpen | TokenKind::ParenOpen => self.group(at, sink),
            TokenKind::Word | TokenKind::Letter => self.index(at + 1, sink),
            // MOD of an Okuma is a function
            TokenKind::Name if !self.is_operator(at) => {
                let end = self.name_end(at);
                let bracket = self.skip_blank(end);
                match self.kind(bracket) {
                    TokenKind::BracketOpen | TokenKind::ParenOpen => self.group(bracket, sink),
                    _ => end,
                }
            }
            _ => return None,
        })
    }

    /// Whether the name at `at` is an operator where an operand is wanted. On a Sinumerik EQ to GE are names like others, and so is `OR1`.
    fn is_operator(&self, at: TokenId) -> bool {
        const COMPARISONS: [&str; 6] = ["EQ", "NE", "LT", "LE", "GT", "GE"];
        let sinumerik = self.options.format == Format::Iso && !self.options.paren_comment;
        let (text, whole) = (self.text(at), self.bytes(self.span(at, self.name_end(at))));
        let name = if sinumerik { whole } else { text };
        let function = self.is_osp() && is_one_of(text, &["MOD"]) || sinumerik && is_one_of(name, &COMPARISONS);
        is_one_of(name, &BINARY) && !function
    }

    /// After the hexadecimal number `#1FH` at `at` (OSP).
    fn hexadecimal(&self, at: TokenId) -> Option<TokenId> {
        let end = self.name_end(at);
        let text = self.bytes(self.span(at, end)).split_first()?.1;
        let (mark, digits) = text.split_last()?;
        let is_one = matches!(mark, b'H' | b'h') && !digits.is_empty() && digits.iter().all(u8::is_ascii_hexdigit);
        is_one.then_some(end)
    }

    /// After an index `[..]` at `at`, if there is one.
    pub(crate) fn index(&self, at: TokenId, sink: &mut impl Sink) -> TokenId {
        let bracket = self.skip_blank(at);
        if self.kind(bracket) == TokenKind::BracketOpen {
            self.group(bracket, sink)
        } else {
            at
        }
    }

    /// After the exponent `EX-3` of a number (Sinumerik), if one stands at `at`.
    fn exponent(&self, at: TokenId) -> Option<TokenId> {
        if self.kind(at) != TokenKind::Name || !self.text(at).eq_ignore_ascii_case(b"EX") {
            return None;
        }
        let sign = matches!(self.kind(at + 1), TokenKind::Plus | TokenKind::Minus);
        let digits = if sign { at + 2 } else { at + 1 };
        (self.kind(digits) == TokenKind::Number).then_some(digits + 1)
    }

    /// After signs and `NOT` at `at`.
    fn unary(&self, mut at: TokenId) -> TokenId {
        loop {
            let signed = match self.kind(at) {
                TokenKind::Plus | TokenKind::Minus => true,
                TokenKind::Name => is_one_of(self.text(at), &["NOT", "B_NOT"]),
                _ => false,
            };
            if !signed {
                return at;
            }
            at = self.skip_blank(at + 1);
        }
    }

    /// The token after the expression at `at`; `None` if not even one operand is there. `owner` is the operator or
    /// `=` before it, which is reported if its value is missing.
    pub(crate) fn expression(&self, at: TokenId, owner: TextRange, sink: &mut impl Sink) -> Option<TokenId> {
        let (mut owner, mut at) = (owner, self.skip_blank(at));
        let mut behind = None;
        loop {
            let first = self.unary(at);
            let Some(end) = self.operand(first, sink) else {
                let signs = self.trim(at, first);
                let range = if signs > at { self.range(signs - 1) } else { owner };
                sink.report(SyntaxErrorKind::MissingValue, range);
                return if signs > at { Some(signs) } else { behind };
            };
            let operator = self.skip_blank(end);
            let Some(next) = self.binary(operator) else {
                return Some(end);
            };
            owner = self.span(operator, next);
            behind = Some(next);
            at = self.skip_blank(next);
        }
    }

    /// Whether there is a single `=` at `at`.
    pub(crate) fn assigns(&self, at: TokenId) -> bool {
        self.kind(at) == TokenKind::Equals && self.kind(at + 1) != TokenKind::Equals
    }

    /// Whether the next word of the block starts at `at`, after a blank or with its own `=`: no operand then.
    fn starts_word(&self, at: TokenId, equals: TokenId) -> bool {
        let behind = match self.kind(at) {
            TokenKind::Word
                if at > equals + 1 && b"NGMXYZABCUWFSTDO".contains(&self.text(at)[0].to_ascii_uppercase()) =>
            {
                return true;
            }
            TokenKind::Word | TokenKind::Letter => at + 1,
            TokenKind::Name => self.name_end(at),
            _ => return false,
        };
        self.assigns(self.skip_blank(behind))
    }

    /// The value after `=` at `equals`, its range, and the token after it.
    pub(crate) fn assigned(&self, equals: TokenId, sink: &mut impl Sink) -> (Value, TextRange, TokenId) {
        let at = self.skip_blank(equals + 1);
        if self.kind(at) == TokenKind::Text
            && self.source.get(self.range(at).start as usize) == Some(&b'"')
            && self.binary(self.skip_blank(at + 1)).is_none()
        {
            return (Value::Text(self.range(at)), self.range(at), at + 1);
        }
        if let Some(found) = self.plain_number(at, sink) {
            return found;
        }
        if let Some(found) = self.target(at) {
            return found;
        }
        if self.starts_word(at, equals) {
            sink.report(SyntaxErrorKind::MissingValue, self.range(equals));
            let behind = TextRange::new(self.range(equals).end, self.range(equals).end);
            return (Value::Missing, behind, equals + 1);
        }
        match self.expression(at, self.range(equals), sink) {
            Some(end) => {
                let range = self.span(at, end);
                (Value::Expression(range), range, end)
            }
            None => (
                Value::Missing,
                TextRange::new(self.range(equals).end, self.range(equals).end),
                equals + 1,
            ),
        }
    }

    /// A number with its sign at `at`, if no operator follows it.
    pub(crate) fn plain_number(&self, at: TokenId, sink: &mut impl Sink) -> Option<(Value, TextRange, TokenId)> {
        let sign = matches!(self.kind(at), TokenKind::Plus | TokenKind::Minus);
        let digits = if sign { self.skip_blank(at + 1) } else { at };
        if self.kind(digits) != TokenKind::Number || self.exponent(digits + 1).is_some() {
            return None;
        }
        if let Some(end) = self.decimal_comma(digits + 1, self.range(at).start, sink) {
            return Some((Value::Bad, self.span(at, end), end));
        }
        if self.binary(self.skip_blank(digits + 1)).is_some() {
            return None;
        }
        let range = self.span(at, digits + 1);
        Some((self.number(range, sink), range, digits + 1))
    }

    /// After `,5` at `at` directly after a number that starts at byte `start`: reported as a decimal comma.
    pub(crate) fn decimal_comma(&self, at: TokenId, start: u32, sink: &mut impl Sink) -> Option<TokenId> {
        let mut end = at;
        while self.kind(end) == TokenKind::Comma && self.kind(end + 1) == TokenKind::Number {
            end += 2;
        }
        if end == at {
            return None;
        }
        sink.report(
            SyntaxErrorKind::DecimalComma,
            TextRange::new(start, self.range(end - 1).end),
        );
        Some(end)
    }

    /// A target such as `DC(90)` at `at`: a known name around one plain number, with no operator after it.
    fn target(&self, at: TokenId) -> Option<(Value, TextRange, TokenId)> {
        if self.kind(at) != TokenKind::Name || !is_one_of(self.text(at), &TARGETS) {
            return None;
        }
        let open = self.skip_blank(at + 1);
        if self.kind(open) != TokenKind::ParenOpen {
            return None;
        }
        let first = self.skip_blank(open + 1);
        let sign = matches!(self.kind(first), TokenKind::Plus | TokenKind::Minus);
        let digits = if sign { first + 1 } else { first };
        let close = self.skip_blank(digits + 1);
        if self.kind(digits) != TokenKind::Number || self.kind(close) != TokenKind::ParenClose {
            return None;
        }
        let Value::Number(number) = self.number(self.span(first, digits + 1), &mut crate::sink::Quiet) else {
            return None;
        };
        if self.binary(self.skip_blank(close + 1)).is_some() {
            return None;
        }
        Some((Value::Call(self.range(at), number), self.span(at, close + 1), close + 1))
    }
}
