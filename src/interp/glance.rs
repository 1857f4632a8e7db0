//! What the bytes of a block show at a glance, before its words are read.

/// The letters of a block (bit 0: A) that is nothing but single capital letters with plain numbers. `None` where it may be more.
pub fn plain_letters(text: &[u8]) -> Option<u32> {
    let digits = |text: &[u8]| text.iter().take_while(|byte| byte.is_ascii_digit()).count();
    let mut letters = 0;
    let mut rest = text.trim_ascii();
    while let [letter @ b'A'..=b'Z', number @ ..] = rest {
        letters |= 1 << (letter - b'A');
        let number = match number {
            [b'+' | b'-', unsigned @ ..] => unsigned,
            number => number,
        };
        let whole = digits(number);
        let length = match &number[whole..] {
            [b'.', fraction @ ..] => whole + 1 + digits(fraction),
            _ => whole,
        };
        if whole == 0 && length < 2 {
            return None;
        }
        rest = number[length..].trim_ascii_start();
    }
    rest.is_empty().then_some(letters)
}

#[cfg(test)]
mod tests {
    use super::plain_letters;

    #[test]
    fn letters_with_plain_numbers_are_seen() {
        assert_eq!(plain_letters(b"A1 B-2.5C+.5"), Some(0b111));
        assert_eq!(plain_letters(b" A1. "), Some(1));
        assert_eq!(plain_letters(b""), Some(0));
        let more = [
            "A", "A.", "A1.2.3", "A1 5", "A=1", "AB1", "a1", "/A1", "A#1", "A[1]", "A1 (B)", "A1;", "A3=1", "%",
            "A1,R2",
        ];
        for text in more {
            assert_eq!(plain_letters(text.as_bytes()), None, "{text}");
        }
    }
}
