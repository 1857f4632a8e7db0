//! What the control remembers between blocks: words that do not change are left out.
use std::collections::BTreeMap;

/// Texts in effect, by the letter (or name) of their word.
#[derive(Clone, Debug, Default)]
pub(crate) struct Modal {
    known: BTreeMap<&'static str, String>,
}

impl Modal {
    /// The word, unless it is in effect already.
    pub(crate) fn change(&mut self, key: &'static str, text: String) -> Option<String> {
        if self.known.get(key) == Some(&text) {
            return None;
        }
        self.known.insert(key, text.clone());
        Some(text)
    }
    /// The word is in effect, written or not.
    pub(crate) fn set(&mut self, key: &'static str, text: String) {
        self.known.insert(key, text);
    }
    /// The word is unknown.
    pub(crate) fn forget(&mut self, key: &'static str) {
        self.known.remove(key);
    }
    /// Nothing is known at all.
    pub(crate) fn forget_all(&mut self) {
        self.known.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::Modal;

    #[test]
    fn words_are_written_once() {
        let mut modal = Modal::default();
        assert_eq!(modal.change("X", "X1".into()).as_deref(), Some("X1"));
        assert_eq!(modal.change("X", "X1".into()), None);
        modal.forget("X");
        assert_eq!(modal.change("X", "X1".into()).as_deref(), Some("X1"));
        modal.set("F", "F5".into());
        assert_eq!(modal.change("F", "F5".into()), None);
        modal.forget_all();
        assert!(modal.change("F", "F5".into()).is_some());
    }
}
