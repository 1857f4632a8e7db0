//! Variables of the type AXIS (`DEF AXIS A1=(Y)`), and the axis that an index names: `AX[A1]=5`, `AX[X]=5`, `AX[$P_AXN1]=5`.
use super::Own;
use crate::FaultKind;
use crate::reader::Reader;
use trunnion_dialect::Role;
use trunnion_syntax::Word;

impl Own {
    /// DEF AXIS, with what is behind `=`; before a value is written, no axis is known.
    pub(super) fn declare_axis(&mut self, name: &str, given: Option<&str>) {
        let axis = given.and_then(|text| self.axis_named(text));
        self.scope.axes.insert(name.trim().to_ascii_lowercase().into(), axis);
    }

    /// An assignment to a variable of that type.
    pub(super) fn assign_axis(&mut self, name: &str, text: &str) {
        let key = name.trim().to_ascii_lowercase();
        if self.scope.axes.contains_key(key.as_str()) {
            let axis = self.axis_named(text);
            self.scope.axes.insert(key.into(), axis);
        }
    }

    /// The letter of the axis that a text names; `None`: it is not known.
    fn axis_named(&self, text: &str) -> Option<u8> {
        let text = text.trim();
        let text = text
            .strip_prefix('(')
            .and_then(|text| text.strip_suffix(')'))
            .unwrap_or(text);
        let key = text.trim().to_ascii_lowercase();
        if let Some(axis) = self.scope.axes.get(key.as_str()) {
            return axis.filter(|_| !self.is_fresh(&key));
        }
        if let Some(place) = key.strip_prefix("$p_axn") {
            let place: usize = place.parse().ok()?;
            return Some(self.plane_letters.get(place.checked_sub(1)?)?.to_ascii_uppercase());
        }
        let &[letter] = key.as_bytes() else { return None };
        let letter = letter.to_ascii_uppercase();
        (crate::AXIS_LETTERS.contains(&letter) && !self.is_declared(&key)).then_some(letter)
    }
}

impl<F: FnMut(trunnion_syntax::TextRange, FaultKind)> Reader<'_, '_, F> {
    /// `AX[A1]=5` is a word of the axis that the index names; false: it is another word, or which axis it is is not known.
    pub(crate) fn axis_by_index(&mut self, (stem, index): (&[u8], &[u8]), word: &Word) -> bool {
        if !stem.eq_ignore_ascii_case(b"AX") || self.dialect.named_role(stem) != Some(Role::NotModelled) {
            return false;
        }
        let inside = index.strip_prefix(b"[").and_then(|index| index.strip_suffix(b"]"));
        let inside = inside.map(String::from_utf8_lossy);
        let own = self.own.as_ref().filter(|own| !own.is_task);
        let axis = own.zip(inside).and_then(|(own, inside)| own.axis_named(&inside));
        let Some(letter) = axis.filter(|letter| self.dialect.role(*letter) == Some(Role::Axis)) else {
            return false;
        };
        self.words.letters |= 1 << (letter - b'A');
        self.role_word(Role::Axis, letter, word);
        true
    }
}
