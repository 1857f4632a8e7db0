//! Named parameters and their values: a few stand in a list that is searched from the front, the rest in order.
use std::collections::BTreeMap;
use trunnion_formula::Name;

/// So many stand in the list: more are found faster in order.
const FEW: usize = 12;

/// Values by name.
#[derive(Clone, Debug, Default)]
pub(super) struct Names {
    few: Vec<(Name, f64)>,
    rest: BTreeMap<Name, f64>,
}

impl Names {
    /// The value of a name.
    #[inline]
    pub(super) fn get(&self, name: &Name) -> Option<f64> {
        match self.few.iter().find(|(known, _)| known == name) {
            Some((_, value)) => Some(*value),
            None if self.rest.is_empty() => None,
            None => self.rest.get(name).copied(),
        }
    }
    /// Gives a name a value.
    pub(super) fn set(&mut self, name: &Name, value: f64) {
        if let Some((_, place)) = self.few.iter_mut().find(|(known, _)| known == name) {
            *place = value;
        } else if self.few.len() < FEW {
            self.few.push((name.clone(), value));
        } else {
            self.rest.insert(name.clone(), value);
        }
    }
    /// Forgets all names.
    pub(super) fn clear(&mut self) {
        self.few.clear();
        self.rest.clear();
    }
}
