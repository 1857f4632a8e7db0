//! Numbers as people read them in messages: with the digits that matter, and their unit.
use trunnion_geometry::deg;
use trunnion_machine::{Axis, AxisKind};

/// How many decimals of a value matter: about four digits in all.
fn decimals(value: f64) -> usize {
    match value.abs() {
        size if size >= 1000.0 => 0,
        size if size >= 100.0 => 1,
        size if size >= 0.1 => 3,
        size if size >= 0.001 => 4,
        _ => 6,
    }
}

/// A number with about four digits that matter and no trailing zeros.
pub(crate) fn number(value: f64) -> String {
    let decimals = decimals(value);
    let text = fixed(value, decimals);
    let text = if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.')
    } else {
        &text
    };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// Powers of ten.
const SCALES: [u32; 7] = [1, 10, 100, 1000, 10_000, 100_000, 1_000_000];

/// A value with this many decimals, at most six, rounded as `format!` rounds it.
fn fixed(value: f64, decimals: usize) -> String {
    let scaled = value.abs() * f64::from(SCALES[decimals]);
    let whole = scaled as u64;
    // the product is off by less than a thousandth: only near the middle between two numbers may it lead to the wrong one
    let rest = scaled - whole as f64;
    if scaled.is_nan() || scaled >= 1e12 || (rest - 0.5).abs() < 0.001 {
        return format!("{value:.decimals$}");
    }
    let mut rest = whole + u64::from(rest > 0.5);
    // sign, 13 digits, point
    let (mut text, mut at) = ([0; 16], 16);
    for place in 0.. {
        if place == decimals && place > 0 {
            at -= 1;
            text[at] = b'.';
        }
        if place > decimals && rest == 0 {
            break;
        }
        at -= 1;
        text[at] = b'0' + (rest % 10) as u8;
        rest /= 10;
    }
    if value.is_sign_negative() {
        at -= 1;
        text[at] = b'-';
    }
    core::str::from_utf8(&text[at..]).unwrap_or_default().to_owned()
}

/// A feed or speed: fewer digits than [`number`], since more are never programmed.
pub(crate) fn rate(value: f64) -> String {
    match value.abs() {
        size if size >= 100.0 => fixed(value, 0),
        size if size >= 10.0 => number((value * 10.0).round() / 10.0),
        _ => number(value),
    }
}

/// A highest feed, positive: rounded down, so that the printed value is never above the true one.
pub(crate) fn highest_rate(value: f64) -> String {
    let step = match value {
        _ if value >= 100.0 => 1.0,
        _ if value >= 10.0 => 0.1,
        _ => return number(value),
    };
    // the quotient of a value that is a whole number of steps may come out a little low
    number(((value / step) * (1.0 + 1e-12)).floor() * step)
}

/// An upper bound in mm, positive: rounded up, so that the printed value is never below what is proven.
pub(crate) fn bound_mm(value: f64) -> String {
    let mut scale = 1.0;
    for _ in 0..decimals(value) {
        scale *= 10.0;
    }
    format!("{} mm", number(((value * scale) * (1.0 - 1e-12)).ceil() / scale))
}

/// An upper bound of an angle, positive, rad, printed in degrees: rounded up, as [`bound_mm`].
pub(crate) fn bound_degrees(value: f64) -> String {
    bound_mm(deg(value)).replace(" mm", " deg")
}

/// A length in mm.
pub(crate) fn mm(value: f64) -> String {
    format!("{} mm", number(value))
}

/// An angle in rad, printed in degrees.
pub(crate) fn degrees(angle: f64) -> String {
    format!("{} deg", number(deg(angle)))
}

/// How near the tool axis comes to the pole, in words that follow "passes".
pub(crate) fn past_pole(angle: f64) -> String {
    if deg(angle) < 1e-6 {
        "over the pole".to_owned()
    } else {
        format!("{} from the pole", degrees(angle))
    }
}

/// A joint value in the axis's unit: mm or deg.
pub(crate) fn joint(axis: &Axis, value: f64) -> String {
    match axis.kind {
        AxisKind::Linear => mm(value),
        AxisKind::Rotary => degrees(value),
    }
}

/// A joint speed, mm/s or rad/s, in mm/min or deg/s.
pub(crate) fn speed(axis: &Axis, value: f64) -> String {
    match axis.kind {
        AxisKind::Linear => format!("{} mm/min", rate(value * 60.0)),
        AxisKind::Rotary => format!("{} deg/s", rate(deg(value))),
    }
}

/// The letter of an axis as text.
pub(crate) fn letter(letter: u8) -> String {
    char::from(letter).to_string()
}

/// A text as a key for merging (FNV-1a, 64 bit).
pub(crate) fn hash(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

/// A cause may quote the program: its first 100 characters, in one line.
pub(crate) fn short(what: &str) -> String {
    const MOST: usize = 100;
    let line = what.split_whitespace().collect::<Vec<_>>().join(" ");
    match line.char_indices().nth(MOST) {
        Some((end, _)) => format!("{}...", &line[..end]),
        None => line,
    }
}

#[cfg(test)]
mod tests {
    use super::{fixed, number};
    use proptest::prelude::*;

    #[test]
    fn digits_are_those_of_the_formatter_at_the_edges() {
        let odd = [
            f64::NAN,
            f64::INFINITY,
            f64::NEG_INFINITY,
            -0.0,
            0.0,
            1e12,
            999_999_999_999.7,
            1e300,
            5e-324,
        ];
        let middles = [
            0.5,
            1.5,
            2.5,
            -0.5,
            0.125,
            0.375,
            0.0005,
            1.005,
            999.5,
            99.95,
            0.000_000_5,
            -0.05,
        ];
        for value in odd.into_iter().chain(middles) {
            for decimals in 0..=6 {
                assert_eq!(
                    fixed(value, decimals),
                    format!("{value:.decimals$}"),
                    "{value} {decimals}"
                );
            }
        }
    }

    proptest! {
        #[test]
        fn digits_are_those_of_the_formatter(
            value in prop_oneof![-2.0..2.0, -2e3..2e3, -1e13..1e13, any::<f64>()],
            steps in -2_000_000..2_000_000_i32,
            decimals in 0..=6_usize,
        ) {
            prop_assert_eq!(fixed(value, decimals), format!("{value:.decimals$}"));
            // at and next to the middle between two numbers
            let middle = (f64::from(steps) + 0.5) / 1000.0;
            for value in [middle, middle * (1.0 + 1e-15), middle * (1.0 - 1e-6), middle / 10.0] {
                prop_assert_eq!(fixed(value, decimals), format!("{value:.decimals$}"));
            }
        }
    }

    #[test]
    fn numbers_keep_the_digits_that_matter() {
        for (value, text) in [
            (5201.4, "5201"),
            (205.04, "205"),
            (47.773, "47.773"),
            (0.0772, "0.0772"),
            (0.000_031, "0.000031"),
            (10.0, "10"),
            (-0.0, "0"),
            (-2.5, "-2.5"),
            (f64::INFINITY, "inf"),
        ] {
            assert_eq!(number(value), text);
        }
    }
}

#[cfg(test)]
mod rounding {
    use super::{bound_mm, highest_rate};

    #[test]
    fn bounds_are_said_on_the_safe_side() {
        assert_eq!(bound_mm(29.304_259_4), "29.305 mm");
        assert_eq!(bound_mm(340.005), "340.1 mm");
        assert_eq!(bound_mm(1000.2), "1001 mm");
        assert_eq!(bound_mm(0.25), "0.25 mm");
        assert_eq!(highest_rate(707.975), "707");
        assert_eq!(highest_rate(46.149), "46.1");
        assert_eq!(highest_rate(33.199), "33.1");
        assert_eq!(highest_rate(600.0), "600");
        assert_eq!(highest_rate(20.1), "20.1");
    }
}
