//! The items of an ISO block: how tokens make words, names, labels and marks.
use crate::error::SyntaxErrorKind;
use crate::expression::{is_function, is_one_of};
use crate::scan::Scan;
use crate::sink::{Quiet, Sink};
use crate::{Address, Call, Comment, Decimal, Item, SyntaxError, TextRange, TokenId, TokenKind, Value, Word};

/// Names that own one operand without parentheses, even one that is glued on: `GOTO100`, `GOTOF LABEL`.
const JUMPS: [&str; 4] = ["GOTO", "GOTOF", "GOTOB", "GOTOC"];

/// Names that own a number, even one that is glued on: `DO1`.
const NUMBERED: [&str; 3] = ["DO", "END", "LBL"];

/// Names that own one expression: `IF R1>5`, `WHILE [#1 LT 2]`.
const CONDITIONS: [&str; 7] = ["IF", "ELSEIF", "WHILE", "UNTIL", "EVERY", "WHEN", "WHENEVER"];

/// Names that own the rest of the block: declarations, and loops with a syntax of their own.
const DECLARATIONS: [&str; 7] = ["DEF", "PROC", "EXTERN", "CASE", "FOR", "DEFINE", "REDEF"];

/// How far into a block the reader is: some marks have their meaning only in front.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Stage {
    /// Nothing but block delete so far.
    Start,
    /// Behind the block number.
    Numbered,
    /// Behind anything else.
    Inside,
}

/// Iterator over the items of a block. No allocation.
#[derive(Clone)]
pub struct Items<'p> {
    pub(crate) scan: Scan<'p>,
    pub(crate) at: TokenId,
    stage: Stage,
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

/// Where a comment's text begins and ends, by its marks.
pub(crate) fn comment(source: &[u8], range: TextRange) -> Comment {
    let text = &source[range.as_usize()];
    let (open, close) = match text {
        [b'(', .., b')'] => (1, 1),
        [b'/', b'*', rest @ ..] => (2, if rest.ends_with(b"*/") { 2 } else { 0 }),
        [b'$', b'$', ..] => (2, 0),
        _ => (1, 0),
    };
    Comment { range, inner: TextRange::new(range.start + open, range.end - close) }
}

impl<'p> Items<'p> {
    pub(crate) fn new(scan: Scan<'p>, first: TokenId) -> Self {
        Self { scan, at: first, stage: Stage::Start }
    }

    /// The next item; problems go to `sink`.
    #[inline]
    fn step(&mut self, sink: &mut impl Sink) -> Option<Item> {
        while self.at < self.scan.end {
            let at = self.at;
            match self.scan.kind(at) {
                TokenKind::Blank | TokenKind::Newline => self.at += 1,
                TokenKind::Word => return Some(self.word(at, sink)),
                _ => return Some(self.rare(at, sink)),
            }
        }
        None
    }

    /// A word in one piece: the path of nearly every token.
    #[inline]
    fn word(&mut self, at: TokenId, sink: &mut impl Sink) -> Item {
        let scan = self.scan;
        let next = scan.kind(at + 1);
        let behind = if next == TokenKind::Blank { scan.kind(at + 2) } else { next };
        if behind == TokenKind::Equals || next == TokenKind::Comma {
            return self.odd_word(at, sink);
        }
        let range = scan.range(at);
        let text = scan.bytes(range);
        let letter = text[0].to_ascii_uppercase();
        let blanks = text[1..].iter().take_while(|&&byte| byte == b' ' || byte == b'\t').count();
        let value_range = TextRange::new(range.start + 1 + blanks as u32, range.end);
        let value = match Decimal::parse(&text[1 + blanks..]) {
            Some(number) => Value::Number(number),
            None => scan.number(value_range, sink),
        };
        self.at = at + 1;
        self.stage = if letter == b'N' && self.stage == Stage::Start { Stage::Numbered } else { Stage::Inside };
        Item::Word(Word { address: Address::Letter(letter), value, range, value_range })
    }

    /// A word with `=` or a comma behind it.
    #[cold]
    fn odd_word(&mut self, at: TokenId, sink: &mut impl Sink) -> Item {
        let scan = self.scan;
        let range = scan.range(at);
        let equals = scan.skip_blank(at + 1);
        self.stage = Stage::Inside;
        if scan.kind(equals) == TokenKind::Equals {
            let text = scan.bytes(range);
            let index = text[1..].trim_ascii();
            let number = index.iter().all(u8::is_ascii_digit).then(|| core::str::from_utf8(index).ok()?.parse().ok());
            let address = match number.flatten() {
                Some(number) => Address::Indexed(text[0].to_ascii_uppercase(), number),
                None => Address::Named(range),
            };
            return self.assignment(at, address, equals, sink);
        }
        let blanks = scan.bytes(range)[1..].iter().take_while(|byte| byte.is_ascii_whitespace()).count() as u32;
        let start = range.start + 1 + blanks;
        let letter = Address::Letter(self.scan.source[range.start as usize].to_ascii_uppercase());
        if let Some(end) = scan.decimal_comma(at + 1, start, sink) {
            self.at = end;
            let value_range = TextRange::new(start, scan.range(end - 1).end);
            return Item::Word(Word { address: letter, value: Value::Bad, range: range.cover(value_range), value_range });
        }
        self.at = at + 1;
        let value_range = TextRange::new(start, range.end);
        Item::Word(Word { address: letter, value: scan.number(value_range, sink), range, value_range })
    }

    /// `address = value`, from the address's first token.
    fn assignment(&mut self, from: TokenId, address: Address, equals: TokenId, sink: &mut impl Sink) -> Item {
        let (value, value_range, end) = self.scan.assigned(equals, sink);
        self.at = end;
        Item::Word(Word { address, value, range: self.scan.span(from, end), value_range })
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
        if kind == TokenKind::Slash && stage == Stage::Start {
            return self.skip(at);
        }
        self.stage = Stage::Inside;
        match kind {
            TokenKind::Letter => self.letter(at, at, sink),
            TokenKind::Name => self.name(at, stage, sink),
            TokenKind::Hash => {
                let end = scan.parameter(at, sink);
                let equals = scan.skip_blank(end);
                if self.assigns(equals) {
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

    fn label(&mut self, from: TokenId, to: TokenId) -> Item {
        self.at = to;
        self.stage = Stage::Numbered;
        Item::Label(self.scan.span(from, to))
    }

    /// Whether a single `=` stands at `at`.
    fn assigns(&self, at: TokenId) -> bool {
        self.scan.kind(at) == TokenKind::Equals && self.scan.kind(at + 1) != TokenKind::Equals
    }

    /// Block delete at the start of the block: `/`, `/3`.
    fn skip(&mut self, at: TokenId) -> Item {
        let digits = if self.scan.kind(at + 1) == TokenKind::Number { self.scan.text(at + 1) } else { &[] };
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

    /// A letter without a number behind it: what else can be its value? `from` is the first token of its word.
    fn letter(&mut self, from: TokenId, at: TokenId, sink: &mut impl Sink) -> Item {
        let scan = self.scan;
        let address = Address::Letter(scan.text(at)[0].to_ascii_uppercase());
        let next = scan.skip_blank(at + 1);
        let end = match scan.kind(next) {
            TokenKind::Equals => return self.assignment(from, address, next, sink),
            TokenKind::BracketOpen => {
                let end = scan.group(next, sink);
                let equals = scan.skip_blank(end);
                if self.assigns(equals) {
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
                return Item::Word(Word { address, value, range: scan.span(from, next + 1), value_range });
            }
            TokenKind::Less if scan.text(next).len() > 1 => Some(next + 1),
            _ => None,
        };
        self.at = end.unwrap_or(at + 1);
        let range = scan.span(from, self.at);
        match end {
            Some(end) => {
                let value_range = scan.span(next, end);
                Item::Word(Word { address, value: Value::Expression(value_range), range, value_range })
            }
            None => {
                sink.report(SyntaxErrorKind::WordWithoutValue, scan.range(at));
                let value_range = TextRange::new(range.end, range.end);
                Item::Word(Word { address, value: Value::Missing, range, value_range })
            }
        }
    }

    /// Behind `SQRT[2]` or `ATAN[1]/[2]` at `at`.
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

    /// Behind one sign and its operand that is no number: `-#1`, `-[1+2]`, `-SIN[30]`.
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
        Item::Word(Word { address, value: Value::Bad, range: self.scan.span(from, end), value_range })
    }

    /// A name: label, assignment, jump, condition, declaration or call.
    fn name(&mut self, at: TokenId, stage: Stage, sink: &mut impl Sink) -> Item {
        let scan = self.scan;
        let text = scan.text(at);
        if let Some(item) = self.keyword(at, text, sink) {
            return item;
        }
        let end = scan.name_end(at);
        let next = scan.skip_blank(end);
        if scan.kind(next) == TokenKind::Colon && stage <= Stage::Numbered {
            return self.label(at, next + 1);
        }
        if self.assigns(next) {
            return self.assignment(at, Address::Named(scan.span(at, end)), next, sink);
        }
        if is_one_of(text, &DECLARATIONS) {
            let stop = scan.trim(next, scan.end);
            return self.call(at, end, next, (stop > next).then_some(stop));
        }
        match scan.kind(next) {
            TokenKind::BracketOpen => self.bracketed(at, end, next, sink),
            TokenKind::ParenOpen => {
                let stop = scan.group(next, sink);
                let closed = stop > next + 1 && scan.kind(stop - 1) == TokenKind::ParenClose;
                let inner = TextRange::new(scan.range(next).end, scan.span(next, stop - u32::from(closed)).end);
                self.at = stop;
                Item::Call(Call { name: scan.span(at, end), arguments: Some(inner), range: scan.span(at, stop) })
            }
            TokenKind::Text | TokenKind::Number => self.call(at, end, next, Some(next + 1)),
            _ => self.call(at, end, next, None),
        }
    }

    /// A jump or a condition: names that end where their letters end, whatever is glued on.
    fn keyword(&mut self, at: TokenId, text: &[u8], sink: &mut impl Sink) -> Option<Item> {
        let scan = self.scan;
        let next = scan.skip_blank(at + 1);
        if self.assigns(next) || scan.kind(next) == TokenKind::Colon {
            return None;
        }
        let stop = if is_one_of(text, &JUMPS) {
            if scan.kind(next) == TokenKind::ParenOpen { None } else { scan.operand(next, sink) }
        } else if is_one_of(text, &NUMBERED) {
            (scan.kind(next) == TokenKind::Number).then_some(next + 1)
        } else if is_one_of(text, &CONDITIONS) {
            scan.expression(at + 1, scan.range(at), sink)
        } else {
            return None;
        };
        Some(self.call(at, at + 1, next, stop))
    }

    /// The call of the name `at..end`, whose arguments, if any, are the tokens from `first` to before `stop`.
    fn call(&mut self, at: TokenId, end: TokenId, first: TokenId, stop: Option<TokenId>) -> Item {
        self.at = stop.unwrap_or(end);
        let arguments = stop.map(|stop| self.scan.span(first, stop));
        Item::Call(Call { name: self.scan.span(at, end), arguments, range: self.scan.span(at, self.at) })
    }

    /// A name with brackets: an element that is assigned (`A[1]=5`), a letter with a function glued on (`XSIN[30]`),
    /// or a name with arguments (`call [1] [2]`).
    fn bracketed(&mut self, at: TokenId, end: TokenId, open: TokenId, sink: &mut impl Sink) -> Item {
        let scan = self.scan;
        let text = scan.bytes(scan.span(at, end));
        let mut stop = scan.group(open, sink);
        let equals = scan.skip_blank(stop);
        if self.assigns(equals) {
            return self.assignment(at, Address::Named(scan.span(at, stop)), equals, sink);
        }
        if is_function(&text[1..]) && !is_function(text) {
            self.at = stop;
            let range = scan.span(at, stop);
            let value_range = TextRange::new(range.start + 1, range.end);
            let address = Address::Letter(text[0].to_ascii_uppercase());
            return Item::Word(Word { address, value: Value::Expression(value_range), range, value_range });
        }
        while scan.kind(scan.skip_blank(stop)) == TokenKind::BracketOpen {
            stop = scan.group(scan.skip_blank(stop), sink);
        }
        self.call(at, end, open, Some(stop))
    }
}
