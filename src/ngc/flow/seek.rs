//! Skipping: from a condition that does not hold, a `break`, a definition or a call to the line that counts next.
//!
//! The control looks at every line it skips: comments must be closed, N must be a number, O lines must have a known keyword. Only O
//! lines with the wanted label matter. Where a skip ended is kept with the line that began it, until a new label is known.
use super::fetch::{self, Head};
use super::glance;
use super::labels::Place;
use super::oline::{self, Keyword, OLine};
use super::{Compiled, Goal, Kind, Seeking, Why, problems};
use crate::{Engine, Error, read};
use trunnion_formula::Pool;
use trunnion_syntax::TextRange;

/// The result of a skip.
pub(super) enum SkipResult {
    /// A relevant line; `true`: it is kept.
    Landed(Box<Compiled>, Seeking, bool),
    /// A skipped line has an error.
    Refused(Error),
    /// A label depends on something unknown.
    Undecided(String),
    EndOfFile,
    /// `%` where the program began with one.
    Percent,
    OutOfFuel,
}

impl Engine {
    /// Begins to skip; `compiled` is the line that makes it necessary.
    pub(super) fn begin_seeking(&mut self, compiled: &mut Compiled, goal: Goal) -> &mut Seeking {
        let mut known = false;
        if let Some((generation, place)) = compiled.skip {
            known = generation == self.flow.labels.generation;
            if known {
                self.flow.here = place;
            } else {
                compiled.skip = None;
            }
        }
        self.flow.seeking.insert(Seeking {
            goal,
            opener: compiled.place,
            leaving: false,
            again: false,
            satisfied: false,
            fixed: true,
            known,
        })
    }
    /// Skips to the next relevant line.
    pub(super) fn seek(&mut self) -> SkipResult {
        let Some(mut seeking) = self.flow.seeking else {
            return SkipResult::EndOfFile;
        };
        if seeking.known {
            if self.flow.fuel == 0 {
                return SkipResult::OutOfFuel;
            }
            self.flow.seeking = None;
            self.flow.texts.skip();
            let (compiled, keep) = self.fetch();
            return SkipResult::Landed(compiled, seeking, keep);
        }
        loop {
            let counts = self.pass(&seeking);
            let place = self.flow.here;
            if place.offset as usize >= self.files[place.file().0 as usize].bytes().len() {
                return SkipResult::EndOfFile;
            }
            if self.flow.fuel == 0 {
                return SkipResult::OutOfFuel;
            }
            let lines = self.flow.lines(place.file());
            if lines.glance(place.line()) {
                self.flow.fuel -= 1;
            }
            let range = self.range_at(place);
            let next = Self::behind(place, range);
            if counts {
                self.landed(place, &seeking);
                let compiled = self.read(place, false);
                return SkipResult::Landed(compiled, seeking, false);
            }
            match self.glance(place, range, &mut seeking) {
                SkippedLine::Counts(line) => return self.land(place, next, *line, seeking),
                SkippedLine::Percent if self.flow.percent => return SkipResult::Percent,
                SkippedLine::Nothing | SkippedLine::Percent => self.flow.here = next,
                SkippedLine::Refused(error) => {
                    self.flow.here = next;
                    self.note(place);
                    return SkipResult::Refused(error);
                }
                SkippedLine::Undecided(why) => return SkipResult::Undecided(why),
            }
        }
    }
    /// The relevant line is made ready to run.
    fn land(&mut self, place: Place, next: Place, line: OLine, seeking: Seeking) -> SkipResult {
        self.landed(place, &seeking);
        let mut compiled = self.flow.texts.nowhere();
        compiled.place = place;
        compiled.next = next;
        compiled.kind = Kind::Label;
        compiled.only_sets = false;
        compiled.flaw = None;
        compiled.skip = None;
        compiled.o = Some(Box::new(line));
        SkipResult::Landed(compiled, seeking, false)
    }
    /// A skip ends at this line, which runs now.
    fn landed(&mut self, place: Place, seeking: &Seeking) {
        let generation = self.flow.labels.generation;
        if seeking.fixed {
            let opener = seeking.opener;
            let skip = Some((generation, place));
            self.flow.lines(opener.file()).skipped(opener.line(), skip);
        }
        self.flow.seeking = None;
        self.flow.texts.skip();
        self.flow.lines(place.file()).run(place.line());
    }
    /// Skips lines whose first characters show that they do not matter; returns whether the line after them does by its first characters.
    fn pass(&mut self, seeking: &Seeking) -> bool {
        let from = self.flow.here;
        let glanced = self.flow.lines(from.file()).glanced();
        let (wanted, global) = match seeking.goal {
            Goal::Label(_, wanted) => (wanted, false),
            Goal::Definition(wanted) | Goal::Subprogram(wanted, _) => (wanted, true),
        };
        let wanted = self.flow.labels.name_bytes(wanted);
        let bytes = self.files[from.file().0 as usize].bytes();
        // lines that were examined before cost time: they are the first ones
        let known = glanced.saturating_sub(from.line());
        let most = if self.flow.fuel < u64::from(known) {
            self.flow.fuel as usize
        } else {
            usize::MAX
        };
        let rest = bytes.get(from.offset as usize..).unwrap_or_default();
        let passed = glance::pass(rest, wanted, global, most);
        let lines = passed.lines as u32;
        self.flow.fuel -= u64::from(known.min(lines));
        if lines > 0 {
            self.flow.lines(from.file()).glance(from.line() + lines - 1);
        }
        self.flow.here = from.further(lines, from.offset + passed.length as u32);
        passed.counts
    }
    fn note(&mut self, place: Place) {
        self.flow.at = crate::At {
            file: place.file(),
            line: place.line(),
            chain: self.flow.chain,
        };
    }
    /// Examines one skipped line.
    fn glance(&mut self, place: Place, range: TextRange, seeking: &mut Seeking) -> SkippedLine {
        let file = std::sync::Arc::clone(&self.files[place.file().0 as usize]);
        let source = file.bytes();
        if let Some(error) = fetch::too_long(range) {
            return SkippedLine::Refused(error);
        }
        let text = fetch::trimmed(source, range);
        if text.start == text.end {
            return SkippedLine::Nothing;
        }
        if let Some(error) = fetch::text_flaw(source, text) {
            return SkippedLine::Refused(error);
        }
        let head = fetch::head(source, text);
        match head.first {
            _ if head.delete && self.setup.block_delete => SkippedLine::Nothing,
            Some(b'%') if fetch::is_percent(source, text) => SkippedLine::Percent,
            Some(b'o') => self.classify_label(&head, seeking),
            Some(b'm') => self.classify_call(place),
            _ => SkippedLine::Nothing,
        }
    }
    /// Examines a skipped line that begins with M: `M98` is read as a whole, as if it ran.
    fn classify_call(&mut self, place: Place) -> SkippedLine {
        let compiled = self.read(place, false);
        let refused = match compiled.kind {
            Kind::CallNumbered => self.skipped_call_flaw(&compiled),
            _ => None,
        };
        self.put_back(compiled, false);
        refused.map_or(SkippedLine::Nothing, SkippedLine::Refused)
    }
    /// Examines a skipped O line: whether it matters.
    fn classify_label(&mut self, head: &Head<'_>, seeking: &mut Seeking) -> SkippedLine {
        let mut cursor = head.cursor;
        let mut line = OLine::default();
        oline::read(&mut cursor, &mut Pool::default(), &mut line);
        if matches!(line.label, super::label::Label::Computed(_)) {
            seeking.fixed = false;
        }
        let definition = matches!(seeking.goal, Goal::Definition(_));
        let opens = matches!(line.keyword, Keyword::Sub | Keyword::Bare);
        let nested = || Error::new(&problems::NESTED_SUB, line.label_range.cover(line.keyword_range));
        let name = match self.name_of(&line).map_err(|halt| *halt.0) {
            Ok(name) => name,
            // observed: in a definition that is skipped a name may have no value
            Err(Why::Refused(error)) if definition && read::is_not_defined(&error) => {
                return if opens {
                    SkippedLine::Refused(nested())
                } else {
                    SkippedLine::Nothing
                };
            }
            Err(Why::Refused(error)) => return SkippedLine::Refused(error),
            Err(Why::Undecided(why)) => return SkippedLine::Undecided(why),
            Err(Why::Told | Why::Endless(_)) => return SkippedLine::Nothing,
        };
        if let Some(flaw) = line.flaw
            && flaw.problem == &problems::UNKNOWN_KEYWORD
        {
            if definition {
                return SkippedLine::Nothing;
            }
            return SkippedLine::Refused(Error::new(flaw.problem, flaw.range));
        }
        if line.keyword == Keyword::Bare && self.flow.no_fanuc {
            return SkippedLine::Refused(Error::new(&problems::FANUC_HEAD_OFF, line.label_range));
        }
        let is_global = line.keyword.is_global();
        let counts = match seeking.goal {
            Goal::Label(_, wanted) => !is_global && name == wanted,
            Goal::Definition(wanted) => {
                if opens {
                    return SkippedLine::Refused(nested());
                }
                is_global && name == wanted
            }
            Goal::Subprogram(wanted, _) => is_global && name == wanted,
        };
        if counts {
            SkippedLine::Counts(Box::new(line))
        } else {
            SkippedLine::Nothing
        }
    }
}

/// The kind of a skipped line.
enum SkippedLine {
    Nothing,
    Counts(Box<OLine>),
    Percent,
    Refused(Error),
    Undecided(String),
}
