//! Operands: numbers, variables, functions.
use super::Osp;
use crate::code::{Binary, Op, Unary};
use crate::infix::{Reader, Rules, Waiting};
use crate::{FormulaErrorKind as Kind, Name};

pub(super) fn number(reader: &mut Reader<'_, Osp>) -> Result<(), Kind> {
    let rest = reader.rest();
    let length = rest
        .iter()
        .take_while(|byte| byte.is_ascii_digit() || **byte == b'.')
        .count();
    let text = String::from_utf8_lossy(&rest[..length]);
    let value = text.parse().map_err(|_| Kind::NotANumber {
        text: text.as_ref().into(),
    })?;
    reader.take(length);
    reader.push(Op::Number(value));
    Ok(())
}

/// `#1FH`.
pub(super) fn hexadecimal(reader: &mut Reader<'_, Osp>) -> Result<(), Kind> {
    let text = String::from_utf8_lossy(word(&reader.rest()[1..])).to_ascii_uppercase();
    let value = text
        .strip_suffix('H')
        .and_then(|digits| u32::from_str_radix(digits, 16).ok());
    let Some(value) = value else {
        return Err(Kind::NotANumber { text: text.into() });
    };
    reader.take(text.len() + 1);
    reader.push(Op::Number(f64::from(value)));
    Ok(())
}

pub(super) fn word(rest: &[u8]) -> &[u8] {
    let length = rest.iter().take_while(|byte| byte.is_ascii_alphanumeric()).count();
    &rest[..length]
}

/// A variable, a function or NOT.
pub(super) fn name(reader: &mut Reader<'_, Osp>) -> Result<bool, Kind> {
    let name = String::from_utf8_lossy(word(reader.rest())).to_ascii_lowercase();
    reader.take(name.len());
    Osp::blanks(reader);
    if name == "not" {
        reader.prefix(Unary::TruthNot);
        return Ok(false);
    }
    if reader.peek() != Some(b'[') {
        reader.back();
        reader.named(&name);
        return Ok(true);
    }
    let waiting = match function(&name) {
        Function::Known(waiting) => waiting,
        Function::None if reader.has_one_index() => Waiting::Field(Name::new(&name)),
        Function::Unstated | Function::None => return reader.bracket_of(&name, Osp::GROUP).map(|()| true),
    };
    reader.open(waiting);
    Ok(false)
}

/// What a name before a bracket is.
enum Function {
    Known(Waiting),
    /// A function, and what it gives is not stated by a source.
    Unstated,
    /// None.
    None,
}

fn function(name: &str) -> Function {
    Function::Known(match name {
        "sin" => Waiting::One(Unary::Sin),
        "cos" => Waiting::One(Unary::Cos),
        "tan" => Waiting::One(Unary::CheckedTan),
        "sqrt" => Waiting::One(Unary::Sqrt),
        "abs" => Waiting::One(Unary::Abs),
        "round" => Waiting::One(Unary::NearestWhole),
        "fix" => Waiting::One(Unary::WholeBelow),
        "fup" => Waiting::One(Unary::RoundUp),
        "mod" => Waiting::Two(Binary::PositiveRemainder, false),
        "atan" | "atan2" | "dround" | "dfix" | "dfup" | "bin" | "bcd" => return Function::Unstated,
        _ => return Function::None,
    })
}
