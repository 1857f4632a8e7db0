//! Token kinds: what a piece of text is, before it means anything.

/// The kind of one token. Tokens of all kinds together cover the source without gap or overlap.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum TokenKind {
    /// Spaces and tabs (also form feed, NUL and other control bytes that carry no meaning).
    Blank,
    /// `\n`, `\r\n` or `\r`: ends a block (APT: unless continued).
    Newline,
    /// A letter with its number in one piece: `G1`, `X-.5`, `x 1.5`.
    Word,
    /// A single letter without a number behind it: the `X` of `X=R1`, `X#1`, `X[1+2]`.
    Letter,
    /// Two or more letters (and `_`): `TRAORI`, `CYCLE` of `CYCLE800`, `GOTO`. APT: any identifier, digits included.
    Name,
    /// A number that follows no letter directly.
    Number,
    /// `=`
    Equals,
    /// `[`
    BracketOpen,
    /// `]`
    BracketClose,
    /// `(` where it is not a comment
    ParenOpen,
    /// `)` where it is not a comment
    ParenClose,
    /// `#`
    Hash,
    /// `,`
    Comma,
    /// `/` (block delete, division, APT major/minor separator)
    Slash,
    /// `*`
    Star,
    /// `+`
    Plus,
    /// `-`
    Minus,
    /// `<`
    Less,
    /// `>`
    Greater,
    /// `%`
    Percent,
    /// `:`
    Colon,
    /// `"..."` on one line
    Text,
    /// A closed comment: `( ... )`, `; ...`, `/* ... */`, APT `$$ ...`.
    Comment,
    /// A comment that is opened and not closed: reaches to the end of its line (`(`) or file (`/*`).
    UnclosedComment,
    /// APT `$` and the rest of its line including the line end: the statement goes on.
    Continuation,
    /// APT text that follows PARTNO, PPRINT, REMARK, INSERT ... to the end of the line.
    FreeText,
    /// Any byte that fits nowhere else, one byte (or one UTF-8 character) each.
    Unknown,
}
