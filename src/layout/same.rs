//! Whether two texts contain the same words: token by token, ignoring only what a layout may change. That is blanks between
//! tokens and inside words, empty lines, the kind of line end, case where it has no meaning, and zeros before a code's number.
use crate::blanks::is_plain_blank;
use trunnion_syntax::{Address, Item, Program, TextRange, TokenId, TokenKind, Value};

/// Whether two parsed blocks are the same words in the same order, read as the same items.
pub(crate) fn same_block(a: &Program, b: &Program) -> bool {
    same_text(a, b).is_none() && {
        let items = |program| Items {
            program,
            block: 0,
            open: None,
        };
        items(a).eq(items(b))
    }
}

/// The first place (in `b`) where two texts differ in words; `None` if they do not.
pub(crate) fn same_text(a: &Program, b: &Program) -> Option<TextRange> {
    let (mut left, mut right) = (Tokens::new(a), Tokens::new(b));
    loop {
        match (left.next(), right.next()) {
            (None, None) => return None,
            (Some(Token::LineEnd), Some(Token::LineEnd)) => {}
            (Some(Token::Text(kind, x)), Some(Token::Text(other, y)))
                if kind == other && says(kind, a.bytes(x), b.bytes(y)) => {}
            (_, Some(Token::Text(_, range))) => return Some(range),
            _ => return Some(TextRange::new(right.at(), right.at())),
        }
    }
}

/// Whether two tokens of one kind mean the same.
fn says(kind: TokenKind, a: &[u8], b: &[u8]) -> bool {
    if a == b {
        return true;
    }
    match kind {
        TokenKind::Comment
        | TokenKind::UnclosedComment
        | TokenKind::Text
        | TokenKind::FreeText
        | TokenKind::Continuation
        | TokenKind::Unknown
        | TokenKind::Blank => false,
        TokenKind::Word => core_of(a).eq(core_of(b)),
        _ => letters_of(a).eq(letters_of(b)),
    }
}

/// Bytes without blanks, upper case.
fn letters_of(text: &[u8]) -> impl Iterator<Item = u8> {
    text.iter()
        .filter(|byte| !matches!(byte, b' ' | b'\t'))
        .map(u8::to_ascii_uppercase)
}

/// The same of a word; of a G or M code without zeros before its number.
fn core_of(text: &[u8]) -> impl Iterator<Item = u8> {
    let code = matches!(text.first(), Some(b'G' | b'g' | b'M' | b'm'));
    let digits = letters_of(&text[1..]).take_while(u8::is_ascii_digit).count();
    let zeros = letters_of(&text[1..]).take_while(|&byte| byte == b'0').count();
    let skipped = if code && digits > 0 { zeros.min(digits - 1) } else { 0 };
    letters_of(text)
        .enumerate()
        .filter(move |(at, _)| *at == 0 || *at > skipped)
        .map(|(_, byte)| byte)
}

/// A token, or the end of a line with content.
enum Token {
    Text(TokenKind, TextRange),
    LineEnd,
}

/// The tokens with meaning.
struct Tokens<'p> {
    program: &'p Program,
    next: TokenId,
    /// The current line has content.
    content: bool,
}

impl<'p> Tokens<'p> {
    fn new(program: &'p Program) -> Self {
        Self {
            program,
            next: 0,
            content: false,
        }
    }
    /// Byte at which the next token starts.
    fn at(&self) -> u32 {
        let table = self.program.tokens();
        if (self.next as usize) < table.len() {
            table.range(self.next).start
        } else {
            self.program.source().len() as u32
        }
    }
}

impl Iterator for Tokens<'_> {
    type Item = Token;

    fn next(&mut self) -> Option<Token> {
        let table = self.program.tokens();
        while (self.next as usize) < table.len() {
            let (kind, range) = (table.kind(self.next), table.range(self.next));
            self.next += 1;
            match kind {
                TokenKind::Newline if self.content => {
                    self.content = false;
                    return Some(Token::LineEnd);
                }
                TokenKind::Newline => {}
                TokenKind::Blank if is_plain_blank(self.program.bytes(range)) => {}
                _ => {
                    self.content = true;
                    return Some(Token::Text(kind, range));
                }
            }
        }
        // a last line without a line end still ends
        std::mem::take(&mut self.content).then_some(Token::LineEnd)
    }
}

/// What the items of a program are, without their places.
struct Items<'p> {
    program: &'p Program,
    block: u32,
    open: Option<trunnion_syntax::Items<'p>>,
}

/// An item by what it is, and how many tokens' bytes it has without blanks.
#[derive(PartialEq)]
struct Shape {
    sort: std::mem::Discriminant<Item>,
    value: Option<std::mem::Discriminant<Value>>,
    visible: usize,
    /// How many bytes of it are its name, if it has one: digits after a name may belong to it.
    name: usize,
}

impl Iterator for Items<'_> {
    type Item = Shape;

    fn next(&mut self) -> Option<Shape> {
        loop {
            if let Some(item) = self.open.as_mut().and_then(Iterator::next) {
                return Some(shape(self.program, &item));
            }
            if self.block as usize >= self.program.block_count() {
                return None;
            }
            self.open = Some(self.program.block(trunnion_syntax::BlockId(self.block)).items());
            self.block += 1;
        }
    }
}

fn shape(program: &Program, item: &Item) -> Shape {
    let visible = |range: TextRange| letters_of(program.bytes(range)).count();
    let value = if let Item::Word(word) = item {
        Some(std::mem::discriminant(&word.value))
    } else {
        None
    };
    // zeros of a code may come and go
    let whole = match item {
        Item::Word(word) if value.is_some() && core_of(program.bytes(word.range)).count() < visible(word.range) => {
            core_of(program.bytes(word.range)).count()
        }
        _ => visible(crate::iso::range_of(item)),
    };
    Shape {
        sort: std::mem::discriminant(item),
        value,
        visible: whole,
        name: match item {
            Item::Call(call) => visible(call.name),
            Item::Word(word) => match word.address {
                Address::Named(name) => visible(name),
                _ => 0,
            },
            _ => 0,
        },
    }
}
