//! Operands: numbers, variables, functions.
use super::Sinumerik;
use crate::code::{Binary, Op, Unary};
use crate::infix::{Reader, Rules, Waiting};
use crate::{FormulaErrorKind as Kind, Name};

/// `5`, `.5`, `1.EX-3`.
pub(super) fn number(reader: &mut Reader<'_, Sinumerik>) -> Result<(), Kind> {
    let rest = reader.rest();
    let digits = |from: usize| rest[from..].iter().take_while(|byte| byte.is_ascii_digit()).count();
    let mut length = digits(0);
    if rest.get(length) == Some(&b'.') {
        length += 1;
        length += digits(length);
    }
    let mut text = String::from_utf8_lossy(&rest[..length]).into_owned();
    if rest
        .get(length..length + 2)
        .is_some_and(|mark| mark.eq_ignore_ascii_case(b"EX"))
    {
        let sign = usize::from(matches!(rest.get(length + 2), Some(b'+' | b'-')));
        let exponent = digits((length + 2 + sign).min(rest.len()));
        if exponent > 0 {
            text.push('e');
            text.push_str(&String::from_utf8_lossy(
                &rest[length + 2..length + 2 + sign + exponent],
            ));
            length += 2 + sign + exponent;
        }
    }
    let value = text.parse().map_err(|_| Kind::NotANumber { text: text.into() })?;
    reader.take(length);
    reader.push(Op::Number(value));
    Ok(())
}

/// `'H1F'`, `'B101'`.
pub(super) fn coded(reader: &mut Reader<'_, Sinumerik>) -> Result<(), Kind> {
    let inside = reader.rest()[1..]
        .split(|&byte| byte == b'\'')
        .next()
        .unwrap_or_default();
    let text = String::from_utf8_lossy(inside).to_ascii_uppercase();
    let value = match (text.get(..1), text.get(1..)) {
        (Some("H"), Some(digits)) => u32::from_str_radix(digits, 16).ok(),
        (Some("B"), Some(digits)) => u32::from_str_radix(digits, 2).ok(),
        _ => None,
    };
    let Some(value) = value.filter(|_| reader.rest().len() > inside.len() + 1) else {
        return Err(Kind::NotANumber { text: text.into() });
    };
    reader.take(inside.len() + 2);
    reader.push(Op::Number(f64::from(value)));
    Ok(())
}

pub(super) fn word(rest: &[u8]) -> &[u8] {
    let sign = usize::from(rest.first() == Some(&b'$'));
    let of_name = |byte: &&u8| byte.is_ascii_alphanumeric() || **byte == b'_';
    let letters = rest[sign..].iter().take_while(of_name).count();
    &rest[..sign + letters]
}

/// A variable, function, TRUE, FALSE or NOT.
pub(super) fn name(reader: &mut Reader<'_, Sinumerik>) -> Result<bool, Kind> {
    let name = String::from_utf8_lossy(word(reader.rest())).to_ascii_lowercase();
    reader.take(name.len());
    Sinumerik::blanks(reader);
    match (name.as_str(), reader.peek()) {
        ("not", _) => reader.prefix(Unary::Not),
        ("b_not", _) => reader.prefix(Unary::BitNot),
        ("r", Some(b'[')) => reader.open(Waiting::Index),
        (_, Some(b'(')) => match function(&name) {
            Some(waiting) => reader.open(waiting),
            None => return reader.bracket_of(&name, *b"()").map(|()| true),
        },
        (_, Some(b'[')) if !name.starts_with('$') && reader.has_one_index() => {
            reader.open(Waiting::Field(Name::new(&name)));
        }
        (_, Some(b'[')) => return reader.bracket_of(&name, *b"[]").map(|()| true),
        _ => {
            reader.back();
            let number = name
                .strip_prefix('r')
                .filter(|digits| digits.bytes().all(|byte| byte.is_ascii_digit()));
            match (name.as_str(), number.and_then(|digits| digits.parse().ok())) {
                ("true", _) => reader.push(Op::Number(1.0)),
                ("false", _) => reader.push(Op::Number(0.0)),
                (_, Some(number)) => reader.push(Op::Read(number)),
                _ => reader.named(&name),
            }
            return Ok(true);
        }
    }
    Ok(false)
}

fn function(name: &str) -> Option<Waiting> {
    Some(match name {
        "sin" => Waiting::One(Unary::Sin),
        "cos" => Waiting::One(Unary::Cos),
        "tan" => Waiting::One(Unary::CheckedTan),
        "asin" => Waiting::One(Unary::Asin),
        "acos" => Waiting::One(Unary::Acos),
        "sqrt" => Waiting::One(Unary::Sqrt),
        "abs" => Waiting::One(Unary::Abs),
        "pot" => Waiting::One(Unary::Square),
        "trunc" => Waiting::One(Unary::CutOff),
        "round" => Waiting::One(Unary::RoundHalf),
        "roundup" => Waiting::One(Unary::RoundUp),
        "ln" => Waiting::One(Unary::Ln),
        "exp" => Waiting::One(Unary::Exp),
        "atan2" => Waiting::Two(Binary::Atan2, false),
        "minval" => Waiting::Two(Binary::Minimum, false),
        "maxval" => Waiting::Two(Binary::Maximum, false),
        "bound" => Waiting::Bound(0),
        _ => return None,
    })
}
