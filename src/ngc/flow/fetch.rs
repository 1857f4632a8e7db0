//! From the bytes of a line to its parsed form, and how lines are kept.
use super::labels::Place;
use super::oline::{self, Keyword};
use super::texts::Key;
use super::{Compiled, Kind, problems};
use crate::read::{self, Line};
use crate::{Engine, Error};
use trunnion_formula::Cursor;
use trunnion_syntax::TextRange;

/// Longest line, its line end counted.
pub(super) const LONGEST: u32 = 253;

/// How a line begins.
pub(super) struct Head<'s> {
    /// After `/` and N.
    pub(super) cursor: Cursor<'s>,
    /// The line begins with `/`.
    pub(super) delete: bool,
    /// There was an N, and where it is not a number.
    pub(super) flaw: Option<TextRange>,
    /// The first byte after them, in lower case; `None`: nothing is there.
    pub(super) first: Option<u8>,
}

/// Examines how a line begins; `text` is [`trimmed`].
pub(super) fn head(source: &[u8], text: TextRange) -> Head<'_> {
    let mut cursor = Cursor::new(source, text);
    let delete = cursor.eat(b'/');
    let mut flaw = None;
    if cursor.peek() == Some(b'n') {
        let start = cursor.at();
        cursor.bump();
        if cursor.peek().is_some_and(|byte| byte.is_ascii_digit()) {
            while cursor.peek().is_some_and(|byte| byte.is_ascii_digit() || byte == b'.') {
                cursor.bump();
            }
        } else {
            cursor.bump();
            flaw = Some(cursor.since(start));
        }
    }
    Head {
        first: cursor.peek(),
        cursor,
        delete,
        flaw,
    }
}

/// The line without its line end; it ends at a NUL, too.
pub(super) fn trimmed(source: &[u8], range: TextRange) -> TextRange {
    let bytes = &source[range.start as usize..range.end as usize];
    ends_at(bytes, memchr::memchr(0, bytes), range)
}

/// The same where the place of the first NUL is known.
fn ends_at(bytes: &[u8], nul: Option<usize>, range: TextRange) -> TextRange {
    let end = nul.unwrap_or(bytes.len());
    let length = bytes[..end]
        .iter()
        .rposition(|byte| !byte.is_ascii_whitespace())
        .map_or(0, |last| last + 1);
    TextRange::new(range.start, range.start + length as u32)
}

/// A line that is too long: what is too much of it.
pub(super) fn too_long(range: TextRange) -> Option<Error> {
    (range.end - range.start > LONGEST)
        .then(|| Error::new(&problems::TOO_LONG, TextRange::new(range.start + LONGEST, range.end)))
}

/// Whether a line is `%` and nothing else.
pub(super) fn is_percent(source: &[u8], range: TextRange) -> bool {
    source[range.start as usize..range.end as usize].trim_ascii() == b"%"
}

impl Engine {
    /// The bytes of the line that begins at a place.
    #[inline]
    pub(super) fn range_at(&self, place: Place) -> TextRange {
        self.files[place.file().0 as usize].line_at(place.offset)
    }
    /// The place of the line after one.
    pub(super) fn behind(place: Place, range: TextRange) -> Place {
        place.further(1, range.end)
    }
    /// The line at `here` in its parsed form, and whether it runs repeatedly: then where a skip from it ends is remembered.
    #[inline]
    pub(super) fn fetch(&mut self) -> (Box<Compiled>, bool) {
        let place = self.flow.here;
        let again = self.flow.lines(place.file()).run(place.line());
        if again {
            self.flow.fuel = self.flow.fuel.saturating_sub(1);
        }
        let keep = again || self.flow.looping;
        let mut compiled = self.read(place, keep);
        if again && compiled.kind != Kind::Words {
            compiled.skip = self.flow.lines(place.file()).skip(place.line());
        }
        (compiled, keep)
    }
    /// The line at a place in its parsed form. `keep`: it will run again.
    #[inline]
    pub(super) fn read(&mut self, place: Place, keep: bool) -> Box<Compiled> {
        let source = self.files[place.file().0 as usize].bytes();
        match self.flow.texts.guess(source, place) {
            Some(compiled) => compiled,
            None => self.look_up(place, keep),
        }
    }
    /// The same, by its text.
    #[inline(never)]
    fn look_up(&mut self, place: Place, keep: bool) -> Box<Compiled> {
        let source = self.files[place.file().0 as usize].bytes();
        let range = self.range_at(place);
        let Some(key) = Key::of(source, range) else {
            let mut compiled = self.flow.texts.nowhere();
            self.compile_range(place, range, &mut compiled);
            return compiled;
        };
        let (mut compiled, known) = self.flow.texts.find(&key, source, &self.files, keep);
        if known {
            compiled.move_to_key(place, key);
        } else {
            self.compile_range(place, range, &mut compiled);
            compiled.comes_from(&key, place.file());
        }
        self.flow.texts.follows(compiled.slot());
        compiled
    }
    /// Reads the line at a place. Its errors are in the result.
    pub(super) fn compile(&self, place: Place, into: &mut Compiled) {
        self.compile_range(place, self.range_at(place), into);
    }
    /// Reads the line at a place, whose bytes are known.
    fn compile_range(&self, place: Place, range: TextRange, into: &mut Compiled) {
        let source = self.files[place.file().0 as usize].bytes();
        into.place = place;
        into.next = Self::behind(place, range);
        into.skip = None;
        if let Some(line) = into.o.take() {
            into.spare = Some(line);
        }
        into.kind = Kind::Blank;
        into.only_sets = false;
        into.flaw = too_long(range);
        let bytes = &source[range.start as usize..range.end as usize];
        let nul = memchr::memchr(0, bytes);
        into.cut = nul.map(|at| TextRange::new(range.start + at as u32, range.end));
        let text = ends_at(bytes, nul, range);
        if text.start == text.end || into.flaw.is_some() {
            return;
        }
        let head = head(source, text);
        match head.first {
            _ if head.delete && self.setup.block_delete => {}
            Some(b'%') if is_percent(source, text) => into.kind = Kind::Percent,
            Some(b'o') => {
                let mut cursor = head.cursor;
                into.flaw = flaw_with(source, text, head.flaw);
                let mut line = into.spare.take().unwrap_or_default();
                oline::read(&mut cursor, &mut into.line.pool, &mut line);
                into.o = Some(line);
                into.kind = Kind::Label;
            }
            Some(b'm') => compile_m(source, &head, text, into),
            _ => {
                into.kind = Kind::Words;
                Line::read(source, text, &mut into.line);
                into.only_sets = into.cut.is_none() && into.line.only_sets();
            }
        }
    }
    /// Puts a line back where it came from.
    #[inline]
    pub(super) fn put_back(&mut self, compiled: Box<Compiled>, keep: bool) {
        if keep && compiled.kind != Kind::Words {
            let place = compiled.place;
            self.flow.lines(place.file()).keep(place.line(), compiled.skip);
        }
        self.flow.texts.put_back(compiled);
    }
}

/// A line that begins with M: `M98` and `M99` are calls and returns.
fn compile_m(source: &[u8], head: &Head<'_>, text: TextRange, into: &mut Compiled) {
    let mut cursor = head.cursor;
    into.o = oline::numbered(&mut cursor, &mut into.line.pool).map(Box::new);
    let (kind, words) = match &into.o {
        Some(line) if line.keyword == Keyword::CallNumbered => (Kind::CallNumbered, line.rest),
        Some(_) => (Kind::ReturnNumbered, text),
        None => (Kind::Words, text),
    };
    into.kind = kind;
    if kind == Kind::CallNumbered {
        into.flaw = text_flaw(source, text);
    }
    Line::read(source, words, &mut into.line);
}

/// Errors of a line apart from its meaning: comments, N. Lines of words check these themselves.
pub(super) fn text_flaw(source: &[u8], text: TextRange) -> Option<Error> {
    flaw_with(source, text, head(source, text).flaw)
}

/// The same where it is known what is wrong with N.
fn flaw_with(source: &[u8], text: TextRange, number: Option<TextRange>) -> Option<Error> {
    let error = || number.map(|range| Error::new(&problems::SEQUENCE_NUMBER, range));
    read::comment_flaw(source, text).or_else(error)
}
