//! A list whose entries are found by a key: nearly always there are a few, and a hostile program makes a million.
use std::{collections::HashMap, hash::Hash};

/// So many entries are looked through one by one.
const FEW: usize = 12;

/// Entries in the order in which they came, each key once.
#[derive(Clone, Debug)]
pub(crate) struct Keyed<K, T> {
    list: Vec<(K, T)>,
    /// Places of all keys, once there are more than a few.
    places: HashMap<K, usize>,
}

impl<K, T> Default for Keyed<K, T> {
    fn default() -> Self {
        Self {
            list: Vec::new(),
            places: HashMap::new(),
        }
    }
}

impl<K: Copy + Eq + Hash, T> Keyed<K, T> {
    fn place(&self, key: &K) -> Option<usize> {
        if self.list.len() <= FEW {
            self.list.iter().position(|(known, _)| known == key)
        } else {
            self.places.get(key).copied()
        }
    }

    /// The entry of a key; where there is none yet, what `make` gives.
    pub(crate) fn entry(&mut self, key: K, make: impl FnOnce() -> T) -> &mut T {
        let place = self.place(&key).unwrap_or_else(|| {
            self.list.push((key, make()));
            if self.list.len() > FEW {
                // those that were looked through until now, too
                for (place, (key, _)) in self.list.iter().enumerate().skip(self.places.len()) {
                    self.places.insert(*key, place);
                }
            }
            self.list.len() - 1
        });
        &mut self.list[place].1
    }

    /// Whether the key was not there, and is from now on.
    pub(crate) fn insert(&mut self, key: K, value: T) -> bool {
        let before = self.list.len();
        self.entry(key, || value);
        self.list.len() > before
    }

    /// The entries in their order.
    pub(crate) fn values(&self) -> impl Iterator<Item = &T> {
        self.list.iter().map(|(_, value)| value)
    }

    /// The keys in their order.
    pub(crate) fn keys(&self) -> impl Iterator<Item = &K> {
        self.list.iter().map(|(key, _)| key)
    }

    /// The entries in their order, without their keys.
    pub(crate) fn into_values(self) -> Vec<T> {
        self.list.into_iter().map(|(_, value)| value).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::Keyed;
    use std::{cell::Cell, hash::Hash};

    thread_local! {
        static COMPARED: Cell<u64> = const { Cell::new(0) };
    }

    /// A key that counts how often it is compared.
    #[derive(Clone, Copy, Debug)]
    struct Key(u32);

    impl PartialEq for Key {
        fn eq(&self, other: &Self) -> bool {
            COMPARED.with(|compared| compared.set(compared.get() + 1));
            self.0 == other.0
        }
    }
    impl Eq for Key {}
    impl Hash for Key {
        fn hash<H: std::hash::Hasher>(&self, state: &mut H) {
            self.0.hash(state);
        }
    }

    #[test]
    fn entries_keep_their_order_and_are_not_compared_with_all_others() {
        for count in [1, 12, 13, 20_000] {
            COMPARED.with(|compared| compared.set(0));
            let mut keyed = Keyed::default();
            for i in 0..count {
                assert!(keyed.insert(Key(i), i));
                *keyed.entry(Key(i), || unreachable!("it is there")) += 1;
                assert!(!keyed.insert(Key(i / 2), 0));
            }
            assert!(keyed.keys().zip(0..).all(|(key, i)| key.0 == i));
            assert!(keyed.values().copied().eq(1..=count));
            let compared = COMPARED.with(Cell::get);
            assert!(compared < 20 * u64::from(count), "{compared} comparisons of {count}");
        }
    }
}
