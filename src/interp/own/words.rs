//! Words that write and read the variables of a Sinumerik program.
use crate::FaultKind;
use crate::reader::Reader;
use crate::values::READINGS;
use crate::words::{Number, Reading, WordValue};
use trunnion_dialect::Code;
use trunnion_syntax::{TextRange, Value, Word};

impl super::Own {
    /// What a variable holds now, also where the current block has written it.
    pub(crate) fn held(&self, name: &str) -> Option<f64> {
        let name = name.to_ascii_lowercase();
        match super::r_parameter(&name).filter(|_| !self.is_task) {
            Some(number) => self.parameters.get(&number).copied(),
            None if name.contains('[') => self.held_element(&name),
            None => self
                .scope
                .values
                .get(name.as_str())
                .or_else(|| self.others.get(name.as_str()))
                .copied(),
        }
    }
}

impl<F: FnMut(TextRange, FaultKind)> Reader<'_, '_, F> {
    /// An assignment to a name that the program defines.
    pub(crate) fn own_assignment(&mut self, name: TextRange, word: &Word) {
        self.words.has_values = true;
        let name = self.text(name);
        self.undefined_name(&name, word);
        self.own_value(&name, word);
    }

    /// A name that no DEF of the program defines: the machine may have such data (GUD), or the control stops at a misspelt name.
    fn undefined_name(&mut self, name: &str, word: &Word) {
        let Some(own) = self.own.as_ref().filter(|own| !own.is_task) else {
            return;
        };
        let stem = name.split('[').next().unwrap_or_default().trim();
        let is_name = stem.len() > 1 && stem.starts_with(|first: char| first.is_ascii_alphabetic() || first == '_');
        let is_known = self.dialect.name(&stem.to_ascii_uppercase()).is_some() || own.is_declared(stem);
        if is_name && !is_known {
            let what = format!("{stem}: no DEF of the program defines it; the machine may (GUD)");
            (self.report)(word.range, FaultKind::NotModelled { what });
        }
    }

    /// `H2=6`, `Q=6` where the program declares a variable with that name (DEF REAL H2): it is no address then. False: it is one.
    pub(crate) fn declared_word(&mut self, name: &[u8], word: &Word) -> bool {
        let Some(own) = self
            .own
            .as_ref()
            .filter(|own| !own.is_task && !own.scope.sorts.is_empty())
        else {
            return false;
        };
        let name = String::from_utf8_lossy(name).into_owned();
        let assigns = self.text(word.range).contains('=');
        if !assigns || !own.is_declared(&name) {
            return false;
        }
        self.words.has_values = true;
        self.own_value(&name, word);
        true
    }

    /// Gives a variable the value of a word.
    pub(crate) fn own_value(&mut self, name: &str, word: &Word) {
        let number = self.value_of(word);
        let text = self.text(word.value_range);
        if let Some(own) = &mut self.own {
            if let Some(kind) = own.misfit(name, &text, number) {
                (self.report)(word.range, kind);
            }
            if number.is_none() && (own.assign_list(name, &text) || own.assign_texts(name, &text)) {
                return;
            }
            if number.is_none() {
                own.note_text(name, &text);
                own.assign_axis(name, &text);
            }
            let joined = own.text_for(name, &text);
            own.assign(name, number);
            own.put_text(name, joined);
        }
    }

    /// DEF, EXTERN.
    pub(crate) fn own_declaration(&mut self, code: &Code, range: TextRange) {
        let text = self.text(range);
        match (&mut self.own, code.id.as_str()) {
            (Some(own), "DEF") => {
                for kind in own.define(text.get(3..).unwrap_or_default()) {
                    (self.report)(range, kind);
                }
            }
            (Some(own), "DEFINE") => {
                let rest = text.get(6..).unwrap_or_default().trim();
                let (name, means) = rest.split_once(char::is_whitespace).unwrap_or((rest, ""));
                own.note_text(name, means);
            }
            (Some(own), "PROC") if own.levels == 0 => {
                crate::sinumerik::declare_parameters(own, text.get(4..).unwrap_or_default());
            }
            (Some(own), "EXTERN") => own.declare_subprogram(text.get(6..).unwrap_or_default()),
            _ => {}
        }
    }

    /// The number of a word, written or worked out; `None`: not known.
    pub(crate) fn value_of(&self, word: &Word) -> Option<f64> {
        match word.value {
            Value::Number(decimal) => Some(decimal.to_f64()),
            _ => self.own_number(word.value_range).map(|number| number.value),
        }
    }

    /// The value of an expression.
    pub(crate) fn own_number(&self, range: TextRange) -> Option<Number> {
        let value = self.own.as_ref()?.value(&self.text(range))?;
        Some(Number {
            value,
            has_point: true,
            range,
        })
    }

    /// Why an expression has no known value; `None` where it is not one that can be read.
    pub(crate) fn why_no_number(&self, range: TextRange) -> Option<String> {
        let own = self.own.as_ref()?;
        let text = self.text(range);
        let inside = place_inside(&text).map_or(text.as_str(), |(_, inside)| inside);
        let (_, why, end) = own.evaluate(inside.as_bytes(), 0).ok()?;
        let whole = inside.get(end..).is_some_and(|rest| rest.trim().is_empty());
        why.filter(|_| whole)
    }

    /// Why the control stops at an expression.
    pub(crate) fn why_it_stops(&self, range: TextRange) -> Option<FaultKind> {
        let own = self.own.as_ref()?;
        let text = self.text(range);
        own.stops(place_inside(&text).map_or(text.as_str(), |(_, inside)| inside))
    }

    /// `IC(R1+2)`.
    pub(crate) fn own_place(&self, word: &Word) -> Option<(WordValue, Reading)> {
        let Value::Expression(_) = word.value else { return None };
        let own = self.own.as_ref()?;
        let text = self.text(word.value_range);
        let (reading, inside) = place_inside(&text)?;
        let value = own.value(inside)?;
        let number = Number {
            value,
            has_point: true,
            range: word.range,
        };
        Some((WordValue::Number(number), reading))
    }
}

/// The reading and the expression of `IC(R1+2)`.
fn place_inside(text: &str) -> Option<(Reading, &str)> {
    let (name, inside) = text.split_once('(')?;
    let known = |(known, _): &&(&[u8], Reading)| name.trim().as_bytes().eq_ignore_ascii_case(known);
    let (_, reading) = READINGS.iter().find(known)?;
    Some((*reading, inside.strip_suffix(')')?))
}
