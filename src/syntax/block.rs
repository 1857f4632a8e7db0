//! Borrowed views: blocks, and the items in them.
use crate::comment::comment;
use crate::{BlockId, Decimal, Format, Items, Program, Record, Sentence, TextRange, TokenId, TokenKind, klartext};
use core::ops::Range;

/// A view of one block.
#[derive(Clone, Copy)]
pub struct Block<'p> {
    pub(crate) program: &'p Program,
    pub(crate) id: BlockId,
}

/// The address of a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Address {
    /// One letter, upper case: `X`; also `@` and `^` (polar words) and `$` (number of a spindle).
    Letter(u8),
    /// A letter with its own number before `=`: `A3=`, `S2=`, `R1=` (letter upper case, number).
    Indexed(u8, u16),
    /// Anything longer, with the range of its text: several letters before `=`, digits and index included (`CR=`, `MX1=`,
    /// `VAR5[R2]=`, `SPOS[1]=`), a parameter that is assigned (`#1=`, `#<name>=`, `#[#1+2]=`), and letters after a comma
    /// (`,R5` has the address `,R`: it is not an R word).
    Named(TextRange),
}

/// The value of a word.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// A number as written.
    Number(Decimal),
    /// A target around one plain number: `IC(10)`, `DC(90)`, `AC(5)`, `ACP()`, `ACN()`: name's range, number.
    Call(TextRange, Decimal),
    /// A quoted text: `T="DRILL"`.
    Text(TextRange),
    /// An expression, parameter or anything that must be evaluated: `R1+2`, `#1`, `[1+2]`. The range is its text.
    Expression(TextRange),
    /// Nothing: reported as a syntax error.
    Missing,
    /// Not a number, though digits are there: reported as a syntax error.
    Bad,
}

/// One word: address and value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Word {
    /// What it addresses.
    pub address: Address,
    /// Its value.
    pub value: Value,
    /// Bytes of the whole word.
    pub range: TextRange,
    /// Bytes of the value (for edits); empty where there is none.
    pub value_range: TextRange,
}

/// A name with or without arguments: `TRAORI`, `CYCLE800(1,"X",2)`, `GOTO 100`, `MSG("text")`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Call {
    /// The name's text, digits included (`CYCLE800`; but `GOTO` of `GOTO100`, `DO` of `DO1`).
    pub name: TextRange,
    /// Inside of the parentheses, if there are any. Of a name without parentheses: the brackets after it, with their marks
    /// (`call [1] [2]`); the condition of `IF`, `WHILE`, `UNTIL`; the target of `GOTO`; the number of `DO1`; the text of
    /// `CALL "NAME"`; the rest of the block after `DEF`, `PROC`, `FOR`, `CASE`.
    pub arguments: Option<TextRange>,
    /// Bytes of the whole.
    pub range: TextRange,
}

/// A comment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Comment {
    /// Bytes with the marks.
    pub range: TextRange,
    /// Bytes between the marks.
    pub inner: TextRange,
}

/// One item of an ISO block, in order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Item {
    /// A word.
    Word(Word),
    /// A name.
    Call(Call),
    /// A comment.
    Comment(Comment),
    /// Block delete `/` or `/3` at the start of the block: its level (1 where none is written).
    Skip(u8, TextRange),
    /// `%`, with the rest of its line where that is a program name (Sinumerik `%_N_NAME_MPF`).
    Percent(TextRange),
    /// A program or label mark: `:100`, `LABEL:`.
    Label(TextRange),
    /// Anything else (expressions without address, stray characters): the text's range. Reported where it is an error.
    Other(TextRange),
}

impl<'p> Block<'p> {
    /// Which block.
    pub fn id(&self) -> BlockId {
        self.id
    }
    /// The program it is in.
    pub fn program(&self) -> &'p Program {
        self.program
    }
    /// Its tokens, the line end included.
    pub fn tokens(&self) -> Range<TokenId> {
        self.program.block_tokens(self.id)
    }
    /// Its bytes without the line end.
    #[inline]
    pub fn range(&self) -> TextRange {
        let tokens = self.tokens();
        let table = &self.program.tokens;
        let (start, last) = (table.start(tokens.start), tokens.end - 1);
        let end = match table.kind(last) {
            TokenKind::Newline => table.start(last),
            _ => table.range(last).end,
        };
        TextRange::new(start, end)
    }
    /// Its first byte, which may be that of its line end.
    #[inline]
    pub fn first_byte(&self) -> Option<u8> {
        let start = self.program.tokens.start(self.program.blocks[self.id.0 as usize]);
        self.program.source.get(start as usize).copied()
    }
    /// It has more than blanks, comments and percent signs: what is counted as a block of a program.
    #[inline]
    pub fn has_code(&self) -> bool {
        self.first_byte().is_some_and(|byte| byte.is_ascii_alphabetic()) || self.has_code_inside()
    }
    #[inline(never)]
    fn has_code_inside(&self) -> bool {
        let text = &self.program.source[self.range().as_usize()];
        match text.iter().find(|byte| !byte.is_ascii_whitespace()) {
            None => return false,
            // a letter begins a word, a name or a record in either format
            Some(byte) if byte.is_ascii_alphabetic() => return true,
            Some(_) => {}
        }
        self.record().is_some()
            || self
                .items()
                .any(|item| !matches!(item, Item::Comment(_) | Item::Percent(_)))
    }
    /// Its items, ISO format. In APT format: comments, and every other token but blanks as [`Item::Other`].
    #[inline]
    pub fn items(&self) -> Items<'p> {
        let tokens = self.tokens();
        Items::new(self.program.scan(tokens.end), tokens.start)
    }
    /// Only the words.
    pub fn words(&self) -> impl Iterator<Item = Word> + use<'p> {
        self.items()
            .filter_map(|item| if let Item::Word(word) = item { Some(word) } else { None })
    }
    /// The block number as written (`N2930`), if there is one. Marks and labels may precede it.
    pub fn number(&self) -> Option<TextRange> {
        if self.program.options.format == Format::Klartext {
            let tokens = self.tokens();
            let scan = self.program.scan(tokens.end);
            return klartext::head(&scan, tokens.start).0.map(|token| scan.range(token));
        }
        let first = self
            .items()
            .find(|item| !matches!(item, Item::Skip(..) | Item::Comment(_)))?;
        match first {
            Item::Word(Word {
                address: Address::Letter(b'N'),
                value: Value::Number(_),
                range,
                ..
            }) => Some(range),
            _ => None,
        }
    }
    /// APT: the record, unless the statement is empty, is only a comment, or does not begin with a word (reported).
    pub fn record(&self) -> Option<Record<'p>> {
        let tokens = self.tokens();
        match self.program.options.format {
            Format::Iso | Format::Osp | Format::Klartext => None,
            Format::Apt => Record::read(self.program, self.program.scan(tokens.end), tokens.start),
        }
    }
    /// Klartext: its words, unless the block has none.
    pub fn sentence(&self) -> Option<Sentence<'p>> {
        let tokens = self.tokens();
        match self.program.options.format {
            Format::Iso | Format::Osp | Format::Apt => None,
            Format::Klartext => Sentence::read(self.program, self.program.scan(tokens.end), tokens.start),
        }
    }
    /// All comments of the block, both formats, those inside words and brackets included.
    pub fn comments(&self) -> impl Iterator<Item = Comment> + use<'p> {
        let program = self.program;
        self.tokens().filter_map(move |id| match program.tokens.kind(id) {
            TokenKind::Comment | TokenKind::UnclosedComment => Some(comment(&program.source, program.tokens.range(id))),
            _ => None,
        })
    }
}
