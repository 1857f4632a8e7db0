//! The list of rules, alphabetical. A rule is one file in `rules/`, its name in two lists here.
use crate::Rule;

/// All rules, by name.
pub fn rules() -> &'static [&'static Rule] {
    &[]
}

/// A rule by name.
pub fn rule(name: &str) -> Option<&'static Rule> {
    rules().iter().copied().find(|rule| rule.name == name)
}
