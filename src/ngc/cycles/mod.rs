//! Canned cycles (G73-G89), threads (G33, G33.1, G76), splines (G5-G5.3), turning cycles (G70-G72.2).
//!
//! Everything is emitted as the calls that `rs274` makes, in its order; the tests contain the programs they were compared with.
mod drill;
mod hole;
mod problems;
mod spline;
mod thread;
mod threading;
mod turning;

use crate::{At, Block, Engine, Error, Sink};
pub(crate) use spline::Spline;
pub(crate) use turning::Turning;

/// What a cycle needs available.
pub(super) struct Work<'a> {
    engine: &'a mut Engine,
    block: &'a Block,
    at: At,
    sink: &'a mut dyn Sink,
}

impl Work<'_> {
    /// Emits a call, which counts as a line: cycles in loops end as loops do.
    fn emit(&mut self, call: crate::Canon) {
        self.engine.flow.spend();
        self.engine.emit(call, self.at, self.sink);
    }
    /// Bytes of the motion code, or of the line where the code is modal.
    fn code_range(&self) -> trunnion_syntax::TextRange {
        if self.block.g[1] >= 0 {
            self.block.g_range(1)
        } else {
            self.block.range
        }
    }
    /// Refuses to continue when the bound on executed lines is reached.
    fn may_go_on(&self) -> Result<(), Error> {
        if self.engine.flow.is_spent() {
            return Err(self.refuse(&problems::MANY));
        }
        Ok(())
    }
    /// A refusal at the motion code.
    fn refuse(&self, problem: &'static crate::Problem) -> Error {
        Error::new(problem, self.code_range())
    }
    /// The spindle of `$`: it applies to this and the following threads.
    fn choose_spindle(&mut self, problem: &'static crate::Problem) -> Result<(), Error> {
        let Some(number) = self.block.spindle else {
            return Ok(());
        };
        if !self.engine.setup.has_spindle(number) {
            return Err(self.refuse(problem));
        }
        self.engine.state.chosen_spindle = number.unsigned_abs() as usize;
        Ok(())
    }
    /// The spindle whose state matters, and its direction: 0, 1, -1.
    fn turning(&self) -> (i32, i8) {
        let spindle = self.engine.state.chosen_spindle;
        (spindle as i32, self.engine.state.turning[spindle])
    }
}

/// Before a block does anything: G5.3 is not allowed with another motion.
pub(crate) fn check_between(block: &Block) -> Result<(), Error> {
    if matches!(block.g[0], 53 | 63) && block.g[1] >= 0 && block.g[1] != 52 {
        return Err(Error::new(&problems::NURBS_BETWEEN, block.g_range(1)));
    }
    Ok(())
}

/// Before a block does anything: the words that G76 cannot do without.
pub(crate) fn check_thread(block: &Block) -> Result<(), Error> {
    if block.motion == 760 {
        threading::check(block)?;
    }
    Ok(())
}

/// Runs a block whose motion code is a cycle or a special motion. `code` is ten times its number.
pub(crate) fn run(engine: &mut Engine, code: i16, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    let mut work = Work {
        engine,
        block,
        at,
        sink,
    };
    if block.g[1] >= 0 && !block.has_axes() && !matches!(code, 52 | 53 | 700..=722) {
        return Err(work.refuse(&problems::NO_AXES));
    }
    match code {
        330 => thread::synchronized(&mut work),
        331 => thread::rigid(&mut work),
        760 => threading::run(&mut work),
        50 => spline::cubic(&mut work),
        51 => spline::quadratic(&mut work),
        52 => spline::point(&mut work),
        53 => spline::finish(&mut work),
        700..=722 => turning::begin(&mut work, code),
        _ => drill::run(&mut work, code),
    }
}
