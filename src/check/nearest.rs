//! The code that a misspelt one most resembles.
use std::collections::{BTreeMap, BTreeSet};
use trunnion_dialect::{CodeKind, Dialect, nearest};

/// Finds the code with a name of its own that a text resembles: `TRAORY` is near TRAORI. Codes with numbers are never near each other: CYCLE81
/// and CYCLE83 are different codes.
#[derive(Debug)]
pub(crate) struct NearCodes<'a> {
    dialect: &'a Dialect,
    /// What follows the letters of the names of all codes; found when it is first needed.
    numbers: Option<BTreeSet<&'a str>>,
    /// The first names that were asked for: a program may repeat one a million times.
    known: BTreeMap<String, Option<&'a str>>,
}

/// This many names are remembered.
const REMEMBERED: usize = 256;

/// What follows the letters of a name.
fn number(name: &str) -> &str {
    name.trim_start_matches(|c: char| !c.is_ascii_digit())
}

impl<'a> NearCodes<'a> {
    pub(crate) fn new(dialect: &'a Dialect) -> Self {
        Self {
            dialect,
            numbers: None,
            known: BTreeMap::new(),
        }
    }

    /// The text with the name of the code in place of its first word.
    pub(crate) fn of(&mut self, text: &str) -> Option<String> {
        let name = text.split(['(', ' ']).next().unwrap_or_default();
        // a sentence about several words is no name
        let rest = text.get(name.len()..).unwrap_or_default().trim_start();
        if rest.starts_with(|first: char| first.is_ascii_lowercase()) {
            return None;
        }
        if name.len() < 4 || !name.bytes().all(|byte| byte.is_ascii_alphanumeric() || byte == b'_') {
            return None;
        }
        let name = name.to_ascii_uppercase();
        let near = self.of_name(&name)?;
        Some(near.to_owned() + text.get(name.len()..).unwrap_or_default())
    }

    fn of_name(&mut self, name: &str) -> Option<&'a str> {
        if let Some(known) = self.known.get(name) {
            return *known;
        }
        let dialect = self.dialect;
        let named = || dialect.codes().iter().filter(|code| code.kind == CodeKind::Name);
        let numbers = self
            .numbers
            .get_or_insert_with(|| named().map(|code| number(&code.id)).collect());
        let near = numbers.contains(number(name)).then(|| {
            let near = nearest(name, named().map(|code| code.id.as_str()))?;
            (number(near) == number(name) && near != name).then_some(near)
        });
        let near = near.flatten();
        if self.known.len() < REMEMBERED {
            self.known.insert(name.to_owned(), near);
        }
        near
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_were_asked_for_before_have_the_same_answer() {
        let dialect = trunnion_dialect::builtin("sinumerik-840d").expect("embedded");
        let mut near = NearCodes::new(dialect);
        for _ in 0..2 {
            assert_eq!(near.of("TRAORY").as_deref(), Some("TRAORI"));
            assert_eq!(near.of("traory(1)").as_deref(), Some("TRAORI(1)"));
            assert_eq!(near.of("axes in the block of a dwell"), None);
            assert_eq!(near.of("CYCEL81(5)").as_deref(), Some("CYCLE81(5)"));
            // another number is another code, and what has a number of no code resembles none
            assert_eq!(near.of("CYCLE89999"), None);
            assert_eq!(near.of("CYCLE8"), None);
            assert_eq!(near.of("O12345"), None);
            assert_eq!(near.of("TRAORI"), None);
        }
    }
}
