//! Fanuc-style calls: `M98 P.. L..` and `M99`.
use super::labels::Style;
use super::{Compiled, Halt, Why, context, label, oline, problems};
use crate::exec::{self, After};
use crate::read;
use crate::{Block, Engine, Error, Sink};
use trunnion_formula::Name;

/// Bits of P and L.
const P_AND_L: u32 = 1 << (b'P' - b'A') | 1 << (b'L' - b'A');

impl Engine {
    /// `M98 P.. L..`: other words of the line are checked and have no effect, as on the control.
    pub(super) fn call_numbered(&mut self, compiled: &mut Compiled, sink: &mut dyn Sink) -> Result<After, Halt> {
        let Some(line) = compiled.o.take() else {
            return Ok(After::Go);
        };
        let mut block = self.block.take().unwrap_or_default();
        let result = self.numbered_target(compiled, &line, &mut block, sink);
        self.block = Some(block);
        let result = match result {
            Ok((number, rounds)) => {
                let name = self.flow.labels.name(&Name::new(&number.to_string()));
                self.store.set_returned(None);
                self.enter(compiled, &line, name, Style::Fanuc, rounds, None)
            }
            Err(halt) => Err(halt),
        };
        compiled.o = Some(line);
        result.map(|()| After::Go)
    }
    /// The subprogram's number, and how often it runs.
    fn numbered_target(
        &mut self,
        compiled: &Compiled,
        line: &oline::OLine,
        block: &mut Block,
        sink: &mut dyn Sink,
    ) -> Result<(i64, i64), Halt> {
        if self.flow.no_fanuc {
            return Err(Self::refusal(&problems::FANUC_CALL_OFF, line));
        }
        let evaluated = read::evaluate(&compiled.line, &self.values(), block);
        if !compiled.line.errors.is_empty() || evaluated.is_err() {
            let all = read::errors(&compiled.line, &self.values(), block);
            return Err(self.refuse_text(evaluated, &all, sink));
        }
        block.range = block.range.cover(line.keyword_range);
        let (number, rounds) = (block.word(b'P'), block.word(b'L'));
        let (p_range, l_range) = (block.range_of(b'P'), block.range_of(b'L'));
        // P and L belong to M98; other words must be correct by themselves
        block.given &= !P_AND_L;
        let Some(number) = number else {
            return Err(Self::refusal(&problems::NO_P, line));
        };
        exec::check(self, block)?;
        self.apply(&compiled.line, sink)?;
        for (value, letter) in [(number, 'P'), (rounds.unwrap_or(1.0), 'L')] {
            if value.is_nan() {
                let why = Self::undecided_word(letter, "which subprogram runs, and how many times,");
                return Err(Why::Undecided(why).into());
            }
        }
        let whole = |value: f64, range| match label::whole(value) {
            Some(number) => Ok(number),
            None => Err(Error::new(&problems::LABEL, range)),
        };
        let number = whole(number, p_range)?;
        let rounds = rounds.map_or(Ok(1), |rounds| whole(rounds, l_range))?;
        if rounds < 0 {
            return Err(Error::new(&problems::NEGATIVE_L, l_range).into());
        }
        Ok((number, rounds))
    }
    /// What is wrong with the words of an `M98` that is skipped, as far as its values are known.
    pub(super) fn skipped_call_flaw(&mut self, compiled: &Compiled) -> Option<Error> {
        if compiled.flaw.is_some() {
            return compiled.flaw.clone();
        }
        let mut block = self.block.take().unwrap_or_default();
        let result = self.skipped_call(compiled, &mut block);
        self.block = Some(block);
        result.err().filter(|error| error.problem != &read::UNDECIDED)
    }
    fn skipped_call(&self, compiled: &Compiled, block: &mut Block) -> Result<(), Error> {
        let range = compiled
            .o
            .as_ref()
            .map_or(compiled.line.range, |line| line.keyword_range);
        if self.flow.no_fanuc {
            return Err(Error::new(&problems::FANUC_CALL_OFF, range));
        }
        read::evaluate(&compiled.line, &self.values(), block)?;
        if let Some(error) = compiled.line.errors.first() {
            return Err(error.clone());
        }
        match block.word(b'P') {
            None => Err(Error::new(&problems::NO_P, range)),
            Some(number) if !number.is_nan() && label::whole(number).is_none() => {
                Err(Error::new(&problems::LABEL, block.range_of(b'P')))
            }
            Some(_) => Ok(()),
        }
    }
    /// `M99` inside a call: the next round, or back.
    pub(super) fn return_numbered(&mut self, compiled: &Compiled, sink: &mut dyn Sink) -> Result<After, Halt> {
        let (Some(line), Some(call)) = (&compiled.o, self.flow.calls.last_mut()) else {
            return Ok(After::Go);
        };
        if let Some(flaw) = line.tail {
            self.abandon_call();
            return Err(Error::new(flaw.problem, flaw.range).into());
        }
        let problem = match (self.flow.no_fanuc, self.flow.style) {
            (true, _) => Some(&problems::FANUC_RETURN_OFF),
            (_, Style::Sub) => Some(&problems::END_WITH_ENDSUB),
            _ => None,
        };
        if let Some(problem) = problem {
            self.abandon_call();
            return Err(Self::refusal(problem, line));
        }
        call.rounds -= 1;
        let (rounds, body) = (call.rounds, call.body);
        let Some(body) = body.filter(|_| rounds > 0) else {
            self.leave_call(sink)?;
            return Ok(After::Go);
        };
        // each round is a separate call: names are new, and what M73 saved is restored
        self.flow.here = body;
        let context = call.context.take();
        self.store.leave();
        self.store.enter_sharing();
        if let Some(context) = context {
            context::restore_after_call(self, &context, sink)?;
        }
        Ok(After::Go)
    }
}
