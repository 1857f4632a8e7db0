//! Formulas of Q parameters.
//!
//! Source: HEIDENHAIN TNC 640 user's manual, Q parameter programming. A function without parentheses and `^` come before `+` and `-`
//! (iTNC 530 user's manual 340 49x, entering formulas: `SQ 10 - 3^3` is 73). Their order among `*`, `/`, each other and signs is not taken from a
//! source: the value is unknown there.
use super::values::{Parameters, Value};
use super::words::{Said, Words};
use crate::frames::sin_cos_degrees;
use trunnion_geometry::math::{acos, asin, atan2, exp, ln, pow};

/// Parentheses inside parentheses.
const DEEPEST: usize = 64;

/// A formula at the place of `words`, up to what cannot continue it: its value, and why it has none where all of it is known.
pub(crate) fn formula(words: &mut Words<'_>, parameters: &Parameters) -> Result<(Value, Option<&'static str>), String> {
    let mut formula = Formula {
        words,
        parameters,
        depth: 0,
    };
    let found = formula.sum()?;
    Ok((found.value, found.stops))
}

struct Formula<'w, 't, 'p> {
    words: &'w mut Words<'t>,
    parameters: &'p Parameters,
    depth: usize,
}

/// An operand, and what is not taken from a source about it.
#[derive(Default)]
struct Operand {
    value: Value,
    /// Why the control stops at it.
    stops: Option<&'static str>,
    /// A function whose argument stands without parentheses, or a power: what an operator after it acts on.
    loose: bool,
    /// A power: what an operator before it acts on.
    power: bool,
    /// A remainder: what any operator beside it acts on.
    remainder: bool,
}

/// Two operands with `+` or `-` between them: what is in them comes first.
fn added(first: &Operand, second: &Operand, of: impl Fn(f64, f64) -> f64) -> Operand {
    let known = !first.remainder && !second.remainder;
    let value = first.value.zip(second.value).filter(|_| known);
    Operand {
        value: value.map(|(a, b)| of(a, b)).filter(|value| value.is_finite()),
        stops: first.stops.or(second.stops).filter(|_| known),
        loose: false,
        power: false,
        remainder: !known,
    }
}

/// Two operands with `*` or `/` between them.
fn joined(first: &Operand, second: &Operand, of: impl Fn(f64, f64) -> f64) -> Operand {
    let known = !first.loose && !second.power && !first.remainder;
    let value = first.value.zip(second.value).filter(|_| known);
    Operand {
        value: value.map(|(a, b)| of(a, b)).filter(|value| value.is_finite()),
        // on what another order of the operators acts is not known
        stops: first.stops.or(second.stops).filter(|_| known),
        loose: second.loose,
        power: false,
        remainder: first.remainder,
    }
}

/// The remainder of a division. What it is of negative numbers, and what comes first of it and another operator, is not taken from a source.
fn remainder(first: &Operand, second: &Operand, alone: bool) -> Operand {
    let plain = |operand: &Operand| alone && !operand.loose && !operand.power && !operand.remainder;
    let value = first.value.zip(second.value);
    let value = value.filter(|(a, b)| plain(first) && plain(second) && *a >= 0.0 && *b > 0.0);
    Operand {
        value: value.map(|(a, b)| a % b).filter(|value| value.is_finite()),
        remainder: true,
        ..Operand::default()
    }
}

/// The same for a division.
fn divided(first: &Operand, second: &Operand) -> Operand {
    let mut found = joined(first, second, |a, b| a / b);
    let known = !first.loose && !second.power && !first.remainder;
    let by_zero = second.value == Some(0.0) && first.value.is_some() && known;
    if by_zero {
        found.stops = Some(BY_ZERO);
    }
    found
}

/// What no control computes.
pub(crate) const BY_ZERO: &str = "division by zero";
pub(crate) const NEGATIVE_ROOT: &str = "square root of a negative number";

/// Why a function has no value where its argument has one.
fn undefined(name: &[u8]) -> Option<&'static str> {
    match name {
        b"SQRT" => Some(NEGATIVE_ROOT),
        b"ASIN" => Some("ASIN of a number outside -1 to 1"),
        b"ACOS" => Some("ACOS of a number outside -1 to 1"),
        b"LN" | b"LOG" => Some("logarithm of zero or of a negative number"),
        _ => None,
    }
}

impl Formula<'_, '_, '_> {
    fn next_is(&mut self, byte: u8) -> bool {
        self.words.takes(byte)
    }

    fn sum(&mut self) -> Result<Operand, String> {
        let mut first = self.product()?;
        loop {
            let minus = if self.next_is(b'+') {
                false
            } else if self.next_is(b'-') {
                true
            } else {
                return Ok(first);
            };
            let second = self.product()?;
            first = added(&first, &second, |a, b| if minus { a - b } else { a + b });
        }
    }

    fn product(&mut self) -> Result<Operand, String> {
        let mut first = self.power()?;
        let mut alone = true;
        loop {
            let divides = if self.next_is(b'*') {
                false
            } else if self.next_is(b'/') {
                true
            } else if self.next_is(b'%') {
                let second = self.power()?;
                first = remainder(&first, &second, alone);
                continue;
            } else {
                return Ok(first);
            };
            alone = false;
            let second = self.power()?;
            first = if divides {
                divided(&first, &second)
            } else {
                joined(&first, &second, |a, b| a * b)
            };
        }
    }

    fn power(&mut self) -> Result<Operand, String> {
        self.words.blanks();
        let signed = matches!(self.words.peek(), Some(b'+' | b'-'));
        let base = self.operand()?;
        if !self.next_is(b'^') {
            return Ok(base);
        }
        let exponent = self.operand()?;
        let known = !signed && !base.loose && !exponent.loose;
        let value = base.value.zip(exponent.value).filter(|_| known);
        Ok(Operand {
            value: value.map(|(a, b)| pow(a, b)).filter(|value| value.is_finite()),
            stops: base.stops.or(exponent.stops).filter(|_| known),
            loose: true,
            power: true,
            remainder: false,
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

    /// What is in the parentheses after a function of texts.
    fn value_of_text(&mut self) -> Result<Value, String> {
        self.words.blanks();
        let rest = self.words.rest();
        let end = rest
            .iter()
            .position(|byte| *byte == b')')
            .filter(|_| rest.first() == Some(&b'('));
        let Some(end) = end else {
            return Err("a function of texts needs its arguments in parentheses".to_owned());
        };
        self.words.at += end + 1;
        Ok(None)
    }

    fn read_operand(&mut self) -> Result<Operand, String> {
        let plain = |value| {
            Ok(Operand {
                value,
                ..Operand::default()
            })
        };
        if self.next_is(b'(') {
            let Operand { value, stops, .. } = self.sum()?;
            if !self.next_is(b')') {
                return Err("a parenthesis is not closed".to_owned());
            }
            return Ok(Operand {
                value,
                stops,
                ..Operand::default()
            });
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
                    power: false,
                    ..inner
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
        if OF_TEXTS.contains(&name.as_slice()) {
            return plain(self.value_of_text()?);
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
        let value = inner.value.and_then(function).filter(|value| value.is_finite());
        let without = undefined(&name).filter(|_| inner.value.is_some() && value.is_none());
        Ok(Operand {
            value,
            stops: inner.stops.or(without),
            loose: !closed,
            power: false,
            remainder: false,
        })
    }
}

/// Functions of texts: they are recognised, and their values are not known (TNC 640, Q parameter programming, string parameters).
const OF_TEXTS: [&[u8]; 5] = [b"TONUMB", b"STRLEN", b"INSTR", b"STRCOMP", b"SYSNUM"];

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
        // of 0 it is 1 in the manuals of the iTNC 530 and the TNC 320 and 620; for other controls no source is known
        b"SGN" => |x| (x != 0.0).then(|| x.signum()),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::klartext::words::{Kind, Parameter};

    fn value(text: &str) -> Result<Value, String> {
        let mut parameters = Parameters::default();
        let q = |number| Parameter {
            kind: Kind::Global,
            number,
        };
        parameters.set(q(1), Some(5.0));
        parameters.set(q(2), Some(-2.5));
        formula(&mut Words::new(text.as_bytes()), &parameters).map(|found| found.0)
    }

    /// What is known to have no value, and what is not.
    #[test]
    fn formulas_at_which_the_control_stops() {
        let stops = |text: &str| {
            formula(&mut Words::new(text.as_bytes()), &Parameters::default())
                .expect(text)
                .1
        };
        for text in [
            "1 / 0",
            "SQRT -4",
            "- SQRT ( 1 - 5 )",
            "2 * ( 3 / ( 1 - 1 ) ) + Q9",
            "LN 0",
            "SQRT -4 + 8",
            "ASIN ( 2 )",
            "SIN ( 1 / 0 )",
        ] {
            assert!(stops(text).is_some(), "{text}");
        }
        for text in ["Q9 / 0", "1 / Q9", "SQRT Q9", "1 / 0 ^ 2", "SQRT 4", "TAN ( 90 )"] {
            assert_eq!(stops(text), None, "{text}");
        }
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
            ("2 + ( 3 ^ 2 )", 11.0),
            ("( -3 ) ^ 2", 9.0),
            ("5 - - 3", 8.0),
            ("SQ 10 - 3 ^ 3", 73.0),
            ("2 + 3 ^ 2", 11.0),
            ("SQRT 16 + 9", 13.0),
            ("NEG 2 + 3", 1.0),
            ("INT 2,7 + 1", 3.0),
            ("SGN -4", -1.0),
            ("17 % 5", 2.0),
            ("Q1 + ( 400 % 360 )", 45.0),
            ("17,5 % Q1", 2.5),
        ] {
            let found = value(text).expect(text).expect(text);
            assert!((found - expected).abs() < 1e-12, "{text}: {found}");
        }
        for text in [
            "SIN 30 * 2",
            "Q9 + 1",
            "SQRT ( -1 )",
            "1 / 0",
            "2 ^ 3 * 4",
            "SGN ( 1 - 1 )",
            "2 * 3 ^ 2",
            "- 3 ^ 2",
            "17 % 5 + 1",
            "1 + 17 % 5",
            "17 % 5 * 2",
            "2 * 17 % 5",
            "17 % 5 % 2",
            "Q2 % 5",
            "17 % Q2",
            "17 % 0",
            "SQRT 16 % 3",
            "-3 ^ 2",
            "TONUMB ( SRC_QS1 )",
            "INSTR ( SRC_QS1 SEA_QS2 BEG0 ) + 1",
        ] {
            assert_eq!(value(text), Ok(None), "{text}");
        }
        for text in ["( 1 + 2", "FOO ( 1 )", "1 +", "STRLEN SRC_QS1"] {
            assert!(value(text).is_err(), "{text}");
        }
        assert!(value(&"(".repeat(5000)).is_err());
    }
}
