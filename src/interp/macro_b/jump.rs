//! What a block asks for beside its motion: jumps and loops.
use super::alarms::{Mistake, rejected};
use super::index::Index;
use super::run::Running;
use super::{Deep, Pending};
use crate::run::{Interpreter, Sink};
use crate::{Fault, FaultKind, Refusal};
use std::sync::Arc;
use trunnion_syntax::{BlockId, Program, TextRange};

impl Deep {
    /// Where jumps of a file may lead.
    pub(crate) fn index(&mut self, file: u16, program: &Program) -> Arc<Index> {
        let place = usize::from(file);
        if self.indexes.len() <= place {
            self.indexes.resize(place + 1, None);
        }
        let index = self.indexes[place].get_or_insert_with(|| Arc::new(Index::of(program)));
        Arc::clone(index)
    }
}

impl Interpreter<'_> {
    /// Sequence numbers of the file that runs.
    pub(crate) fn sequence_numbers(&mut self, program: &Program) -> Arc<Index> {
        match &mut self.flow.deep {
            Some(deep) => deep.index(deep.place.file, program),
            None => Arc::new(Index::of(program)),
        }
    }

    /// Does what the block `from` of the program that runs asks for.
    pub(crate) fn transfer(&mut self, pending: Pending, running: &Running<'_>, from: u32, sink: &mut impl Sink) {
        match pending {
            Pending::Stop => self.stop(),
            Pending::Goto(number, range) => self.jump_to_label(number, range, running, from, sink),
            Pending::Do(holds) => {
                let Some(index) = self.index(running) else { return };
                self.enter_loop(from);
                match index.opened_by(from) {
                    Some(found) if !holds => self.jump(found.close + 1),
                    Some(_) => {}
                    None => self.broken(&index, running, from, sink),
                }
            }
            Pending::End => {
                let Some(index) = self.index(running) else { return };
                match index.ended_by(from) {
                    Some(open) => {
                        self.jump_back(open);
                        if let Some(deep) = &mut self.flow.deep {
                            deep.again = Some(open);
                        }
                    }
                    None => self.broken(&index, running, from, sink),
                }
            }
            Pending::Call(calling) => self.enter(calling, running, from, sink),
            Pending::Return(label, range) => self.leave(label, range, running, from, sink),
        }
    }

    /// A loop that is not entered from its END begins to count.
    fn enter_loop(&mut self, open: u32) {
        if let Some(deep) = &mut self.flow.deep
            && deep.again.take() != Some(open)
        {
            deep.turns.remove(&(deep.place.file, open));
        }
    }

    /// The index of the program that runs, whose section is known from then on.
    fn index(&mut self, running: &Running<'_>) -> Option<Arc<Index>> {
        let from = self.flow.next.saturating_sub(1);
        let deep = self.flow.deep.as_mut()?;
        let index = deep.index(deep.place.file, running.program());
        deep.place.section.get_or_insert_with(|| index.section(from));
        Some(index)
    }

    fn jump_to_label(&mut self, number: u32, range: TextRange, running: &Running<'_>, from: u32, sink: &mut impl Sink) {
        let Some(index) = self.index(running) else { return };
        let Some(section) = self.flow.deep.as_ref().and_then(|deep| deep.place.section) else {
            return;
        };
        let Some(to) = index.label(number, from, section) else {
            return self.no_label(number, range, running, from, sink);
        };
        if index.enters_loop(from, to) {
            let message = format!("GOTO {number} leads into a loop from outside: its DO has not run");
            let kind = rejected(self.dialect, Mistake::Unnumbered, Refusal::Structure, message);
            self.tell_of_flow(running, from, (range, kind), sink);
            return self.stop();
        }
        if to <= from {
            self.jump_back(to);
        } else {
            self.jump(to);
        }
    }

    /// There is no such sequence number.
    pub(crate) fn no_label(
        &mut self,
        number: u32,
        range: TextRange,
        running: &Running<'_>,
        from: u32,
        sink: &mut impl Sink,
    ) {
        let message = format!("there is no block N{number} in this program");
        let kind = rejected(self.dialect, Mistake::NumberNotFound, Refusal::Label, message);
        self.tell_of_flow(running, from, (range, kind), sink);
        self.stop();
    }

    /// The block belongs to a loop that is not whole: the run ends. Of the main program's file the end tells what is wrong.
    fn broken(&mut self, index: &Index, running: &Running<'_>, from: u32, sink: &mut impl Sink) {
        if let (Some(_), Some(broken)) = (running.called, index.broken.first()) {
            let kind = rejected(self.dialect, broken.mistake, Refusal::Structure, broken.message.clone());
            self.tell_of_flow(running, from, (broken.range, kind), sink);
        }
        self.stop();
    }

    /// Goes on at a block of the program that runs.
    pub(crate) fn jump(&mut self, to: u32) {
        if let Some(deep) = &mut self.flow.deep
            && deep.place.file == 0
        {
            deep.ran.jump(self.flow.next, to);
        }
        self.flow.next = to;
    }

    /// Goes back to the block that opens a loop.
    pub(crate) fn jump_back(&mut self, to: u32) {
        if let Some(deep) = &mut self.flow.deep {
            let key = (deep.place.file, to);
            // loops beyond that are named by the block that ran last
            if deep.turns.len() < (1 << 16) || deep.turns.contains_key(&key) {
                let changes = deep.variables.changes;
                let turns = deep.turns.entry(key).or_default();
                if turns.count > 0 && turns.changes == changes {
                    // nothing that decides anything has changed: every further turn is the same
                    deep.endless = Some(key);
                }
                turns.count += 1;
                turns.changes = changes;
            }
        }
        self.jump(to);
    }

    /// The text of the program that runs is at its end, without M30 or M99.
    pub(crate) fn ran_out(&mut self, main: &Program, sink: &mut impl Sink) {
        self.state.ended = true;
        let Some(deep) = self.flow.deep.as_ref().filter(|deep| !deep.calls.is_empty()) else {
            return;
        };
        let (block, range) = match deep.place.file {
            0 => {
                let last = deep.place.section.map_or(0, |section| section.1.saturating_sub(1));
                (BlockId(last), main.block(BlockId(last)).range())
            }
            _ => (deep.place.main, deep.place.main_range),
        };
        let message = "the program that is called ends without M99".to_owned();
        let kind: FaultKind = rejected(self.dialect, Mistake::EndOfRecord, Refusal::ProgramEnd, message);
        sink.fault(Fault { block, range, kind });
        self.stop();
    }
}
