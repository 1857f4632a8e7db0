//! The variables that a text names. A program may declare hundreds of thousands and name one in each block, so only those are looked for.
use super::{Argument, Own};
use std::collections::{BTreeMap, BTreeSet};

/// The entries with this name, or with an index after it: `name`, `name[2]`.
fn with_stem<'m, V>(map: &'m BTreeMap<Box<str>, V>, stem: &str) -> impl Iterator<Item = (&'m Box<str>, &'m V)> {
    let indexed = format!("{stem}[");
    let after = map.range::<str, _>((std::ops::Bound::Included(indexed.as_str()), std::ops::Bound::Unbounded));
    let elements = after.take_while(move |(name, _)| name.starts_with(&indexed));
    map.get_key_value(stem).into_iter().chain(elements)
}

/// Whether a declaration can give a variable this name: letters, digits and underscores (Sinumerik 840D sl Programming Manual, Job
/// Planning, user-defined variables). Anything else is a mistake of the program and declares nothing.
pub(super) fn is_variable_name(name: &str) -> bool {
    let all = name.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_');
    all && name.starts_with(|first: char| !first.is_ascii_digit())
}

impl Own {
    /// `EXTERN GROOVE(REAL)`: everything after EXTERN.
    pub(crate) fn declare_subprogram(&mut self, text: &str) {
        let is_name = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let name = text.trim().split(|c| !is_name(c)).next().unwrap_or_default();
        let name: Box<str> = name.to_ascii_uppercase().into();
        self.declared.insert(name);
    }
    /// What the settings declare: R parameters of a Sinumerik, common variables of an Okuma.
    pub(crate) fn take_declared(&mut self, declared: &crate::NamedVariables) {
        for (name, value) in &declared.0 {
            let key = name.to_ascii_lowercase();
            let is_own = if self.is_task {
                crate::osp::is_common(&key)
            } else {
                super::r_parameter(&key).is_some()
            };
            if is_own {
                self.assign(name, Some(*value));
            }
        }
        self.fresh.clear();
    }

    /// The known values of the variables that a text names.
    pub(crate) fn named_in(&self, text: &str) -> Vec<Argument> {
        let lower = text.to_ascii_lowercase();
        let words: BTreeSet<&str> = lower
            .split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'))
            .collect();
        if !words
            .iter()
            .any(|word| self.scope.sorts.contains_key(*word) || self.texts.contains_key(*word))
        {
            return Vec::new();
        }
        let mut values: BTreeMap<Box<str>, f64> = BTreeMap::new();
        let mut texts: BTreeMap<&str, &str> = BTreeMap::new();
        for word in words {
            // those that are known now take the place of those from before they were lost
            values.extend(with_stem(&self.before_loss, word).map(|(name, value)| (name.clone(), *value)));
            let parameter = super::r_parameter(word).filter(|number| format!("r{number}") == word);
            let parameter = parameter.and_then(|number| self.parameters.get(&number));
            values.extend(parameter.map(|value| (word.into(), *value)));
            for map in [&self.others, &self.scope.values] {
                values.extend(with_stem(map, word).map(|(name, value)| (name.clone(), *value)));
            }
            values.extend(self.elements_of(word));
            texts.extend(with_stem(&self.texts, word).map(|(name, text)| (&**name, &**text)));
        }
        let values = values
            .into_iter()
            .map(|(name, value)| Argument::number(name.into_string(), value));
        let texts = texts
            .into_iter()
            .map(|(name, text)| Argument::text(name.to_owned(), text));
        values.chain(texts).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::own::Sort;

    #[test]
    fn the_named_ones_are_those_of_all_with_such_a_stem() {
        let mut own = Own::default();
        let names = ["a", "a1", "a10", "ab", "r1", "r10", "r[7]", "b", "c[3]", "c[3,4]", "c"];
        for name in ["a", "a1", "a10", "ab", "b"] {
            own.declare(name, Sort::Real, None);
        }
        assert!(own.define_field(Sort::Real, "field[3]=SET(1,2,3)"));
        for round in 0..2 {
            for (at, name) in names.iter().enumerate() {
                if at % 2 == round {
                    own.assign(name, Some(at as f64));
                }
                own.note_text(name, "TEXT");
            }
            for text in [
                "A",
                "a1+A10",
                "r1*r10",
                "C[3]+B",
                "FIELD[1]",
                "x y z",
                "",
                "AB-a-A[1]",
                "r01 A",
            ] {
                let lower = text.to_ascii_lowercase();
                let words: Vec<&str> = lower
                    .split(|c: char| !(c.is_ascii_alphanumeric() || c == '_'))
                    .collect();
                let mut all = own.all();
                all.retain(|argument| {
                    let stem = argument.name.split('[').next().unwrap_or_default();
                    words.contains(&stem)
                });
                assert_eq!(own.named_in(text), all, "{text:?}");
            }
            own.lose();
        }
        assert!(!own.named_in("a").is_empty());
    }
}
