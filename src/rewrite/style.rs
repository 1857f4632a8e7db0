//! How a program writes its numbers, and numbers written that way.
use core::ops::RangeInclusive;
use trunnion_syntax::{Address, BlockId, Program, Value};

/// What ends a line of the program: what ends its first one.
pub(crate) fn newline(source: &[u8]) -> &'static str {
    match source.iter().position(|byte| *byte == b'\n') {
        Some(at) if source[..at].ends_with(b"\r") => "\r\n",
        _ => "\n",
    }
}

/// How the words of one letter are written in a program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct NumberStyle {
    /// The largest number of digits after the point that the program uses.
    pub decimals: usize,
    /// Trailing zeros are left out: `-0.79` next to `2.042`.
    pub trims: bool,
    /// A whole number keeps its point: `10.`.
    pub whole_point: bool,
    /// A zero is written before the point: `0.5`, not `.5`.
    pub leading_zero: bool,
}

/// How the numbers of some letters are written in a program.
pub(crate) fn of_letters(program: &Program, letters: RangeInclusive<u8>) -> Option<NumberStyle> {
    let mut ranges = Vec::new();
    for block in program.blocks() {
        let words = block.words().filter(|word| {
            matches!(word.value, Value::Number(_))
                && matches!(word.address, Address::Letter(letter) if letters.contains(&letter))
        });
        ranges.extend(words.map(|word| word.value_range));
    }
    NumberStyle::learn(ranges.into_iter().map(|range| program.text(range)))
}

impl NumberStyle {
    /// Where a program shows none.
    pub(crate) const USUAL: Self = Self {
        decimals: 3,
        trims: false,
        whole_point: true,
        leading_zero: true,
    };

    /// Learns from numbers as written. `None` when there is none, or none that is a plain decimal.
    pub(crate) fn learn<T: AsRef<str>>(texts: impl Iterator<Item = T>) -> Option<Self> {
        let mut style: Option<Self> = None;
        let (mut fewest, mut zero_ended) = (usize::MAX, 0);
        let (mut whole_without_point, mut bare_point) = (false, false);
        for text in texts {
            let digits = text.as_ref().trim_start_matches(['+', '-']);
            if digits.is_empty() || !digits.bytes().all(|b| b.is_ascii_digit() || b == b'.') {
                continue;
            }
            let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
            whole_without_point |= !digits.contains('.');
            bare_point |= digits.ends_with('.');
            fewest = fewest.min(fraction.len());
            if fraction.ends_with('0') {
                zero_ended = zero_ended.max(fraction.len());
            }
            let known = style.get_or_insert(Self {
                decimals: 0,
                trims: false,
                whole_point: true,
                leading_zero: true,
            });
            known.decimals = known.decimals.max(fraction.len());
            known.leading_zero &= !whole.is_empty();
        }
        style.map(|known| Self {
            trims: fewest < known.decimals && zero_ended < known.decimals,
            whole_point: bare_point || !whole_without_point,
            ..known
        })
    }

    /// `value` in this style, rounded to [`NumberStyle::decimals`]; `plus` writes the sign of positive numbers.
    pub(crate) fn write(&self, value: f64, plus: bool) -> String {
        let mut text = rounded(value, self.decimals).unwrap_or_else(|| format!("{value:.*}", self.decimals));
        if self.trims && text.contains('.') {
            text.truncate(text.trim_end_matches('0').len());
            if text.ends_with('.') && !self.whole_point {
                text.pop();
            }
        } else if self.decimals == 0 && self.whole_point {
            text.push('.');
        }
        finish(text, plus, self.leading_zero)
    }

    /// The numbers of this style next below and next above `value`, with their texts; one of them twice where `value` is one.
    pub(crate) fn neighbours(&self, value: f64, plus: bool) -> [String; 2] {
        let step = 2.0 * self.rounding();
        [(value / step).floor(), (value / step).ceil()].map(|count| self.write(count * step, plus))
    }

    /// The same with at least so many digits after the point, as many as a value needs.
    pub(crate) fn with_decimals(self, least: usize) -> Self {
        if self.decimals >= least {
            return self;
        }
        Self {
            decimals: least,
            trims: true,
            ..self
        }
    }

    /// Half of the last digit: by this much rounding may change a number.
    pub(crate) fn rounding(&self) -> f64 {
        0.5 / 10f64.powi(i32::try_from(self.decimals).unwrap_or(i32::MAX))
    }
}

/// `value` with so many digits after the point, where one product shows which number is nearest: as `format!` writes it, without the exact arithmetic that
/// it needs for numbers that are decimals but for the last bit. `None` where the product is too large, or too near to the middle between two numbers.
fn rounded(value: f64, decimals: usize) -> Option<String> {
    // powers of ten up to this one are exact, and below the limit the product is off by less than 1e-3
    let scale = 10f64.powi(i32::try_from(decimals).ok().filter(|digits| *digits <= 15)?);
    let scaled = value.abs() * scale;
    let whole = scaled.floor();
    let rest = scaled - whole;
    if scaled.is_nan() || scaled >= 4e12 || (rest - 0.5).abs() < 2e-3 {
        return None;
    }
    // the cast is exact below the limit
    let digits = (whole + if rest > 0.5 { 1.0 } else { 0.0 }) as u64;
    let sign = if value.is_sign_negative() { "-" } else { "" };
    let mut text = format!("{sign}{digits:0width$}", width = decimals + 1);
    if decimals > 0 {
        text.insert(text.len() - decimals, '.');
    }
    Some(text)
}

/// Signs and leading zero in this style; never a minus before only zeros.
fn finish(mut text: String, plus: bool, leading_zero: bool) -> String {
    if text.starts_with('-') && !text.bytes().any(|b| (b'1'..=b'9').contains(&b)) {
        text.remove(0);
    }
    if !leading_zero {
        let sign = usize::from(text.starts_with('-'));
        if text[sign..].starts_with("0.") && text.len() > sign + 2 {
            text.remove(sign);
        }
    }
    if plus && !text.starts_with('-') {
        text.insert(0, '+');
    }
    text
}

/// The decimal number `text` plus the whole number `add`, exactly, with as many digits after the point as before.
/// `None` when `text` is not a plain decimal or has too many digits.
pub(crate) fn add_whole(text: &str, add: i64) -> Option<String> {
    let digits = text.trim_start_matches(['+', '-']);
    let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
    if text.len() - digits.len() > 1 || (whole.is_empty() && fraction.is_empty()) {
        return None;
    }
    if !whole.bytes().chain(fraction.bytes()).all(|b| b.is_ascii_digit()) {
        return None;
    }
    let scale = 10i64.checked_pow(u32::try_from(fraction.len()).ok()?)?;
    let size: i64 = format!("0{whole}{fraction}").parse().ok()?;
    let signed = if text.starts_with('-') { -size } else { size };
    let sum = signed.checked_add(add.checked_mul(scale)?)?;
    let mut out = format!(
        "{}{}",
        if sum < 0 { "-" } else { "" },
        sum.unsigned_abs() / scale.unsigned_abs()
    );
    if digits.contains('.') {
        out.push('.');
    }
    if !fraction.is_empty() {
        let digits = (sum.unsigned_abs() % scale.unsigned_abs()).to_string();
        out.extend(core::iter::repeat_n('0', fraction.len().saturating_sub(digits.len())));
        out.push_str(&digits);
    }
    Some(finish(out, text.starts_with('+'), !whole.is_empty()))
}

/// The byte after the last word of a block.
pub(crate) fn end_of_words(program: &Program, block: BlockId) -> u32 {
    let block = program.block(block);
    block.words().last().map_or(block.range().start, |word| word.range.end)
}

/// A blank for an F word at `at`, where the program has one before its F words.
pub(crate) fn blank_before_f(program: &Program, at: u32) -> &'static str {
    let source = program.source();
    let line = source[..at as usize]
        .rsplit(|&byte| byte == b'\n')
        .next()
        .unwrap_or_default();
    if line.contains(&b' ') || source.windows(2).any(|pair| pair == b" F") {
        " "
    } else {
        ""
    }
}

#[cfg(test)]
mod tests {
    use super::{NumberStyle, add_whole, rounded};
    use proptest::prelude::*;

    fn style(texts: &[&str]) -> NumberStyle {
        NumberStyle::learn(texts.iter().copied()).expect("numbers")
    }

    proptest! {
        #[test]
        fn one_product_rounds_as_exact_arithmetic_does(
            value in prop_oneof![-1e5..1e5f64, -1.0..1.0f64, (-1_000_000_i64..1_000_000).prop_map(|count| count as f64 * 0.5e-3), any::<f64>()],
            decimals in 0..9_usize,
        ) {
            if let Some(text) = rounded(value, decimals) {
                prop_assert_eq!(text, format!("{value:.decimals$}"));
            }
        }
    }

    #[test]
    fn the_middle_between_two_numbers_is_left_to_exact_arithmetic() {
        assert_eq!(rounded(2.2124, 3).as_deref(), Some("2.212"));
        assert_eq!(rounded(-0.0, 2).as_deref(), Some("-0.00"));
        assert_eq!(rounded(7.0, 0).as_deref(), Some("7"));
        for (value, decimals) in [(0.5, 0), (0.125, 2), (1.0005, 3), (f64::NAN, 3), (1e300, 3), (1.0, 400)] {
            assert_eq!(rounded(value, decimals), None, "{value} {decimals}");
        }
    }

    #[test]
    fn the_published_rows_are_written_as_they_are() {
        let c = style(&["3.358", "4.822", "52.595", "-3.086", "-0.905"]);
        assert_eq!(c.write(2.2124, false), "2.212");
        let a = style(&["2.042", "-0.79", "0"]);
        assert_eq!(
            (a.write(-0.79, false), a.write(0.0, false), a.write(1.5, false)),
            ("-0.79".into(), "0".into(), "1.5".into())
        );
        let y = style(&["0.00000", "60.00000"]);
        assert_eq!(y.write(-0.000_001, false), "0.00000");
        assert_eq!(y.write(-2.144_69, false), "-2.14469");
        let with_header = style(&["0", "100", "59.95290"]);
        assert_eq!(
            with_header.write(1.5, false),
            "1.50000",
            "whole numbers in a header do not make zeros superfluous"
        );
        assert_eq!(style(&["10.0", "2.125"]).write(1.5, false), "1.5");
    }

    #[test]
    fn neighbours_enclose_the_value() {
        let c = style(&["3.358"]);
        assert_eq!(c.neighbours(-1.2345, false), ["-1.235", "-1.234"]);
        assert_eq!(c.neighbours(2.0, false), ["2.000", "2.000"]);
    }

    #[test]
    fn points_zeros_and_signs_follow_the_file() {
        assert_eq!(style(&["10.", ".5"]).write(-0.5, false), "-.5");
        assert_eq!(style(&["10.", "2.25"]).write(3.0, false), "3.");
        assert_eq!(style(&["10"]).write(3.4, false), "3");
        assert_eq!(style(&["10."]).write(3.4, false), "3.");
        assert_eq!(style(&["1.50"]).write(3.0, true), "+3.00");
        assert_eq!(NumberStyle::learn(["R1+2", ""].into_iter()), None);
    }

    #[test]
    fn whole_turns_are_added_exactly() {
        for (text, add, sum) in [
            ("0.5", 360, "360.5"),
            (".5", 360, "360.5"),
            ("-359.90", 360, "0.10"),
            ("-359.9", 0, "-359.9"),
            ("10.", 360, "370."),
            ("+5", 360, "+365"),
            ("355", -360, "-5"),
            ("360.000", -360, "0.000"),
            ("-.25", 0, "-.25"),
        ] {
            assert_eq!(add_whole(text, add).as_deref(), Some(sum), "{text} + {add}");
        }
        for text in ["", "-", ".", "1.2.3", "--5", "1e5", "99999999999999999999"] {
            assert_eq!(add_whole(text, 360), None, "{text}");
        }
    }
}
