//! Variables of a Sinumerik program's own (R parameters, DEF) and the arithmetic of its words, followed while the program runs straight
//! on: after a label, a jump, a loop or a call no variable has a known value.
//!
//! Arithmetic: Sinumerik 840D sl Programming Manual, Job Planning (variables; arithmetic operations and functions): angles in degrees,
//! MOD and DIV before + and -, INT variables rounded when they are written.
mod words;

use std::collections::HashMap;
use trunnion_geometry::math;

/// What DEF says of a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Sort {
    Real,
    Int,
}

/// See the module. Names are in capitals, R parameters `R5`.
#[derive(Clone, Debug, Default)]
pub(crate) struct Own {
    sorts: HashMap<Box<str>, Sort>,
    values: HashMap<Box<str>, f64>,
    /// Written in the present block: the sources do not say when the control writes, so they are not read in the same block.
    fresh: Vec<Box<str>>,
}

impl Own {
    /// A block begins.
    pub(crate) fn begin_block(&mut self) {
        self.fresh.clear();
    }
    /// No variable has a value that is known.
    pub(crate) fn lose(&mut self) {
        self.values.clear();
    }
    /// `R5`, `R[2+3]`, `_HOME` = a value.
    pub(crate) fn assign(&mut self, name: &str, value: Option<f64>) {
        let name = name.to_ascii_uppercase();
        let key = match name.split_once('[') {
            None => name,
            Some((stem, index)) if stem.trim() == "R" => {
                let index = index.trim_end().strip_suffix(']').and_then(|text| self.value(text));
                let Some(number) = index.and_then(whole) else {
                    // it may be any of them
                    self.values.retain(|known, _| !is_r_parameter(known));
                    return;
                };
                format!("R{number}")
            }
            // elements of fields are not kept
            Some(_) => return,
        };
        let key: Box<str> = key.trim().into();
        let value = match (self.sorts.get(&key), value) {
            (_, None) => None,
            (Some(Sort::Int), Some(value)) => rounded(value),
            (Some(Sort::Real), value) => value,
            (None, Some(value)) if is_r_parameter(&key) || value.fract() == 0.0 => Some(value),
            // declared elsewhere: it may be an INT
            (None, Some(_)) => None,
        };
        match value.filter(|value| value.abs() <= crate::reader::LARGEST) {
            Some(value) => self.values.insert(key.clone(), value),
            None => self.values.remove(&key),
        };
        self.fresh.push(key);
    }
    /// `DEF REAL A, B=3`: everything after DEF.
    pub(crate) fn define(&mut self, text: &str) {
        let text = text.trim();
        let (sort, names) = match text.split_once(char::is_whitespace) {
            Some((kind, names)) if kind.eq_ignore_ascii_case("REAL") => (Sort::Real, names),
            Some((kind, names)) if kind.eq_ignore_ascii_case("INT") => (Sort::Int, names),
            _ => return,
        };
        if names.contains(['[', '(', '"']) {
            return;
        }
        for one in names.split(',') {
            let (name, value) = match one.split_once('=') {
                None => (one, Some(0.0)),
                Some((name, value)) => (name, self.value(value)),
            };
            let name = name.trim().to_ascii_uppercase();
            self.sorts.insert(name.as_str().into(), sort);
            self.assign(&name, value);
        }
    }
    /// The value of an expression; `None`: it is not known, or not of this language.
    pub(crate) fn value(&self, text: &str) -> Option<f64> {
        let mut reader = Expression {
            own: self,
            rest: text.trim_start(),
            depth: 0,
        };
        let value = reader.sum()?;
        (reader.rest.is_empty() && value.is_finite()).then_some(value)
    }
    /// Whether DEF declares the name, so that it ends with the program.
    pub(crate) fn is_local(&self, name: &str) -> bool {
        self.sorts.contains_key(name)
    }
    fn read(&self, name: &str) -> Option<f64> {
        let fresh = self.fresh.iter().any(|written| **written == *name);
        self.values.get(name).copied().filter(|_| !fresh)
    }
}

fn is_r_parameter(name: &str) -> bool {
    name.strip_prefix('R')
        .is_some_and(|digits| !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit()))
}

/// The number of an R parameter.
fn whole(value: f64) -> Option<u32> {
    (value >= 0.0 && value.fract() == 0.0 && value <= 99_999.0).then_some(value as u32)
}

/// Brackets inside brackets.
const DEEPEST: u32 = 32;

struct Expression<'a> {
    own: &'a Own,
    rest: &'a str,
    depth: u32,
}

impl<'a> Expression<'a> {
    fn eat(&mut self, sign: char) -> bool {
        match self.rest.strip_prefix(sign) {
            Some(rest) => {
                self.rest = rest.trim_start();
                true
            }
            None => false,
        }
    }
    fn word(&mut self) -> &'a str {
        let end = self
            .rest
            .find(|c: char| !(c.is_ascii_alphanumeric() || c == '_'))
            .unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(end);
        self.rest = rest.trim_start();
        word
    }
    /// DIV or MOD.
    fn operator(&mut self, name: &str) -> bool {
        let before = self.rest;
        if self.word().eq_ignore_ascii_case(name) {
            return true;
        }
        self.rest = before;
        false
    }
    fn sum(&mut self) -> Option<f64> {
        self.depth += 1;
        if self.depth > DEEPEST {
            return None;
        }
        let mut value = self.product()?;
        loop {
            if self.eat('+') {
                value += self.product()?;
            } else if self.eat('-') {
                value -= self.product()?;
            } else {
                self.depth -= 1;
                return Some(value);
            }
        }
    }
    fn product(&mut self) -> Option<f64> {
        let mut value = self.factor()?;
        loop {
            if self.eat('*') {
                value *= self.factor()?;
            } else if self.eat('/') {
                let by = self.factor()?;
                if by == 0.0 {
                    return None;
                }
                value /= by;
            } else if self.operator("DIV") {
                let by = self.factor()?;
                value = whole_operands(value, by).map(|()| (value / by).trunc())?;
            } else if self.operator("MOD") {
                let by = self.factor()?;
                value = whole_operands(value, by).map(|()| value % by)?;
            } else {
                return Some(value);
            }
        }
    }
    fn factor(&mut self) -> Option<f64> {
        if self.eat('-') {
            return Some(-self.primary()?);
        }
        self.eat('+');
        self.primary()
    }
    fn primary(&mut self) -> Option<f64> {
        if self.eat('(') {
            let value = self.sum()?;
            return self.eat(')').then_some(value);
        }
        let digits = self
            .rest
            .find(|c: char| !(c.is_ascii_digit() || c == '.'))
            .unwrap_or(self.rest.len());
        if digits > 0 {
            let (number, rest) = self.rest.split_at(digits);
            if rest.starts_with(|c: char| c.is_ascii_alphabetic()) && !is_operator(rest) {
                // 1EX3, 'H20'
                return None;
            }
            self.rest = rest.trim_start();
            return number.parse().ok();
        }
        let name = self.word().to_ascii_uppercase();
        if name.is_empty() {
            return None;
        }
        if self.eat('(') {
            return self.function(&name);
        }
        if name == "R" && self.eat('[') {
            let index = self.sum()?;
            let number = whole(index).filter(|_| self.eat(']'))?;
            return self.own.read(&format!("R{number}"));
        }
        if self.rest.starts_with('[') {
            return None;
        }
        self.own.read(&name)
    }
    fn function(&mut self, name: &str) -> Option<f64> {
        let value = self.sum()?;
        let second = if name == "ATAN2" {
            self.eat(',').then(|| self.sum())??
        } else {
            0.0
        };
        if !self.eat(')') {
            return None;
        }
        let (sine, cosine) = math::sin_cos(value.to_radians());
        Some(match name {
            "SIN" => sine,
            "COS" => cosine,
            "TAN" if cosine != 0.0 => sine / cosine,
            "ATAN2" => math::atan2(value, second).to_degrees(),
            "ASIN" if value.abs() <= 1.0 => math::asin(value).to_degrees(),
            "ACOS" if value.abs() <= 1.0 => math::acos(value).to_degrees(),
            "SQRT" if value >= 0.0 => value.sqrt(),
            "ABS" => value.abs(),
            "POT" => value * value,
            "TRUNC" => value.trunc(),
            "ROUND" => rounded(value)?,
            _ => return None,
        })
    }
}

fn is_operator(text: &str) -> bool {
    ["DIV", "MOD"]
        .iter()
        .any(|name| text.get(..3).is_some_and(|start| start.eq_ignore_ascii_case(name)))
}

/// To the nearest whole number; the rounding direction of a negative half is not documented.
fn rounded(value: f64) -> Option<f64> {
    (value >= 0.0 || value.fract() != -0.5).then(|| (value + 0.5).floor())
}

/// DIV and MOD are documented for whole numbers that are not negative.
fn whole_operands(a: f64, b: f64) -> Option<()> {
    (a >= 0.0 && b > 0.0 && a.fract() == 0.0 && b.fract() == 0.0).then_some(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn arithmetic_is_the_control_s() {
        let mut own = Own::default();
        own.assign("R1", Some(10.0));
        own.assign("r[1+1]", Some(-4.0));
        own.begin_block();
        for (text, value) in [
            ("R1+2*3", Some(16.0)),
            ("(R1+2)*3", Some(36.0)),
            ("-R2", Some(4.0)),
            ("R1-R2-1", Some(13.0)),
            ("R[2]", Some(-4.0)),
            ("7 DIV 2*2", Some(6.0)),
            ("7MOD 4", Some(3.0)),
            ("R1/4", Some(2.5)),
            ("POT(3)+ABS(R2)", Some(13.0)),
            ("TRUNC(-2.7)", Some(-2.0)),
            ("ROUND(2.5)", Some(3.0)),
            (".5*R1", Some(5.0)),
            ("R1/0", None),
            ("R9", None),
            ("R1+", None),
            ("R1)", None),
            ("SQRT(R2)", None),
            ("NAME", None),
            ("$AA_IM[X]", None),
            ("1EX3", None),
            ("R1>3", None),
        ] {
            assert_eq!(own.value(text), value, "{text}");
        }
        for (text, value) in [
            ("SIN(30)", 0.5),
            ("ATAN2(1,-1)", 135.0),
            ("ACOS(0.5)", 60.0),
            ("TAN(45)", 1.0),
        ] {
            assert!((own.value(text).expect(text) - value).abs() < 1e-12, "{text}");
        }
        let deep = format!("{}1{}", "(".repeat(100_000), ")".repeat(100_000));
        assert_eq!(own.value(&deep), None);
    }

    #[test]
    fn what_may_have_changed_is_not_known() {
        let mut own = Own::default();
        own.define("REAL A, B=2.5");
        own.define("INT COUNT=2.5");
        assert_eq!(own.value("B"), None, "written in the block in hand");
        own.begin_block();
        assert_eq!(
            (own.value("a"), own.value("B"), own.value("COUNT")),
            (Some(0.0), Some(2.5), Some(3.0))
        );
        own.assign("GLOBAL", Some(0.5));
        own.assign("R5", Some(0.5));
        own.begin_block();
        assert_eq!(
            (own.value("GLOBAL"), own.value("R5")),
            (None, Some(0.5)),
            "the sort of GLOBAL is not known"
        );
        own.assign("R[X]", Some(1.0));
        assert_eq!((own.value("R5"), own.value("B")), (None, Some(2.5)));
        own.lose();
        assert_eq!(own.value("B"), None);
    }
}
