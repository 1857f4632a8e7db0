//! What can be wrong with an expression, with the place in the file.
use core::fmt;
use std::borrow::Cow;
use trunnion_syntax::TextRange;

/// An expression that cannot be read, or that has no value.
#[derive(Clone, Debug, PartialEq)]
pub struct FormulaError {
    /// The part of the file that is wrong: the sign, the call, or the operation with its operands.
    pub range: TextRange,
    /// What is wrong.
    pub kind: FormulaErrorKind,
}

/// The cause of a [`FormulaError`].
#[derive(Clone, Debug, PartialEq)]
pub enum FormulaErrorKind {
    /// The line ends where a value is expected.
    MissingValue,
    /// Something that is not a number where a value is expected; `text` is what was read of a number (`""`, `-`, `.`).
    NotANumber {
        /// Sign, digits and points as far as they reach.
        text: Box<str>,
    },
    /// A number with two decimal points.
    TwoPoints {
        /// The number as written, without blanks.
        text: Box<str>,
    },
    /// `[` without `]` on the line.
    UnclosedBracket,
    /// Letters that are not a function; the first one in lower case.
    UnknownFunction(char),
    /// A function name without `[`.
    MissingBracket,
    /// `ATAN[y]` without `/`.
    MissingSlash,
    /// `ATAN[y]/` without `[`.
    MissingSecondBracket,
    /// `POW[x` without `,`.
    MissingComma,
    /// Neither an operator nor `]` after a value; the letter it begins with, if it is one, in lower case.
    UnknownOperator(Option<char>),
    /// `#<` without `>` on the line.
    UnclosedName,
    /// `EXISTS[` without `#`.
    MissingParameter,
    /// `EXISTS[#<name>` without `]`.
    MissingClose,
    /// Brackets nested deeper than the control allows.
    TooDeep {
        /// How many levels it allows.
        limit: usize,
    },
    /// A variable number or an operand that must be whole is not.
    NotInteger(f64),
    /// There is no variable of this number.
    ParameterOutOfRange(i64),
    /// The named variable has no value.
    NotDefined(Box<str>),
    /// The variable cannot be read, with the reason.
    NotReadable(Box<str>),
    /// The divisor is zero.
    DivisionByZero,
    /// The square root of a negative number.
    NegativeRoot,
    /// ACOS of a number outside -1 to 1.
    AcosRange,
    /// ASIN of a number outside -1 to 1.
    AsinRange,
    /// TAN of 90 deg, or of half turns more or less.
    NoTangent,
    /// LN of zero or of a negative number.
    LogarithmRange,
    /// A negative number to a power that is not whole.
    NegativePower,
    /// BIN or BCD of a number that is negative, not whole, too large, or (BIN) whose digits are not decimal.
    NotDecimalCoded,
    /// The result is larger than any number.
    Infinite,
    /// The operation has no result (`0 MOD 0`).
    Undefined,
}

impl fmt::Display for FormulaError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.kind.fmt(f)
    }
}

impl core::error::Error for FormulaError {}

/// One sentence without a full stop.
impl fmt::Display for FormulaErrorKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::MissingValue => f.write_str("a value is missing at the end of the line"),
            Self::NotANumber { text } if text.is_empty() => {
                f.write_str("expected a number, `#`, `[` or a function here")
            }
            Self::NotANumber { text } => write!(f, "`{text}` is not a number: it has no digit"),
            Self::TwoPoints { text } => write!(f, "`{text}` is not a number: it has more than one decimal point"),
            Self::UnclosedBracket => f.write_str("missing `]` for this `[`"),
            Self::UnknownFunction(letter) => {
                write!(f, "unknown function, starting with {}", letter.to_ascii_uppercase())
            }
            Self::MissingBracket => f.write_str("the argument of a function must be in `[ ]`"),
            Self::MissingSlash => f.write_str("ATAN needs two arguments: `ATAN[y]/[x]`"),
            Self::MissingSecondBracket => f.write_str("the second argument of ATAN must be in `[ ]`: `ATAN[y]/[x]`"),
            Self::MissingComma => f.write_str("POW needs two arguments: `POW[base,exponent]`"),
            Self::UnknownOperator(Some(letter)) => {
                write!(f, "unknown operator, starting with {}", letter.to_ascii_uppercase())
            }
            Self::UnknownOperator(_) => f.write_str("expected an operator or `]` here"),
            Self::UnclosedName => f.write_str("missing `>` for this `#<`"),
            Self::MissingParameter => f.write_str("EXISTS needs a parameter: `EXISTS[#<name>]`"),
            Self::MissingClose => f.write_str("EXISTS takes one parameter and nothing else: expected `]` here"),
            Self::TooDeep { limit } => write!(f, "brackets are nested deeper than {limit} levels"),
            Self::NotInteger(value) => write!(f, "{value} is not a whole number"),
            Self::ParameterOutOfRange(index) => write!(f, "parameter #{index} does not exist"),
            Self::NotDefined(name) => write!(f, "#<{name}> has no value here"),
            Self::NotReadable(reason) => f.write_str(reason),
            Self::DivisionByZero => f.write_str("division by zero"),
            Self::NegativeRoot => f.write_str("square root of a negative number"),
            Self::AcosRange => f.write_str("ACOS of a number outside -1 to 1"),
            Self::AsinRange => f.write_str("ASIN of a number outside -1 to 1"),
            Self::NoTangent => f.write_str("TAN of 90 or 270 degrees, which has no value"),
            Self::LogarithmRange => f.write_str("LN of zero or of a negative number"),
            Self::NegativePower => f.write_str("a negative number raised to a power that is not a whole number"),
            Self::NotDecimalCoded => {
                f.write_str("not a binary coded decimal: write at most eight decimal digits and no sign")
            }
            Self::Infinite => f.write_str("the result is too large"),
            Self::Undefined => f.write_str("the operation has no result"),
        }
    }
}

impl FormulaErrorKind {
    /// What LinuxCNC's stand-alone interpreter (2.9.0~pre1) prints for this, as observed; `None` where it has no such error.
    pub fn rs274_message(&self) -> Option<Cow<'static, str>> {
        Some(Cow::Borrowed(match self {
            Self::MissingValue => "No characters found in reading real value",
            Self::NotANumber { text } => {
                return Some(format!("bad number format (conversion failed) parsing '{text}'").into());
            }
            Self::TwoPoints { text } => {
                return Some(format!("bad number format (trailing characters) parsing '{text}'").into());
            }
            Self::UnclosedBracket => "Unclosed expression",
            Self::UnknownFunction(letter) if "acelfrst".contains(*letter) => {
                return Some(format!("Unknown word starting with {letter}").into());
            }
            Self::UnknownFunction(_) => "Unknown word where unary operation could be",
            Self::MissingBracket => "Left bracket missing after unary operation name",
            Self::MissingSlash => "Slash missing after first atan argument",
            Self::MissingSecondBracket => "Left bracket missing after slash with atan",
            Self::UnknownOperator(Some(letter)) if "aeglmnox".contains(*letter) => {
                return Some(format!("Unknown operation name starting with {letter}").into());
            }
            Self::UnknownOperator(_) => "Unknown operation",
            Self::UnclosedName => "Named parameter not terminated",
            Self::MissingParameter => "Expected # reading parameter",
            Self::MissingClose => "Expected ] reading bracketed parameter",
            Self::NotInteger(_) => "Non integer value for integer",
            Self::ParameterOutOfRange(_) => "Parameter number out of range",
            Self::NotDefined(name) => return Some(format!("Named parameter #<{name}> not defined").into()),
            Self::DivisionByZero => "Attempt to divide by zero",
            Self::NegativeRoot => "Negative argument to sqrt",
            Self::AcosRange => "Argument to acos out of range",
            Self::AsinRange => "Argument to asin out of range",
            Self::LogarithmRange => "Zero or negative argument to ln",
            Self::NegativePower => "Attempt to raise negative to non integer power",
            Self::Infinite => "Calculation resulted in 'infinity'",
            Self::Undefined => "Calculation resulted in 'not a number'",
            Self::NotReadable(reason) => return Some(reason.to_string().into()),
            Self::MissingComma | Self::TooDeep { .. } | Self::NotDecimalCoded | Self::NoTangent => return None,
        }))
    }
}
