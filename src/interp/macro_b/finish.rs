//! The end of a run: blocks that never ran are still read, so that one mistake does not hide the others.
use super::Deep;
use super::alarms::rejected;
use super::read::{Macros, Mode};
use super::system::Kept;
use crate::Sink;
use crate::flow::{Trail, index_of};
use crate::iso::Iso;
use crate::reader::Reader;
use crate::words::Words;
use crate::{Clamps, Fault, FaultKind, Refusal};
use trunnion_syntax::{BlockId, Program, TextRange};

impl Iso<'_> {
    /// Nothing is left to run: reports what is missing, and what is wrong with the text of blocks that did not run.
    #[cold]
    pub(crate) fn end(&mut self, program: &Program, sink: &mut impl Sink) {
        if std::mem::replace(&mut self.flow.finished, true) {
            return;
        }
        self.finish(program, sink);
        let reads =
            self.core.dialect.quirks.macro_b() || self.core.dialect.quirks.user_names() && self.flow.trail.is_some();
        if !reads || !program.options().format.has_words() {
            return;
        }
        let next = self.flow.next;
        let mut trail = self.flow.trail.take();
        if let Some(trail) = &mut trail {
            trail.course.stop(next);
            self.broken_loops(program, trail, sink);
        }
        let blocks = program.block_count() as u32;
        let from = if trail.is_some() { 0 } else { next };
        if !ends_text(program, next.wrapping_sub(1)) {
            let ran = |block: u32| trail.as_ref().is_some_and(|trail| trail.course.has_run(block));
            let rest = (from..blocks).filter(|&block| !ran(block));
            self.read_only(program, rest, sink);
        }
        self.flow.trail = trail;
    }

    /// What is wrong with DO and END.
    fn broken_loops(&self, program: &Program, trail: &mut Trail, sink: &mut impl Sink) {
        if self.core.dialect.quirks.user_names() {
            // structures are searched while a program runs: one that is not reached is not a mistake
            return;
        }
        for broken in &trail.index(0, || index_of(self.core.dialect, program)).broken {
            let kind = rejected(
                self.core.dialect,
                broken.mistake,
                Refusal::Structure,
                broken.message.clone(),
            );
            sink.fault(Fault {
                place: None,
                block: BlockId(broken.block),
                range: broken.range,
                kind,
            });
        }
    }

    fn read_only(&mut self, program: &Program, blocks: impl Iterator<Item = u32>, sink: &mut impl Sink) {
        let mut codes = std::mem::take(&mut self.codes);
        let mut deep = Some(Box::<Deep>::default());
        // no variable has a value that is known
        if let Some(deep) = &mut deep {
            deep.variables.lose();
        }
        for at in blocks {
            if at > 0 && ends_text(program, at) {
                break;
            }
            codes.clear();
            let mut words = Words::default();
            let block = BlockId(at);
            let view = program.block(block);
            let mut reader = Reader {
                program,
                dialect: self.core.dialect,
                block,
                words: &mut words,
                codes: &mut codes,
                delete: None,
                clamps: (&mut Clamps::default(), &self.core.setup.control.clamp_codes),
                macros: self.core.dialect.quirks.macro_b().then_some(Macros {
                    mode: Mode::Text,
                    file: 0,
                    deep: &mut deep,
                    state: &self.core.state,
                    setup: &self.core.setup,
                    frames: &self.memory.frames,
                    kept: Kept::of(&self.memory),
                }),
                own: None,
                report: |range: TextRange, kind: FaultKind| {
                    if is_of_text(&kind) {
                        sink.fault(Fault {
                            place: None,
                            block,
                            range,
                            kind,
                        });
                    }
                },
            };
            for item in view.items() {
                reader.take(item);
            }
        }
        self.codes = codes;
    }
}

/// Whether a block is the `%` that ends the text: the first line that holds something begins it.
fn ends_text(program: &Program, block: u32) -> bool {
    if block as usize >= program.block_count() {
        return false;
    }
    let range = program.block(BlockId(block)).range();
    let begins = program.source()[..range.start as usize].trim_ascii().is_empty();
    !begins && program.bytes(range).trim_ascii_start().first() == Some(&b'%')
}

/// What the reader alone finds.
fn is_of_text(kind: &FaultKind) -> bool {
    matches!(
        kind,
        FaultKind::UnknownCode { .. } | FaultKind::UnknownWord | FaultKind::RepeatedWord | FaultKind::Rejected { .. }
    )
}
