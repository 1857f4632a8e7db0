//! Digits eight bytes at a time.

/// The upper halves of eight bytes.
const HIGH: u64 = 0xf0f0_f0f0_f0f0_f0f0;

/// Of eight bytes, the first of them lowest: zero in each that is a digit. A byte above 0xF9 makes what it says of those behind it wrong.
#[inline]
#[must_use]
pub const fn not_digits(bytes: u64) -> u64 {
    // a digit is 3x, and stays below 40 when 6 is added; a sum that overflows spoils only what stands behind
    ((bytes & HIGH) | ((bytes.wrapping_add(0x0606_0606_0606_0606) & HIGH) >> 4)) ^ 0x3333_3333_3333_3333
}

/// The whole number of the first `bits / 8` of eight bytes, which are digits; at most seven of them.
#[inline]
#[must_use]
pub const fn whole_number(bytes: u64, bits: u32) -> u64 {
    // zeros in front, then pairs, fours and eight digits at once
    let digits = (bytes & !HIGH) << 8 << (56 - bits);
    let pairs = digits.wrapping_mul(10).wrapping_add(digits >> 8);
    let low = (pairs & 0x0000_00ff_0000_00ff).wrapping_mul(0x000f_4240_0000_0064);
    let high = (pairs >> 16 & 0x0000_00ff_0000_00ff).wrapping_mul(0x0000_2710_0000_0001);
    low.wrapping_add(high) >> 32
}

#[cfg(test)]
mod tests {
    use super::{not_digits, whole_number};

    #[test]
    fn every_byte_is_a_digit_or_none_wherever_it_stands() {
        for byte in 0..=u8::MAX {
            for place in 0..8 {
                let mut bytes = *b"13579024";
                bytes[place] = byte;
                let other = not_digits(u64::from_le_bytes(bytes));
                let expected = if byte.is_ascii_digit() { 8 } else { place };
                assert_eq!(other.trailing_zeros() as usize / 8, expected, "{byte} {place}");
            }
        }
    }

    #[test]
    fn whole_numbers_are_those_that_are_written() {
        let bytes = *b"9070605x";
        let mut value = 0;
        for count in 0..8_usize {
            assert_eq!(whole_number(u64::from_le_bytes(bytes), 8 * count as u32), value);
            value = value * 10 + u64::from(bytes[count].wrapping_sub(b'0'));
        }
    }
}
