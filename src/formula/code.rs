//! A compiled expression: postfix code, each step with its place in the file.
use crate::{FormulaErrorKind, Name, Variable};
use trunnion_syntax::{Decimal, TextRange};

/// An operation on one value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Unary {
    /// The end of a value in brackets: refused where it is infinite or does not exist.
    Check,
    Negate,
    Abs,
    Acos,
    Asin,
    /// The same, 0 to 360 where the control says so (Macro B).
    MacroAsin,
    /// Macro B's `ATAN` of one argument.
    Atan,
    Cos,
    Exp,
    /// RS274/NGC's `FIX`: down.
    Floor,
    /// RS274/NGC's `FUP`: up.
    Ceiling,
    /// Macro B's `FIX`: towards zero.
    Truncate,
    /// Macro B's `FUP`: away from zero.
    AwayFromZero,
    Ln,
    /// Macro B's `ROUND`: to the nearest whole number, halves away from zero.
    Round,
    /// RS274/NGC's `ROUND`: the same in 32 bits.
    RoundToInt,
    Sin,
    Sqrt,
    Tan,
    /// The same, refused at 90 deg and 270 deg, where there is no tangent.
    CheckedTan,
    /// Macro B's `BIN`: decimal digits in groups of four bits to a number.
    FromBcd,
    /// Macro B's `BCD`: a number to decimal digits in groups of four bits.
    ToBcd,
    /// Macro B's `ADP`: the value itself; it adds the decimal point to an argument of a macro call.
    AddPoint,
    /// Sinumerik: POT.
    Square,
    /// Sinumerik: NOT of a truth value.
    Not,
    /// Sinumerik: B_NOT.
    BitNot,
    /// Sinumerik: TRUNC, unknown near a whole number.
    CutOff,
    /// Sinumerik: ROUND, halves away from zero.
    RoundHalf,
    /// Sinumerik: ROUNDUP, unknown below zero; Okuma: FUP.
    RoundUp,
    /// Okuma: NOT, known of 0 and 1.
    TruthNot,
    /// Okuma: ROUND, unknown of a half.
    NearestWhole,
    /// Okuma: FIX, unknown below zero.
    WholeBelow,
    /// Okuma: operators whose order no source states: unknown.
    Unsettled,
}

/// How a Sinumerik compares two numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Comparison {
    Equal,
    NotEqual,
    Greater,
    GreaterOrEqual,
    Less,
    LessOrEqual,
}

/// An operation on two values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Binary {
    Power,
    Multiply,
    Divide,
    /// RS274/NGC: never negative.
    Modulo,
    /// Macro B: of the operands rounded to whole numbers, with the sign of the dividend.
    Remainder,
    Add,
    Subtract,
    /// Equal within 1e-4 (RS274/NGC).
    NearlyEqual,
    NotNearlyEqual,
    /// Equal to the bit; `<vacant>` equals only `<vacant>` (Macro B).
    Equal,
    NotEqual,
    Greater,
    GreaterOrEqual,
    Less,
    LessOrEqual,
    LogicalAnd,
    LogicalOr,
    LogicalXor,
    BitAnd,
    BitOr,
    BitXor,
    /// Angle of the point (second, first) in degrees, -180 to 180.
    Atan2,
    /// The same, 0 to 360 where the control says so (Macro B).
    MacroAtan2,
    /// Sinumerik: unknown if the numbers are nearly equal.
    Compared(Comparison),
    /// Sinumerik: DIV, MOD and bits, known of whole numbers.
    WholeDivide,
    WholeRemainder,
    WholeAnd,
    WholeOr,
    WholeXor,
    /// Sinumerik: MINVAL, MAXVAL.
    Minimum,
    Maximum,
    /// Okuma: AND, OR, EOR, known of 0 and 1.
    TruthAnd,
    TruthOr,
    TruthXor,
    /// Okuma: MOD, known of whole numbers that are not negative.
    PositiveRemainder,
    /// Sinumerik: `<<` joins strings, whose values are not followed.
    Join,
}

/// One step of a compiled expression.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Op {
    Number(f64),
    /// The variable of this number.
    Read(i64),
    /// The variable whose number is on the stack.
    ReadAt,
    /// The same two where a variable may be `<vacant>` (Macro B).
    ReadNullable(i64),
    ReadNullableAt,
    Named(Name),
    /// `#_NAME[index]`, the index on the stack.
    NamedAt(Name),
    ExistsNamed(Name),
    /// Whether there is a variable of the number on the stack.
    ExistsAt,
    Unary(Unary),
    Binary(Binary),
    /// The same with a number as its second value: the commonest of all, in one step.
    WithNumber(Binary, f64),
    /// Sinumerik: BOUND of the least, the most and a value.
    Bound,
    /// The text is wrong from here on.
    Fail(Box<FormulaErrorKind>),
}

/// One operation with the part of the text it comes from, counted from the start of the formula (wrapping): a formula that occurs
/// again in another place is moved without changing its steps.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Step {
    pub(crate) op: Op,
    pub(crate) range: TextRange,
}

impl Step {
    /// Appends an operation on the two values before it; a second value that is a plain number becomes part of the step.
    #[inline]
    pub(crate) fn push_binary(steps: &mut Vec<Self>, binary: Binary, range: TextRange) {
        match steps.last_mut() {
            Some(Self {
                op: op @ Op::Number(_),
                range: own,
            }) => {
                if let Op::Number(value) = *op {
                    *op = Op::WithNumber(binary, value);
                    *own = range;
                }
            }
            _ => steps.push(Self {
                op: Op::Binary(binary),
                range,
            }),
        }
    }
    /// Whether it is an operation on two values.
    #[inline]
    pub(crate) fn is_binary(&self) -> bool {
        matches!(self.op, Op::Binary(_) | Op::WithNumber(..))
    }
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Code {
    /// A number, with its digits where they can be held exactly.
    Literal { value: f64, decimal: Option<Decimal> },
    /// Anything else, and how many values it keeps at most.
    Steps { steps: Vec<Step>, depth: usize },
}

/// An expression, compiled once to be evaluated many times.
///
/// A plain number takes no memory of its own; anything else is one allocation, or comes from a [`crate::Pool`].
#[derive(Clone, Debug, PartialEq)]
pub struct Formula {
    pub(crate) range: TextRange,
    pub(crate) code: Code,
}

impl Formula {
    /// A number without text, for a place that needs a formula.
    pub fn constant(value: f64) -> Self {
        Self {
            range: TextRange::default(),
            code: Code::Literal { value, decimal: None },
        }
    }

    /// Its text in the file: from the first sign to the last.
    pub fn range(&self) -> TextRange {
        self.range
    }

    /// The number, exactly as written with its sign, if the formula is a number and nothing else.
    ///
    /// `None`, too, for a number of more digits than [`Decimal`] holds.
    #[inline]
    pub fn literal(&self) -> Option<Decimal> {
        match self.code {
            Code::Literal { decimal, .. } => decimal,
            Code::Steps { .. } => None,
        }
    }

    /// The value, if it needs no variable and no arithmetic: a number of any length.
    #[inline]
    pub fn number(&self) -> Option<f64> {
        match self.code {
            Code::Literal { value, .. } => Some(value),
            Code::Steps { .. } => None,
        }
    }

    /// Moves its ranges by this many bytes (wrapping: 2^32 less moves back), to another place with the same text.
    #[inline]
    pub fn shift(&mut self, by: u32) {
        // a constant has no place
        if self.range != TextRange::default() {
            self.range = self.range.shifted(by);
        }
    }

    /// The steps of the code; none for a plain number.
    pub(crate) fn steps(&self) -> &[Step] {
        match &self.code {
            Code::Literal { .. } => &[],
            Code::Steps { steps, .. } => steps,
        }
    }

    /// The variables it reads, in the order of the text, each as often as it occurs there.
    pub fn reads(&self) -> impl Iterator<Item = Variable<'_>> {
        self.steps().iter().filter_map(|step| match &step.op {
            Op::Read(index) | Op::ReadNullable(index) => Some(Variable::Numbered(*index)),
            Op::ReadAt | Op::ReadNullableAt => Some(Variable::Computed(step.range.shifted(self.range.start))),
            Op::Named(name) | Op::NamedAt(name) => Some(Variable::Named(name)),
            _ => None,
        })
    }
}
