//! Calls and returns: `o... call`, `sub`, `endsub`, `return`; subprograms in separate files.
use super::labels::{NameId, Place, Style, Subprogram};
use super::oline::{Keyword, OLine};
use super::{Call, Compiled, Goal, Halt, Seeking, context, problems};
use crate::parameters::Values;
use crate::{Engine, Error, FileId, Limits, Sink, Source};
use std::sync::Arc;
use trunnion_formula::{Formula, ValueError, Variables};

/// Most arguments of a call.
const ARGUMENTS: usize = 30;

impl Engine {
    /// `o... call [..] ..`
    pub(super) fn call(
        &mut self,
        compiled: &mut Compiled,
        line: &OLine,
        name: NameId,
        sought: Option<&Seeking>,
    ) -> Result<(), Halt> {
        if sought.is_some() {
            // a call in the text of its own definition, which is skipped: as on the control its arguments are not evaluated
            self.flow.seeking = sought.copied();
            return Ok(());
        }
        let mut arguments = [0.0; ARGUMENTS];
        for (place, formula) in arguments.iter_mut().zip(&line.values) {
            *place = self.value(formula)?;
        }
        if let Some(flaw) = line.tail {
            return Err(Error::new(flaw.problem, flaw.range).into());
        }
        let given = &arguments[..line.values.len()];
        self.enter(compiled, line, name, Style::Sub, 1, Some(given))
    }
    /// Enters a subprogram: at its first line if that is known, to its file, or forward in this file until it is found.
    /// `arguments`: become #1 to #30, which are the call's own then; `None`: #1 to #30 are shared (M98).
    pub(super) fn enter(
        &mut self,
        compiled: &mut Compiled,
        line: &OLine,
        name: NameId,
        style: Style,
        rounds: i64,
        arguments: Option<&[f64]>,
    ) -> Result<(), Halt> {
        let most = self.setup.limits.depth.min(Limits::LINUXCNC_DEPTH);
        if self.flow.calls.len() + 1 >= most as usize {
            return Err(Self::refusal(&problems::TOO_DEEP, line));
        }
        self.flow.watch.stir();
        let known = self.flow.labels.subprogram(name);
        if let Some(known) = known
            && known.style != style
        {
            return Err(Self::refusal(wrong_style(known.style), line));
        }
        match arguments {
            Some(arguments) => self.store.enter(arguments),
            None => self.store.enter_sharing(),
        }
        let site = self.flow.at;
        let called_at = (compiled.place.file(), compiled.place.line());
        let chain = self.flow.chains.call(self.flow.chain, called_at, name, style);
        self.flow.calls.push(Call {
            back: self.flow.here,
            site,
            sub: self.flow.sub,
            style: self.flow.style,
            chain: self.flow.chain,
            body: known.map(|known| known.body),
            rounds,
            context: None,
        });
        self.flow.sub = name;
        self.flow.style = style;
        self.flow.called = true;
        self.flow.chain = chain;
        if rounds == 0 {
            // `M98 P1 L0`: as on the control the call is entered without going anywhere
            return Ok(());
        }
        if let Some(known) = known {
            self.flow.here = known.body;
            return Ok(());
        }
        if let Some(file) = self.load(name) {
            self.flow.here = Place::new(file, 0, 0);
        }
        self.flow.seeking = Some(Seeking {
            goal: Goal::Subprogram(name, style),
            opener: compiled.place,
            leaving: false,
            again: false,
            satisfied: false,
            fixed: false,
            known: false,
        });
        Ok(())
    }
    /// The file of a subprogram, if there is one.
    fn load(&mut self, name: NameId) -> Option<FileId> {
        self.flow.searched.clear();
        let files = self.setup.files.clone()?;
        let loaded = match files.load(self.flow.labels.text(name)) {
            Ok(loaded) => loaded,
            Err(searched) => {
                self.flow.searched = searched;
                return None;
            }
        };
        if u32::try_from(loaded.bytes.len()).is_err() {
            return None;
        }
        if let Some(known) = self.opened.get(&loaded.path) {
            return Some(*known);
        }
        let id = FileId(self.files.len() as u32);
        Arc::make_mut(&mut self.opened).insert(loaded.path.clone(), id);
        self.files.push(Arc::new(Source::new(loaded.path, loaded.bytes)));
        Some(id)
    }
    /// `o... sub`, and an O word alone.
    pub(super) fn sub(
        &mut self,
        compiled: &mut Compiled,
        line: &OLine,
        name: NameId,
        sought: Option<&Seeking>,
    ) -> Result<(), Halt> {
        self.flow.watch.stir();
        let style = if line.keyword == Keyword::Sub {
            Style::Sub
        } else {
            Style::Fanuc
        };
        let subprogram = Subprogram {
            style,
            place: compiled.place,
            body: compiled.next,
        };
        if let Some(seeking) = sought {
            let Goal::Subprogram(_, wanted) = seeking.goal else {
                return Ok(());
            };
            if wanted != style {
                self.abandon_call();
                return Err(Self::refusal(wrong_style(style), line));
            }
            self.flow.labels.define(name, subprogram);
            if let Some(call) = self.flow.calls.last_mut() {
                call.body = Some(compiled.next);
            }
            return Ok(());
        }
        if let Some(flaw) = line.tail {
            return Err(Error::new(flaw.problem, flaw.range).into());
        }
        let head_inside = style == Style::Sub || !self.flow.calls.is_empty();
        if head_inside && self.flow.style != style {
            return Err(Self::refusal(wrong_style(style), line));
        }
        if style == Style::Fanuc {
            return Ok(());
        }
        if let Some(known) = self.flow.labels.subprogram(name) {
            return Err(self.redefined(line, name, &known).into());
        }
        self.flow.labels.define(name, subprogram);
        self.flow.defined.push(name);
        self.begin_seeking(compiled, Goal::Definition(name));
        Ok(())
    }
    /// A subprogram whose name is taken.
    fn redefined(&mut self, line: &OLine, name: NameId, known: &Subprogram) -> Error {
        let (here, at) = (self.flow.at.file, self.line_number());
        let text = self.flow.labels.text(name).to_owned();
        let head = format!("File:{} line:{at}", self.file_name(here));
        let range = line.label_range.cover(line.keyword_range);
        let same = known.place.file() == here && known.place.line() + 1 == at;
        let error = if same {
            let detail = format!("{head} sub: o|{text}| found in illegal location");
            Error::with(&problems::ILLEGAL_PLACE, range, detail)
        } else {
            let other = self.file_name(known.place.file());
            let detail = format!("{head} redefining sub: o|{text}| already defined in file:{other}");
            Error::with(&problems::REDEFINED, range, detail)
        };
        // the run still does not enter the text of the subprogram
        self.flow.seeking = Some(Seeking {
            goal: Goal::Definition(name),
            opener: known.place,
            leaving: false,
            again: false,
            satisfied: false,
            fixed: false,
            known: false,
        });
        error
    }
    /// A file as the control names it.
    pub(super) fn file_name(&self, file: FileId) -> String {
        self.files[file.0 as usize].path.clone()
    }
    /// `o... endsub [..]`, `o... return [..]`
    pub(super) fn end_sub(&mut self, line: &OLine, sought: Option<&Seeking>, sink: &mut dyn Sink) -> Result<(), Halt> {
        let passed = matches!(sought, Some(seeking) if matches!(seeking.goal, Goal::Definition(_)));
        let value = line.values.first().map(|formula| {
            if passed {
                self.value_in_definition(formula)
            } else {
                self.value(formula)
            }
        });
        let value = value.transpose();
        if let Some(seeking) = sought {
            if line.keyword == Keyword::Return || matches!(seeking.goal, Goal::Subprogram(..)) {
                self.flow.seeking = sought.copied();
            }
            // the control sets the value while it reads the line, in a skip, too
            self.store.set_returned(value?);
            return Ok(());
        }
        if self.flow.calls.is_empty() {
            return self.end_sub_outside(line, value?);
        }
        let value = match (value, line.tail) {
            (Ok(value), None) => value,
            (value, flaw) => {
                // refused; the subprogram still ends here
                let error = match (value, flaw) {
                    (Err(error), _) => error,
                    (_, flaw) => flaw.map_or(Error::new(&problems::TAIL, line.label_range), |flaw| {
                        Error::new(flaw.problem, flaw.range)
                    }),
                };
                self.abandon_call();
                return Err(error.into());
            }
        };
        if self.flow.style == Style::Fanuc {
            self.abandon_call();
            return Err(Self::refusal(&problems::END_WITH_M99, line));
        }
        self.store.set_returned(value);
        self.leave_call(sink)
    }
    /// A value in a definition that is skipped: names that are not defined there are not a mistake, but have no value either.
    fn value_in_definition(&self, formula: &Formula) -> Result<f64, Error> {
        let value = formula.eval(&DefinitionValues(self.values()));
        value.map_err(|error| crate::read::formula_error(&error))
    }
    /// `endsub` and `return` in the main program.
    fn end_sub_outside(&mut self, line: &OLine, value: Option<f64>) -> Result<(), Halt> {
        if let Some(flaw) = line.tail {
            return Err(Error::new(flaw.problem, flaw.range).into());
        }
        if !self.flow.called {
            let detail = format!(
                "{}: not in a subroutine definition: '{}'",
                self.line_number(),
                self.line_text()
            );
            let range = line.label_range.cover(line.keyword_range);
            return Err(Error::with(&problems::NOT_IN_SUB, range, detail).into());
        }
        if self.flow.style == Style::Fanuc {
            return Err(Self::refusal(&problems::END_WITH_M99, line));
        }
        if line.keyword == Keyword::EndSub {
            return Err(Self::refusal(&problems::SEEKING_END, line));
        }
        self.store.set_returned(value);
        Ok(())
    }
    /// Back to the line after the call; what M73 saved is restored.
    pub(super) fn leave_call(&mut self, sink: &mut dyn Sink) -> Result<(), Halt> {
        let context = self.flow.calls.last_mut().and_then(|call| call.context.take());
        let turning = self.take_turning();
        self.abandon_call();
        if let Some(context) = context {
            context::restore_after_call(self, &context, sink)?;
        }
        if let Some(turning) = turning {
            self.finish_turning(*turning, sink)?;
        }
        Ok(())
    }
    /// Back to the line after the call, nothing else.
    pub(super) fn abandon_call(&mut self) {
        // a contour that is left by an error is lost
        self.take_turning();
        self.flow.watch.stir();
        let Some(call) = self.flow.calls.pop() else { return };
        self.store.leave();
        self.flow.here = call.back;
        self.flow.sub = call.sub;
        self.flow.chain = call.chain;
        self.flow.style = call.style;
        self.flow.seeking = None;
        self.flow.looping = false;
    }
}

/// The source of variables for formulas in a definition that is skipped.
struct DefinitionValues<'a>(Values<'a>);

impl Variables for DefinitionValues<'_> {
    fn numbered(&self, index: i64) -> Result<f64, ValueError> {
        self.0.numbered(index)
    }
    fn named(&self, name: &str) -> Result<f64, ValueError> {
        match self.0.named(name) {
            // observed: rs274 reads memory that was never written
            Err(ValueError::NotDefined) => Ok(f64::NAN),
            value => value,
        }
    }
    fn exists(&self, name: &str) -> bool {
        self.0.exists(name)
    }
}

/// The refusal of a call to a subprogram that is written in the other style.
fn wrong_style(written: Style) -> &'static crate::Problem {
    match written {
        Style::Sub => &problems::CALL_WITH_CALL,
        Style::Fanuc => &problems::CALL_WITH_M98,
    }
}
