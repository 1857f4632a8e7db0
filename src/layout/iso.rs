//! The layout of one block of ISO words.
use crate::blanks::{columns, is_plain_blank};
use crate::same::same_block;
use crate::style::{Spacing, Style};
use crate::words::{Letters, write};
use trunnion_dialect::Dialect;
use trunnion_syntax::{Address, Block, Format, Item, Program, TextRange, TokenId, TokenKind, parse};

/// Names whose brackets contain text for a printer: nothing in such a block is touched.
const PRINTS: [&[u8]; 5] = [b"DPRNT", b"BPRNT", b"POPEN", b"PCLOS", b"SETVN"];

/// Lines that a control refuses when they are longer: characters of a line of RS274/NGC, and of a Sinumerik block. A line within
/// these is not made longer than them.
const LONGEST_NGC: usize = 250;
const LONGEST: usize = 500;

/// A longer block is not a line of a program, bytes: it stays as it is, so that memory does not grow with it.
const LAID_OUT: usize = 1 << 16;

/// Lays out blocks of one program.
pub(crate) struct Blocks<'p> {
    pub(crate) program: &'p Program,
    pub(crate) dialect: &'p Dialect,
    pub(crate) style: &'p Style,
}

/// Whether there are blanks between two digits.
fn parts_number(text: &[u8]) -> bool {
    let digit = |byte: &u8| byte.is_ascii_digit() || *byte == b'.';
    let blank = |byte: &u8| matches!(byte, b' ' | b'\t');
    text.windows(2).any(|pair| digit(&pair[0]) && blank(&pair[1])) && text.last().is_some_and(digit)
}

/// What is to the left of a token.
struct Left {
    kind: TokenKind,
    item: Option<Item>,
    /// Blanks were there.
    gap: bool,
}

impl Blocks<'_> {
    /// Appends the block without its line end. A block whose new layout would not be read as the same words, or that is incomplete,
    /// stays byte for byte.
    pub(crate) fn write(&self, block: &Block<'_>, depth: usize, out: &mut Vec<u8>) {
        let from = out.len();
        let written = self.program.bytes(block.range());
        if self.stays(block) {
            out.extend_from_slice(written);
            return;
        }
        self.lay_out(block, depth, out);
        let laid = &out[from..];
        if laid == written {
            return;
        }
        let longest = if self.dialect.lex.blanks_in_numbers {
            LONGEST_NGC
        } else {
            LONGEST
        };
        let too_long = laid.len() > longest && laid.len() > written.len();
        let again = |text: &[u8]| parse(text.to_vec(), self.program.options());
        if too_long || !(self.is_simple(block) || same_block(&again(written), &again(laid))) {
            out.truncate(from);
            out.extend_from_slice(written);
        }
    }

    /// Whether a block consists only of unbroken words and comments: with blanks between, they cannot be read in another way. The proof
    /// of the whole text checks them again.
    fn is_simple(&self, block: &Block<'_>) -> bool {
        use TokenKind::{Blank, Comment, Newline, Word};
        let table = self.program.tokens();
        let simple = |id| matches!(table.kind(id), Word | Blank | Comment | Newline);
        self.style.spacing == Spacing::One && block.tokens().all(simple)
    }

    /// Whether nothing of a block may be touched: too long, problems, program names after `%`, texts for a printer, bytes without meaning.
    pub(crate) fn stays(&self, block: &Block<'_>) -> bool {
        let table = self.program.tokens();
        let range = block.range();
        // LinuxCNC refuses a long line: made shorter, it would run
        let length = range.as_usize().len();
        if length > LAID_OUT || self.dialect.quirks.rs274() && length > LONGEST_NGC {
            return true;
        }
        if self.program.options().format == Format::Osp && self.joins_number(block) {
            return true;
        }
        let errors = self.program.errors();
        let next = errors.partition_point(|error| error.range.end <= range.start);
        if errors.get(next).is_some_and(|error| error.range.start < range.end) {
            return true;
        }
        let mut percent = false;
        block.tokens().any(|id| {
            let text = self.program.bytes(table.range(id));
            match table.kind(id) {
                TokenKind::Blank => !is_plain_blank(text),
                TokenKind::Unknown | TokenKind::UnclosedComment | TokenKind::Continuation => true,
                // `GOTOF LBL1 2 GOTOF LBL2` of a CASE: two numbers, where the control does not read over blanks
                TokenKind::Word | TokenKind::Number => !self.dialect.lex.blanks_in_numbers && parts_number(text),
                TokenKind::Percent => {
                    percent = true;
                    false
                }
                TokenKind::Name => percent || PRINTS.iter().any(|name| text.eq_ignore_ascii_case(name)),
                _ => false,
            }
        })
    }

    /// Whether there is no blank behind the number of a block: OSP refuses it, and a layout with a blank would run.
    fn joins_number(&self, block: &Block<'_>) -> bool {
        let mut items = block.items();
        let number = items.find(|item| !matches!(item, Item::Skip(..)));
        let Some(number) = number.filter(|item| is_number(Some(*item))) else {
            return false;
        };
        let behind = self.program.source().get(range_of(&number).end as usize);
        !matches!(behind, None | Some(b' ' | b'\t' | b'(' | b'\r' | b'\n'))
    }

    fn lay_out(&self, block: &Block<'_>, depth: usize, out: &mut Vec<u8>) {
        debug_assert!(self.program.options().format.has_words());
        let table = self.program.tokens();
        let from = out.len();
        let control = is_control_line(block);
        let mut items = block.items().peekable();
        let mut indent = usize::from(self.style.indent) * depth;
        let mut left: Option<Left> = None;
        let mut item = None;
        let last = last_visible(self.program, block);
        for id in block.tokens() {
            let (kind, range) = (table.kind(id), table.range(id));
            match kind {
                TokenKind::Newline => break,
                TokenKind::Blank => {
                    if let Some(left) = &mut left {
                        left.gap = true;
                    }
                    continue;
                }
                _ => {}
            }
            let starts = items.peek().is_some_and(|item| range_of(item).start <= range.start);
            if starts {
                item = items.next();
            }
            let numbers = matches!(item, Some(Item::Skip(..))) || starts && is_number(item);
            if left.is_none() {
                if !numbers && !matches!(item, Some(Item::Percent(_))) {
                    out.extend(std::iter::repeat_n(b' ', std::mem::take(&mut indent)));
                }
            } else if let Some(left) = &left {
                let apart = kind == TokenKind::Comment && starts && Some(id) == last;
                if apart && !numbers_only(left.item) {
                    self.comment_gap(block, range, width(&out[from..]), out);
                } else if self.gap(left, kind, item, starts) {
                    out.push(b' ');
                } else if as_written(left, kind, item) {
                    // a blank here would be one that was written, when it is laid out again
                    indent = 0;
                }
                if starts && !numbers {
                    out.extend(std::iter::repeat_n(b' ', std::mem::take(&mut indent)));
                }
            }
            let letters = self.letters(item, starts, control);
            write(out, kind, self.program.bytes(range), letters, self.style);
            left = Some(Left { kind, item, gap: false });
        }
    }

    /// Whether there is a blank before a token.
    fn gap(&self, left: &Left, kind: TokenKind, item: Option<Item>, starts: bool) -> bool {
        if !starts {
            return match (left.kind, kind) {
                (TokenKind::Letter, TokenKind::Name | TokenKind::Equals) => left.gap,
                (TokenKind::Letter | TokenKind::BracketOpen | TokenKind::ParenOpen | TokenKind::Hash, _)
                | (_, TokenKind::BracketClose | TokenKind::ParenClose | TokenKind::Comma) => false,
                _ => left.gap,
            };
        }
        match (left.item, item) {
            (Some(Item::Skip(_, range)), _) => self.program.bytes(range).last().is_some_and(u8::is_ascii_digit),
            _ if as_written(left, kind, item) || self.may_be_one_name(left, item) => left.gap,
            (Some(Item::Word(_)), Some(Item::Word(word))) if self.style.spacing == Spacing::Packed => {
                // some controls read an E after digits as an exponent
                let joined =
                    left.kind == TokenKind::Word && kind == TokenKind::Word && word.address != Address::Letter(b'E');
                // OSP needs a blank behind the number of a block
                !joined || is_number(left.item) && self.program.options().format == Format::Osp
            }
            _ => true,
        }
    }

    /// Whether a control on which programs define names may read what is left and right of a place as one name: `WHILE DO1X1` asks for the
    /// variable `DO1X1`.
    fn may_be_one_name(&self, left: &Left, item: Option<Item>) -> bool {
        self.dialect.quirks.user_names()
            && matches!(left.item, Some(Item::Call(_)))
            && matches!(left.kind, TokenKind::Name | TokenKind::Number)
            && matches!(item, Some(Item::Word(_) | Item::Call(_) | Item::Label(_)))
    }

    /// The blanks before a comment after words.
    fn comment_gap(&self, block: &Block<'_>, comment: TextRange, now: usize, out: &mut Vec<u8>) {
        let wanted = match self.style.comment_column {
            Some(column) => usize::from(column).saturating_sub(1),
            None => self.written_column(block, comment),
        };
        out.extend(std::iter::repeat_n(b' ', wanted.saturating_sub(now).max(1)));
    }

    /// The column from 0 of a comment that is set apart; 0 for others.
    fn written_column(&self, block: &Block<'_>, comment: TextRange) -> usize {
        let before = self.program.bytes(TextRange::new(block.range().start, comment.start));
        let text = before.trim_ascii_end();
        let blank = &before[text.len()..];
        if blank.len() < 2 && !blank.contains(&b'\t') {
            return 0;
        }
        width(before)
    }

    /// Whether the letters of a token are the style's. Names are, if programs of the control cannot define names (Macro B).
    fn letters(&self, item: Option<Item>, starts: bool, control: bool) -> Letters {
        let own = self.dialect.quirks.numbers_follow_names && !self.dialect.quirks.user_names();
        let styled = match item {
            Some(Item::Word(word)) if starts => match word.address {
                Address::Letter(b'O') => !control,
                Address::Letter(b'G' | b'M') => return Letters::Code,
                Address::Letter(_) | Address::Indexed(..) => true,
                Address::Named(_) => own,
            },
            Some(Item::Word(_) | Item::Call(_)) => own,
            _ => false,
        };
        if styled { Letters::Styled } else { Letters::Kept }
    }
}

/// Whether there is a blank before an item where one was written, and none where none was: what is around it has no meaning of its own.
fn as_written(left: &Left, kind: TokenKind, item: Option<Item>) -> bool {
    let bare = matches!(left.item, Some(Item::Other(_) | Item::Percent(_))) || matches!(item, Some(Item::Other(_)));
    !matches!(left.item, Some(Item::Skip(..))) && (bare || kind == TokenKind::Comma)
}

/// The last token that is neither blank nor line end.
fn last_visible(program: &Program, block: &Block<'_>) -> Option<TokenId> {
    let table = program.tokens();
    block
        .tokens()
        .rev()
        .find(|&id| !matches!(table.kind(id), TokenKind::Blank | TokenKind::Newline))
}

/// Columns that the last line of a text takes.
fn width(text: &[u8]) -> usize {
    let line = text.iter().rposition(|&byte| byte == b'\n').map_or(0, |at| at + 1);
    columns(0, &text[line..])
}

/// Bytes of an item.
pub(crate) fn range_of(item: &Item) -> TextRange {
    match item {
        Item::Word(word) => word.range,
        Item::Call(call) => call.range,
        Item::Comment(comment) => comment.range,
        Item::Skip(_, range) | Item::Percent(range) | Item::Label(range) | Item::Other(range) => *range,
    }
}

/// Whether an item is a block number.
fn is_number(item: Option<Item>) -> bool {
    matches!(item, Some(Item::Word(word)) if word.address == Address::Letter(b'N'))
}

/// Whether there is only a block number or block delete on the left, so that a comment there is the content of its line.
fn numbers_only(item: Option<Item>) -> bool {
    is_number(item) || matches!(item, Some(Item::Skip(..)))
}

/// Whether a block is an O-word line of RS274/NGC (`o100 while [..]`), whose author has chosen its case as a whole.
fn is_control_line(block: &Block<'_>) -> bool {
    let mut items = block.items();
    let labelled = items.any(|item| matches!(item, Item::Word(word) if word.address == Address::Letter(b'O')));
    labelled && items.any(|item| matches!(item, Item::Call(_)))
}
