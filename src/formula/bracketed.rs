//! A number in brackets and nothing else: `[1.5]`.
use crate::Cursor;
use crate::code::{Code, Formula};
use crate::compile::signed;
use trunnion_syntax::{Decimal, TextRange};

/// `[1.5]` without blanks and nothing else in brackets, as a number: for a place where a value in brackets must stand. The cursor is
/// after it then.
#[inline]
pub fn number_in_brackets(cursor: &mut Cursor<'_>) -> Option<Formula> {
    let start = cursor.at();
    let value = match short_in_brackets(cursor.rest()) {
        Some((value, length)) => {
            cursor.skip_to(start + length);
            value
        }
        None => bracketed_number(cursor)?.0,
    };
    Some(Formula {
        range: cursor.since(start),
        code: Code::Literal { value, decimal: None },
    })
}

/// `[1.5]` at the start of a text, of few digits, without a sign and without blanks, and how many bytes it has; `at`: where the text
/// is in the file. `None` for all else.
#[inline]
pub fn literal_in_brackets(text: &[u8], at: u32) -> Option<(Formula, usize)> {
    let (value, length) = short_in_brackets(text)?;
    let formula = Formula {
        range: TextRange::new(at, at + length),
        code: Code::Literal { value, decimal: None },
    };
    Some((formula, length as usize))
}

/// `[1.5]` at the start of a text, of few digits and without a sign: the number, and one past the bracket that closes.
#[inline]
fn short_in_brackets(text: &[u8]) -> Option<(f64, u32)> {
    // both operands of the division are exact, so that it rounds as a whole
    const POWERS: [f64; 16] = [
        1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
    ];
    let text: &[u8] = text.first_chunk::<{ POWERS.len() }>().map_or(text, |short| short);
    if text.first() != Some(&b'[') {
        return None;
    }
    let (mut mantissa, mut point) = (0u64, 0);
    for (at, &byte) in text.iter().enumerate().skip(1) {
        let digit = byte.wrapping_sub(b'0');
        if digit < 10 {
            mantissa = 10 * mantissa + u64::from(digit);
        } else if byte == b'.' && point == 0 {
            point = at;
        } else {
            let places = if point == 0 { 0 } else { at - point - 1 };
            let digits = at - 1 - usize::from(point != 0);
            return (byte == b']' && digits > 0).then(|| (mantissa as f64 / POWERS[places], at as u32 + 1));
        }
    }
    None
}

/// `[1.5]` without blanks: a number in brackets, and where the number is.
#[inline]
pub(crate) fn bracketed_number(cursor: &mut Cursor<'_>) -> Option<(f64, TextRange)> {
    let (&b'[', rest) = cursor.rest().split_first()? else {
        return None;
    };
    let sign = usize::from(matches!(rest.first(), Some(b'-' | b'+')));
    let other = |byte: &u8| !byte.is_ascii_digit() && *byte != b'.';
    let length = sign + rest.get(sign..)?.iter().position(other)?;
    if length == sign || rest[length] != b']' {
        return None;
    }
    let decimal = Decimal::parse(&rest[..length])?;
    let start = cursor.at() + 1;
    let end = start + length as u32;
    cursor.skip_to(end + 1);
    Some((signed(decimal, rest[0] == b'-'), TextRange::new(start, end)))
}
