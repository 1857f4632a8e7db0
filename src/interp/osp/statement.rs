//! Reads one statement of the user task, decides it with the known values, and returns what it requests.
use super::call::With;
use super::variables::{Class, class};
use crate::FaultKind;
use crate::flow::{Back, Calling, Index, Label, Text, Transfer, With as Handed};
use crate::own::{Own, without_value};

use trunnion_flow::{Key, Search};
use trunnion_syntax::TextRange;

/// A place and what is wrong or unknown there.
type Trouble = (TextRange, FaultKind);

/// One statement of the current block.
pub(super) struct Statement<'a> {
    pub(super) text: Text,
    pub(super) own: &'a mut Own,
    pub(super) block: u32,
    /// The labels of the file.
    pub(super) index: &'a mut dyn FnMut() -> std::sync::Arc<Index>,
}

fn not_decided<T>(range: TextRange, what: impl Into<String>) -> Result<T, Trouble> {
    Err((range, FaultKind::NotDecided { what: what.into() }))
}

/// Longest name after O and N (NC-PB/gEdit, syntax-okuma.md, 2.2 and 3.1).
const LONGEST: usize = 4;

/// Whether a name is one of a block (`N`) or program (`O`), with its letter.
pub(super) fn is_name(name: &str, letter: char) -> bool {
    let Some(rest) = name.strip_prefix(letter) else {
        return false;
    };
    let digits = rest.bytes().all(|byte| byte.is_ascii_digit());
    let begins = digits || rest.starts_with(|first: char| first.is_ascii_uppercase());
    begins && (1..=LONGEST).contains(&rest.len()) && rest.bytes().all(|byte| byte.is_ascii_alphanumeric())
}

impl Statement<'_> {
    /// What the statement requests.
    pub(super) fn read(&mut self) -> Result<Transfer, Trouble> {
        let from = self.text.at();
        let keyword = self.text.letters();
        let range = self.text.range(from, from + keyword.len());
        let transfer = match keyword.as_str() {
            "RTS" => Transfer::Return(Back { label: None, range }),
            "GOTO" => self.jump()?,
            "IF" => self.branch()?,
            "CALL" => Transfer::Call(self.call(range, false)?),
            "MODIN" => {
                let calling = self.call(range, true)?;
                if self.own.task.modal.is_some() {
                    return not_decided(range, "MODIN inside MODIN: in which order their programs run");
                }
                self.own.task.modal = Some((calling, self.own.task.outer.len()));
                Transfer::Next
            }
            "MODOUT" => {
                self.own.task.modal = None;
                Transfer::Next
            }
            other => return not_decided(range, format!("{other}: the statement")),
        };
        if self.text.is_at_end() {
            return Ok(transfer);
        }
        not_decided(self.text.rest(), "a flow statement that is not understood")
    }

    /// `IF [V1 LT 3] GOTO NLOOP`, `IF [V1 LT 3] NLOOP`, `IF DIA1 NLOOP`.
    fn branch(&mut self) -> Result<Transfer, Trouble> {
        let from = self.text.at();
        let holds = if self.text.bytes().get(from) == Some(&b'[') {
            self.condition(from)?
        } else {
            let name = self.text.word();
            self.defined(&name, from)?
        };
        let at = self.text.at();
        if self.text.letters() != "GOTO" {
            self.text.go_to(at);
        }
        let jump = self.jump()?;
        Ok(if holds { jump } else { Transfer::Next })
    }

    fn defined(&mut self, name: &str, from: usize) -> Result<bool, Trouble> {
        let range = self.text.range(from, from + name.len());
        match self.own.is_defined(name) {
            Some(is) => Ok(is),
            None => not_decided(
                range,
                format!("whether {name} has a value: no program that is read here writes it"),
            ),
        }
    }

    /// The truth of what is in the brackets at `from`.
    fn condition(&mut self, from: usize) -> Result<bool, Trouble> {
        let bytes = &self.text.bytes()[from..];
        let close = bytes.iter().position(|byte| *byte == b']').unwrap_or(bytes.len());
        let inside = String::from_utf8_lossy(&bytes[1..close.max(1)]).to_ascii_uppercase();
        let words: Vec<&str> = inside.split_whitespace().collect();
        if let [name, compares @ ("EQ" | "NE"), "EMPTY"] = words[..] {
            let name = name.to_owned();
            let is_defined = self.defined(&name, from + 1)?;
            let wanted = compares == "NE";
            self.text.go_to(from + close + 1);
            return Ok(is_defined == wanted);
        }
        let (value, why, end) = match self.own.evaluate(self.text.bytes(), from) {
            Ok(found) => found,
            Err(error) => {
                let text = String::from_utf8_lossy(&self.text.bytes()[from..]).into_owned();
                let what = format!("a condition that cannot be read: {error}");
                let kind = without_value(&error, &text).unwrap_or(FaultKind::NotDecided { what });
                return Err((self.text.rest(), kind));
            }
        };
        let range = self.text.range(from, end);
        self.text.go_to(end);
        match value {
            Some(0.0) => Ok(false),
            Some(1.0) => Ok(true),
            Some(value) => not_decided(range, format!("whether {value} is true")),
            None => not_decided(range, why.unwrap_or_default()),
        }
    }

    /// A sequence name.
    fn jump(&mut self) -> Result<Transfer, Trouble> {
        let from = self.text.at();
        let name = self.text.word();
        let range = self.text.range(from, from + name.len());
        if !is_name(&name, 'N') {
            return not_decided(
                range,
                "the target of a jump: a sequence name is N and up to 4 letters or digits",
            );
        }
        let key = Key::Name(name.as_str().into());
        let index = (self.index)();
        if index.all(&key, index.section(self.block)).nth(1).is_some() {
            return not_decided(range, format!("{name}: the name is in this program more than once"));
        }
        let label = Label {
            key,
            range,
            may_miss: false,
        };
        Ok(Transfer::Jump(label, Search::FromStart))
    }

    /// `OPART Q2 DIA1=40 ZL1=-20`.
    fn call(&mut self, keyword: TextRange, modal: bool) -> Result<Calling, Trouble> {
        let from = self.text.at();
        let name = self.text.word();
        let range = self.text.range(from, from + name.len());
        if !is_name(&name, 'O') {
            return not_decided(
                range,
                "which program is called: its name is O and up to 4 letters or digits",
            );
        }
        let mut times = 1;
        let mut arguments = Vec::new();
        while !self.text.is_at_end() {
            let at = self.text.at();
            let word = self.text.word();
            let range = self.text.range(at, at + word.len().max(1));
            let repeats = word
                .strip_prefix('Q')
                .filter(|digits| digits.bytes().all(|byte| byte.is_ascii_digit()));
            if let Some(digits) = repeats.filter(|digits| !digits.is_empty()) {
                times = times_of(digits.parse().ok(), range)?;
                continue;
            }
            let lower = word.to_ascii_lowercase();
            if !self.text.eat(b'=') || repeats.is_none() && class(&lower) != Class::Local {
                return not_decided(range, "an argument of a call that is not understood");
            }
            let start = self.text.at();
            let value = match self.own.evaluate(self.text.bytes(), start) {
                Ok((value, _, end)) => {
                    self.text.go_to(end);
                    value
                }
                Err(error) => {
                    let text = String::from_utf8_lossy(&self.text.bytes()[start..]).into_owned();
                    let what = format!("an argument that cannot be read: {error}");
                    let kind = without_value(&error, &text).unwrap_or(FaultKind::NotDecided { what });
                    return Err((range, kind));
                }
            };
            if repeats.is_some() {
                times = times_of(value, range)?;
            } else {
                arguments.push((lower.into(), value));
            }
        }
        Ok(Calling {
            program: Key::Name(name.into()),
            times,
            range: keyword.cover(range),
            with: Handed::Task(With { arguments, modal }),
        })
    }
}

fn times_of(value: Option<f64>, range: TextRange) -> Result<u32, Trouble> {
    match value {
        Some(times) if (1.0..=9999.0).contains(&times) && times.fract() == 0.0 => Ok(times as u32),
        _ => not_decided(range, "how often the subprogram runs"),
    }
}
