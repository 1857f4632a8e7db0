//! Operands: numbers, variables, functions.
use super::{Reader, Waiting};
use crate::code::{Binary, Op, Unary};
use crate::{FormulaErrorKind as Kind, Name};

impl<'s> Reader<'s> {
    pub(super) fn number(&mut self) -> Result<(), Kind> {
        let rest = self.rest();
        let length = rest
            .iter()
            .take_while(|byte| byte.is_ascii_digit() || **byte == b'.')
            .count();
        let text = String::from_utf8_lossy(&rest[..length]);
        let value = text.parse().map_err(|_| Kind::NotANumber {
            text: text.as_ref().into(),
        })?;
        self.take(length);
        self.push(Op::Number(value));
        Ok(())
    }

    /// `#1FH`.
    pub(super) fn hexadecimal(&mut self) -> Result<(), Kind> {
        let rest = &self.rest()[1..];
        let length = rest.iter().take_while(|byte| byte.is_ascii_alphanumeric()).count();
        let text = String::from_utf8_lossy(&rest[..length]).to_ascii_uppercase();
        let value = text
            .strip_suffix('H')
            .and_then(|digits| u32::from_str_radix(digits, 16).ok());
        let Some(value) = value else {
            return Err(Kind::NotANumber { text: text.into() });
        };
        self.take(length + 1);
        self.push(Op::Number(f64::from(value)));
        Ok(())
    }

    pub(super) fn word(&self) -> &'s [u8] {
        let rest = self.rest();
        let length = rest.iter().take_while(|byte| byte.is_ascii_alphanumeric()).count();
        &rest[..length]
    }

    /// A variable, a function or NOT.
    pub(super) fn name(&mut self) -> Result<bool, Kind> {
        let name = String::from_utf8_lossy(self.word()).to_ascii_lowercase();
        self.take(name.len());
        let behind = self.at;
        self.blanks();
        let bracket = self.peek() == Some(b'[');
        if name == "not" {
            self.waiting.push(Waiting::Unary(Unary::TruthNot));
            return Ok(false);
        }
        if !bracket {
            self.at = behind;
            self.push(Op::Named(Name::new(&name)));
            return Ok(true);
        }
        let waiting = match function(&name) {
            Function::Known(waiting) => waiting,
            Function::None if self.has_one_index() => Waiting::Field(Name::new(&name)),
            Function::Unstated | Function::None => return self.unknown(&name),
        };
        self.take(1);
        self.open(waiting);
        Ok(false)
    }

    /// Skips the bracket of a name that has no known value.
    fn unknown(&mut self, name: &str) -> Result<bool, Kind> {
        let mut deep = 0usize;
        for (at, byte) in self.rest().iter().enumerate() {
            match byte {
                b'[' => deep += 1,
                b']' => deep -= 1,
                _ => {}
            }
            if deep == 0 {
                self.take(at + 1);
                self.push(Op::Named(Name::new(&format!("{name}["))));
                return Ok(true);
            }
        }
        Err(Kind::UnclosedBracket)
    }

    /// Whether the bracket at the cursor holds one expression.
    fn has_one_index(&mut self) -> bool {
        if self.at < self.one_index_to {
            return true;
        }
        let inside = self.rest().split(|&byte| byte == b']').next().unwrap_or_default();
        let one = !inside.contains(&b',');
        if one {
            self.one_index_to = self.at + inside.len() as u32;
        }
        one
    }
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
        "tan" => Waiting::One(Unary::Tan),
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
