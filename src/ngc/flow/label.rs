//! The label of an O line: a number, a name, or an expression whose value is the number.
use trunnion_formula::{Cursor, Formula, FormulaError, Grammar, Name, Pool, Target, target};

/// What follows the O.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Label {
    /// A number of up to nine digits.
    Number(u32),
    /// `<name>` without blanks and in lower case, or another number as the control writes it.
    Text(Name),
    /// `#1`, `[2*#3]`: known when the line runs.
    Computed(Formula),
}

/// The largest number of nine digits.
const LARGEST: i64 = 999_999_999;

impl Default for Label {
    fn default() -> Self {
        Self::Text(Name::new(""))
    }
}

/// Reads the label at the cursor.
pub(super) fn label(cursor: &mut Cursor<'_>, errors: &mut Vec<FormulaError>, pool: &mut Pool) -> Label {
    if let Some(name) = plain_name(cursor) {
        return Label::Text(name);
    }
    if cursor.eat(b'<') {
        // a name that is not closed takes the rest of the line
        let mut name = String::new();
        while let Some(byte) = cursor.bump() {
            if byte == b'>' {
                break;
            }
            name.push(char::from(byte));
        }
        return Label::Text(Name::new(name.trim_end_matches(['\r', '\n'])));
    }
    if let Some(number) = plain_label(cursor) {
        return Label::Number(number);
    }
    let (formula, error) = pool.value_or_error(cursor, Grammar::Rs274);
    errors.extend(error);
    match formula.number().and_then(whole) {
        Some(number @ 0..=LARGEST) => Label::Number(number as u32),
        Some(number) => Label::Text(Name::new(&number.to_string())),
        None => Label::Computed(formula),
    }
}

/// `<name>` at the cursor, where the name is closed and made of letters, digits and `_`.
fn plain_name(cursor: &mut Cursor<'_>) -> Option<Name> {
    let (&b'<', _) = cursor.rest().split_first()? else {
        return None;
    };
    let mut ahead = *cursor;
    match target(&mut ahead, Grammar::Rs274) {
        Ok(Target::Named(name)) if name.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_') => {
            *cursor = ahead;
            Some(name)
        }
        _ => None,
    }
}

/// The number at the cursor, where it is written as the control writes it and a keyword or nothing follows.
fn plain_label(cursor: &mut Cursor<'_>) -> Option<u32> {
    let rest = cursor.rest();
    let (number, length) = digits(rest)?;
    let behind = rest[length..].iter().find(|byte| !matches!(byte, b' ' | b'\t' | b'\r'));
    if !behind.is_none_or(u8::is_ascii_alphabetic) {
        return None;
    }
    cursor.skip_to(cursor.at() + length as u32);
    Some(number)
}

/// The number that a text begins with, of at most nine digits and without a zero in front, and how many digits it has.
#[inline]
pub(super) fn digits(text: &[u8]) -> Option<(u32, usize)> {
    let mut number = 0u32;
    let mut length = 0;
    for byte in text {
        let digit = byte.wrapping_sub(b'0');
        if digit >= 10 {
            break;
        }
        if length == 9 {
            return None;
        }
        number = number * 10 + u32::from(digit);
        length += 1;
    }
    (length == 1 || length > 1 && text[0] != b'0').then_some((number, length))
}

/// A whole number, where it is one within the tolerance that the control grants.
pub(crate) fn whole(value: f64) -> Option<i64> {
    let nearest = (value + 0.5).floor();
    ((value - nearest).abs() <= 0.0001).then_some(nearest as i64)
}
