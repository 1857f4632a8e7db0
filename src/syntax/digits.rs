//! Digits eight bytes at a time.

/// Eight times the byte 0.
const ZEROS: u64 = 0x3030_3030_3030_3030;
/// The highest bit of each of eight bytes.
const TOPS: u64 = 0x8080_8080_8080_8080;

/// Eight bytes, the first of them lowest, in which a digit is its value: the others are found by [`not_digits`].
#[inline]
#[must_use]
pub(crate) const fn digits(bytes: [u8; 8]) -> u64 {
    u64::from_le_bytes(bytes) ^ ZEROS
}

/// A byte as it is among [`digits`].
#[inline]
#[must_use]
pub(crate) const fn as_digit(byte: u8) -> u64 {
    byte as u64 ^ 0x30
}

/// The highest bit of each byte of [`digits`] that is none. The bits of bytes after one above `z` may be wrong.
#[inline]
#[must_use]
pub(crate) const fn not_digits(digits: u64) -> u64 {
    // 10 and more reach the highest bit; a sum that overflows, of a byte that has it already, spoils only what follows
    (digits.wrapping_add(0x7676_7676_7676_7676) | digits) & TOPS
}

#[cfg(test)]
mod tests {
    use super::{as_digit, digits, not_digits};

    #[test]
    fn every_byte_is_a_digit_or_none_wherever_it_stands() {
        for byte in 0..=u8::MAX {
            for place in 0..8 {
                let mut bytes = *b"13579024";
                bytes[place] = byte;
                let other = not_digits(digits(bytes));
                let expected = if byte.is_ascii_digit() { 8 } else { place };
                assert_eq!(other.trailing_zeros() as usize / 8, expected, "{byte} {place}");
                assert_eq!(digits(bytes) >> (8 * place) & 0xff, as_digit(byte));
                // for bytes up to a letter, the result for the following ones is correct
                let behind = other & other.wrapping_sub(1);
                assert!(byte > b'z' || behind == 0, "{byte} {place}");
            }
        }
        let both = not_digits(digits(*b"1.23 456"));
        assert_eq!(both, 0x80_0000_8000);
    }
}
