//! What the lexer must know before it can split a text into tokens: the few lexical facts that differ per dialect.

/// The family of notations.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// ISO 6983 words: `N10 G1 X1.5`.
    Iso,
    /// APT / CL records: `GOTO / 1, 2, 3`.
    Apt,
    /// HEIDENHAIN Klartext: `12 L X+10 Y-5,5 R0 FMAX M3`.
    Klartext,
    /// Okuma OSP: ISO words, with names after `N` and `O` at the start of a block (`NLOOP G1 X1`), a first line `$NAME.MIN%`, lines that begin
    /// with `$` and continue the block above, and hexadecimal numbers `#1FH`.
    Osp,
}

impl Format {
    /// Blocks of words: ISO 6983 and what extends it.
    pub fn has_words(self) -> bool {
        match self {
            Self::Iso | Self::Osp => true,
            Self::Apt | Self::Klartext => false,
        }
    }
}

/// Lexical facts of a dialect. Comments the flags do not name are still lexed as far as that is unambiguous.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LexOptions {
    /// ISO words, APT records, Klartext or OSP.
    pub format: Format,
    /// `( ... )` is a comment (else it brackets arguments: `CYCLE81(1,2)`).
    pub paren_comment: bool,
    /// `;` starts a comment that runs to the end of the line (else it is a blank at the end of a line, and reported elsewhere).
    pub semicolon_comment: bool,
    /// `/* ... */` is a comment, also over several lines (else it is lexed as one on its line, and reported).
    pub slash_star_comment: bool,
    /// Blanks may be inside a number (`X1 2` is X12, as RS274/NGC says); otherwise that is reported as a bad number.
    pub blanks_in_numbers: bool,
}

impl Default for LexOptions {
    /// The common core: ISO words, all comment forms.
    fn default() -> Self {
        Self {
            format: Format::Iso,
            paren_comment: true,
            semicolon_comment: true,
            slash_star_comment: true,
            blanks_in_numbers: false,
        }
    }
}
