//! The length of a number, eight bytes at a time.
use crate::digits::{as_digit, digits, not_digits};

/// After the number at `first`, digits with perhaps a point and digits after it, if it fits into eight bytes; otherwise `None`.
#[inline]
pub(crate) fn short(source: &[u8], first: usize) -> Option<usize> {
    let bytes = digits(*source.get(first..)?.first_chunk()?);
    let other = not_digits(bytes);
    if other == 0 {
        return None;
    }
    // bits before the first byte that is no digit: 0, 8, .. 56
    let whole = other.trailing_zeros() & 0x38;
    if bytes >> whole & 0xff != as_digit(b'.') {
        return (whole > 0).then_some(first + whole as usize / 8);
    }
    let behind = other & (other - 1);
    let end = behind.trailing_zeros() & 0x38;
    // `X1.` is cut by the lexer's own rules
    (behind != 0 && end > whole + 8).then_some(first + end as usize / 8)
}

#[cfg(test)]
mod tests {
    use super::short;
    use proptest::prelude::*;

    /// The same byte by byte.
    fn one_by_one(number: &[u8]) -> Option<usize> {
        let digits = |at: usize| number[at..].iter().take_while(|byte| byte.is_ascii_digit()).count();
        let before = digits(0);
        if number[before] != b'.' {
            return (before > 0).then_some(before);
        }
        let after = digits(before + 1);
        (after > 0).then_some(before + 1 + after)
    }

    proptest! {
        #[test]
        fn a_number_is_as_long_as_its_bytes_say(text in "[0-9]{0,9}[.]?[0-9]{0,9}[ \nX.;\u{e9}-][ -~]{20}") {
            let expected = one_by_one(text.as_bytes());
            match short(text.as_bytes(), 0) {
                Some(length) => prop_assert_eq!(Some(length), expected, "{}", text),
                // what fits into eight bytes is found
                None => prop_assert!(expected.is_none_or(|length| length > 7), "{}", text),
            }
        }
    }
}
