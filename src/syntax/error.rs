//! Problems of the text as facts; the check floor writes the messages.
use crate::TextRange;

/// What is wrong with a piece of text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SyntaxErrorKind {
    /// A comment is opened and not closed. Range: the comment.
    UnclosedComment,
    /// A comment opens inside a comment that has the same closing mark; the comment ends at the first one. Range: the first inner opening.
    NestedComment,
    /// A character that belongs to no word. Range: the character(s).
    UnexpectedCharacter,
    /// A letter has no value. Range: the letter.
    WordWithoutValue,
    /// A number without a letter. Range: the number.
    NumberWithoutLetter,
    /// Not a number: two points, a sign without digits, more digits than can be held exactly. Range: the number's text.
    BadNumber,
    /// A comma in place of a decimal point (`X1,5`). Range: the number with its comma.
    DecimalComma,
    /// Blanks inside a number in a dialect that does not allow them. Range: the number.
    BlankInNumber,
    /// `=`, an operator, `#` or an opening bracket without a value after it. Range: that sign.
    MissingValue,
    /// A bracket or parenthesis without its partner. Range: the bracket.
    UnbalancedBracket,
    /// A quoted text that is not closed on its line. Range: the text.
    UnclosedText,
    /// APT: a statement is continued by `$` at the end of the file. Range: the `$`.
    DanglingContinuation,
    /// APT: a statement does not begin with a major word, a comma or slash is not allowed there (range: that place), or GOTO does
    /// not have the 3, 6 or 7 numbers of a point, a tool axis and a feed (range: the statement).
    BadRecord,
    /// The file is larger than 4 GiB: only the part before is parsed. Range: its last byte.
    TooLarge,
}

/// One problem of the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SyntaxError {
    /// What is wrong.
    pub kind: SyntaxErrorKind,
    /// Where, inside the file.
    pub range: TextRange,
}
