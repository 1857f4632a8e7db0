//! What was reported, so that it is reported once.

use std::collections::BTreeSet;

/// Names of what was reported.
#[derive(Clone, Debug, Default)]
pub(crate) struct Reported(BTreeSet<Box<str>>);

impl Reported {
    /// How many names a clone copies.
    pub(crate) fn copied(&self) -> usize {
        self.0.len()
    }

    /// Whether this is the first time; from then on it is not.
    pub(crate) fn first(&mut self, what: &str) -> bool {
        let first = !self.0.contains(what);
        if first {
            self.0.insert(what.into());
        }
        first
    }
}

#[cfg(test)]
mod tests {
    use super::Reported;

    #[test]
    fn each_name_is_new_once() {
        let mut reported = Reported::default();
        assert_eq!(
            ["G54", "G55", "G54"].map(|name| reported.first(name)),
            [true, true, false]
        );
    }
}
