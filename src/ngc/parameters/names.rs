//! Named parameters and their values: a few are in a list that is searched from the front, the rest in order.
use std::collections::BTreeMap;
use trunnion_formula::Name;

/// This many are in the list: more are found faster in order.
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
        match self.few.iter().find(|(known, _)| known.is(name)) {
            Some((_, value)) => Some(*value),
            None if self.rest.is_empty() => None,
            None => self.one_of_many(name),
        }
    }
    #[cold]
    #[inline(never)]
    fn one_of_many(&self, name: &Name) -> Option<f64> {
        self.rest.get(name).copied()
    }
    /// Gives a name a value.
    pub(super) fn set(&mut self, name: &Name, value: f64) {
        if let Some((_, place)) = self.few.iter_mut().find(|(known, _)| known.is(name)) {
            *place = value;
        } else if self.few.len() < FEW {
            self.few.push((name.clone(), value));
        } else {
            self.rest.insert(name.clone(), value);
        }
    }
    /// Whether the same names, set in the same order, have the same values, bit for bit.
    pub(super) fn is_same(&self, other: &Self) -> bool {
        let same = |((a, x), (b, y)): ((&Name, &f64), (&Name, &f64))| a == b && x.to_bits() == y.to_bits();
        let few = |names: &Self| names.few.len();
        let listed = self.few.iter().map(|(name, value)| (name, value));
        few(self) == few(other)
            && self.rest.len() == other.rest.len()
            && listed
                .zip(other.few.iter().map(|(name, value)| (name, value)))
                .all(same)
            && self.rest.iter().zip(&other.rest).all(same)
    }
    /// All names with their values.
    pub(super) fn iter(&self) -> impl Iterator<Item = (&Name, f64)> {
        let listed = self.few.iter().map(|(name, value)| (name, *value));
        listed.chain(self.rest.iter().map(|(name, value)| (name, *value)))
    }
    /// How many names there are.
    pub(super) fn count(&self) -> usize {
        self.few.len() + self.rest.len()
    }
    /// Forgets all names.
    pub(super) fn clear(&mut self) {
        self.few.clear();
        self.rest.clear();
    }
}
