//! Lines in their parsed form, looked up by their text: a line is not parsed again when it occurs a second time, in a loop, in
//! another subprogram, or under another O number.
//!
//! The meaning of a line depends on its text alone; only its ranges depend on its place, and they are moved. A text is kept from the
//! second time on, so that programs whose lines all differ need no memory for it.
use super::Compiled;
use super::fetch::LONGEST;
use super::label::{Label, digits};
use super::labels::Place;
use super::oline::OLine;
use crate::{FileId, Source};
use core::hash::BuildHasher;
use foldhash::fast::FixedState;
use std::sync::Arc;
use trunnion_formula::Name;
use trunnion_syntax::TextRange;

/// At most this many texts are kept.
const SLOTS: usize = 8192;
/// The slot of a line that is not kept.
const NOWHERE: u32 = u32::MAX;
/// At most this many unused parsed forms are kept.
const SPARE: usize = 64;

/// The part of a line on which its parsed form depends.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Part {
    #[default]
    Whole,
    /// What follows an O and a plain number.
    BehindNumber,
    /// What follows an O and a plain name.
    BehindName,
}

/// The key of a line.
pub(super) struct Key {
    part: Part,
    /// The O and its label, where they are plain and not part of the text.
    label: Option<(TextRange, Label)>,
    /// The bytes that are compared.
    text: TextRange,
    hash: u64,
}

impl Key {
    /// The key of a line, including its line end; `None` for a line that is too long to run.
    #[inline]
    pub(super) fn of(source: &[u8], line: TextRange) -> Option<Self> {
        let bytes = &source[line.as_usize()];
        if bytes.len() > LONGEST as usize {
            return None;
        }
        let (part, label, behind) = match plain_label(bytes) {
            Some((start, end, label)) => {
                let part = match label {
                    Label::Number(_) => Part::BehindNumber,
                    _ => Part::BehindName,
                };
                let range = TextRange::new(line.start + start as u32, line.start + end as u32);
                (part, Some((range, label)), end)
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
fn plain_label(line: &[u8]) -> Option<(usize, usize, Label)> {
    let start = o_word(line)?;
    let rest = &line[start + 1..];
    if let Some((b'<', inside)) = rest.split_first() {
        let (name, length) = Name::before(inside, b'>')?;
        return Some((start, start + length + 3, Label::Text(name)));
    }
    let (number, length) = digits(rest)?;
    // a line that ends here was cut off
    (length < rest.len()).then_some((start, start + length + 1, Label::Number(number)))
}

/// Where the O is with which a line begins.
#[inline]
fn o_word(line: &[u8]) -> Option<usize> {
    let mut start = 0;
    while matches!(line.get(start), Some(b' ' | b'\t')) {
        start += 1;
    }
    matches!(line.get(start), Some(b'o' | b'O')).then_some(start)
}

/// The origin of a parsed form.
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
    /// Of the last text.
    hash: u64,
    /// It occurred twice, or runs in a loop.
    read: Option<Box<Compiled>>,
    /// Slots of the texts that were read after it the last time: where no line was skipped in between, and where some were.
    after: [u32; 2],
}

/// The texts that were read.
#[derive(Debug, Default)]
pub(crate) struct Texts {
    slots: Vec<Slot>,
    /// Kept for their storage.
    #[expect(clippy::vec_box, reason = "they go from hand to hand and are large")]
    spare: Vec<Box<Compiled>>,
    /// Slot of the text that was read last.
    last: u32,
    /// Lines were skipped since then.
    skipped: bool,
}

/// A copy starts empty: check-points must not copy what can be read again.
impl Clone for Texts {
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl Texts {
    /// Lines are skipped: what is read next does not follow what was read last.
    #[inline]
    pub(super) fn skip(&mut self) {
        self.skipped = true;
    }
    /// The line at a place, if its text is the one that followed last time: then it need not be looked up.
    #[inline]
    pub(super) fn guess(&mut self, source: &[u8], place: Place) -> Option<Box<Compiled>> {
        let at = self.slots.get(self.last as usize)?.after[usize::from(self.skipped)];
        let slot = self.slots.get_mut(at as usize)?;
        let read = slot.read.as_deref_mut()?;
        if read.origin.file != place.file() {
            return None;
        }
        let (label, behind) = match read.origin.part {
            Part::Whole => (None, place.offset),
            Part::BehindNumber => {
                let line = source.get(place.offset as usize..)?;
                let start = o_word(line)?;
                let (number, length) = digits(line.get(start + 1..)?)?;
                let start = place.offset + start as u32;
                (Some((start, number)), start + 1 + length as u32)
            }
            Part::BehindName => return None,
        };
        let there = source.get(read.origin.text.as_usize())?;
        let here = source.get(behind as usize..)?.get(..there.len())?;
        let end = behind + there.len() as u32;
        // a text without its line end could continue here
        if here != there || there.last() != Some(&b'\n') || end - place.offset > LONGEST {
            return None;
        }
        read.move_to_line(place, TextRange::new(behind, end));
        if let (Some((start, number)), Some(line)) = (label, &mut read.o) {
            line.label_stands_at(TextRange::new(start, behind));
            line.label = Label::Number(number);
        }
        self.last = at;
        self.skipped = false;
        slot.read.take()
    }
    /// Records that the text of this slot follows the one that was read last.
    #[inline]
    pub(super) fn follows(&mut self, slot: u32) {
        if (slot as usize) < self.slots.len() {
            if let Some(last) = self.slots.get_mut(self.last as usize) {
                last.after[usize::from(self.skipped)] = slot;
            }
            self.last = slot;
            self.skipped = false;
        }
    }
    /// The parsed form of a text, with `true`, to be moved to its present place; otherwise room to parse it into. `keep`: it will run again.
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
    /// Room for a new text.
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
    /// It was just read at `file` from the text of this key: from now on it serves all lines of that text, unless its meaning depends on more than the text.
    pub(super) fn comes_from(&mut self, key: &Key, file: FileId) {
        self.origin.part = key.part;
        self.origin.file = file;
        self.origin.text = key.text;
        let as_seen = match (&key.label, self.o.as_deref()) {
            (None, _) => true,
            (
                Some((range, label)),
                Some(OLine {
                    label: own,
                    label_range,
                    ..
                }),
            ) => own == label && label_range == range,
            _ => false,
        };
        if self.cut.is_some() || !as_seen {
            self.origin.slot = NOWHERE;
        }
    }
    /// Moves it from where its text was run last to a line where the text is at `text`.
    #[inline]
    pub(super) fn move_to_line(&mut self, place: Place, text: TextRange) {
        self.place = place;
        self.next = place.further(1, text.end);
        self.skip = None;
        let by = text.start.wrapping_sub(self.origin.text.start);
        self.origin.file = place.file();
        self.origin.text = text;
        if by != 0 {
            self.shift(by);
        }
    }
    /// The same of the line of this key.
    pub(super) fn move_to_key(&mut self, place: Place, key: Key) {
        self.move_to_line(place, key.text);
        if let (Some((range, label)), Some(line)) = (key.label, &mut self.o) {
            line.label_stands_at(range);
            line.label = label;
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
    /// It follows another label, whose place this is.
    #[inline]
    fn label_stands_at(&mut self, range: TextRange) {
        if self.keyword_range == self.label_range {
            self.keyword_range = range;
        }
        self.label_range = range;
    }
    /// Moves its ranges by this many bytes (wrapping).
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
mod tests;
