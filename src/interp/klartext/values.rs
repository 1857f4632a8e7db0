//! Q parameters: their values, and what other programs see of them.
use super::words::{Kind, Parameter, Said, Words};
use crate::Argument;
use std::collections::BTreeMap;

/// A value; `None`: not known.
pub(crate) type Value = Option<f64>;

/// All Q parameters.
#[derive(Clone, Debug, Default)]
pub(crate) struct Parameters {
    numbers: BTreeMap<Parameter, Value>,
    pub(crate) texts: BTreeMap<u32, Option<String>>,
    /// Why the value of a parameter is not known, where that is another parameter or the control.
    causes: BTreeMap<Parameter, String>,
    /// What was known before a program that is not there ran: it may read it.
    forgotten: Vec<Argument>,
    /// Grows with everything that may change a decision.
    pub(crate) changes: u64,
}

impl Parameters {
    /// How many entries a clone copies.
    pub(crate) fn copied(&self) -> usize {
        self.numbers.len() + self.texts.len() + self.causes.len() + self.forgotten.len()
    }

    /// The value; parameters that the program has not set are unknown, since they keep their values from programs before.
    pub(crate) fn get(&self, parameter: Parameter) -> Value {
        self.numbers.get(&parameter).copied().flatten()
    }
    /// Whether its number or text is known.
    pub(crate) fn is_known(&self, parameter: Parameter) -> bool {
        if parameter.kind == Kind::Text {
            self.text(parameter).is_some()
        } else {
            self.get(parameter).is_some()
        }
    }
    /// Whether a parameter is defined; `None`: not known. Where the program has given it no known value, one from a program before may be left in it.
    pub(crate) fn is_defined(&self, parameter: Parameter) -> Option<bool> {
        let has_value = self.get(parameter).is_some() || self.text(parameter).is_some();
        has_value.then_some(true)
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
            None if self.text(parameter).is_some() => format!("{parameter}: functions of texts are not followed"),
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
        self.forgotten = self.arguments();
        for (parameter, value) in &mut self.numbers {
            if parameter.kind != Kind::Local {
                *value = None;
            }
        }
        self.texts.clear();
        self.causes.clear();
    }
    /// Those with known values that other programs see.
    pub(crate) fn arguments(&self) -> Vec<Argument> {
        let numbers = self.known().into_iter();
        let numbers = numbers.map(|(name, value)| Argument::number(name, value));
        numbers
            .chain(self.known_texts().map(|(name, text)| Argument::text(name, text)))
            .collect()
    }
    /// The same, and those that were known before a program that is not there ran.
    pub(crate) fn readable(&self) -> Vec<Argument> {
        let mut all = self.arguments();
        all.extend(self.forgotten.iter().cloned());
        all
    }
    /// The text of a QS parameter.
    pub(crate) fn text(&self, parameter: Parameter) -> Option<&str> {
        let text = self
            .texts
            .get(&parameter.number)
            .filter(|_| parameter.kind == Kind::Text);
        text?.as_deref()
    }
    /// Known texts by name.
    pub(crate) fn known_texts(&self) -> impl Iterator<Item = (String, &str)> {
        let known = self.texts.iter();
        known.filter_map(|(number, text)| Some((format!("QS{number}"), text.as_deref()?)))
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
