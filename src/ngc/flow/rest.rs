//! Lines that never ran: their text is still read, so that a check reports every mistake of a program.
use super::labels::Place;
use super::oline::Keyword;
use super::{Compiled, Kind};
use crate::{At, Engine, Error, FileId, Sink};

impl Engine {
    /// Reports the errors of the text of lines that did not run: skipped branches, subprograms that are never called, what follows an
    /// undecided jump. After the end of the main program only subprograms are read: other text there is not part of the program.
    ///
    /// Of a called file the first line with errors stands for all: often it is written for something else.
    ///
    /// Values are not computed and codes are not run, so this finds less than a run.
    pub fn read_rest(&mut self, sink: &mut dyn Sink) {
        for file in 0..self.files.len() as u32 {
            self.read_rest_of(FileId(file), sink);
        }
    }
    fn read_rest_of(&mut self, file: FileId, sink: &mut dyn Sink) {
        let length = self.files[file.0 as usize].bytes().len();
        let end = self.flow.end.filter(|place| place.file() == file);
        let mut compiled = Compiled::default();
        let mut place = Place::new(file, 0, 0);
        let mut inside = true;
        while (place.offset as usize) < length {
            if let Some(next) = self.after_executed(place) {
                place = next;
                continue;
            }
            self.compile(place, &mut compiled);
            let next = compiled.next;
            if compiled.kind == Kind::Percent && place.line() > 0 && self.flow.percent {
                return;
            }
            let behind = end.is_some_and(|end| place.line() > end.line());
            if end.is_some_and(|end| place.line() == end.line()) {
                inside = false;
            }
            if behind && is_head(&compiled) {
                inside = true;
            }
            let unread = (inside || !behind) && !self.flow.lines(file).has_run(place.line());
            if unread && tell(&compiled, file, sink) && file != FileId::MAIN {
                return;
            }
            if behind && is_end(&compiled) {
                inside = false;
            }
            place = next;
        }
    }
}

impl Engine {
    /// After lines that all ran, where the line at `place` begins a range of them before the end of the program: there is nothing to
    /// report.
    fn after_executed(&self, place: Place) -> Option<Place> {
        let stretch = crate::source::STRIDE;
        let next = place.line() + stretch;
        let source = &self.files[place.file().0 as usize];
        let before_end = self
            .flow
            .end
            .is_none_or(|end| end.file() != place.file() || end.line() >= next);
        let ran = place.line().is_multiple_of(stretch)
            && before_end
            && self.flow.lines.get(place.file().0 as usize)?.all_ran(place.line());
        if !ran {
            return None;
        }
        let offset = source.line(next)?.start;
        // a second `%` is the end
        let text = &source.bytes()[place.offset as usize..offset as usize];
        (!self.flow.percent || memchr::memchr(b'%', text).is_none()).then_some(Place::new(place.file(), next, offset))
    }
}

/// Whether a line begins a subprogram.
fn is_head(compiled: &Compiled) -> bool {
    compiled
        .o
        .as_ref()
        .is_some_and(|line| matches!(line.keyword, Keyword::Sub | Keyword::Bare) && line.flaw.is_none())
}

/// Whether a line ends a subprogram.
fn is_end(compiled: &Compiled) -> bool {
    compiled
        .o
        .as_ref()
        .is_some_and(|line| matches!(line.keyword, Keyword::EndSub | Keyword::ReturnNumbered))
}

/// Reports the errors of a line; whether it has any.
fn tell(compiled: &Compiled, file: FileId, sink: &mut dyn Sink) -> bool {
    let at = At {
        file,
        line: compiled.place.line(),
        ..At::default()
    };
    let mut said = false;
    let mut say = |error: &Error| {
        let error = Error { file, ..error.clone() };
        sink.error(&error, at);
        said = true;
    };
    if let Some(flaw) = &compiled.flaw {
        say(flaw);
    }
    if let Some(line) = &compiled.o {
        for flaw in line.flaw.into_iter().chain(line.tail) {
            say(&Error::new(flaw.problem, flaw.range));
        }
        for error in &line.errors {
            say(&crate::read::formula_error(error));
        }
    }
    if matches!(compiled.kind, Kind::Words | Kind::CallNumbered | Kind::ReturnNumbered) {
        for error in &compiled.line.errors {
            say(error);
        }
    }
    said
}
