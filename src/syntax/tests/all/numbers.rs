//! Decimals are exact, and their doubles are the nearest ones.
use proptest::prelude::*;
use trunnion_syntax::Decimal;

fn exact(text: &str) -> Option<(i64, i16, bool)> {
    Decimal::parse(text.as_bytes()).map(|number| (number.mantissa, number.scale, number.has_point))
}

#[test]
fn forms() {
    let rows = [
        ("10", Some((10, 0, false))),
        ("10.", Some((10, 0, true))),
        ("-.5", Some((-5, 1, true))),
        ("+007.250", Some((7250, 3, true))),
        ("-2.5E-3", Some((-25, 4, true))),
        ("1E6", Some((1, -6, false))),
        ("1.5e+2", Some((15, -1, true))),
        ("9223372036854775807", Some((i64::MAX, 0, false))),
        ("-9223372036854775808", Some((i64::MIN, 0, false))),
        ("9223372036854775808", None),
        ("0.0000000000000000001", Some((1, 19, true))),
        ("1.00000000000000000000000", Some((1, 0, true))),
        ("1.10000000000000000000000", Some((11, 1, true))),
        ("123456789012345678901", None),
        ("000000000000000000000000012", Some((12, 0, false))),
        ("", None),
        (".", None),
        ("-", None),
        ("+.", None),
        ("1.2.3", None),
        ("--1", None),
        ("1 2", None),
        ("1E", None),
        ("1E+", None),
        ("1E1.5", None),
        ("E5", None),
        ("1E9999999", None),
        ("1E99999", None),
        ("1,5", None),
        ("x", None),
    ];
    for (text, expected) in rows {
        assert_eq!(exact(text), expected, "{text:?}");
    }
}

#[test]
fn integers() {
    let integer = |text: &str| Decimal::parse(text.as_bytes()).and_then(Decimal::to_integer);
    assert_eq!(integer("10"), Some(10));
    assert_eq!(integer("10.00"), Some(10));
    assert_eq!(integer("-2E2"), Some(-200));
    assert_eq!(integer("10.5"), None);
    assert_eq!(integer("0.0000000000000000000000"), Some(0));
    assert_eq!(integer("1E30"), None);
}

/// Texts of numbers up to the digits that fit.
fn number() -> impl Strategy<Value = String> {
    prop_oneof![
        r"[+-]?[0-9]{1,5}(\.[0-9]{0,6})?",
        r"[+-]?[0-9]{0,9}\.[0-9]{1,9}",
        r"-?[1-9][0-9]{0,17}(E[+-]?[0-9]{1,3})?"
    ]
}

proptest! {
    #[test]
    fn doubles_are_correctly_rounded(text in number()) {
        let decimal = Decimal::parse(text.as_bytes()).expect("at most 18 digits");
        let expected: f64 = text.parse().expect("a number for std too");
        prop_assert_eq!(decimal.to_f64(), expected);
    }

    #[test]
    fn display_keeps_value_and_digits(text in number()) {
        let decimal = Decimal::parse(text.as_bytes()).expect("at most 18 digits");
        prop_assume!(decimal.scale.unsigned_abs() < 30);
        let shown = decimal.to_string();
        let value: f64 = shown.parse().expect("a number");
        prop_assert_eq!(value, decimal.to_f64());
        if decimal.scale >= 0 {
            let back = Decimal::parse(shown.as_bytes()).map(|back| (back.mantissa, back.scale));
            prop_assert_eq!(back, Some((decimal.mantissa, decimal.scale)));
        }
    }

    #[test]
    fn any_bytes_are_a_number_or_none(bytes in proptest::collection::vec(any::<u8>(), 0..30)) {
        if let Some(decimal) = Decimal::parse(&bytes) {
            let text = std::str::from_utf8(&bytes).expect("digits are text");
            prop_assert_eq!(Ok(decimal.to_f64()), text.parse::<f64>());
        }
    }

    #[test]
    fn any_decimal_has_a_double(mantissa: i64, scale: i16) {
        let decimal = Decimal { mantissa, scale, has_point: false };
        let expected: f64 = format!("{mantissa}e{}", -i32::from(scale)).parse().expect("a number");
        prop_assert_eq!(decimal.to_f64(), expected);
    }
}
