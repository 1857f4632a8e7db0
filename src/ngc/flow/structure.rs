//! O lines of structures: if, while, do, repeat and what belongs to them.
//!
//! Labels become known when their opening line runs and stay known: an `endwhile` that is reached again jumps back again, a repeat that
//! was left by `return` continues with the remaining rounds. That is what the control does.
use super::label::{Label, whole};
use super::labels::{LabelId, NameId, Opener, Structure};
use super::oline::{Keyword, OLine};
use super::{Compiled, Goal, Halt, Seeking, Why, problems};
use crate::exec::After;
use crate::{Engine, Error, Problem, Sink};
use trunnion_formula::Name;

impl Engine {
    /// Runs an O line; `sought`: it is where a skip ended.
    pub(super) fn run_label(
        &mut self,
        compiled: &mut Compiled,
        sought: Option<&Seeking>,
        sink: &mut dyn Sink,
    ) -> Result<After, Halt> {
        let Some(line) = compiled.o.take() else {
            return Ok(After::Go);
        };
        let result = self.run_o(compiled, &line, sought, sink);
        if result.is_err() {
            self.recover(compiled, &line, sought);
        }
        compiled.o = Some(line);
        result
    }
    fn run_o(
        &mut self,
        compiled: &mut Compiled,
        line: &OLine,
        sought: Option<&Seeking>,
        sink: &mut dyn Sink,
    ) -> Result<After, Halt> {
        let name = self.name_of(line)?;
        if let Some(flaw) = line.flaw {
            return Err(Error::new(flaw.problem, flaw.range).into());
        }
        if line.keyword == Keyword::Bare && self.flow.no_fanuc {
            return Err(Error::new(&problems::FANUC_HEAD_OFF, line.label_range).into());
        }
        match line.keyword {
            Keyword::Call => self.call(compiled, line, name, sought),
            Keyword::Sub | Keyword::Bare => self.sub(compiled, line, name, sought),
            Keyword::EndSub | Keyword::Return => self.end_sub(line, sought, sink),
            _ => self.run_structure(compiled, line, name, sought),
        }?;
        Ok(After::Go)
    }
    /// The name of a label.
    pub(super) fn name_of(&mut self, line: &OLine) -> Result<NameId, Halt> {
        match &line.label {
            Label::Number(number) => Ok(self.flow.labels.numbered(*number)),
            Label::Text(text) => Ok(self.flow.labels.name(text)),
            Label::Computed(formula) => {
                let value = self.decided(formula, line)?;
                let Some(number) = whole(value) else {
                    return Err(Error::new(&problems::LABEL, line.label_range).into());
                };
                Ok(self.flow.labels.name(&Name::new(&number.to_string())))
            }
        }
    }
    fn run_structure(
        &mut self,
        compiled: &mut Compiled,
        line: &OLine,
        name: NameId,
        sought: Option<&Seeking>,
    ) -> Result<(), Halt> {
        let label = self.flow.labels.label(self.flow.sub, name);
        let goal = Goal::Label(label, name);
        // the control computes the condition while it reads the line, before it asks whether the line is allowed here
        let value = match line.values.first() {
            Some(formula) => self.decided(formula, line)?,
            None => 0.0,
        };
        if let (Some(flaw), None) = (line.tail, sought) {
            return Err(Error::new(flaw.problem, flaw.range).into());
        }
        match line.keyword {
            Keyword::If => {
                self.open(compiled, line, label, Opener::If)?;
                if value == 0.0 {
                    self.begin_seeking(compiled, goal);
                }
            }
            Keyword::ElseIf | Keyword::Else => self.alternative(compiled, line, (label, goal), sought, value)?,
            Keyword::EndIf => {
                self.opened(line, label, &[Opener::If])?;
            }
            Keyword::While => {
                let opener = self.flow.labels.structure(label).map(|known| known.place);
                if sought.is_none()
                    && value != 0.0
                    && let Some(outermost) = self.find_endless(compiled.place, opener.unwrap_or(compiled.place))
                {
                    return Err(Why::Endless(outermost).into());
                }
                self.run_while(compiled, line, (label, goal), sought, value)?;
            }
            Keyword::EndWhile => {
                let structure = self.opened(line, label, &[Opener::While])?;
                // observed: a `break` out of a while loop is obeyed once more by the end of the next do loop
                self.flow.broken |= sought.is_some_and(|seeking| seeking.leaving && !seeking.again);
                if sought.is_none_or(|seeking| seeking.again) && !structure.once {
                    self.flow.here = structure.place;
                } else {
                    self.left(label);
                }
            }
            Keyword::Do => {
                self.flow.broken |= sought.is_some_and(|seeking| seeking.leaving && !seeking.again);
                let known = self.flow.labels.structure(label);
                if known.is_none_or(|known| known.place == compiled.place) {
                    self.open(compiled, line, label, Opener::Do)?;
                    self.flow.looping = true;
                }
            }
            Keyword::Repeat => self.repeat(compiled, line, (label, goal), value)?,
            Keyword::EndRepeat => {
                let structure = self.opened(line, label, &[Opener::Repeat])?;
                if sought.is_none() && !structure.once {
                    self.flow.here = structure.place;
                }
            }
            _ => self.leave(compiled, line, (label, goal), sought)?,
        }
        Ok(())
    }
    /// Registers a label at its opening line, which must be the only one.
    fn open(&mut self, compiled: &Compiled, line: &OLine, label: LabelId, opener: Opener) -> Result<(), Halt> {
        let fuel = self.flow.fuel;
        match self.flow.labels.structure_mut(label) {
            Some(known) if known.place != compiled.place => {
                let known = *known;
                Err(self.duplicate(line, &known).into())
            }
            Some(known) => {
                if known.fuel == 0 {
                    known.fuel = fuel;
                }
                Ok(())
            }
            None => {
                self.flow.labels.open(
                    label,
                    Structure {
                        opener,
                        place: compiled.place,
                        rounds: 0,
                        fuel,
                        once: false,
                    },
                );
                Ok(())
            }
        }
    }
    /// A loop is at its end: when it is reached again, it starts again.
    fn left(&mut self, label: LabelId) {
        self.flow.looping = false;
        if let Some(structure) = self.flow.labels.structure_mut(label) {
            structure.fuel = 0;
        }
    }
    /// The structure a line belongs to.
    fn opened(&mut self, line: &OLine, label: LabelId, openers: &[Opener]) -> Result<Structure, Halt> {
        match self.flow.labels.structure(label) {
            None => {
                let detail = format!("{}: undefined O-word label: '{}'", self.line_number(), self.line_text());
                Err(Error::with(&problems::UNDEFINED, line.label_range.cover(line.keyword_range), detail).into())
            }
            Some(known) if openers.contains(&known.opener) => Ok(*known),
            Some(known) => Err(self.mismatch(line, known).into()),
        }
    }
    fn alternative(
        &mut self,
        compiled: &mut Compiled,
        line: &OLine,
        (label, goal): (LabelId, Goal),
        sought: Option<&Seeking>,
        value: f64,
    ) -> Result<(), Halt> {
        self.opened(line, label, &[Opener::If])?;
        let satisfied = sought.is_none_or(|seeking| seeking.satisfied);
        let go = line.keyword == Keyword::Else || value != 0.0;
        if satisfied || !go {
            self.begin_seeking(compiled, goal).satisfied = satisfied;
        }
        Ok(())
    }
    fn run_while(
        &mut self,
        compiled: &mut Compiled,
        line: &OLine,
        (label, goal): (LabelId, Goal),
        sought: Option<&Seeking>,
        value: f64,
    ) -> Result<(), Halt> {
        if let Some(known) = self.flow.labels.structure(label)
            && known.opener == Opener::Do
        {
            let (place, once) = (known.place, known.once);
            let broken = core::mem::take(&mut self.flow.broken);
            if value != 0.0 && sought.is_none_or(|seeking| seeking.again) && !once && !broken {
                self.flow.here = place;
            } else {
                self.left(label);
            }
            return Ok(());
        }
        self.open(compiled, line, label, Opener::While)?;
        self.flow.looping = true;
        if value == 0.0 {
            self.left(label);
            self.begin_seeking(compiled, goal);
        }
        Ok(())
    }
    #[inline(never)]
    fn repeat(
        &mut self,
        compiled: &mut Compiled,
        line: &OLine,
        (label, goal): (LabelId, Goal),
        value: f64,
    ) -> Result<(), Halt> {
        // its rounds are not a parameter
        self.flow.watch.stir();
        self.open(compiled, line, label, Opener::Repeat)?;
        let fuel = self.flow.fuel;
        let Some(structure) = self.flow.labels.structure_mut(label) else {
            return Ok(());
        };
        if structure.rounds > 0 {
            structure.rounds -= 1;
        } else {
            structure.rounds = value.round_ties_even() as i64;
            structure.fuel = fuel;
        }
        self.flow.looping = structure.rounds > 0;
        if structure.rounds <= 0 {
            structure.rounds = 0;
            structure.fuel = 0;
            self.begin_seeking(compiled, goal);
        }
        Ok(())
    }
    /// `break`, `continue`; in a skip they have no effect.
    #[inline(never)]
    fn leave(
        &mut self,
        compiled: &mut Compiled,
        line: &OLine,
        (label, goal): (LabelId, Goal),
        sought: Option<&Seeking>,
    ) -> Result<(), Halt> {
        match self.flow.labels.structure(label) {
            Some(known) if !matches!(known.opener, Opener::While | Opener::Do) => {
                return Err(self.no_loop(line, known).into());
            }
            _ => self.opened(line, label, &[Opener::While, Opener::Do])?,
        };
        let fresh = (true, line.keyword == Keyword::Continue);
        let (leaving, again) = sought.map_or(fresh, |seeking| (seeking.leaving, seeking.again));
        let seeking = self.begin_seeking(compiled, goal);
        (seeking.leaving, seeking.again) = (leaving, again);
        Ok(())
    }
    /// After a refusal: structures are taken as opened and are run once, so that the lines inside are checked and their ends are not
    /// new errors.
    #[cold]
    fn recover(&mut self, compiled: &mut Compiled, line: &OLine, sought: Option<&Seeking>) {
        let opener = match line.keyword {
            Keyword::If => Opener::If,
            Keyword::While => Opener::While,
            Keyword::Do => Opener::Do,
            Keyword::Repeat => Opener::Repeat,
            _ => {
                // the search continues
                if self.flow.seeking.is_none() && line.keyword != Keyword::Bare {
                    self.flow.seeking = sought
                        .copied()
                        .filter(|seeking| !matches!(seeking.goal, Goal::Subprogram(..)));
                }
                return;
            }
        };
        let Ok(name) = self.name_of(line) else { return };
        let label = self.flow.labels.label(self.flow.sub, name);
        let place = compiled.place;
        let fuel = self.flow.fuel;
        let fresh = self
            .flow
            .labels
            .structure(label)
            .is_none_or(|known| known.place == place);
        if fresh {
            self.flow.labels.open(
                label,
                Structure {
                    opener,
                    place,
                    rounds: 0,
                    fuel,
                    once: true,
                },
            );
        }
    }

    #[cold]
    fn duplicate(&self, line: &OLine, known: &Structure) -> Error {
        let (number, text) = (self.line_number(), self.line_text());
        let first = known.place.line() + 1;
        let detail = if line.keyword == Keyword::If {
            format!("{number}: duplicate O-word label - already defined in line {first}: '{text}'")
        } else {
            format!("{number}: duplicate O-word label: '{text}' - defined in line {first}")
        };
        Error::with(&problems::DUPLICATE, line.label_range, detail)
    }
    #[cold]
    fn mismatch(&self, line: &OLine, known: &Structure) -> Error {
        let (number, text) = (self.line_number(), self.line_text());
        let (word, first) = (known.opener.word(), known.place.line() + 1);
        let detail = match line.keyword {
            Keyword::EndIf => {
                let label = self.scoped_text(line);
                format!("{number}: no matching label: '{label}' (found '{word}' in line {first}): '{text}'")
            }
            Keyword::ElseIf | Keyword::Else => {
                format!("{number}: no matching 'if' label: '{text}' (found '{word}' in line {first})")
            }
            _ => format!("{number}: no matching label: '{text}' (found '{word}' in line {first})"),
        };
        Error::with(&problems::MISMATCH, line.label_range.cover(line.keyword_range), detail)
    }
    #[cold]
    fn no_loop(&self, line: &OLine, known: &Structure) -> Error {
        let (number, text) = (self.line_number(), self.line_text());
        let (word, first) = (known.opener.word(), known.place.line() + 1);
        let detail = format!("{number}: no matching while/do label: '{text}' (found '{word}' in line {first})");
        Error::with(&problems::NO_LOOP, line.label_range.cover(line.keyword_range), detail)
    }
    /// The label as the control names it inside a subprogram.
    fn scoped_text(&self, line: &OLine) -> String {
        let label = match &line.label {
            Label::Number(number) => number.to_string(),
            Label::Text(text) => text.to_string(),
            Label::Computed(formula) => self.value(formula).ok().and_then(whole).unwrap_or(0).to_string(),
        };
        format!("{}#{label}", self.flow.labels.text(self.flow.sub))
    }
    /// Number of the line that runs, from 1.
    pub(super) fn line_number(&self) -> u32 {
        self.flow.at.line + 1
    }
    /// The line that runs, as written, without blanks at its end.
    pub(super) fn line_text(&self) -> String {
        let at = self.flow.at;
        let source = &self.files[at.file.0 as usize];
        let range = source.line(at.line).unwrap_or_default();
        String::from_utf8_lossy(source.bytes()[range.start as usize..range.end as usize].trim_ascii_end()).into_owned()
    }
    /// A refusal without details.
    #[cold]
    pub(super) fn refusal(problem: &'static Problem, line: &OLine) -> Halt {
        Error::new(problem, line.label_range.cover(line.keyword_range)).into()
    }
}
