//! Operands: numbers, variables, functions.
use super::{Reader, Waiting, is_name};
use crate::code::{Binary, Op, Unary};
use crate::{FormulaErrorKind as Kind, Name};

impl<'s> Reader<'s> {
    /// `5`, `.5`, `1.EX-3`.
    pub(super) fn number(&mut self) -> Result<(), Kind> {
        let rest = self.rest();
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
        self.take(length);
        self.push(Op::Number(value));
        Ok(())
    }

    /// `'H1F'`, `'B101'`.
    pub(super) fn coded(&mut self) -> Result<(), Kind> {
        let inside = self.rest()[1..].split(|&byte| byte == b'\'').next().unwrap_or_default();
        let text = String::from_utf8_lossy(inside).to_ascii_uppercase();
        let value = match (text.get(..1), text.get(1..)) {
            (Some("H"), Some(digits)) => u32::from_str_radix(digits, 16).ok(),
            (Some("B"), Some(digits)) => u32::from_str_radix(digits, 2).ok(),
            _ => None,
        };
        let Some(value) = value.filter(|_| self.rest().len() > inside.len() + 1) else {
            return Err(Kind::NotANumber { text: text.into() });
        };
        self.take(inside.len() + 2);
        self.push(Op::Number(f64::from(value)));
        Ok(())
    }

    pub(super) fn word(&self) -> &'s [u8] {
        let rest = self.rest();
        let sign = usize::from(rest.first() == Some(&b'$'));
        let letters = rest[sign..].iter().take_while(|byte| is_name(**byte)).count();
        &rest[..sign + letters]
    }

    /// A variable, function, TRUE, FALSE or NOT.
    pub(super) fn name(&mut self) -> Result<bool, Kind> {
        let name = String::from_utf8_lossy(self.word()).to_ascii_lowercase();
        self.take(name.len());
        let behind = self.at;
        self.blanks();
        match (name.as_str(), self.peek()) {
            ("not", _) => self.waiting.push(Waiting::Unary(Unary::Not)),
            ("b_not", _) => self.waiting.push(Waiting::Unary(Unary::BitNot)),
            ("r", Some(b'[')) => {
                self.take(1);
                self.waiting.push(Waiting::Index);
            }
            (_, Some(b'(')) => {
                let Some(waiting) = function(&name) else {
                    self.group(b'(', b')')?;
                    self.unknown(&format!("{name}("));
                    return Ok(true);
                };
                self.take(1);
                self.waiting.push(waiting);
            }
            (_, Some(b'[')) if !name.starts_with('$') && self.has_one_index() => {
                self.take(1);
                self.waiting.push(Waiting::Field(Name::new(&name)));
            }
            (_, Some(b'[')) => {
                self.group(b'[', b']')?;
                self.unknown(&format!("{name}["));
                return Ok(true);
            }
            _ => {
                self.at = behind;
                let number = name
                    .strip_prefix('r')
                    .filter(|digits| digits.bytes().all(|byte| byte.is_ascii_digit()));
                match (name.as_str(), number.and_then(|digits| digits.parse().ok())) {
                    ("true", _) => self.push(Op::Number(1.0)),
                    ("false", _) => self.push(Op::Number(0.0)),
                    (_, Some(number)) => self.push(Op::Read(number)),
                    _ => self.unknown(&name),
                }
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Whether the bracket at the cursor holds one expression, which is no text.
    fn has_one_index(&mut self) -> bool {
        if self.at < self.one_index_to {
            return true;
        }
        let inside = self.rest().split(|&byte| byte == b']').next().unwrap_or_default();
        let one = !inside.iter().any(|byte| matches!(byte, b',' | b'"'));
        if one {
            self.one_index_to = self.at + inside.len() as u32;
        }
        one
    }

    /// Skips a bracket and its contents.
    pub(super) fn group(&mut self, open: u8, close: u8) -> Result<(), Kind> {
        let mut deep = 0usize;
        let mut quoted = false;
        for (at, &byte) in self.rest().iter().enumerate() {
            quoted ^= byte == b'"';
            if byte == open && !quoted {
                deep += 1;
            } else if byte == close && !quoted {
                deep -= 1;
                if deep == 0 {
                    self.take(at + 1);
                    return Ok(());
                }
            }
        }
        Err(Kind::UnclosedBracket)
    }
}

fn function(name: &str) -> Option<Waiting> {
    Some(match name {
        "sin" => Waiting::One(Unary::Sin),
        "cos" => Waiting::One(Unary::Cos),
        "tan" => Waiting::One(Unary::Tan),
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
        _ => return None,
    })
}
