//! What the operations compute. NaN is an unknown number; `<vacant>` is a separate NaN.
use crate::FormulaErrorKind as Kind;
use crate::code::{Binary, Unary};
use crate::{degrees, sinumerik};
use trunnion_geometry::math;

/// Within this two numbers are equal in RS274/NGC (observed: `[3 EQ 3.00009]` is 1, `[3 EQ 3.0001]` is 0), and a number is whole.
const TOLERANCE: f64 = 1e-4;

/// The bits of `<vacant>`: a NaN that no computation and no variable yields.
const VACANT: u64 = 0x7ff8_0000_7661_6361;

/// The bits of a result that does not exist (`0 MOD 0`): also a NaN, but different from an unknown number.
const UNDEFINED: u64 = 0x7ff8_0000_756e_6465;

/// Macro B's `<vacant>`.
pub(crate) const fn vacant() -> f64 {
    f64::from_bits(VACANT)
}

/// Whether `value` is `<vacant>`.
#[inline]
pub(crate) fn is_vacant(value: f64) -> bool {
    value.to_bits() == VACANT
}

#[inline]
fn is_undefined(value: f64) -> bool {
    value.to_bits() == UNDEFINED
}

/// The end of a value: what is infinite or has no result is refused here, and not before (observed: `[10**400 EQ 1]` is 0,
/// `[[10**400] EQ 1]` is an error).
#[inline]
pub(crate) fn checked(value: f64) -> Result<f64, Kind> {
    if value.is_infinite() {
        Err(Kind::Infinite)
    } else if is_undefined(value) {
        Err(Kind::Undefined)
    } else {
        Ok(value)
    }
}

/// A NaN that resulted from `a` and `b`: unknown if one of them is unknown, else without result.
#[cold]
fn without_number(a: f64, b: f64) -> f64 {
    let unknown = |value: f64| value.is_nan() && !is_undefined(value);
    if unknown(a) || unknown(b) {
        f64::NAN
    } else {
        f64::from_bits(UNDEFINED)
    }
}

/// In arithmetic `<vacant>` is zero.
#[inline]
fn filled(value: f64) -> f64 {
    if is_vacant(value) { 0.0 } else { value }
}

/// `value` as an integer, if it is one within 1e-4 (observed: `#1.99995` is `#2`; `#1.0002` and `#1.9999` are refused).
#[inline]
pub(crate) fn whole(value: f64) -> Option<i64> {
    let below = value.floor();
    let fraction = value - below;
    let integer = if fraction > 1.0 - TOLERANCE { below + 1.0 } else { below };
    ((fraction <= TOLERANCE || integer > below) && integer.abs() < 9e18).then_some(integer as i64)
}

#[inline]
fn truth(holds: bool) -> f64 {
    if holds { 1.0 } else { 0.0 }
}

/// The result of a comparison; unknown where an operand is not, false where one has no result (observed for all six).
#[inline]
fn compared(a: f64, b: f64, holds: bool) -> f64 {
    if a.is_nan() || b.is_nan() {
        return if without_number(a, b).to_bits() == UNDEFINED {
            0.0
        } else {
            f64::NAN
        };
    }
    truth(holds)
}

/// Whether `value` is taken as true; `None` if it is unknown. A value without result is not zero (observed).
#[inline]
fn holds(value: f64) -> Option<bool> {
    if value.is_nan() && !is_undefined(value) {
        None
    } else {
        Some(value != 0.0)
    }
}

/// AND, OR and XOR of RS274/NGC; the result is known if one operand decides it.
fn logic(operation: Binary, a: f64, b: f64) -> f64 {
    match (operation, holds(a), holds(b)) {
        (Binary::LogicalAnd, Some(false), _) | (Binary::LogicalAnd, _, Some(false)) => 0.0,
        (Binary::LogicalOr, Some(true), _) | (Binary::LogicalOr, _, Some(true)) => 1.0,
        (Binary::LogicalXor, Some(a), Some(b)) => truth(a != b),
        (_, Some(_), Some(_)) => truth(operation == Binary::LogicalAnd),
        _ => f64::NAN,
    }
}

/// An operation on one value; `positive` asks for angles of 0 to 360 degrees. Not part of the loop of evaluation, which stays small.
#[inline(never)]
pub(crate) fn unary(operation: Unary, value: f64, positive: &dyn Fn() -> Option<bool>) -> Result<f64, Kind> {
    let x = filled(value);
    let result = match operation {
        Unary::Negate => -x,
        Unary::Abs if x < 0.0 => -x,
        Unary::Acos if x.abs() > 1.0 => return Err(Kind::AcosRange),
        Unary::Acos => degrees::from_radians(math::acos(x)),
        Unary::Asin | Unary::MacroAsin if x.abs() > 1.0 => return Err(Kind::AsinRange),
        Unary::Asin => degrees::from_radians(math::asin(x)),
        Unary::MacroAsin => match turned(degrees::from_radians(math::asin(x)), positive) {
            Some(angle) => angle,
            None => return Ok(f64::NAN),
        },
        Unary::Atan => degrees::from_radians(math::atan2(x, 1.0)),
        Unary::Cos => degrees::cos(x),
        Unary::Exp => math::exp(x),
        Unary::Floor => x.floor(),
        Unary::Truncate => x.trunc(),
        Unary::AwayFromZero if x < 0.0 => x.floor(),
        Unary::Ceiling | Unary::AwayFromZero => x.ceil(),
        Unary::Ln if x <= 0.0 => return Err(Kind::LogarithmRange),
        Unary::Ln => math::ln(x),
        Unary::Round => x.round() + 0.0,
        Unary::RoundToInt => to_int(x),
        Unary::Sin => degrees::sin(x),
        Unary::Sqrt if x < 0.0 => return Err(Kind::NegativeRoot),
        Unary::Sqrt => x.sqrt(),
        Unary::CheckedTan if (x % 180.0).abs() == 90.0 => return Err(Kind::NoTangent),
        Unary::Tan | Unary::CheckedTan => degrees::tan(x),
        Unary::FromBcd => from_bcd(x)?,
        Unary::ToBcd => to_bcd(x)?,
        Unary::Square
        | Unary::Not
        | Unary::BitNot
        | Unary::CutOff
        | Unary::RoundHalf
        | Unary::RoundUp
        | Unary::TruthNot
        | Unary::NearestWhole
        | Unary::WholeBelow
        | Unary::Unsettled => {
            // what is not documented is unknown
            return checked(if x.is_nan() { x } else { sinumerik::unary(operation, x) });
        }
        Unary::Check | Unary::AddPoint | Unary::Abs => x,
    };
    checked(if result.is_nan() { without_number(x, x) } else { result })
}

/// RS274/NGC's ROUND: half is added away from zero and the rest cut off, in 32 bits (observed: `ROUND[.49999999999999994]` is 1,
/// `ROUND[3000000000]` is -2147483648).
fn to_int(x: f64) -> f64 {
    let cut = if x < 0.0 { (x - 0.5).ceil() } else { (x + 0.5).floor() };
    let fits = (f64::from(i32::MIN)..=f64::from(i32::MAX)).contains(&cut);
    if x.is_nan() {
        x
    } else if fits {
        cut + 0.0
    } else {
        f64::from(i32::MIN)
    }
}

/// A negative angle as the positive one of the same direction, where `positive` asks for it; `None`: which one it is, is not known.
fn turned(angle: f64, positive: &dyn Fn() -> Option<bool>) -> Option<f64> {
    if angle < 0.0 && positive()? {
        Some(angle + 360.0)
    } else {
        Some(angle)
    }
}

/// An operation on two values; `positive` asks for angles of 0 to 360 degrees. The result may be infinite or have no value.
#[inline(never)]
pub(crate) fn binary(
    operation: Binary,
    left: f64,
    right: f64,
    positive: &dyn Fn() -> Option<bool>,
) -> Result<f64, Kind> {
    let (a, b) = (filled(left), filled(right));
    let result = match operation {
        Binary::Power if a < 0.0 && b.floor() != b && !b.is_nan() => return Err(Kind::NegativePower),
        Binary::Power => math::pow(a, b),
        Binary::Multiply => a * b,
        Binary::Divide | Binary::Remainder if b == 0.0 => return Err(Kind::DivisionByZero),
        Binary::Divide => a / b,
        Binary::Modulo => modulo(a, b),
        Binary::Remainder if b.round() == 0.0 => return Err(Kind::DivisionByZero),
        Binary::Remainder => a.round() % b.round(),
        Binary::Add => a + b,
        Binary::Subtract => a - b,
        Binary::Atan2 => degrees::from_radians(math::atan2(a, b)),
        Binary::MacroAtan2 => match turned(degrees::from_radians(math::atan2(a, b)), positive) {
            Some(angle) => angle,
            None => return Ok(f64::NAN),
        },
        Binary::Compared(_)
        | Binary::WholeDivide
        | Binary::WholeRemainder
        | Binary::TruthAnd
        | Binary::TruthOr
        | Binary::TruthXor
        | Binary::PositiveRemainder
        | Binary::WholeAnd
        | Binary::WholeOr
        | Binary::WholeXor
        | Binary::Minimum
        | Binary::Maximum
        | Binary::Join => {
            if a.is_nan() || b.is_nan() {
                return Ok(f64::NAN);
            }
            return sinumerik::binary(operation, a, b);
        }
        _ => return truths(operation, left, right),
    };
    Ok(if result.is_nan() { without_number(a, b) } else { result })
}

/// Comparisons and logic.
fn truths(operation: Binary, left: f64, right: f64) -> Result<f64, Kind> {
    let (a, b) = (filled(left), filled(right));
    Ok(match operation {
        Binary::Equal | Binary::NotEqual if is_vacant(left) != is_vacant(right) => {
            compared(a, b, operation == Binary::NotEqual)
        }
        Binary::NearlyEqual => compared(a, b, (a - b).abs() < TOLERANCE),
        Binary::NotNearlyEqual => compared(a, b, (a - b).abs() >= TOLERANCE),
        Binary::Equal => compared(a, b, a == b),
        Binary::NotEqual => compared(a, b, a != b),
        Binary::Greater => compared(a, b, a > b),
        Binary::GreaterOrEqual => compared(a, b, a >= b),
        Binary::Less => compared(a, b, a < b),
        Binary::LessOrEqual => compared(a, b, a <= b),
        Binary::BitAnd | Binary::BitOr | Binary::BitXor => return bits(operation, a, b),
        _ => logic(operation, a, b),
    })
}

/// The remainder, made positive by the size of the divisor (observed: `[5 MOD -3]` is 2, `[-5 MOD -3]` is 1).
#[inline]
fn modulo(a: f64, b: f64) -> f64 {
    let rest = a % b;
    if rest < 0.0 { rest + b.abs() } else { rest }
}

/// Bit by bit on whole numbers; of others the part before the decimal point is used (Haas says so, Fanuc's manuals do not: trade knowledge).
fn bits(operation: Binary, a: f64, b: f64) -> Result<f64, Kind> {
    if a.is_nan() || b.is_nan() {
        let settled = operation == Binary::BitAnd && (a.trunc() == 0.0 || b.trunc() == 0.0);
        return Ok(if settled { 0.0 } else { without_number(a, b) });
    }
    let integer = |value: f64| {
        let whole = value.trunc();
        (whole.abs() < 9e15)
            .then_some(whole as i64)
            .ok_or(Kind::NotInteger(value))
    };
    let (a, b) = (integer(a)?, integer(b)?);
    Ok(match operation {
        Binary::BitAnd => a & b,
        Binary::BitOr => a | b,
        _ => a ^ b,
    } as f64)
}

/// `#18` read as four-bit decimal digits: hexadecimal 12, so 12.
fn from_bcd(x: f64) -> Result<f64, Kind> {
    if x.is_nan() {
        return Ok(x);
    }
    let mut rest = coded(x, f64::from(u32::MAX))?;
    let (mut value, mut place) = (0u64, 1u64);
    while rest > 0 {
        let digit = rest & 15;
        if digit > 9 {
            return Err(Kind::NotDecimalCoded);
        }
        value += digit * place;
        place *= 10;
        rest >>= 4;
    }
    Ok(value as f64)
}

/// 12 as four-bit decimal digits: hexadecimal 12, so 18.
fn to_bcd(x: f64) -> Result<f64, Kind> {
    if x.is_nan() {
        return Ok(x);
    }
    let mut rest = coded(x, 99_999_999.0)?;
    let (mut value, mut shift) = (0u64, 0);
    while rest > 0 {
        value |= (rest % 10) << shift;
        shift += 4;
        rest /= 10;
    }
    Ok(value as f64)
}

fn coded(x: f64, most: f64) -> Result<u64, Kind> {
    (x >= 0.0 && x <= most && x.trunc() == x)
        .then_some(x as u64)
        .ok_or(Kind::NotDecimalCoded)
}
