//! What is reported about undeclared zero points and tool lengths.
use super::OffsetName;
use trunnion_dialect::Dialect;
use trunnion_interp::{ChainId, LengthOf, UNNAMED_ZERO};
use trunnion_syntax::{BlockId, Format};

/// Something that is not declared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Missing {
    Offset(OffsetName),
    Length(LengthOf),
}

impl Missing {
    /// The cause under which it is reported: the offsets of a lathe's tools are one.
    pub(crate) fn reported(self) -> Self {
        match self {
            Self::Length(LengthOf::Offset(_)) => Self::Length(LengthOf::Offset(None)),
            other => other,
        }
    }

    /// As a sentence begins or continues: `G54`, `the length of tool 3`.
    pub(crate) fn name(&self, dialect: &Dialect) -> String {
        match self {
            Self::Offset(name) => match name.as_str() {
                "" if dialect.lex.format == Format::Apt => "the place of the part in the machine".to_owned(),
                "" if dialect.quirks.first_offset_at_start => "G54".to_owned(),
                "" if dialect.lex.format == Format::Klartext => {
                    format!("the preset that is active ({UNNAMED_ZERO} in trunnion.toml)")
                }
                "" => format!("the zero point without a work offset ({UNNAMED_ZERO})"),
                name => name.to_owned(),
            },
            Self::Length(LengthOf::Tool(Some(number))) => format!("the length of tool {number}"),
            Self::Length(LengthOf::Tool(None)) => "the length of the tool in use".to_owned(),
            Self::Length(LengthOf::Offset(Some(number))) => format!("the tool offset {number}"),
            Self::Length(LengthOf::Offset(None)) => "the tool offset that T names".to_owned(),
            Self::Length(LengthOf::Nothing | LengthOf::Other) => "the active tool length".to_owned(),
        }
    }

    /// How to declare it.
    pub(crate) fn help(&self, dialect: &Dialect) -> String {
        match self {
            Self::Offset(name) => {
                let own = match name.as_str() {
                    "" if dialect.lex.format == Format::Apt => {
                        return "`--assume work-offset` takes the part zero as the machine zero".to_owned();
                    }
                    "" if dialect.quirks.first_offset_at_start => "G54",
                    "" => UNNAMED_ZERO,
                    name => name,
                };
                let quoted = if own.bytes().all(|byte| byte.is_ascii_alphanumeric()) {
                    own.to_owned()
                } else {
                    format!("\"{own}\"")
                };
                format!(
                    "declare it in trunnion.toml: [work_offsets] {quoted} = {{ X = 0, Y = 0, Z = 0 }}; `--assume work-offset` takes it as zero"
                )
            }
            Self::Length(LengthOf::Offset(number)) => {
                let number = number.map_or_else(|| "...".to_owned(), |number| number.to_string());
                format!(
                    "declare it in trunnion.toml: [tool_offsets] {number} = {{ X = 0, Z = 0 }}, by its number; `--assume tool-length` takes the offsets of T as zero: a work offset in trunnion.toml is then the place of the part relative to the tip of \
                     the tool at machine zero"
                )
            }
            Self::Length(of) => {
                let number = match of {
                    LengthOf::Tool(Some(number)) => number.to_string(),
                    _ => "...".to_owned(),
                };
                format!(
                    "declare it in trunnion.toml: [[tool]] number = {number}, length = ...; `--assume tool-length` takes it as zero"
                )
            }
        }
    }

    /// As an assumption is listed: `G54 = 0 (not declared)`.
    pub(crate) fn assumption(&self, dialect: &Dialect) -> String {
        format!("{} = 0 (not declared)", self.name(dialect))
    }
}

/// The values of a zero point, or of a zero point plus a tool length, with which an axis stays within its travel.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fit {
    pub(crate) letter: u8,
    /// The undeclared length that is added to the zero point.
    pub(crate) with_length: Option<LengthOf>,
    /// Lowest and highest, mm.
    pub(crate) range: Result<[f64; 2], Unclear>,
}

/// Why it is unknown which values fit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Unclear {
    /// It is unknown which words are relative to this position.
    Motions,
    /// The tool runs beside the programmed path by an amount that is not computed.
    Radius,
}

impl Unclear {
    /// As a sentence ends; `missing`: the name of what is not declared.
    pub(crate) fn why(self, missing: &str) -> String {
        match self {
            Self::Motions => format!("it is unclear which motions depend on {missing}"),
            Self::Radius => "cutter radius compensation is not computed".to_owned(),
        }
    }
}

/// A cause that leaves the travel of linear axes open.
#[derive(Clone, Debug)]
pub(crate) struct Open {
    pub(crate) missing: Missing,
    /// Block and calls of the first motion that depends on it.
    pub(crate) block: BlockId,
    pub(crate) chain: ChainId,
    /// On a chain of linear axes: what fits.
    pub(crate) fits: Vec<Fit>,
}

/// An axis that leaves its travel wherever the zero is.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Overrun {
    pub(crate) missing: Missing,
    /// Block and calls of the first motion that spans too much.
    pub(crate) block: BlockId,
    pub(crate) chain: ChainId,
    pub(crate) letter: u8,
    /// How far the path spans, mm.
    pub(crate) span_mm: f64,
    /// Travel of the axis, mm.
    pub(crate) travel_mm: f64,
}
