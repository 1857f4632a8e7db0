//! Token kinds: what a piece of text is, before it means anything.

/// The kind of one token. Tokens of all kinds together cover the source without gap or overlap.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[repr(u8)]
pub enum TokenKind {
    /// Spaces and tabs (also form feed, NUL and other control bytes that carry no meaning).
    Blank,
    /// `\n`, `\r\n` or `\r`: ends a block (APT: unless continued).
    Newline,
    /// A letter with its number in one piece: `G1`, `X-.5`, `x 1.5`; also `@1` and `^30` (polar words), `$0` (number of a spindle), and broken numbers (`X1.2.3`).
    Word,
    /// A single letter (or `@`, `^`) without a number after it: the `X` of `X=R1`, `X#1`, `X[1+2]`.
    Letter,
    /// Two or more letters: `TRAORI`, `CYCLE` of `CYCLE800`, `GOTO`. With its digits where a `_` or a leading `$` shows that they
    /// belong to it: `_X1_HOME`, `$P_AXN1`. Also the program name after `%`. APT: any identifier, digits included.
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
    /// `#`, or a named parameter in one piece: `#<name>`
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
    /// `<`; after the letter of an O word the whole name: `<name>` of `o<name> call`
    Less,
    /// `>`
    Greater,
    /// `%`
    Percent,
    /// `:`
    Colon,
    /// `"..."` or `'...'` on one line; an unclosed `"` reaches to the end of its line
    Text,
    /// A closed comment: `( ... )`, `; ...`, `/* ... */`, APT `$$ ...`.
    Comment,
    /// A comment that is opened and not closed: reaches to the end of its line (`(`) or file (`/*`).
    UnclosedComment,
    /// APT `$` and the rest of its line including the line end: the statement continues.
    Continuation,
    /// APT text that follows PARTNO, PPRINT, REMARK, INSERT ... to the end of the line.
    FreeText,
    /// Any byte that fits nowhere else, one byte (or one UTF-8 character) each.
    Unknown,
}
