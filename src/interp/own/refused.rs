//! Assignments at which the control stops, or that a variable cannot hold.
use super::field::{list, rounded};
use super::prepared::indexed_names;
use super::{Own, Sort, arguments};
use crate::{FaultKind, Refusal};
use trunnion_formula::FormulaErrorKind as Kind;

/// At most this much of an expression is quoted in a message, characters.
const QUOTED: usize = 80;

fn quoted(text: &str) -> String {
    match text.trim().char_indices().nth(QUOTED) {
        Some((end, _)) => format!("`{}...`", &text.trim()[..end]),
        None => format!("`{}`", text.trim()),
    }
}

fn not_modelled(what: String) -> FaultKind {
    FaultKind::NotModelled { what }
}

/// The control stops at an index that nothing has.
fn no_element(message: String) -> FaultKind {
    FaultKind::Rejected {
        refusal: Refusal::Variable,
        message,
        alarm: None,
    }
}

/// The fault of an expression that has no value; `None`: it cannot be read, which is no matter of its value.
pub(crate) fn without_value(error: &Kind, text: &str) -> Option<FaultKind> {
    match error {
        Kind::DivisionByZero
        | Kind::NegativeRoot
        | Kind::AcosRange
        | Kind::AsinRange
        | Kind::LogarithmRange
        | Kind::NegativePower => Some(FaultKind::Rejected {
            refusal: Refusal::Expression,
            message: format!("{error} in {}", quoted(text)),
            alarm: None,
        }),
        Kind::ParameterOutOfRange(number) => {
            Some(no_element(format!("there is no R parameter with the number {number}")))
        }
        // what the control then holds is not documented
        Kind::Infinite | Kind::Undefined | Kind::NoTangent => {
            Some(not_modelled(format!("{error} in {}", quoted(text))))
        }
        _ => None,
    }
}

/// A number that an INT does not hold.
fn beyond(name: &str, sort: Sort, value: Option<f64>) -> Option<FaultKind> {
    let value = value.filter(|_| sort == Sort::Int)?;
    rounded(value)?;
    let fits = sort.takes(value).is_some();
    (!fits).then(|| FaultKind::NotModelled {
        what: format!("{name}: {value} is outside of the range of INT"),
    })
}

impl Own {
    /// Why an expression stops the control; `None`: it does not, as far as its operands are known.
    pub(crate) fn stops(&self, text: &str) -> Option<FaultKind> {
        let outside = self.reads_outside(text);
        if outside.is_some() {
            return outside;
        }
        let error = self.evaluate(text.as_bytes(), 0).err()?;
        without_value(&error, text)
    }

    /// An element that an expression reads and its field does not have.
    pub(crate) fn reads_outside(&self, text: &str) -> Option<FaultKind> {
        if self.is_task || !text.contains('[') {
            return None;
        }
        indexed_names(text)
            .into_iter()
            .find_map(|(stem, inside)| self.outside(&stem, &arguments(&inside)))
    }

    /// What is wrong with `name = text`, whose value is known or not.
    pub(super) fn misfit(&self, name: &str, text: &str, value: Option<f64>) -> Option<FaultKind> {
        let stopped = if value.is_none() { self.stops(text) } else { None };
        if stopped.is_some() || self.is_task {
            return stopped;
        }
        let Some((stem, index)) = name.split_once('[') else {
            let sort = self.scope.sorts.get(name.trim().to_ascii_lowercase().as_str())?;
            return beyond(name.trim(), *sort, value);
        };
        let index = index.trim_end().strip_suffix(']')?;
        let stem = stem.trim().to_ascii_lowercase();
        let outside = self.outside(&stem, &arguments(index));
        if outside.is_some() {
            return outside;
        }
        let (sort, ..) = self.form_of(&stem)?;
        match (value, list(text)) {
            (None, Some(_)) => {
                let from = self.place_in(&stem, &arguments(index), 0)?;
                self.list_misfit(&stem, from as usize, text)
            }
            _ => beyond(name.trim(), sort, value),
        }
    }

    /// An index that no element of a field has, or that no R parameter has.
    fn outside(&self, stem: &str, indices: &[&str]) -> Option<FaultKind> {
        let values: Vec<Option<f64>> = indices.iter().map(|index| self.value(index)).collect();
        // how the control takes a fraction as an index is not documented
        let is_open = values.iter().flatten().any(|value| value.fract() != 0.0);
        let refusal = if is_open { not_modelled } else { no_element };
        let name = || format!("{}[{}]", stem.to_ascii_uppercase(), indices.join(","));
        if stem == "r" {
            let value = values.first().copied().flatten()?;
            // how many there are is machine data
            let refusal = if value >= 0.0 { not_modelled } else { refusal };
            return (super::whole(value).is_none())
                .then(|| format!("{}: there is no R parameter with the number {value}", name()))
                .map(refusal);
        }
        let (sizes, further) = match (self.form_of(stem), self.sizes_of_texts(stem)) {
            (Some((_, sizes)), _) => (sizes, 0),
            // one index more is that of a character
            (None, Some(sizes)) if !sizes.is_empty() => (sizes, 1),
            _ => return None,
        };
        let count = indices.len();
        if count < sizes.len() || count > sizes.len() + further {
            return Some(not_modelled(format!(
                "{}: the field has {} dimensions",
                name(),
                sizes.len()
            )));
        }
        let is_inside = |(value, size): (&Option<f64>, &usize)| {
            value.is_none_or(|value| value.fract() == 0.0 && value >= 0.0 && value < *size as f64)
        };
        let inside = values.iter().zip(sizes).all(is_inside);
        (!inside)
            .then(|| {
                format!(
                    "{}: the field has no such element: the first one has the index 0",
                    name()
                )
            })
            .map(refusal)
    }

    /// What is wrong with a list that fills a field from an element on.
    pub(super) fn list_misfit(&self, stem: &str, from: usize, text: &str) -> Option<FaultKind> {
        let (sort, sizes) = self.form_of(stem)?;
        let count: usize = sizes.iter().product();
        let (repeats, inside) = list(text)?;
        let parts = arguments(inside);
        let name = stem.to_ascii_uppercase();
        let written = match (repeats, parts.as_slice()) {
            (false, parts) => parts.len() as f64,
            (true, [_]) => 0.0,
            (true, [_, times]) => self.value(times)?,
            _ => f64::NAN,
        };
        if written.fract() != 0.0 || !(0.0..=(count - from.min(count)) as f64).contains(&written) {
            let what = format!(
                "{name}: {} does not fit into the field of {count} elements",
                quoted(text)
            );
            return Some(not_modelled(what));
        }
        let values = if repeats { &parts[..1] } else { &parts[..] };
        values.iter().filter(|part| !part.is_empty()).find_map(|part| {
            let value = self.value(part);
            if value.is_none() {
                self.stops(part)
            } else {
                beyond(&name, sort, value)
            }
        })
    }
}
