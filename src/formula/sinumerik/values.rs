//! What the operations that only a Sinumerik or an Okuma has compute; NaN where the outcome is not documented.
use crate::FormulaErrorKind as Kind;
use crate::code::{Binary, Comparison, Unary};

/// Numbers that differ by less than this part of the larger may be equal to the control.
const NEAR: f64 = 1e-9;

/// 0 and 1 as truth values.
fn truth(value: f64) -> Option<bool> {
    (value == 0.0 || value == 1.0).then_some(value == 1.0)
}

/// Whether two numbers differ by so little that the outcome of comparing them is not documented.
fn is_near(a: f64, b: f64) -> bool {
    a != b && (a - b).abs() <= NEAR * a.abs().max(b.abs())
}

/// Operations that only this language has, on numbers that are known; NaN where the outcome is not documented.
pub(crate) fn binary(operation: Binary, a: f64, b: f64) -> Result<f64, Kind> {
    let integers = a.fract() == 0.0 && b.fract() == 0.0;
    let bits = |value: f64| (value.fract() == 0.0 && value.abs() < 2_147_483_648.0).then_some(value as i64);
    Ok(match operation {
        Binary::Compared(_) if is_near(a, b) => f64::NAN,
        Binary::Compared(comparison) => f64::from(u8::from(match comparison {
            Comparison::Equal => a == b,
            Comparison::NotEqual => a != b,
            Comparison::Greater => a > b,
            Comparison::GreaterOrEqual => a >= b,
            Comparison::Less => a < b,
            Comparison::LessOrEqual => a <= b,
        })),
        Binary::WholeDivide | Binary::WholeRemainder | Binary::PositiveRemainder if b == 0.0 => {
            return Err(Kind::DivisionByZero);
        }
        Binary::WholeDivide if integers => (a / b).trunc() + 0.0,
        Binary::WholeRemainder if integers => a % b + 0.0,
        Binary::PositiveRemainder if integers && a >= 0.0 && b > 0.0 => a % b,
        Binary::TruthAnd | Binary::TruthOr | Binary::TruthXor => match (truth(a), truth(b)) {
            (Some(a), Some(b)) => f64::from(u8::from(match operation {
                Binary::TruthAnd => a && b,
                Binary::TruthOr => a || b,
                _ => a != b,
            })),
            _ => f64::NAN,
        },
        Binary::Minimum => a.min(b),
        Binary::Maximum => a.max(b),
        Binary::WholeAnd | Binary::WholeOr | Binary::WholeXor => match (bits(a), bits(b)) {
            (Some(a), Some(b)) => match operation {
                Binary::WholeAnd => (a & b) as f64,
                Binary::WholeOr => (a | b) as f64,
                _ => (a ^ b) as f64,
            },
            _ => f64::NAN,
        },
        _ => f64::NAN,
    })
}

/// The same on one number.
pub(crate) fn unary(operation: Unary, x: f64) -> f64 {
    let nearest = x.round();
    match operation {
        Unary::Square => x * x,
        Unary::Not => f64::from(u8::from(x == 0.0)),
        Unary::BitNot if x.fract() == 0.0 => -x - 1.0,
        Unary::CutOff if !is_near(x, nearest) => x.trunc() + 0.0,
        Unary::RoundHalf => nearest + 0.0,
        Unary::TruthNot => truth(x).map_or(f64::NAN, |x| f64::from(u8::from(!x))),
        Unary::NearestWhole if !is_near(x.abs().fract(), 0.5) && x.abs().fract() != 0.5 => nearest + 0.0,
        Unary::WholeBelow if x >= 0.0 && (x == nearest || !is_near(x, nearest)) => x.floor(),
        Unary::RoundUp if x >= 0.0 && !is_near(x, nearest) || x == nearest => x.ceil(),
        _ => f64::NAN,
    }
}

/// BOUND: the value, or the limit that it is beyond.
pub(crate) fn bound(least: f64, most: f64, x: f64) -> f64 {
    if x.is_nan() || least.is_nan() || most.is_nan() || least > most {
        return f64::NAN;
    }
    x.clamp(least, most)
}
