//! The TOML shape of a dialect table. Unknown keys are errors; every error says where.
use crate::advice::AdviceRow;
use crate::quirks::QuirksRow;
use crate::{Action, Dialect, Role, assemble::assemble};
use serde::Deserialize;
use std::collections::BTreeMap;
use toml::Spanned;

/// Why a table could not be loaded.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DialectError {
    /// What is wrong and what to do.
    pub message: String,
    /// Bytes in the table's text, where known.
    pub span: Option<core::ops::Range<usize>>,
}

impl core::fmt::Display for DialectError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for DialectError {}

/// Who gives a code its meaning.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Owner {
    /// The control.
    #[default]
    Control,
    /// The machine builder: another machine may use it for something else.
    MachineBuilder,
}

/// A whole table.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub(crate) struct Table {
    pub(crate) name: Spanned<String>,
    /// Default: the name.
    pub(crate) title: Option<String>,
    /// Source of every code that names none of its own. Default: this table.
    pub(crate) source: Option<String>,
    pub(crate) extends: Option<Spanned<String>>,
    #[serde(default)]
    pub(crate) extensions: Vec<Spanned<String>>,
    /// Codes of the extended table that this control does not have.
    #[serde(default)]
    pub(crate) remove: Vec<Spanned<String>>,
    /// Codes that the machine builder may give a meaning.
    #[serde(default)]
    pub(crate) builder_codes: Vec<Spanned<String>>,
    pub(crate) lex: Option<Lex>,
    pub(crate) arc_tolerance: Option<ArcToleranceRow>,
    #[serde(default)]
    pub(crate) quirks: QuirksRow,
    #[serde(default)]
    pub(crate) check: AdviceRow,
    /// Replaces the alarms of the extended table.
    pub(crate) alarms: Option<BTreeMap<Spanned<String>, AlarmRow>>,
    #[serde(default)]
    pub(crate) roles: BTreeMap<Spanned<String>, Role>,
    #[serde(default)]
    pub(crate) addresses: BTreeMap<Spanned<String>, Role>,
    #[serde(default)]
    pub(crate) groups: BTreeMap<Spanned<String>, String>,
    #[serde(default)]
    pub(crate) codes: BTreeMap<Spanned<String>, CodeRow>,
}

/// A row of `[alarms]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct AlarmRow {
    pub(crate) number: String,
    pub(crate) source: Option<String>,
}

/// `[lex]`.
#[derive(Clone, Copy, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub(crate) struct Lex {
    pub(crate) format: FormatRow,
    pub(crate) paren_comment: bool,
    pub(crate) semicolon_comment: bool,
    pub(crate) slash_star_comment: bool,
    pub(crate) blanks_in_numbers: bool,
}

/// `format = "iso" | "apt" | "klartext" | "osp"`.
#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum FormatRow {
    Iso,
    Apt,
    Klartext,
    Osp,
}

/// `[arc-tolerance]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub(crate) struct ArcToleranceRow {
    pub(crate) mm: Spanned<f64>,
    pub(crate) inch: Option<Spanned<f64>>,
    pub(crate) relative: Option<Spanned<f64>>,
    pub(crate) relative_up_to: Option<Spanned<f64>>,
    pub(crate) source: Spanned<String>,
}

/// `feed = "per-minute" | "per-revolution"`.
#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub(crate) enum FeedRow {
    PerMinute,
    PerRevolution,
}

impl FeedRow {
    pub(crate) fn action(self) -> Action {
        match self {
            Self::PerMinute => Action::FeedPerMinute,
            Self::PerRevolution => Action::FeedPerRevolution,
        }
    }
}

/// One row of `[codes]`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub(crate) struct CodeRow {
    pub(crate) group: Option<Spanned<String>>,
    #[serde(deserialize_with = "crate::action::action")]
    pub(crate) action: Action,
    pub(crate) path: Option<crate::PathMode>,
    pub(crate) feed: Option<FeedRow>,
    #[serde(default)]
    pub(crate) words: Vec<String>,
    pub(crate) lengths: Option<Vec<Spanned<String>>>,
    pub(crate) doc: Spanned<String>,
    pub(crate) source: Option<Spanned<String>>,
    #[serde(default)]
    pub(crate) owner: Owner,
}

/// Loads a table; `extends` may name a built-in dialect.
pub fn load(toml: &str) -> Result<Dialect, DialectError> {
    let table: Table = toml::from_str(toml).map_err(|error| DialectError {
        message: crate::plain_toml(None, toml, error.message(), error.span()),
        span: error.span(),
    })?;
    assemble(table)
}
