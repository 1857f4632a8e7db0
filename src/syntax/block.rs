//! Borrowed views: blocks, and the items in them.
use crate::{BlockId, Decimal, Program, TextRange};

/// A view of one block.
#[derive(Clone, Copy)]
pub struct Block<'p> {
    pub(crate) program: &'p Program,
    pub(crate) id: BlockId,
}

/// The address of a word.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Address {
    /// One letter, upper case: `X`.
    Letter(u8),
    /// A letter with a number of its own before `=`: `A3=`, `S2=`, `R1=` (letter upper case, number).
    Indexed(u8, u16),
    /// Several letters before `=`, digits included: `CR=`, `TURN=`, `MX1=`. The range is the name's text.
    Named(TextRange),
}

/// The value of a word.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// A number as written.
    Number(Decimal),
    /// A call with one number: `IC(10)`, `DC(90)`, `AC(5)`, `ACP()`, `ACN()`: name's range, number.
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
    /// The name's text, digits included (`CYCLE800`).
    pub name: TextRange,
    /// Inside of the parentheses, if there are any.
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

/// Iterator over the items of a block. No allocation.
#[derive(Clone)]
pub struct Items<'p> {
    pub(crate) program: &'p Program,
    pub(crate) next: u32,
    pub(crate) end: u32,
}

/// An argument of an APT record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AptArg {
    /// A number and its bytes.
    Number(Decimal, TextRange),
    /// A minor word or identifier.
    Word(TextRange),
    /// Anything else, e.g. a nested definition `(POINT/1,2)`, or a broken number.
    Other(TextRange),
}

/// An APT record: major word and what follows the slash.
#[derive(Clone, Copy)]
pub struct Record<'p> {
    /// The program.
    pub program: &'p Program,
    /// The major word's bytes (`GOTO`); compare case-insensitively.
    pub major: TextRange,
    /// Bytes of the statement.
    pub range: TextRange,
    pub(crate) first: u32,
    pub(crate) end: u32,
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
    /// Its bytes without the line end.
    pub fn range(&self) -> TextRange {
        todo!()
    }
    /// Its items, ISO format (APT: comments and other tokens only).
    pub fn items(&self) -> Items<'p> {
        todo!()
    }
    /// Only the words.
    pub fn words(&self) -> impl Iterator<Item = Word> + use<'p> {
        self.items().filter_map(|item| if let Item::Word(word) = item { Some(word) } else { None })
    }
    /// The block number as written (`N2930`), if there is one.
    pub fn number(&self) -> Option<TextRange> {
        todo!()
    }
    /// APT: the record, unless the statement is empty or only a comment.
    pub fn record(&self) -> Option<Record<'p>> {
        todo!()
    }
    /// All comments of the block, both formats.
    pub fn comments(&self) -> impl Iterator<Item = Comment> + use<'p> {
        self.items().filter_map(|item| if let Item::Comment(comment) = item { Some(comment) } else { None })
    }
}

impl Iterator for Items<'_> {
    type Item = Item;
    fn next(&mut self) -> Option<Item> {
        let _ = (self.program, self.next, self.end);
        todo!()
    }
}

impl<'p> Record<'p> {
    /// The major word's text, upper case comparison is the caller's: `record.is("GOTO")`.
    pub fn is(&self, major: &str) -> bool {
        self.program.source()[self.major.as_usize()].eq_ignore_ascii_case(major.as_bytes())
    }
    /// The arguments in order.
    pub fn args(&self) -> impl Iterator<Item = AptArg> + use<'p> {
        let _ = (self.first, self.end);
        std::iter::empty()
    }
}
