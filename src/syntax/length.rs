//! How long numbers and words are, eight bytes at a time.
use crate::digits::{as_digit, digits, not_digits};

/// This many bytes show a word whole: letter, sign, sixteen of its number, and what follows it.
pub(crate) const WHOLE: usize = 20;

/// How long the word is with which these bytes begin, where it is a letter and a number that shows whole; `None` elsewhere. Two bytes more
/// come after it.
#[inline]
pub(crate) fn whole(word: &[u8; WHOLE]) -> Option<usize> {
    let [letter, sign, ..] = *word;
    if !letter.is_ascii_alphabetic() {
        return None;
    }
    let signed = sign == b'-' || sign == b'+';
    let (bytes, more): ([u8; 8], [u8; 8]) = if signed {
        (*word[2..].first_chunk()?, *word[10..].first_chunk()?)
    } else {
        (*word[1..].first_chunk()?, *word[9..].first_chunk()?)
    };
    let first = 1 + usize::from(signed);
    let bytes = digits(bytes);
    let other = not_digits(bytes);
    // bits before the first byte that is no digit: 0, 8, .. 56
    let whole = other.trailing_zeros() & 0x38;
    if other == 0 {
        return None;
    }
    if bytes >> whole & 0xff != as_digit(b'.') {
        return (whole > 0).then_some(first + whole as usize / 8);
    }
    let behind = other & (other - 1);
    if behind != 0 {
        let end = behind.trailing_zeros() & 0x38;
        // `X1.` is cut by the lexer's own rules
        return (end > whole + 8).then_some(first + end as usize / 8);
    }
    let more = not_digits(digits(more));
    let end = 64 + (more.trailing_zeros() & 0x38);
    (more != 0 && end > whole + 8).then_some(first + end as usize / 8)
}

/// After the number at `first`, digits with perhaps a point and digits after it, where all of it shows in eight bytes; `None` elsewhere.
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
    use super::{WHOLE, whole};
    use proptest::prelude::*;

    /// The same byte by byte.
    fn one_by_one(word: &[u8]) -> Option<usize> {
        let first = 1 + usize::from(matches!(word[1], b'-' | b'+'));
        let digits = |at: usize| word[at..].iter().take_while(|byte| byte.is_ascii_digit()).count();
        let before = digits(first);
        if word[first + before] != b'.' {
            return (before > 0).then_some(first + before);
        }
        let behind = digits(first + before + 1);
        (behind > 0).then_some(first + before + 1 + behind)
    }

    proptest! {
        #[test]
        fn a_word_is_as_long_as_its_bytes_say(text in "[A-Za-z][-+]?[0-9]{0,9}[.]?[0-9]{0,9}[ \nX.;\u{e9}-][ -~]{20}") {
            let word = text.as_bytes().first_chunk::<WHOLE>().expect("long enough");
            let expected = one_by_one(text.as_bytes());
            match whole(word) {
                Some(length) => prop_assert_eq!(Some(length), expected, "{}", text),
                // what shows in the first bytes is found
                None => prop_assert!(expected.is_none_or(|length| length > 8), "{}", text),
            }
        }
    }

    #[test]
    fn only_a_letter_and_a_number_are_a_word() {
        let length = |text: &[u8; WHOLE]| whole(text);
        assert_eq!(length(b"X-123.4567 Y1 Z2    "), Some(10));
        assert_eq!(length(b"X12345678.1234 Y1   "), None);
        assert_eq!(length(b"X1234567.1234567\nX1 "), Some(16));
        assert_eq!(length(b"X-1234567.1234567 X1"), Some(17));
        assert_eq!(length(b"X1234567. Y1        "), None);
        assert_eq!(length(b"X1. Y1              "), None);
        assert_eq!(length(b"X- 1 Y1             "), None);
        assert_eq!(length(b"1X1 Y1              "), None);
        assert_eq!(length(b" X1 Y1              "), None);
    }
}
