//! Numbers exactly as written.
use core::fmt;

/// An exact decimal as written in the program: `mantissa * 10^-scale`.
///
/// `X10` and `X10.` differ in [`Decimal::has_point`]: on many controls they are different lengths.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Decimal {
    /// All digits with the sign (the sign of `-0` is not kept).
    pub mantissa: i64,
    /// How many of the digits come after the point (negative for `1E6` in APT).
    pub scale: i16,
    /// Whether a decimal point is written.
    pub has_point: bool,
}

/// Powers of ten that a double holds exactly.
const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20,
    1e21, 1e22,
];

/// An `i64` never has more digits.
const MOST_DIGITS: usize = 19;

/// Up to this mantissa every integer is a double.
const EXACT: u64 = 1 << 53;

impl Decimal {
    /// Reads `[+-] digits [. digits] [E [+-] digits]` without blanks; one digit at least must be there.
    ///
    /// `None` if `bytes` is anything else, or has more digits than can be held exactly.
    #[inline]
    pub fn parse(bytes: &[u8]) -> Option<Self> {
        match Self::parse_short(bytes) {
            Some(number) => Some(number),
            None => Self::parse_rare(bytes),
        }
    }

    /// [`Self::parse`] and [`Self::to_f64`] in one: the usual number stays in registers.
    #[inline]
    pub fn parse_f64(bytes: &[u8]) -> Option<f64> {
        match Self::parse_short(bytes) {
            Some(number) => Some(number.to_f64()),
            None => Self::parse_rare(bytes).map(Self::to_f64),
        }
    }

    /// Reads a number of at most 18 digits without exponent; `None` for any other.
    #[inline]
    pub(crate) fn parse_short(bytes: &[u8]) -> Option<Self> {
        let negative = bytes.first() == Some(&b'-');
        let signed = negative || bytes.first() == Some(&b'+');
        let unsigned = &bytes[usize::from(signed)..];
        let mut mantissa = 0u64;
        // Position of the point, if it was met.
        let mut point = usize::MAX;
        for (at, &byte) in unsigned.iter().enumerate() {
            let digit = byte.wrapping_sub(b'0');
            if digit < 10 {
                mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(digit));
            } else if byte == b'.' && point == usize::MAX {
                point = at;
            } else {
                return None;
            }
        }
        let has_point = point != usize::MAX;
        let digits = unsigned.len() - usize::from(has_point);
        if digits.wrapping_sub(1) >= 18 {
            return None;
        }
        let scale = if has_point { digits - point } else { 0 };
        let value = mantissa as i64;
        let mantissa = if negative { -value } else { value };
        Some(Self {
            mantissa,
            scale: scale as i16,
            has_point,
        })
    }

    /// Exponents, and digits that may not fit: checked at each step.
    #[cold]
    fn parse_rare(bytes: &[u8]) -> Option<Self> {
        let mark = bytes
            .iter()
            .position(|b| matches!(b, b'E' | b'e'))
            .unwrap_or(bytes.len());
        let (number, exponent) = bytes.split_at(mark);
        let exponent = if exponent.is_empty() {
            0
        } else {
            parse_exponent(&exponent[1..])?
        };
        let (negative, number) = match number.first() {
            Some(b'-') => (true, &number[1..]),
            Some(b'+') => (false, &number[1..]),
            _ => (false, number),
        };
        let point = number.iter().position(|&b| b == b'.');
        let (whole, fraction) = match point {
            Some(at) => (&number[..at], &number[at + 1..]),
            None => (number, &[][..]),
        };
        if whole.is_empty() && fraction.is_empty() {
            return None;
        }
        let read = |fraction: &[u8]| {
            let digits = whole.iter().chain(fraction);
            if digits.skip_while(|&&byte| byte == b'0').count() > MOST_DIGITS {
                return None;
            }
            let mut value = 0i64;
            for &byte in whole.iter().chain(fraction) {
                let digit = i64::from(byte.checked_sub(b'0').filter(|&d| d < 10)?);
                value = value.checked_mul(10)?;
                value = if negative {
                    value.checked_sub(digit)?
                } else {
                    value.checked_add(digit)?
                };
            }
            let scale = i16::try_from(i64::try_from(fraction.len()).ok()? - exponent).ok()?;
            Some(Self {
                mantissa: value,
                scale,
                has_point: point.is_some(),
            })
        };
        // Zeros at the end of the fraction carry no value: a number that only fits without them is still exact.
        read(fraction).or_else(|| {
            let kept = fraction.iter().rposition(|&b| b != b'0').map_or(0, |at| at + 1);
            read(&fraction[..kept])
        })
    }

    /// The double nearest to the number as written (ties to even); infinite where the number is beyond the doubles.
    #[inline]
    pub fn to_f64(self) -> f64 {
        let places = usize::from(self.scale.unsigned_abs());
        if places < POWERS.len() && self.mantissa.unsigned_abs() <= EXACT {
            // Both operands are exact, so the one operation rounds correctly.
            let mantissa = self.mantissa as f64;
            return if self.scale >= 0 {
                mantissa / POWERS[places]
            } else {
                mantissa * POWERS[places]
            };
        }
        self.to_f64_rare()
    }

    #[cold]
    fn to_f64_rare(self) -> f64 {
        let text = format!("{}e{}", self.mantissa, -i32::from(self.scale));
        text.parse().expect("digits and an exponent are a number")
    }

    /// The value as an integer, if it is one that fits (`10`, `10.`, `10.0`).
    pub fn to_integer(self) -> Option<i64> {
        let power = 10i64.checked_pow(u32::from(self.scale.unsigned_abs()));
        if self.mantissa == 0 {
            Some(0)
        } else if self.scale <= 0 {
            self.mantissa.checked_mul(power?)
        } else {
            let power = power?;
            (self.mantissa % power == 0).then(|| self.mantissa / power)
        }
    }
}

/// Writes the number with all its digits, without exponent: `-0.50`, `10.`, `10`.
impl fmt::Display for Decimal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sign = if self.mantissa < 0 { "-" } else { "" };
        let digits = self.mantissa.unsigned_abs().to_string();
        let point = if self.has_point { "." } else { "" };
        if self.scale <= 0 {
            let zeros = if self.mantissa == 0 {
                0
            } else {
                usize::from(self.scale.unsigned_abs())
            };
            return write!(f, "{sign}{digits}{:0<zeros$}{point}", "");
        }
        let places = usize::from(self.scale.unsigned_abs());
        let digits = format!("{digits:0>width$}", width = places + 1);
        let (whole, fraction) = digits.split_at(digits.len() - places);
        write!(f, "{sign}{whole}.{fraction}")
    }
}

fn parse_exponent(bytes: &[u8]) -> Option<i64> {
    let digits = bytes
        .strip_prefix(b"-")
        .or_else(|| bytes.strip_prefix(b"+"))
        .unwrap_or(bytes);
    if digits.is_empty() || digits.len() > 6 || !digits.iter().all(u8::is_ascii_digit) {
        return None;
    }
    let value = digits
        .iter()
        .fold(0i64, |value, &digit| value * 10 + i64::from(digit - b'0'));
    Some(if bytes.starts_with(b"-") { -value } else { value })
}
