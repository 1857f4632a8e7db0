//! `[format]` of `trunnion.toml`: how `trunnion fmt` lays out programs. Only read here; no check uses it.
use serde::Deserialize;

/// Letters of words.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum FormatCase {
    /// `G1 X5`.
    Upper,
    /// `g1 x5`.
    Lower,
    /// As written.
    Keep,
}

/// Between words.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum FormatSpacing {
    /// One blank.
    One,
    /// Nothing.
    Packed,
}

/// `G01` or `G1`.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "kebab-case")]
pub enum FormatZeros {
    /// As written.
    Keep,
    /// `G1`.
    Drop,
    /// `G01`.
    Two,
}

/// What the file says; what it does not say is the formatter's own choice.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
#[serde(deny_unknown_fields)]
pub struct FormatSettings {
    /// `case = "upper"`.
    pub case: Option<FormatCase>,
    /// `spacing = "one"`.
    pub spacing: Option<FormatSpacing>,
    /// `leading_zeros = "keep"`: of G and M codes.
    pub leading_zeros: Option<FormatZeros>,
    /// `comment_column = 40`, from 1.
    pub comment_column: Option<u16>,
    /// `indent = 2`, blanks.
    pub indent: Option<u8>,
    /// `blank_lines = 1`, most in a row.
    pub blank_lines: Option<u8>,
}
