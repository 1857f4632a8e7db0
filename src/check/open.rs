//! Runs of findings that may still grow, by what they are of.
use std::collections::BTreeMap;

/// Rule, key, and whether it is unknown.
pub(crate) type Place = (&'static str, u64, bool);

/// This many places, the last ones requested, are tried before the others: consecutive blocks have the same findings.
const RECENT: usize = 4;

/// See the module.
pub(crate) struct Open<R> {
    /// Where each place's run is.
    slots: BTreeMap<Place, usize>,
    runs: Vec<(Place, R)>,
    recent: [usize; RECENT],
    /// Which of them is forgotten next.
    oldest: usize,
    /// The one that is tried first: the one after the last that was found, since blocks ask in the same order.
    next: usize,
}

impl<R> Default for Open<R> {
    fn default() -> Self {
        Self {
            slots: BTreeMap::new(),
            runs: Vec::new(),
            recent: [0; RECENT],
            oldest: 0,
            next: 0,
        }
    }
}

impl<R> Open<R> {
    /// The run at a place.
    #[inline]
    pub(crate) fn get_mut(&mut self, place: &Place) -> Option<&mut R> {
        let slot = self.find(place)?;
        self.runs.get_mut(slot).map(|(_, run)| run)
    }

    #[inline]
    fn find(&mut self, place: &Place) -> Option<usize> {
        // names of rules are static: most that are equal lie in the same place
        let same = |known: &Place| core::ptr::eq(known.0, place.0) && known.1 == place.1 && known.2 == place.2;
        let is_it = |slot: &usize| self.runs.get(*slot).is_some_and(|(known, _)| same(known));
        for step in 0..RECENT {
            let at = (self.next + step) % RECENT;
            let slot = self.recent[at];
            if is_it(&slot) {
                self.next = (at + 1) % RECENT;
                return Some(slot);
            }
        }
        let slot = *self.slots.get(place)?;
        self.recent[self.oldest] = slot;
        self.oldest = (self.oldest + 1) % RECENT;
        Some(slot)
    }

    /// Puts a run at a place; the one that was there.
    pub(crate) fn insert(&mut self, place: Place, run: R) -> Option<R> {
        if let Some(old) = self.get_mut(&place) {
            return Some(core::mem::replace(old, run));
        }
        self.slots.insert(place, self.runs.len());
        self.runs.push((place, run));
        None
    }

    /// Takes all runs, in the order of their places.
    pub(crate) fn take(&mut self) -> Vec<(Place, R)> {
        let mut runs = core::mem::take(self).runs;
        runs.sort_by_key(|(place, _)| *place);
        runs
    }
}

#[cfg(test)]
mod tests {
    use super::{Open, Place};
    use proptest::prelude::*;
    use std::collections::BTreeMap;

    proptest! {
        /// Many places, also of names with the same text elsewhere: as a map does.
        #[test]
        fn it_is_a_map(steps in proptest::collection::vec((0..3_usize, 0..4_u64, any::<bool>(), any::<bool>()), 0..200)) {
            let elsewhere: &'static str = Box::leak(String::from("b-rule").into_boxed_str());
            let names = ["c-rule", "b-rule", elsewhere];
            let (mut open, mut map) = (Open::default(), BTreeMap::new());
            for (step, (name, key, unknown, puts)) in steps.into_iter().enumerate() {
                let place: Place = (names[name], key, unknown);
                if puts {
                    prop_assert_eq!(open.insert(place, step), map.insert(place, step));
                } else {
                    prop_assert_eq!(open.get_mut(&place), map.get_mut(&place));
                }
            }
            prop_assert_eq!(open.take(), map.into_iter().collect::<Vec<_>>());
            prop_assert!(open.get_mut(&("c-rule", 0, false)).is_none() && open.take().is_empty());
        }
    }
}
