//! Q parameters and formulas.
//!
//! Sources: HEIDENHAIN TNC 640 user's manual, Q parameter programming. The order of a function without parentheses and of `^` among other
//! operators is not taken from a source: the value is unknown there.
use super::words::{Kind, Parameter, Said, Words};
use crate::frames::sin_cos_degrees;
use std::collections::BTreeMap;
use trunnion_geometry::math::{acos, asin, atan2, exp, ln, pow};

/// A value; `None`: not known.
pub(crate) type Value = Option<f64>;

/// Parentheses inside parentheses.
const DEEPEST: usize = 64;

/// All Q parameters.
#[derive(Clone, Debug, Default)]
pub(crate) struct Parameters {
    numbers: BTreeMap<Parameter, Value>,
    pub(crate) texts: BTreeMap<u32, Option<String>>,
    /// Why the value of a parameter is not known, where that is another parameter or the control.
    causes: BTreeMap<Parameter, String>,
    /// Grows with everything that may change a decision.
    pub(crate) changes: u64,
}

impl Parameters {
    /// How many entries a clone copies.
    pub(crate) fn copied(&self) -> usize {
        self.numbers.len() + self.texts.len() + self.causes.len()
    }

    /// The value; parameters that the program has not set are unknown, since they keep their values from programs before.
    pub(crate) fn get(&self, parameter: Parameter) -> Value {
        self.numbers.get(&parameter).copied().flatten()
    }
    pub(crate) fn set(&mut self, parameter: Parameter, value: Value) {
        let value = value.filter(|value| value.is_finite());
        if self.numbers.insert(parameter, value) != Some(value) || value.is_none() {
            self.changes += 1;
        }
    }
    /// Sets a value, or remembers why it is not known.
    pub(crate) fn set_from(&mut self, parameter: Parameter, value: Value, cause: Option<String>) {
        self.set(parameter, value);
        match cause.filter(|_| value.is_none()) {
            Some(cause) => self.causes.insert(parameter, cause),
            None => self.causes.remove(&parameter),
        };
    }
    /// The first parameter of a text whose value is not known: why it is not.
    pub(crate) fn cause_in(&self, text: &[u8]) -> Option<String> {
        Words::new(text).find_map(|word| match word.value {
            Said::Parameter(_, parameter) if self.get(parameter).is_none() => Some(self.cause(parameter)),
            _ => None,
        })
    }
    /// Why a value is not known.
    pub(crate) fn cause(&self, parameter: Parameter) -> String {
        match self.causes.get(&parameter) {
            Some(cause) => cause.clone(),
            None if parameter.kind == Kind::Global && (100..200).contains(&parameter.number) => {
                format!("{parameter}: a value of the control")
            }
            None => format!("{parameter}: the program does not set its value"),
        }
    }
    /// The value of a word.
    pub(crate) fn of(&self, said: Said<'_>) -> Value {
        match said {
            Said::Number(value) => Some(value),
            Said::Parameter(negative, parameter) => {
                self.get(parameter).map(|value| if negative { -value } else { value })
            }
            _ => None,
        }
    }
    /// A program that is not read may have changed all that outlive it.
    pub(crate) fn lose(&mut self) {
        self.changes += 1;
        for (parameter, value) in &mut self.numbers {
            if parameter.kind != Kind::Local {
                *value = None;
            }
        }
        self.texts.clear();
        self.causes.clear();
    }
    /// Takes the local ones away.
    pub(crate) fn take_locals(&mut self) -> Vec<(Parameter, Value)> {
        let all = std::mem::take(&mut self.numbers);
        let (local, rest): (Vec<_>, Vec<_>) = all
            .into_iter()
            .partition(|(parameter, _)| parameter.kind == Kind::Local);
        self.numbers = rest.into_iter().collect();
        local
    }
    /// Puts the local ones of a caller back.
    pub(crate) fn put_locals(&mut self, locals: Vec<(Parameter, Value)>) {
        self.take_locals();
        self.numbers.extend(locals);
    }
    /// Known values by name, without local ones.
    pub(crate) fn known(&self) -> Vec<(String, f64)> {
        let known = |(parameter, value): (&Parameter, &Value)| Some((parameter.to_string(), (*value)?));
        let kept = self
            .numbers
            .iter()
            .filter(|(parameter, _)| parameter.kind != Kind::Local);
        kept.filter_map(known).collect()
    }
}

/// A formula at the place of `words`, up to what cannot continue it.
pub(crate) fn formula(words: &mut Words<'_>, parameters: &Parameters) -> Result<Value, String> {
    Formula {
        words,
        parameters,
        depth: 0,
    }
    .sum()
}

struct Formula<'w, 't, 'p> {
    words: &'w mut Words<'t>,
    parameters: &'p Parameters,
    depth: usize,
}

/// An operand, and whether it is a function whose argument stands without parentheses, or a power.
struct Operand {
    value: Value,
    loose: bool,
}

impl Formula<'_, '_, '_> {
    fn next_is(&mut self, byte: u8) -> bool {
        self.words.takes(byte)
    }

    fn sum(&mut self) -> Result<Value, String> {
        let mut first = self.product()?;
        loop {
            let minus = if self.next_is(b'+') {
                false
            } else if self.next_is(b'-') {
                true
            } else {
                return Ok(first.value);
            };
            let second = self.product()?;
            let value = first.value.zip(second.value).filter(|_| !first.loose);
            first = Operand {
                value: value.map(|(a, b)| if minus { a - b } else { a + b }),
                loose: second.loose,
            };
        }
    }

    fn product(&mut self) -> Result<Operand, String> {
        let mut first = self.power()?;
        loop {
            let divides = if self.next_is(b'*') {
                false
            } else if self.next_is(b'/') {
                true
            } else {
                return Ok(first);
            };
            let second = self.power()?;
            let value = first.value.zip(second.value).filter(|_| !first.loose);
            first = Operand {
                value: value
                    .map(|(a, b)| if divides { a / b } else { a * b })
                    .filter(|value| value.is_finite()),
                loose: second.loose,
            };
        }
    }

    fn power(&mut self) -> Result<Operand, String> {
        let base = self.operand()?;
        if !self.next_is(b'^') {
            return Ok(base);
        }
        let exponent = self.operand()?;
        let value = base
            .value
            .zip(exponent.value)
            .filter(|_| !base.loose && !exponent.loose);
        Ok(Operand {
            value: value.map(|(a, b)| pow(a, b)).filter(|value| value.is_finite()),
            loose: true,
        })
    }

    fn operand(&mut self) -> Result<Operand, String> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return Err("too many parentheses".to_owned());
        }
        let found = self.read_operand();
        self.depth -= 1;
        found
    }

    fn read_operand(&mut self) -> Result<Operand, String> {
        let plain = |value| Ok(Operand { value, loose: false });
        if self.next_is(b'(') {
            let value = self.sum()?;
            if !self.next_is(b')') {
                return Err("a parenthesis is not closed".to_owned());
            }
            return plain(value);
        }
        self.words.blanks();
        match self.words.value() {
            Said::Number(value) => return plain(Some(value)),
            said @ Said::Parameter(..) => return plain(self.parameters.of(said)),
            Said::Bad => return Err("a number with two points".to_owned()),
            Said::Sign(minus) => {
                let inner = self.operand()?;
                return Ok(Operand {
                    value: inner.value.map(|value| if minus { -value } else { value }),
                    loose: inner.loose,
                });
            }
            Said::Nothing | Said::Text(_) => {}
        }
        let rest = self.words.rest();
        let letters = rest.iter().take_while(|byte| byte.is_ascii_alphabetic()).count();
        let name = rest[..letters].to_ascii_uppercase();
        self.words.at += letters;
        if name == b"PI" {
            return plain(Some(core::f64::consts::PI));
        }
        let function = function(&name).ok_or_else(|| {
            let text = String::from_utf8_lossy(&rest[..rest.len().min(12)]).into_owned();
            if text.trim().is_empty() {
                "a value is missing".to_owned()
            } else {
                format!("`{text}` is no value")
            }
        })?;
        self.words.blanks();
        let closed = self.words.peek() == Some(b'(');
        let inner = self.operand()?;
        Ok(Operand {
            value: inner.value.and_then(function).filter(|value| value.is_finite()),
            loose: !closed,
        })
    }
}

fn function(name: &[u8]) -> Option<fn(f64) -> Value> {
    Some(match name {
        b"SIN" => |x| Some(sin_cos_degrees(x).0),
        b"COS" => |x| Some(sin_cos_degrees(x).1),
        b"TAN" => |x| {
            let (sin, cos) = sin_cos_degrees(x);
            (cos != 0.0).then(|| sin / cos)
        },
        b"ASIN" => |x| (x.abs() <= 1.0).then(|| asin(x).to_degrees()),
        b"ACOS" => |x| (x.abs() <= 1.0).then(|| acos(x).to_degrees()),
        b"ATAN" => |x| Some(atan2(x, 1.0).to_degrees()),
        b"SQ" => |x| Some(x * x),
        b"SQRT" => |x| (x >= 0.0).then(|| x.sqrt()),
        b"LN" => |x| (x > 0.0).then(|| ln(x)),
        b"LOG" => |x| (x > 0.0).then(|| ln(x) / core::f64::consts::LN_10),
        b"EXP" => |x| Some(exp(x)),
        b"NEG" => |x| Some(-x),
        b"INT" => |x| Some(x.trunc()),
        b"ABS" => |x| Some(x.abs()),
        b"FRAC" => |x| Some(x.fract()),
        b"SGN" => |x| Some(if x == 0.0 { 0.0 } else { x.signum() }),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str) -> Result<Value, String> {
        let mut parameters = Parameters::default();
        let q = |number| Parameter {
            kind: Kind::Global,
            number,
        };
        parameters.set(q(1), Some(5.0));
        parameters.set(q(2), Some(-2.5));
        formula(&mut Words::new(text.as_bytes()), &parameters)
    }

    #[test]
    fn formulas() {
        for (text, expected) in [
            (" ( Q1 + 3 ) * 2 - Q2", 18.5),
            ("INT ( ( Q1 / 2 ) + 0,99 )", 3.0),
            ("-Q1 + +Q2", -7.5),
            ("SIN ( 30 )", 0.5),
            ("2 + 3 * 4", 14.0),
            ("SQRT 16", 4.0),
            ("2 ^ 3", 8.0),
            ("FRAC Q2", -0.5),
            ("5 - - 3", 8.0),
        ] {
            let found = value(text).expect(text).expect(text);
            assert!((found - expected).abs() < 1e-12, "{text}: {found}");
        }
        for text in ["SIN 30 * 2", "Q9 + 1", "SQRT ( -1 )", "1 / 0", "2 ^ 3 * 4"] {
            assert_eq!(value(text), Ok(None), "{text}");
        }
        for text in ["( 1 + 2", "FOO ( 1 )", "1 +"] {
            assert!(value(text).is_err(), "{text}");
        }
        assert!(value(&"(".repeat(5000)).is_err());
    }
}
