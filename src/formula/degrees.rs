//! Angles in degrees, as finely as LinuxCNC takes them on a PC: an angle in rad has 64 bits, not 53.
//!
//! It decides signs (`[COS[90] LT 0]` is 1, observed), and that `FIX[TAN[45]]` is 1.
use core::cell::Cell;
use trunnion_geometry::math;

/// Pi with 64 bits, times 2^62.
const PI_BITS: u64 = 0xc90f_daa2_2168_c235;
/// The same as the sum of two doubles: the upper 53 bits and what is left.
const PI_HIGH: f64 = core::f64::consts::PI;
const PI_LOW: f64 = 1.225_148_454_908_62e-16;

/// Above this only the double is used: it has no more precision as an angle.
const LARGE: f64 = 1e15;

/// A number of 64 bits: `bits * 2^exponent`, the highest bit set.
#[derive(Clone, Copy)]
struct Extended {
    bits: u64,
    exponent: i32,
}

/// `wide * 2^exponent`, with something nonzero below it if `more`, rounded to 64 bits (half to even).
fn rounded(wide: u128, more: bool, exponent: i32) -> Extended {
    let surplus = 64 - wide.leading_zeros() as i32;
    if surplus <= 0 {
        return Extended {
            bits: (wide << -surplus) as u64,
            exponent: exponent + surplus,
        };
    }
    let kept = (wide >> surplus) as u64;
    let rest = wide & ((1u128 << surplus) - 1);
    let half = 1u128 << (surplus - 1);
    let up = rest > half || (rest == half && (more || kept & 1 == 1));
    match kept.checked_add(u64::from(up)) {
        Some(bits) => Extended {
            bits,
            exponent: exponent + surplus,
        },
        None => Extended {
            bits: 1 << 63,
            exponent: exponent + surplus + 1,
        },
    }
}

/// `bits * 2^64` by 180, and whether something is left: long division, since 2^64 is 180 times `WHOLE` and 16.
fn by_180(bits: u64) -> (u128, bool) {
    const WHOLE: u64 = u64::MAX / 180;
    let (high, rest) = (bits / 180, bits % 180);
    let (low, left) = (rest * WHOLE + rest * 16 / 180, rest * 16 % 180);
    (u128::from(high) << 64 | u128::from(low), left != 0)
}

/// 2^exponent for exponents of normal doubles.
fn power_of_two(exponent: i32) -> f64 {
    f64::from_bits(((exponent + 1023) as u64) << 52)
}

/// `degrees` times pi by 180, each operation rounded to 64 bits; the sum of the two doubles is the angle in rad.
fn radians(degrees: f64) -> (f64, f64) {
    let size = degrees.abs();
    if !(1e-280..=LARGE).contains(&size) {
        return (trunnion_geometry::rad(degrees), 0.0);
    }
    let bits = size.to_bits();
    let mantissa = (bits & ((1 << 52) - 1)) | (1 << 52);
    let exponent = (bits >> 52) as i32 - 1075;
    let product = rounded(u128::from(mantissa) * u128::from(PI_BITS), false, exponent - 62);
    let (quotient, more) = by_180(product.bits);
    let quotient = rounded(quotient, more, product.exponent - 64);
    let high_bits = quotient.bits & !0x7ff;
    let scale = power_of_two(quotient.exponent).copysign(degrees);
    let high = high_bits as f64 * scale;
    let low = (quotient.bits - high_bits) as f64 * scale;
    (high, low)
}

/// Sine and cosine of the sum of two doubles, the second small.
fn sin_cos_sum((high, low): (f64, f64)) -> (f64, f64) {
    let (sin, cos) = math::sin_cos(high);
    (sin + low * cos, cos - low * sin)
}

std::thread_local! {
    /// The bits of the last angle, its sine and its cosine: `X[5*COS[#1]] Y[5*SIN[#1]]` needs both of one angle.
    static LAST: Cell<(u64, f64, f64)> = const { Cell::new((0, 0.0, 1.0)) };
}

/// Sine and cosine of an angle in degrees.
fn sin_cos(degrees: f64) -> (f64, f64) {
    let bits = degrees.to_bits();
    let (last, sin, cos) = LAST.get();
    if last == bits {
        return (sin, cos);
    }
    let (sin, cos) = sin_cos_sum(radians(degrees));
    LAST.set((bits, sin, cos));
    (sin, cos)
}

/// Sine of an angle in degrees.
pub(crate) fn sin(degrees: f64) -> f64 {
    sin_cos(degrees).0
}

/// Cosine of an angle in degrees.
pub(crate) fn cos(degrees: f64) -> f64 {
    sin_cos(degrees).1
}

/// Tangent of an angle in degrees.
pub(crate) fn tan(degrees: f64) -> f64 {
    let (high, low) = radians(degrees);
    let tangent = math::tan(high);
    if tangent.abs() < 1e3 {
        return tangent + low * (1.0 + tangent * tangent);
    }
    let (sin, cos) = sin_cos_sum((high, low));
    sin / cos
}

/// An angle in rad, in degrees: the double times 180 by pi, rounded once.
pub(crate) fn from_radians(angle: f64) -> f64 {
    // an angle has 53 bits and 180 has 8: the product is the sum of these two
    let high = angle * 180.0;
    let low = angle.mul_add(180.0, -high);
    let quotient = high / PI_HIGH;
    if !quotient.is_finite() {
        return quotient;
    }
    let rest = (-quotient).mul_add(PI_HIGH, high) + (low - quotient * PI_LOW);
    quotient + rest / PI_HIGH
}

#[cfg(test)]
mod tests {
    use super::by_180;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn long_division_is_division(bits in any::<u64>()) {
            let dividend = u128::from(bits) << 64;
            prop_assert_eq!(by_180(bits), (dividend / 180, dividend % 180 != 0));
        }
    }
}
