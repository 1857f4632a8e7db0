//! The style of a program: the choices of `[format]` in `trunnion.toml`.

/// Case of the letters of words (`g1 x5`). Names that a program may define, texts and comments are never touched.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Case {
    /// `G1 X5`.
    #[default]
    Upper,
    /// `g1 x5`.
    Lower,
    /// As written.
    Keep,
}

/// The text between two words.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Spacing {
    /// One blank: `G1 X5 Y3`.
    #[default]
    One,
    /// Nothing between plain words: `G1X5Y3`.
    Packed,
}

/// Zeros before the number of a G or M code. Other numbers are never touched.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Zeros {
    /// As written.
    #[default]
    Keep,
    /// `G1`.
    Drop,
    /// Two digits at least: `G01`.
    Two,
}

/// The style of a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Style {
    /// Case of letters.
    pub case: Case,
    /// Between words.
    pub spacing: Spacing,
    /// G01 or G1.
    pub zeros: Zeros,
    /// Column, from 1, of comments after words; a comment whose words reach further follows them after one blank.
    /// `None`: comments that are set apart by two blanks or more keep their column, others follow after one blank.
    pub comment_column: Option<u16>,
    /// Blanks by which the body of a subprogram, loop or condition is indented.
    pub indent: u8,
    /// Most blank lines in a row.
    pub blank_lines: u8,
}

impl Default for Style {
    fn default() -> Self {
        Self {
            case: Case::Upper,
            spacing: Spacing::One,
            zeros: Zeros::Keep,
            comment_column: None,
            indent: 2,
            blank_lines: 1,
        }
    }
}
