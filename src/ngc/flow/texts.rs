//! Lines in their read form, found again by their text: what was read once is not read again where it stands a second time, in a loop, in
//! another subprogram, or under another O number.
//!
//! What a line says depends on its text alone; only its ranges know where it stands, and they are moved. A text is kept from the second
//! time on, so that programs whose lines all differ fill no memory.
use super::Compiled;
use super::fetch::LONGEST;
use super::labels::Place;
use super::oline::{Label, OLine};
use crate::{FileId, Source};
use core::hash::BuildHasher;
use foldhash::fast::FixedState;
use std::sync::Arc;
use trunnion_formula::Name;
use trunnion_syntax::TextRange;

/// So many texts have a place at most.
const SLOTS: usize = 8192;
/// The slot of a line that is not kept.
const NOWHERE: u32 = u32::MAX;
/// So many read forms that nobody needs are kept at most.
const SPARE: usize = 64;

/// Which part of a line its read form hangs on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Part {
    #[default]
    Whole,
    /// What stands behind an O and a plain number.
    BehindNumber,
    /// What stands behind an O and a plain name.
    BehindName,
}

/// What a line is found by.
pub(super) struct Key {
    part: Part,
    /// The O and its label, where they are plain and not part of the text.
    label: Option<(TextRange, Name)>,
    /// The bytes that are compared.
    text: TextRange,
    hash: u64,
}

impl Key {
    /// The key of a line, its line end counted; `None` for a line that is too long to run.
    #[inline]
    pub(super) fn of(source: &[u8], line: TextRange) -> Option<Self> {
        let bytes = &source[line.as_usize()];
        if bytes.len() > LONGEST as usize {
            return None;
        }
        let (part, label, behind) = match plain_label(bytes) {
            Some((part, start, end, name)) => {
                let range = TextRange::new(line.start + start as u32, line.start + end as u32);
                (part, Some((range, name)), end)
            }
            None => (Part::Whole, None, 0),
        };
        Some(Self {
            part,
            label,
            text: TextRange::new(line.start + behind as u32, line.end),
            hash: FixedState::with_seed(part as u64).hash_one(&bytes[behind..]),
        })
    }
}

/// The O word that a line begins with, where its label is plain: where it begins and ends.
#[inline]
fn plain_label(line: &[u8]) -> Option<(Part, usize, usize, Name)> {
    let start = line.iter().position(|byte| !matches!(byte, b' ' | b'\t'))?;
    if !matches!(line[start], b'o' | b'O') {
        return None;
    }
    let rest = &line[start + 1..];
    if let Some((b'<', inside)) = rest.split_first() {
        let (name, length) = Name::before(inside, b'>')?;
        return Some((Part::BehindName, start, start + length + 3, name));
    }
    let length = rest.iter().position(|byte| !byte.is_ascii_digit())?;
    if !(1..=9).contains(&length) || (rest[0] == b'0' && length > 1) {
        return None;
    }
    let (name, _) = Name::before(rest, rest[length])?;
    Some((Part::BehindNumber, start, start + length + 1, name))
}

/// Where a read form comes from.
#[derive(Clone, Copy, Debug)]
pub(super) struct Origin {
    slot: u32,
    part: Part,
    file: FileId,
    text: TextRange,
}

impl Default for Origin {
    fn default() -> Self {
        Self {
            slot: NOWHERE,
            part: Part::Whole,
            file: FileId::MAIN,
            text: TextRange::default(),
        }
    }
}

#[derive(Debug, Default)]
struct Slot {
    /// Of the text that was met last.
    hash: u64,
    /// It was met twice, or runs in a loop.
    read: Option<Box<Compiled>>,
}

/// The texts that were read.
#[derive(Debug, Default)]
pub(crate) struct Texts {
    slots: Vec<Slot>,
    /// Kept for their storage.
    #[expect(clippy::vec_box, reason = "they go from hand to hand and are large")]
    spare: Vec<Box<Compiled>>,
}

/// A copy reads its lines again: check-points must not copy what can be had anew.
impl Clone for Texts {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl Texts {
    /// The line at a place, if its text has this slot and was run at this very place the last time.
    #[inline]
    pub(super) fn again(&mut self, slot: u32, place: Place) -> Option<Box<Compiled>> {
        self.slots
            .get_mut(slot as usize)?
            .read
            .take_if(|read| read.place == place)
    }
    /// The read form of a text, with `true`, to be moved to where it stands now; else room to read it into. `keep`: it will run again.
    #[inline]
    pub(super) fn find(
        &mut self,
        key: &Key,
        source: &[u8],
        files: &[Arc<Source>],
        keep: bool,
    ) -> (Box<Compiled>, bool) {
        if self.slots.is_empty() {
            self.slots.resize_with(SLOTS, Slot::default);
        }
        let first = key.hash as usize % SLOTS;
        for at in [first, first ^ 1] {
            let slot = &mut self.slots[at];
            if slot.hash != key.hash {
                continue;
            }
            let same = |read: &mut Box<Compiled>| {
                let origin = &read.origin;
                let there = &files[origin.file.0 as usize].bytes()[origin.text.as_usize()];
                origin.part == key.part && *there == source[key.text.as_usize()]
            };
            if let Some(read) = slot.read.take_if(same) {
                return (read, true);
            }
            return (self.room(at), false);
        }
        (self.first_met(key, first, keep), false)
    }
    /// Room for a text that was not met before.
    fn first_met(&mut self, key: &Key, first: usize, keep: bool) -> Box<Compiled> {
        let is_free = |at: usize| self.slots[at].read.is_none();
        let at = if is_free(first) {
            first
        } else if is_free(first ^ 1) {
            first ^ 1
        } else {
            first ^ (key.hash >> 63) as usize
        };
        self.slots[at].hash = key.hash;
        if keep {
            return self.room(at);
        }
        if let Some(old) = self.slots[at].read.take() {
            self.spare(old);
        }
        self.nowhere()
    }
    /// Room for a text that has a slot from now on.
    fn room(&mut self, at: usize) -> Box<Compiled> {
        let old = self.slots[at].read.take();
        let mut read = old.or_else(|| self.spare.pop()).unwrap_or_default();
        read.origin.slot = at as u32;
        read
    }
    /// Room for a line that is not kept.
    pub(super) fn nowhere(&mut self) -> Box<Compiled> {
        let mut read = self.spare.pop().unwrap_or_default();
        read.origin.slot = NOWHERE;
        read
    }
    /// Takes a line back.
    #[inline]
    pub(super) fn put_back(&mut self, read: Box<Compiled>) {
        match self.slots.get_mut(read.origin.slot as usize) {
            Some(slot) => slot.read = Some(read),
            None => self.spare(read),
        }
    }
    /// Keeps storage.
    fn spare(&mut self, read: Box<Compiled>) {
        if self.spare.len() < SPARE {
            self.spare.push(read);
        }
    }
}

impl Compiled {
    /// Its slot.
    #[inline]
    pub(super) fn slot(&self) -> u32 {
        self.origin.slot
    }
    /// It was just read at `file` from the text of this key: from now on it stands for all lines of that text, unless it says more than that.
    pub(super) fn comes_from(&mut self, key: &Key, file: FileId) {
        self.origin.part = key.part;
        self.origin.file = file;
        self.origin.text = key.text;
        let as_seen = match (&key.label, self.o.as_deref()) {
            (None, _) => true,
            (
                Some((range, name)),
                Some(OLine {
                    label: Label::Text(own),
                    label_range,
                    ..
                }),
            ) => own == name && label_range == range,
            _ => false,
        };
        if self.cut.is_some() || !as_seen {
            self.origin.slot = NOWHERE;
        }
    }
    /// Moves its ranges from where the text was run last to where it stands now.
    #[inline]
    pub(super) fn move_to(&mut self, key: Key, file: FileId) {
        let by = key.text.start.wrapping_sub(self.origin.text.start);
        self.origin.file = file;
        self.origin.text = key.text;
        if by != 0 {
            self.shift(by);
        }
        if let (Some((range, name)), Some(line)) = (key.label, &mut self.o) {
            if line.keyword_range == line.label_range {
                line.keyword_range = range;
            }
            line.label_range = range;
            line.label = Label::Text(name);
        }
    }
    fn shift(&mut self, by: u32) {
        let moved = |range: &mut TextRange| *range = range.shifted(by);
        if let Some(flaw) = &mut self.flaw {
            moved(&mut flaw.range);
        }
        if let Some(line) = &mut self.o {
            line.shift(by);
        }
        let line = &mut self.line;
        moved(&mut line.range);
        for word in &mut line.words {
            moved(&mut word.range);
            word.value.shift(by);
        }
        for assignment in &mut line.assignments {
            moved(&mut assignment.target_range);
            if let trunnion_formula::Target::Numbered(formula) = &mut assignment.target {
                formula.shift(by);
            }
            assignment.value.shift(by);
        }
        line.comment.iter_mut().chain(&mut line.remark).for_each(moved);
        for error in &mut line.errors {
            moved(&mut error.range);
        }
    }
}

impl OLine {
    /// Moves its ranges by so many bytes (wrapping).
    fn shift(&mut self, by: u32) {
        for range in [&mut self.label_range, &mut self.keyword_range, &mut self.rest] {
            *range = range.shifted(by);
        }
        if let Label::Computed(formula) = &mut self.label {
            formula.shift(by);
        }
        for formula in &mut self.values {
            formula.shift(by);
        }
        for flaw in self.flaw.iter_mut().chain(&mut self.tail) {
            flaw.range = flaw.range.shifted(by);
        }
        for error in &mut self.errors {
            error.range = error.range.shifted(by);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::labels::Place;
    use super::{Compiled, NOWHERE};
    use crate::{Engine, Setup, Source};
    use proptest::prelude::*;
    use std::sync::Arc;

    /// All that a read form says.
    fn said(read: &Compiled) -> String {
        let line = &read.line;
        let words = (&line.number, line.delete, &line.items, &line.words, &line.assignments);
        let rest = (line.range, &line.comment, &line.remark, &line.errors);
        format!(
            "{:?} {:?} {:?} {:?} {words:?} {rest:?}",
            read.kind, read.o, read.cut, read.flaw
        )
    }

    /// Reads both lines of a program, the second one as it is found by its text; whether it was found, and what both ways say of it.
    fn both(first: &str, second: &str) -> (bool, String, String) {
        let text = format!("{first}\n\n{second}\n");
        let source = Source::new(String::new(), text.as_bytes().into());
        let mut engine = Engine::new(Arc::new(source), &Setup::default());
        let there = Place {
            line: 2,
            offset: first.len() as u32 + 2,
            ..Place::default()
        };
        let read = engine.read(Place::default(), true);
        let slot = read.slot();
        engine.put_back(read, false);
        let moved = engine.read(there, true);
        let mut fresh = Compiled::default();
        engine.compile(there, &mut fresh);
        assert_eq!((moved.place, moved.next), (fresh.place, fresh.next));
        let words = |read: &Compiled| {
            let counts = matches!(
                read.kind,
                super::super::Kind::Words | super::super::Kind::CallNumbered | super::super::Kind::ReturnNumbered
            );
            counts && read.flaw.is_none()
        };
        let mut moved = moved;
        if !words(&moved) && !words(&fresh) {
            // nobody looks at the words of such a line
            moved.line = fresh.line.clone();
        }
        (slot != NOWHERE && slot == moved.slot(), said(&moved), said(&fresh))
    }

    #[test]
    fn what_is_found_by_its_text_is_what_is_read() {
        for (first, second) in [
            ("  G1 X#<w> Y[#<h> - 1.25] (c)", "  G1 X#<w> Y[#<h> - 1.25] (c)"),
            (
                "o7 if [#1 GT 10 AND #<h> LT 1000] ;c",
                "O12 if [#1 GT 10 AND #<h> LT 1000] ;c",
            ),
            ("o<ab> call [3] [0.5] [#2]", "o<abc_d> call [3] [0.5] [#2]"),
            ("o7", "o77"),
            ("#<a> = [1 + 2] #3=4", "#<a> = [1 + 2] #3=4"),
            ("G1 X1 X2 Y[1+", "G1 X1 X2 Y[1+"),
            ("o7 foo", "o9 foo"),
        ] {
            let (found, moved, fresh) = both(first, second);
            assert!(found, "{first:?}");
            assert_eq!(moved, fresh, "{first:?}");
        }
        // where the number does not end with its digits, what stands behind is no text of its own
        for (first, second) in [("o7.5 if [1]", "o8.5 if [1]"), ("o7 7 if [1]", "o8 7 if [1]")] {
            let (found, moved, fresh) = both(first, second);
            assert!(!found, "{first:?}");
            assert_eq!(moved, fresh, "{first:?}");
        }
    }

    proptest! {
        #[test]
        fn whatever_stands_there(
            line in "[/ ]{0,2}(N5 )?(o(7|<ab>|#1|1\\.5|\\[1\\]) ?(if|while|sub|call|endif|else|foo)?|G1 X#<w>|#1=|#<a>=5|X1\\.2\\.3|M98 P1|M99|%|X1 X)[ 7.]{0,2}(\\[[#<x>1+2.]{0,5}\\]){0,2}( ;c| \\(d\\)|\\(a\\(b)?"
        ) {
            let other = line.replacen("o7", "O12", 1).replacen("<ab>", "<abc_d>", 1);
            let (_, moved, fresh) = both(&line, &other);
            prop_assert_eq!(moved, fresh);
        }
    }
}
