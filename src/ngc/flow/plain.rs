//! Lines of words with plain numbers that run for the first time: most of every program.
use super::Refused;
use crate::exec::{self, After};
use crate::{At, Block, Engine, Error, Sink, Step, read};

impl Engine {
    /// Runs the line at `here` if it is plain and never ran before; `None` where the general path has to look at it.
    #[inline]
    pub(super) fn plain_line(&mut self, sink: &mut dyn Sink) -> Option<Step> {
        let here = self.flow.here;
        if !self.flow.lines(here.file()).is_new(here.line()) || self.turning.is_some() {
            return None;
        }
        let mut block = self.block.take().unwrap_or_default();
        let source = self.files[here.file().0 as usize].bytes();
        let Some(next) = read::plain(source, here.offset, &self.values(), &mut block) else {
            self.block = Some(block);
            return None;
        };
        if matches!(block.g[1], 700..=722) {
            // a turning cycle calls a subprogram
            self.block = Some(block);
            return None;
        }
        self.flow.lines(here.file()).run(here.line());
        self.flow.at = At {
            file: here.file(),
            line: here.line(),
            chain: self.flow.chain,
        };
        self.flow.ran = here;
        self.flow.here = here.further(1, next);
        let result = self.run_plain(&mut block, sink);
        if let Err(error) = &result {
            let not_modelled = error.problem.class == crate::Class::NotModelled;
            self.after_refusal(block.g[1], not_modelled, block.has(b'F'));
            self.flow.refused = Refused::of_block(&block);
        }
        self.block = Some(block);
        Some(match result {
            Ok(After::Go) => Step::Line,
            Ok(After::Ended) => self.program_end(sink),
            Err(error) => self.refuse(&error, sink),
        })
    }

    #[inline]
    fn run_plain(&mut self, block: &mut Block, sink: &mut dyn Sink) -> Result<After, Error> {
        self.flow.watch.stir();
        self.note_values(block, true);
        if exec::choose_line(self, block) {
            return exec::line(self, block, self.flow.at, sink);
        }
        exec::check(self, block)?;
        exec::execute(self, block, self.flow.at, sink)
    }
}
