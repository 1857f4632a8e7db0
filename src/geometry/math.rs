//! The only access to transcendental functions: libm's, so that a verdict is the same on every machine.

/// Sine of an angle in rad.
pub fn sin(x: f64) -> f64 {
    libm::sin(x)
}
/// Cosine of an angle in rad.
pub fn cos(x: f64) -> f64 {
    libm::cos(x)
}
/// Sine and cosine of an angle in rad.
pub fn sin_cos(x: f64) -> (f64, f64) {
    libm::sincos(x)
}
/// Tangent of an angle in rad.
pub fn tan(x: f64) -> f64 {
    libm::tan(x)
}
/// Arc sine in rad; NaN outside -1..=1.
pub fn asin(x: f64) -> f64 {
    libm::asin(x)
}
/// Angle of the point (x, y) in rad, -pi..=pi.
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}
/// Length of (x, y) without overflow.
pub fn hypot(x: f64, y: f64) -> f64 {
    libm::hypot(x, y)
}
/// The angle between two vectors in rad, 0..=pi, accurate near 0 and pi (Kahan: atan2 of cross and dot).
pub fn angle_between(a: &crate::Vec3, b: &crate::Vec3) -> f64 {
    atan2(a.cross(b).norm(), a.dot(b))
}
/// `a` rotated about the unit vector `axis` by `angle` rad (Rodrigues' formula).
pub fn rotate(axis: &crate::Vec3, angle: f64, a: &crate::Vec3) -> crate::Vec3 {
    let (s, c) = sin_cos(angle);
    a * c + axis.cross(a) * s + axis * (axis.dot(a) * (1.0 - c))
}
/// Inverse hyperbolic sine.
pub fn asinh(x: f64) -> f64 {
    libm::asinh(x)
}
/// e to the power x.
pub fn exp(x: f64) -> f64 {
    libm::exp(x)
}
/// Natural logarithm; NaN below 0, minus infinity at 0.
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}
/// `base` to the power `exponent`; NaN where a negative base has an exponent that is not whole.
pub fn pow(base: f64, exponent: f64) -> f64 {
    libm::pow(base, exponent)
}
/// Arc cosine in rad; NaN outside -1..=1. For the ACOS of a program: what a machine's geometry needs is [`atan2`], which is accurate near 0 and pi.
pub fn acos(x: f64) -> f64 {
    libm::acos(x)
}
