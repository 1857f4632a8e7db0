//! What was read from files, kept by their texts: a thousand programs in one folder would otherwise read the same settings and the same machine a
//! thousand times. A file that changed has another text, and is read again.
use std::sync::{Arc, Mutex, PoisonError};

/// So many texts are kept, each of at most 2 MiB.
const MOST: usize = 4;

/// A name and a text, and what was read from it.
type Entry<T> = (String, String, Arc<T>);

/// What was read last, the newest first.
pub(crate) struct Kept<T> {
    known: Mutex<Vec<Entry<T>>>,
    /// How many texts were read.
    #[cfg(test)]
    pub(crate) read: std::sync::atomic::AtomicUsize,
}

impl<T> Kept<T> {
    /// Without any.
    pub(crate) const fn new() -> Self {
        Self {
            known: Mutex::new(Vec::new()),
            #[cfg(test)]
            read: std::sync::atomic::AtomicUsize::new(0),
        }
    }

    /// What `read` gives for this name and text, now or before.
    pub(crate) fn of(&self, name: &str, text: &str, read: impl FnOnce() -> T) -> Arc<T> {
        // held while a text is read: programs that are checked side by side read it once
        let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        let at = known.iter().position(|(of, kept, _)| of == name && kept == text);
        let entry = at.map_or_else(
            || {
                #[cfg(test)]
                self.read.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
                (name.to_owned(), text.to_owned(), Arc::new(read()))
            },
            |at| known.remove(at),
        );
        let found = Arc::clone(&entry.2);
        known.insert(0, entry);
        known.truncate(MOST);
        found
    }
}

#[cfg(test)]
mod tests {
    use super::{Kept, MOST};
    use std::sync::atomic::Ordering;

    #[test]
    fn a_text_is_read_once_and_again_when_it_changed() {
        let kept = Kept::new();
        let length = |name: &str, text: &str| *kept.of(name, text, || text.len());
        for _ in 0..1000 {
            assert_eq!((length("a", "one"), length("a", "three")), (3, 5));
        }
        assert_eq!(kept.read.load(Ordering::Relaxed), 2);
        // the same text under another name is another file
        assert_eq!(length("b", "one"), 3);
        assert_eq!(kept.read.load(Ordering::Relaxed), 3);
        for more in 0..MOST {
            length("a", &"x".repeat(more));
        }
        length("a", "one");
        assert_eq!(kept.read.load(Ordering::Relaxed), 3 + MOST + 1);
        assert_eq!(kept.known.lock().expect("whole").len(), MOST);
    }
}
