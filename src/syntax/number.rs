//! Numbers exactly as written.

/// An exact decimal as written in the program: `mantissa * 10^-scale`.
///
/// `X10` and `X10.` differ in [`Decimal::has_point`]: on many controls they are different lengths.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Decimal {
    /// All digits with the sign.
    pub mantissa: i64,
    /// How many of the digits stand behind the point (negative for `1E6` in APT).
    pub scale: i16,
    /// Whether a decimal point is written.
    pub has_point: bool,
}
