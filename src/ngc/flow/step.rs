//! One step: a line is fetched and run, or lines are skipped until one matters.
use super::labels::Place;
use super::oline::OLine;
use super::seek::SkipResult;
use super::{Compiled, Halt, Kind, Refused, Seeking, Why, problems};
use crate::exec::{self, After};
use crate::parameters::Values;
use crate::read;
use crate::{At, ChainId, Engine, Error, FileId, Frame, Sink, Step, comment};
use trunnion_formula::Formula;
use trunnion_syntax::TextRange;

impl Engine {
    /// Runs the next line in the control's order. After [`Step::Refused`] the next step continues as if the refused line had not
    /// been there; an `if` or `while` that was refused is entered once, so that the errors inside are found, too.
    pub fn step(&mut self, sink: &mut dyn Sink) -> Step {
        if self.flow.ended {
            return Step::Ended;
        }
        self.flow.refused = Refused::default();
        if !self.flow.started {
            self.flow.started = true;
            if let Some(step) = self.begin(sink) {
                return step;
            }
        }
        if self.flow.seeking.is_some() {
            return match self.seek() {
                SkipResult::Landed(compiled, seeking, keep) => self.finish_line(compiled, Some(seeking), keep, sink),
                SkipResult::Refused(error) => self.refuse(&error, sink),
                SkipResult::Undecided(why) => self.give_up(why),
                SkipResult::EndOfFile => self.end_of_file(sink),
                SkipResult::Percent => self.percent_reached(sink),
                SkipResult::OutOfFuel => self.out_of_fuel(),
            };
        }
        let here = self.flow.here;
        if here.offset as usize >= self.files[here.file().0 as usize].bytes().len() {
            return self.end_of_file(sink);
        }
        if let Some(step) = self.plain_line(sink) {
            return step;
        }
        let (compiled, keep) = self.fetch();
        if self.flow.fuel == 0 {
            self.put_back(compiled, keep);
            return self.out_of_fuel();
        }
        if compiled.only_sets && self.turning.is_none() {
            self.continue_after(&compiled);
            // what is refused is evaluated again by the general path
            if self.apply(&compiled.line, sink).is_ok() {
                self.put_back(compiled, keep);
                return Step::Line;
            }
        }
        self.finish_line(compiled, None, keep, sink)
    }
    /// The current line runs: the run is there, and continues after it.
    #[inline]
    fn continue_after(&mut self, compiled: &Compiled) {
        let place = compiled.place;
        self.flow.at = At {
            file: place.file(),
            line: place.line(),
            chain: self.flow.chain,
        };
        self.flow.ran = place;
        self.flow.here = compiled.next;
    }
    /// Runs to the end, to what cannot be decided, or to the bounds. With `stop`, it stops at the first refused line as the control does.
    pub fn run(&mut self, stop: bool, sink: &mut dyn Sink) -> Step {
        loop {
            match self.step(sink) {
                Step::Line => {}
                Step::Refused if !stop => {}
                other => return other,
            }
        }
    }
    /// The line the last step ran.
    pub fn at(&self) -> At {
        self.flow.at()
    }
    /// Bytes of a line (from 0) of a file; the one that ran last is at hand.
    pub(crate) fn line_range(&self, file: FileId, line: u32) -> Option<TextRange> {
        let source = self.files.get(file.0 as usize)?;
        let ran = self.flow.ran;
        if (ran.file(), ran.line()) == (file, line) {
            return Some(source.line_at(ran.offset));
        }
        source.line(line)
    }
    /// The calls of a chain, outermost first; empty for the main program.
    pub fn chain(&self, id: ChainId) -> Vec<Frame> {
        self.flow.frames(id)
    }
    /// The program has ended.
    pub fn ended(&self) -> bool {
        self.flow.ended
    }

    fn finish_line(
        &mut self,
        mut compiled: Box<Compiled>,
        sought: Option<Seeking>,
        keep: bool,
        sink: &mut dyn Sink,
    ) -> Step {
        self.continue_after(&compiled);
        if let Some(range) = compiled.cut.take() {
            sink.cut(range, self.flow.at);
        }
        let result = match sought {
            None => self.run_line(&mut compiled, sink),
            Some(seeking) => self.run_label(&mut compiled, Some(&seeking), sink),
        };
        match result {
            Ok(After::Go) => {
                self.put_back(compiled, keep);
                Step::Line
            }
            Ok(After::Ended) => {
                self.put_back(compiled, keep);
                self.program_end(sink)
            }
            Err(halt) => self.halted(halt, compiled, keep, sink),
        }
    }
    #[cold]
    fn halted(&mut self, halt: Halt, compiled: Box<Compiled>, keep: bool, sink: &mut dyn Sink) -> Step {
        let place = compiled.place;
        if matches!(*halt.0, Why::Refused(_) | Why::Told) {
            let source = self.files[place.file().0 as usize].bytes();
            let text = super::fetch::trimmed(source, self.range_at(place));
            self.flow.refused = Refused::of_line(&compiled, &source[text.as_usize()]);
        }
        self.put_back(compiled, keep);
        match *halt.0 {
            Why::Refused(error) => {
                // what follows does not run
                self.flow.ended |= error.abort().is_some();
                self.refuse(&error, sink)
            }
            Why::Told => Step::Refused,
            Why::Undecided(why) => self.give_up(why),
            Why::Endless(place) => {
                self.flow.ended = true;
                let opens = At {
                    file: place.file(),
                    line: place.line(),
                    chain: self.flow.chain,
                };
                Step::Endless(opens, self.setup.limits.blocks - self.flow.fuel)
            }
        }
    }
    fn run_line(&mut self, compiled: &mut Compiled, sink: &mut dyn Sink) -> Result<After, Halt> {
        if let Some(flaw) = &compiled.flaw {
            return Err(flaw.clone().into());
        }
        match compiled.kind {
            Kind::Blank => Ok(After::Go),
            Kind::Words => self.run_words(compiled, sink),
            Kind::Label => self.run_label(compiled, None, sink),
            Kind::CallNumbered => self.call_numbered(compiled, sink),
            Kind::ReturnNumbered if self.flow.calls.is_empty() => self.run_words(compiled, sink),
            Kind::ReturnNumbered => self.return_numbered(compiled, sink),
            Kind::Percent if self.flow.percent => {
                self.finish(sink);
                Ok(After::Go)
            }
            Kind::Percent => {
                let range = self.range_at(compiled.place);
                Err(Error::new(&problems::STRAY_PERCENT, range).into())
            }
        }
    }
    /// Words, assignments and comments: evaluated, checked, then the comment, then the block.
    fn run_words(&mut self, compiled: &Compiled, sink: &mut dyn Sink) -> Result<After, Halt> {
        let mut block = self.block.take().unwrap_or_default();
        let mut result = self.run_block(compiled, &mut block, sink);
        if result.is_ok() && self.turning.is_some() {
            result = self.call_contour(compiled, &block).and(result);
        }
        if let Err(halt) = &result {
            let not_modelled =
                matches!(&*halt.0, Why::Refused(error) if error.problem.class == crate::Class::NotModelled);
            let feed = compiled.line.words.iter().any(|word| word.letter == b'F');
            self.after_refusal(block.g[1], not_modelled, feed);
        }
        self.block = Some(block);
        result
    }
    /// What a refused line would have left active, so that the lines after it are judged as they were meant: they are run in the
    /// mode of its motion code and not in the one before, and its F is an unknown feed.
    #[cold]
    pub(super) fn after_refusal(&mut self, motion: i16, not_modelled: bool, feed: bool) {
        match motion {
            0 | 10 | 20 | 30 | 52 | 800 => self.state.motion = motion,
            code if code > 0 && not_modelled => self.state.unmodelled = Some(code.unsigned_abs().into()),
            code if code > 0 => self.state.unmodelled = Some(u32::MAX),
            _ => {}
        }
        if feed && self.state.feed_rate == 0.0 {
            self.state.feed_rate = f64::NAN;
        }
    }
    /// Records what a line with these values changes in the run, whether or not it succeeds.
    #[inline]
    pub(super) fn note_values(&mut self, block: &crate::Block, words: bool) {
        self.flow.did += u64::from(words && self.flow.calls.is_empty());
        if block.g[1] >= 0 {
            self.state.unmodelled = None;
        }
    }
    fn run_block(&mut self, compiled: &Compiled, block: &mut crate::Block, sink: &mut dyn Sink) -> Result<After, Halt> {
        let line = &compiled.line;
        let at = self.flow.at;
        if compiled.only_sets {
            // alone on its line there is nothing else to fail
            self.apply(line, sink)?;
            return Ok(After::Go);
        }
        self.flow.watch.stir();
        let evaluated = read::evaluate(line, &self.values(), block);
        self.note_values(block, !line.words.is_empty());
        if !line.errors.is_empty() || evaluated.is_err() {
            let all = read::errors(line, &self.values(), block);
            return Err(self.refuse_text(evaluated, &all, sink));
        }
        let contour = self.in_contour();
        if !contour && exec::choose_line(self, block) {
            self.apply(line, sink)?;
            comment::run(self, line, at, sink)?;
            return Ok(exec::line(self, block, at, sink)?);
        }
        exec::check(self, block)?;
        self.apply(line, sink)?;
        if contour {
            return self.contour_block(block);
        }
        comment::run(self, line, at, sink)?;
        if block.m[4] != 99 {
            return Ok(exec::execute(self, block, at, sink)?);
        }
        // M99 ends the main program like M2; after other words in a subprogram it is not a return
        let range = block.m_range(4);
        let inside = !self.flow.calls.is_empty();
        block.m[4] = if inside { -1 } else { 2 };
        let after = exec::execute(self, block, at, sink)?;
        if inside {
            return Err(Error::new(&problems::LATE_M99, range).into());
        }
        Ok(after)
    }
    /// Assignments take effect after the line, all at once. What the line reads and nothing has set is reported.
    pub(super) fn apply(&mut self, line: &read::Line, sink: &mut dyn Sink) -> Result<(), Error> {
        self.report_unset(line, sink);
        read::apply(self, line)
    }
    /// The source of variables for formulas at the current line.
    #[inline]
    pub(crate) fn values(&self) -> Values<'_> {
        Values::new(self)
    }
    /// The value of a formula.
    pub(super) fn value(&self, formula: &Formula) -> Result<f64, Error> {
        if let Some(number) = formula.number() {
            return Ok(number);
        }
        formula
            .eval(&self.values())
            .map_err(|error| read::formula_error(&error))
    }
    /// The value of a condition or count, which must be known.
    pub(super) fn decided(&self, formula: &Formula, line: &OLine) -> Result<f64, Halt> {
        let value = self.value(formula)?;
        if value.is_nan() {
            return Err(Why::Undecided(self.undecided(formula, line)).into());
        }
        Ok(value)
    }
    /// The words of a line are wrong: the error that the control gives comes first, then all others of the line.
    #[cold]
    pub(super) fn refuse_text(&mut self, evaluated: Result<(), Error>, all: &[Error], sink: &mut dyn Sink) -> Halt {
        let first = match (evaluated, all.first()) {
            (Err(error), _) if error.problem == &read::UNDECIDED => {
                return Why::Undecided(error.message().to_owned()).into();
            }
            (Err(error), _) => error,
            (Ok(()), Some(error)) => error.clone(),
            (Ok(()), None) => return Why::Told.into(),
        };
        if all.iter().any(|error| error.problem == &read::G_UNKNOWN) {
            // it may have been meant as a motion code
            self.state.unmodelled = Some(u32::MAX);
        }
        self.tell(&first, sink);
        for error in all.iter().filter(|error| error.range != first.range) {
            self.tell(error, sink);
        }
        Why::Told.into()
    }
    pub(super) fn tell(&mut self, error: &Error, sink: &mut dyn Sink) {
        self.flow.watch.stir();
        let at = self.flow.at;
        let error = Error {
            file: at.file,
            path: self.path(at.file).into(),
            ..error.clone()
        };
        sink.error(&error, at);
    }
    /// The words of the line that the last step refused.
    pub fn refused(&self) -> Refused {
        self.flow.refused
    }
    #[cold]
    pub(super) fn refuse(&mut self, error: &Error, sink: &mut dyn Sink) -> Step {
        self.tell(error, sink);
        Step::Refused
    }
    #[cold]
    fn give_up(&mut self, why: String) -> Step {
        self.flow.ended = true;
        Step::Undecided(why)
    }
    #[cold]
    fn out_of_fuel(&mut self) -> Step {
        self.flow.ended = true;
        Step::OutOfFuel(self.endless())
    }
    /// The line that opens what does not end: the innermost structure around the current line that has used half of the bound since it
    /// was entered; else the innermost call; else the line itself.
    fn endless(&self) -> At {
        let here = self.flow.here;
        let half = self.setup.limits.blocks / 2;
        let around = |place: Place| place.file() == here.file() && place.line() <= here.line();
        let heavy = self.flow.labels.structures().filter(|structure| {
            structure.opener != super::labels::Opener::If && around(structure.place) && structure.fuel >= half
        });
        let line = heavy.map(|structure| structure.place.line()).max();
        let chain = self.flow.chain;
        match (line, self.flow.calls.last()) {
            (Some(line), _) => At {
                file: here.file(),
                line,
                chain,
            },
            (None, Some(call)) => call.site,
            (None, None) => self.flow.at,
        }
    }
}
