//! Ids of codes in a table: one code, a range, a name.
use crate::schema::DialectError;
use crate::{Code, CodeKind};
use core::ops::{Range, RangeInclusive};
use toml::Spanned;
use trunnion_syntax::Format;

fn error<T>(span: Range<usize>, message: impl Into<String>) -> Result<T, DialectError> {
    Err(DialectError {
        message: message.into(),
        span: Some(span),
    })
}

/// What an id in a table means.
#[derive(Debug, PartialEq)]
pub(crate) enum Pattern {
    /// G or M codes from .. to, in tenths.
    Numbers(CodeKind, RangeInclusive<u32>),
    Name(String),
}

impl Pattern {
    /// `G43.4`, `M6`, `G505..G599`, `TRAORI`; APT words may hold `-` and blanks.
    pub(crate) fn parse(id: &Spanned<String>, format: Format) -> Result<Self, DialectError> {
        let text = id.get_ref();
        let (from, to) = text.split_once("..").unwrap_or((text, text));
        let numbers = format != Format::Apt && matches!(text.as_bytes(), [b'G' | b'M', b'0'..=b'9', ..]);
        if !numbers {
            let apt_name = text.split([' ', '-']).all(is_name) && !format.has_words();
            return if apt_name || is_name(text) {
                Ok(Self::Name(text.clone()))
            } else {
                error(
                    id.span(),
                    format!("`{text}` is not a code: write `G43.4`, `M6`, `G505..G599` or an upper-case name"),
                )
            };
        }
        let kind = if from.starts_with('G') {
            CodeKind::G
        } else {
            CodeKind::M
        };
        match (number_tenths(from), number_tenths(to)) {
            (Some(a), Some(b)) if from.as_bytes()[0] == to.as_bytes()[0] && (a < b || from == to) => {
                Ok(Self::Numbers(kind, a..=b))
            }
            _ => error(
                id.span(),
                format!("`{text}`: code numbers are 0 to 999.9, with at most one decimal and no leading zero"),
            ),
        }
    }
    pub(crate) fn matches(&self, code: &Code) -> bool {
        match self {
            Self::Name(name) => code.kind == CodeKind::Name && code.id == *name,
            Self::Numbers(kind, tenths) => {
                code.kind == *kind && number_tenths(&code.id).is_some_and(|t| tenths.contains(&t))
            }
        }
    }
}

/// Number of a canonical id in tenths: `G43.4` is 434. `None` unless it is written canonically.
pub(crate) fn number_tenths(id: &str) -> Option<u32> {
    let digits = id.get(1..)?;
    let (whole, tenth) = digits
        .split_once('.')
        .map_or((digits, None), |(whole, tenth)| (whole, Some(tenth)));
    let canonical = !whole.is_empty() && whole.len() <= 3 && whole.bytes().all(|b| b.is_ascii_digit());
    if !canonical || (whole.len() > 1 && whole.starts_with('0')) {
        return None;
    }
    let tenth = match tenth.map(str::as_bytes) {
        None => 0,
        Some([digit @ b'1'..=b'9']) => u32::from(digit - b'0'),
        Some(_) => return None,
    };
    Some(whole.parse::<u32>().ok()? * 10 + tenth)
}

pub(crate) fn number_id(kind: CodeKind, tenths: u32) -> String {
    let letter = if kind == CodeKind::G { 'G' } else { 'M' };
    match tenths % 10 {
        0 => format!("{letter}{}", tenths / 10),
        tenth => format!("{letter}{}.{tenth}", tenths / 10),
    }
}

/// An upper-case name.
pub(crate) fn is_name(text: &str) -> bool {
    let mut bytes = text.bytes();
    bytes.next().is_some_and(|b| b.is_ascii_uppercase() || b == b'_')
        && bytes.all(|b| b.is_ascii_uppercase() || b.is_ascii_digit() || b == b'_')
}
