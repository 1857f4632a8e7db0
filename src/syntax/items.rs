//! The items of an ISO block: how tokens make words, names, labels and marks.
use crate::comment::comment;
use crate::error::SyntaxErrorKind;
use crate::expression::is_function;
use crate::scan::Scan;
use crate::sink::{Quiet, Sink};
use crate::{Address, Decimal, Format, Item, SyntaxError, TextRange, TokenId, TokenKind, Value, Word};

/// How far into a block the reader is: some marks have a meaning only at the start.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Stage {
    /// Nothing but block delete so far.
    Start,
    /// After the block number.
    Numbered,
    /// After anything else.
    Inside,
}

/// Iterator over the items of a block. No allocation.
#[derive(Clone)]
pub struct Items<'p> {
    pub(crate) scan: Scan<'p>,
    pub(crate) at: TokenId,
    /// The last item that is not a plain word.
    found: Option<Item>,
    pub(crate) stage: Stage,
}

/// Reports every problem of the block that starts at token `first`.
pub(crate) fn check(scan: Scan<'_>, first: TokenId, errors: &mut Vec<SyntaxError>) {
    let mut items = Items::new(scan, first);
    while items.step(errors).is_some() {}
}

impl Iterator for Items<'_> {
    type Item = Item;

    #[inline]
    fn next(&mut self) -> Option<Item> {
        self.step(&mut Quiet)
    }
}

impl<'p> Items<'p> {
    pub(crate) fn new(scan: Scan<'p>, first: TokenId) -> Self {
        Self {
            scan,
            at: first,
            found: None,
            stage: Stage::Start,
        }
    }

    /// The next item; problems go to `sink`.
    #[inline]
    fn step(&mut self, sink: &mut impl Sink) -> Option<Item> {
        while self.at < self.scan.end {
            let at = self.at;
            let kind = self.scan.kind(at);
            if matches!(kind, TokenKind::Blank | TokenKind::Newline | TokenKind::Continuation) {
                self.at += 1;
                continue;
            }
            if kind == TokenKind::Word
                && let Some(word) = self.plain_word(at)
            {
                return Some(Item::Word(word));
            }
            // Through a field: so the words above never leave the registers.
            self.seek(at, sink);
            return self.found;
        }
        None
    }

    /// A word in one piece with a short number, and no `=` or comma after it: nearly every token.
    #[inline]
    fn plain_word(&mut self, at: TokenId) -> Option<Word> {
        let scan = self.scan;
        let next = scan.kind(at + 1);
        let behind = if next == TokenKind::Blank {
            scan.kind(at + 2)
        } else {
            next
        };
        if next == TokenKind::Comma
            || matches!(
                behind,
                TokenKind::Equals | TokenKind::ParenOpen | TokenKind::BracketOpen
            )
        {
            return None;
        }
        let range = scan.range(at);
        let (&letter, mut digits) = scan.bytes(range).split_first()?;
        while let [b' ' | b'\t', rest @ ..] = digits {
            digits = rest;
        }
        let number = Decimal::parse_short(digits)?;
        self.at = at + 1;
        let letter = letter.to_ascii_uppercase();
        self.pass(letter);
        let value_range = TextRange::new(range.end - digits.len() as u32, range.end);
        Some(Word {
            address: Address::Letter(letter),
            value: Value::Number(number),
            range,
            value_range,
        })
    }

    /// Records that a word of `letter` was read.
    #[inline]
    fn pass(&mut self, letter: u8) {
        let numbers = letter == b'N' && self.stage == Stage::Start;
        self.stage = if numbers { Stage::Numbered } else { Stage::Inside };
    }

    /// Reads the item at `at`, of any kind, into `found`.
    #[cold]
    #[inline(never)]
    fn seek(&mut self, at: TokenId, sink: &mut impl Sink) {
        let word = self.scan.kind(at) == TokenKind::Word;
        self.found = Some(if word { self.word(at, sink) } else { self.rare(at, sink) });
    }

    /// A word in one piece.
    fn word(&mut self, at: TokenId, sink: &mut impl Sink) -> Item {
        if self.is_numbered_call(at) {
            return self.name(at, self.stage, sink);
        }
        if let Some(element) = self.numbered_element(at, sink) {
            return element;
        }
        self.plain_word(at).map_or_else(|| self.odd_word(at, sink), Item::Word)
    }

    /// A word with `=` or a comma after it, or with an odd number.
    fn odd_word(&mut self, at: TokenId, sink: &mut impl Sink) -> Item {
        let scan = self.scan;
        let range = scan.range(at);
        let equals = scan.skip_blank(at + 1);
        if scan.kind(equals) == TokenKind::Equals {
            self.stage = Stage::Inside;
            let text = scan.bytes(range);
            let index = text[1..].trim_ascii();
            let number = index
                .iter()
                .all(u8::is_ascii_digit)
                .then(|| core::str::from_utf8(index).ok()?.parse().ok());
            let address = match number.flatten() {
                Some(number) => Address::Indexed(text[0].to_ascii_uppercase(), number),
                None => Address::Named(range),
            };
            return self.assignment(at, address, equals, sink);
        }
        let blanks = scan.bytes(range)[1..]
            .iter()
            .take_while(|byte| byte.is_ascii_whitespace())
            .count() as u32;
        let start = range.start + 1 + blanks;
        let letter = scan.source[range.start as usize].to_ascii_uppercase();
        self.pass(letter);
        let letter = Address::Letter(letter);
        if let Some(end) = scan.decimal_comma(at + 1, start, sink) {
            self.at = end;
            let value_range = TextRange::new(start, scan.range(end - 1).end);
            return Item::Word(Word {
                address: letter,
                value: Value::Bad,
                range: range.cover(value_range),
                value_range,
            });
        }
        self.at = at + 1;
        let value_range = TextRange::new(start, range.end);
        Item::Word(Word {
            address: letter,
            value: scan.number(value_range, sink),
            range,
            value_range,
        })
    }

    /// `address = value`, from the address's first token.
    pub(crate) fn assignment(
        &mut self,
        from: TokenId,
        address: Address,
        equals: TokenId,
        sink: &mut impl Sink,
    ) -> Item {
        let (value, value_range, end) = self.scan.assigned(equals, sink);
        self.at = end;
        Item::Word(Word {
            address,
            value,
            range: self.scan.span(from, end),
            value_range,
        })
    }

    /// Everything that is not a plain word.
    #[cold]
    fn rare(&mut self, at: TokenId, sink: &mut impl Sink) -> Item {
        let (scan, stage) = (self.scan, self.stage);
        let kind = scan.kind(at);
        if matches!(kind, TokenKind::Comment | TokenKind::UnclosedComment) {
            self.at = at + 1;
            return Item::Comment(comment(scan.source, scan.range(at)));
        }
        if kind == TokenKind::Slash && (stage == Stage::Start || stage == Stage::Numbered && scan.is_osp()) {
            return self.skip(at);
        }
        if scan.options.format == Format::Klartext {
            // its words have a view of their own: `Sentence`
            self.at = at + 1;
            return self.silent(at, at + 1);
        }
        if kind == TokenKind::Name
            && stage == Stage::Start
            && let Some(end) = self.osp_name(at)
        {
            return self.label(at, end);
        }
        self.stage = Stage::Inside;
        match kind {
            TokenKind::Letter => self.letter(at, at, sink),
            TokenKind::Name => self.name(at, stage, sink),
            TokenKind::Hash => {
                let end = scan.parameter(at, sink);
                let equals = scan.skip_blank(end);
                if self.scan.assigns(equals) {
                    return self.assignment(at, Address::Named(scan.span(at, end)), equals, sink);
                }
                sink.report(SyntaxErrorKind::UnexpectedCharacter, scan.span(at, end));
                self.silent(at, end)
            }
            TokenKind::Percent => self.percent(at, stage, sink),
            TokenKind::Colon if stage <= Stage::Numbered => match scan.kind(at + 1) {
                TokenKind::Number => self.label(at, at + 2),
                TokenKind::Name => self.label(at, scan.name_end(at + 1)),
                _ => self.stray(at, sink),
            },
            TokenKind::Comma => self.comma(at, sink),
            _ => self.stray(at, sink),
        }
    }

    pub(crate) fn label(&mut self, from: TokenId, to: TokenId) -> Item {
        self.at = to;
        self.stage = Stage::Numbered;
        Item::Label(self.scan.span(from, to))
    }

    /// Block delete at the start of the block: `/`, `/3`.
    fn skip(&mut self, at: TokenId) -> Item {
        let digits = if self.scan.kind(at + 1) == TokenKind::Number {
            self.scan.text(at + 1)
        } else {
            &[]
        };
        let level = core::str::from_utf8(digits).ok().and_then(|text| text.parse().ok());
        self.at = if level.is_some() { at + 2 } else { at + 1 };
        Item::Skip(level.unwrap_or(1), self.scan.span(at, self.at))
    }

    fn percent(&mut self, at: TokenId, stage: Stage, sink: &mut impl Sink) -> Item {
        let next = self.scan.skip_blank(at + 1);
        let last = matches!(self.scan.kind(next), TokenKind::Newline | TokenKind::Comment);
        self.at = at + 1;
        if self.scan.kind(next) == TokenKind::Name && stage == Stage::Start {
            self.at = next + 1;
        } else if !last && stage != Stage::Start {
            sink.report(SyntaxErrorKind::UnexpectedCharacter, self.scan.range(at));
        }
        Item::Percent(self.scan.span(at, self.at))
    }

    /// `,R5` and `,C2` (chamfer and corner words) carry the comma in their address: they are not R and C.
    fn comma(&mut self, at: TokenId, sink: &mut impl Sink) -> Item {
        let next = self.scan.skip_blank(at + 1);
        let mut item = match self.scan.kind(next) {
            TokenKind::Word => self.word(next, sink),
            TokenKind::Letter => self.letter(next, next, sink),
            _ => return self.stray(at, sink),
        };
        if let Item::Word(word) = &mut item {
            let start = self.scan.range(at).start;
            word.address = Address::Named(TextRange::new(start, self.scan.range(next).start + 1));
            word.range.start = start;
        }
        item
    }

    /// A letter without a number after it: what else can be its value? `from` is the first token of its word.
    fn letter(&mut self, from: TokenId, at: TokenId, sink: &mut impl Sink) -> Item {
        let scan = self.scan;
        let address = Address::Letter(scan.text(at)[0].to_ascii_uppercase());
        let next = scan.skip_blank(at + 1);
        let end = match scan.kind(next) {
            TokenKind::Equals => return self.assignment(from, address, next, sink),
            TokenKind::BracketOpen => {
                let end = scan.group(next, sink);
                let equals = scan.skip_blank(end);
                if self.scan.assigns(equals) {
                    return self.assignment(from, Address::Named(scan.span(at, end)), equals, sink);
                }
                Some(end)
            }
            TokenKind::Hash => Some(scan.parameter(next, sink)),
            TokenKind::Plus | TokenKind::Minus => match self.signed(next, sink) {
                Some(end) => Some(end),
                None => return self.bad_sign(from, address, next, sink),
            },
            TokenKind::Name => self.function(next, sink),
            TokenKind::Text if next == at + 1 => {
                self.at = next + 1;
                let value_range = scan.range(next);
                let value = Value::Text(value_range);
                return Item::Word(Word {
                    address,
                    value,
                    range: scan.span(from, next + 1),
                    value_range,
                });
            }
            TokenKind::Less if scan.text(next).len() > 1 => Some(next + 1),
            _ => None,
        };
        self.at = end.unwrap_or(at + 1);
        let range = scan.span(from, self.at);
        let (value, value_range) = if let Some(end) = end {
            let value_range = scan.span(next, end);
            (Value::Expression(value_range), value_range)
        } else {
            sink.report(SyntaxErrorKind::WordWithoutValue, scan.range(at));
            (Value::Missing, TextRange::new(range.end, range.end))
        };
        Item::Word(Word {
            address,
            value,
            range,
            value_range,
        })
    }

    /// After `SQRT[2]` or `ATAN[1]/[2]` at `at`.
    fn function(&self, at: TokenId, sink: &mut impl Sink) -> Option<TokenId> {
        let scan = self.scan;
        let open = scan.skip_blank(scan.name_end(at));
        if scan.kind(open) != TokenKind::BracketOpen || !is_function(scan.bytes(scan.span(at, scan.name_end(at)))) {
            return None;
        }
        let end = scan.group(open, sink);
        let second = scan.skip_blank(end);
        if scan.kind(second) == TokenKind::Slash && scan.kind(scan.skip_blank(second + 1)) == TokenKind::BracketOpen {
            return Some(scan.group(scan.skip_blank(second + 1), sink));
        }
        Some(end)
    }

    /// After one sign and its operand that is not a number: `-#1`, `-[1+2]`, `-SIN[30]`.
    fn signed(&self, at: TokenId, sink: &mut impl Sink) -> Option<TokenId> {
        let next = self.scan.skip_blank(at + 1);
        match self.scan.kind(next) {
            TokenKind::Hash => Some(self.scan.parameter(next, sink)),
            TokenKind::BracketOpen => Some(self.scan.group(next, sink)),
            TokenKind::Name => self.function(next, sink),
            _ => None,
        }
    }

    /// A sign without digits, or several: `X-`, `X--5`.
    fn bad_sign(&mut self, from: TokenId, address: Address, at: TokenId, sink: &mut impl Sink) -> Item {
        let mut end = at;
        while matches!(self.scan.kind(end), TokenKind::Plus | TokenKind::Minus) {
            end += 1;
        }
        if self.scan.kind(end) == TokenKind::Number {
            end += 1;
        }
        self.at = end;
        let value_range = self.scan.span(at, end);
        sink.report(SyntaxErrorKind::BadNumber, value_range);
        Item::Word(Word {
            address,
            value: Value::Bad,
            range: self.scan.span(from, end),
            value_range,
        })
    }
}
