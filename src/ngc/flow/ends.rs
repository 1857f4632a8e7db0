//! Beginning and end of a program: `%`, M2, the end of the file.
use super::labels::Place;
use super::{Goal, Seeking, fetch, problems};
use crate::{At, Canon, Engine, Error, FileId, Missing, Problem, Sink, Start, Step, exec};
use std::sync::Arc;
use trunnion_syntax::TextRange;

impl Engine {
    /// Opens the program: blank lines and a first `%` are skipped.
    pub(super) fn begin(&mut self, sink: &mut dyn Sink) -> Option<Step> {
        exec::start(self, sink);
        let mut place = Place::default();
        let source = Arc::clone(&self.files[0]);
        loop {
            // empty lines at once, since a file may be nothing else
            let rest = &source.bytes()[place.offset as usize..];
            let empty = rest.iter().take_while(|byte| **byte == b'\n').count() as u32;
            place = place.further(empty, place.offset + empty);
            if place.offset as usize >= source.bytes().len() {
                let end = source.bytes().len() as u32;
                return Some(self.stop(&problems::NO_END_PERCENT, TextRange::new(end, end), sink));
            }
            let range = source.line_at(place.offset);
            if let Some(error) = fetch::too_long(range) {
                self.flow.at.line = place.line();
                return Some(self.stop(error.problem, error.range, sink));
            }
            let next = Self::behind(place, range);
            let text = fetch::trimmed(source.bytes(), range);
            if text.start == text.end {
                place = next;
                continue;
            }
            if fetch::is_percent(source.bytes(), range) {
                self.flow.percent = true;
                self.flow.here = next;
            }
            break;
        }
        self.emit(Canon::Reset, At::default(), sink);
        None
    }
    /// The last line is passed: the end of the program is missing, or the line that was searched.
    pub(super) fn end_of_file(&mut self, sink: &mut dyn Sink) -> Step {
        match self.flow.seeking {
            Some(Seeking {
                goal: Goal::Subprogram(name, _),
                opener,
                ..
            }) => {
                let file = self.flow.here.file();
                let from = if file == opener.file() { opener.line() + 1 } else { 0 };
                let name = self.flow.labels.text(name).to_owned();
                let searched = core::mem::take(&mut self.flow.searched);
                let detail = format!(
                    "EOF in file:{} seeking o-word: o<{name}> from line: {from}",
                    self.file_name(file)
                );
                let error = Error {
                    read_last: Some(self.last_line()),
                    missing: Some(Box::new(Missing { name, searched })),
                    ..Error::with(&problems::NOT_FOUND, self.written_range(opener), detail)
                };
                self.flow.at = self.flow.calls.last().map_or(self.flow.at, |call| call.site);
                self.abandon_call();
                self.refuse(&error, sink)
            }
            seeking => {
                if seeking.is_none() {
                    if self.enter_next_definition(0, sink) {
                        return self.step(sink);
                    }
                    if self.flow.entered > 0 {
                        self.flow.ended = true;
                        return Step::Ended;
                    }
                    if let Some(why) = self.only_subprograms() {
                        self.flow.ended = true;
                        return Step::Undecided(why);
                    }
                }
                let problem = match (self.flow.percent, seeking.is_some()) {
                    (true, _) => &problems::NO_END_PERCENT,
                    (false, true) => &problems::NO_STRUCTURE_END,
                    (false, false) => &problems::NO_END,
                };
                let range = match seeking {
                    Some(seeking) => {
                        self.flow.at = At {
                            file: seeking.opener.file(),
                            line: seeking.opener.line(),
                            chain: self.flow.chain,
                        };
                        self.written_range(seeking.opener)
                    }
                    None => self.last_range(),
                };
                self.flow.ended = true;
                let error = Error {
                    read_last: seeking.map(|_| self.last_line()),
                    ..Error::new(problem, range)
                };
                self.refuse(&error, sink);
                Step::Ended
            }
        }
    }
    /// The last line of the current file.
    fn last_line(&self) -> (FileId, TextRange) {
        let file = self.flow.here.file();
        let bytes = self.files[file.0 as usize].bytes();
        let end = bytes.len() - usize::from(bytes.ends_with(b"\n"));
        let start = memchr::memrchr(b'\n', &bytes[..end]).map_or(0, |before| before + 1);
        (file, TextRange::new(start as u32, end as u32))
    }
    /// A file that only defines subprograms is one that another program calls: in a check its missing end is not a mistake. Reports
    /// that, and makes the first definition the current line.
    fn only_subprograms(&mut self) -> Option<String> {
        let idle = self.flow.did == 0 && !self.flow.called && !self.flow.percent;
        let first = self.flow.defined.first().copied();
        let name = first.filter(|_| idle && self.setup.start == Start::Unknown)?;
        let place = self.flow.labels.subprogram(name)?.place;
        (self.flow.at.file, self.flow.at.line) = (place.file(), place.line());
        let name = self.flow.labels.text(name);
        Some(format!(
            "the program that calls o<{name}>: this file only defines it and runs nothing"
        ))
    }
    /// A line's text without blanks at its ends.
    fn written_range(&self, place: Place) -> TextRange {
        let bytes = self.files[place.file().0 as usize].bytes();
        let text = fetch::trimmed(bytes, self.range_at(place));
        let blanks = bytes[text.as_usize()]
            .iter()
            .take_while(|byte| byte.is_ascii_whitespace())
            .count() as u32;
        TextRange::new(text.start + blanks, text.end)
    }
    /// The last line that ran, or the end of the file.
    fn last_range(&self) -> TextRange {
        let here = self.flow.here;
        let at = self.flow.at;
        let source = &self.files[here.file().0 as usize];
        if at.file == here.file()
            && let Some(range) = source.line(at.line)
        {
            return fetch::trimmed(source.bytes(), range);
        }
        TextRange::new(here.offset, here.offset)
    }
    /// `%` while lines are skipped: the line that is searched does not follow.
    pub(super) fn percent_reached(&mut self, sink: &mut dyn Sink) -> Step {
        let (name, opener) = match self.flow.seeking {
            Some(Seeking { goal, opener, .. }) => {
                let name = match goal {
                    Goal::Label(_, name) => {
                        let sub = self.flow.labels.text(self.flow.sub);
                        format!("{sub}#{}", self.flow.labels.text(name))
                    }
                    Goal::Definition(name) | Goal::Subprogram(name, _) => self.flow.labels.text(name).to_owned(),
                };
                (name, opener)
            }
            None => (String::new(), self.flow.here),
        };
        let here = self.flow.here;
        let percent = (here.file(), self.range_at(here));
        self.finish(sink);
        let detail = format!("Failed to find sub 'O{name}' before EOF");
        let error = Error {
            read_last: Some(percent),
            ..Error::with(&problems::NOT_FOUND_PERCENT, self.written_range(opener), detail)
        };
        self.flow.at.file = opener.file();
        self.flow.at.line = opener.line();
        self.refuse(&error, sink);
        Step::Refused
    }
    /// The program ends with `%`.
    pub(super) fn finish(&mut self, sink: &mut dyn Sink) {
        self.flow.ended = true;
        let at = self.flow.at;
        self.emit(Canon::Finish, at, sink);
        self.flow.ended = !self.enter_next_definition(0, sink);
    }
    /// The program ends with M2, M30 or M99. Where it began with `%` the control misses the one at the end.
    pub(super) fn program_end(&mut self, sink: &mut dyn Sink) -> Step {
        self.flow.ended = true;
        self.flow.end = Some(Place::new(self.flow.at.file, self.flow.at.line, 0));
        if self.flow.percent && !self.percent_follows() {
            let text = b"interpreter: percent sign missing from end of file";
            let at = self.flow.at;
            self.emit(Canon::Comment(Arc::from(text.as_slice())), at, sink);
        }
        self.flow.ended = !self.enter_next_definition(1, sink);
        Step::Line
    }
    fn percent_follows(&self) -> bool {
        let here = self.flow.here;
        let bytes = &self.files[here.file().0 as usize].bytes()[here.offset as usize..];
        bytes.split(|&byte| byte == b'\n').any(|line| line.trim_ascii() == b"%")
    }
    /// The run ends with an error.
    fn stop(&mut self, problem: &'static Problem, range: TextRange, sink: &mut dyn Sink) -> Step {
        self.flow.ended = true;
        self.refuse(&Error::new(problem, range), sink);
        Step::Ended
    }
}
