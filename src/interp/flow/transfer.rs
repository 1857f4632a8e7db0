//! What a block requests apart from its motion: jumps, loops, branches, repeated sections.
use super::{Index, Label, Level, Running, Transfer, index_of};
use crate::Sink;
use crate::iso::Iso;
use crate::macro_b::{Mistake, rejected};
use crate::{FaultKind, Refusal, sinumerik};
use std::sync::Arc;
use trunnion_flow::{Ends, Key, PendingCall, Search};
use trunnion_syntax::{BlockId, Program, TextRange};

/// So many repeated sections are open at most: a control has a few levels for them.
const MOST_OPEN: usize = 1000;

impl Iso<'_> {
    /// Targets of the jumps of the file that runs.
    pub(crate) fn sequence_numbers(&mut self, program: &Program) -> Arc<Index> {
        let (dialect, file) = (self.core.dialect, self.flow.file());
        match &mut self.flow.trail {
            Some(trail) => trail.index(file, || index_of(dialect, program)),
            None => Arc::new(index_of(dialect, program)),
        }
    }

    /// Does what the block `from` of the program that runs requests.
    pub(crate) fn transfer(&mut self, transfer: Transfer, running: &Running<'_>, from: u32, sink: &mut impl Sink) {
        match transfer {
            Transfer::Next => {}
            Transfer::End => self.stop(),
            Transfer::Jump(label, search) => self.jump_to_label(&label, search, running, from, sink),
            Transfer::Open(holds) => {
                let Some(index) = self.index(running) else { return };
                if let Some(trail) = &mut self.flow.trail {
                    trail.course.open_loop(from);
                }
                match index.loops.opened_by(from) {
                    Some(found) if !holds => self.jump(found.other.unwrap_or(found.close) + 1),
                    Some(_) => {}
                    None => self.broken(&index, running, from, sink),
                }
            }
            Transfer::Leave => {
                let Some(index) = self.index(running) else { return };
                match index.loops.divided_by(from) {
                    Some(found) => self.jump(found.close + 1),
                    None => self.broken(&index, running, from, sink),
                }
            }
            Transfer::Close => {
                let Some(index) = self.index(running) else { return };
                let changes = self.changes();
                match (index.loops.closed_by(from), &mut self.flow.trail) {
                    (Some(found), Some(trail)) => {
                        self.flow.next = trail.course.close_loop(self.flow.next, found.open, changes);
                    }
                    _ => self.broken(&index, running, from, sink),
                }
            }
            Transfer::Call(calling) => self.enter(calling, running, from, sink),
            Transfer::Return(back) => self.leave(back, running, from, sink),
            Transfer::Repeat { first, last, times } => self.repeat((first, last), times, running, from, sink),
        }
    }

    /// The index of the program that runs, whose section is known from then on.
    pub(crate) fn index(&mut self, running: &Running<'_>) -> Option<Arc<Index>> {
        let from = self.flow.next.saturating_sub(1);
        let (dialect, file) = (self.core.dialect, self.flow.file());
        let trail = self.flow.trail.as_mut()?;
        let index = trail.index(file, || index_of(dialect, running.program()));
        trail.course.section(|| index.section(from));
        Some(index)
    }

    fn jump_to_label(&mut self, label: &Label, search: Search, running: &Running<'_>, from: u32, sink: &mut impl Sink) {
        let Some(index) = self.index(running) else { return };
        let Some(section) = self.flow.trail.as_ref().and_then(|trail| trail.course.place().section) else {
            return;
        };
        let Some(to) = index.label(&label.key, from, section, search) else {
            if !label.may_miss {
                self.no_label(&label.key, search, label.range, running, from, sink);
            }
            return;
        };
        let several = search == Search::ForwardThenStart && index.all(&label.key, section).nth(1).is_some();
        if let (true, Key::Number(number)) = (several, &label.key) {
            let what = format!("which of the blocks N{number} a jump leads to: this program has several");
            self.tell_of_flow(running, from, (label.range, FaultKind::NotDecided { what }), sink);
            return self.stop();
        }
        if let Some(kind) = self.wrong_target(&index, &label.key, (from, to)) {
            self.tell_of_flow(running, from, (label.range, kind), sink);
            return self.stop();
        }
        if to <= from {
            self.jump_back(to);
        } else {
            self.jump(to);
        }
    }

    /// Why a jump is refused, or its outcome unknown.
    fn wrong_target(&self, index: &Index, label: &Key, (from, to): (u32, u32)) -> Option<FaultKind> {
        if !self.core.dialect.quirks.user_names() {
            index.loops.entered(from, to, |_| true)?;
            let Key::Number(number) = label else { return None };
            let message = format!("GOTO {number} jumps into a loop from outside: its DO has not run");
            return Some(rejected(
                self.core.dialect,
                Mistake::Unnumbered,
                Refusal::Structure,
                message,
            ));
        }
        let repeated = self.flow.trail.as_ref().and_then(|trail| trail.course.repeated());
        sinumerik::wrong_target(index, repeated, (from, to))
    }

    /// There is no such label.
    pub(crate) fn no_label(
        &mut self,
        label: &Key,
        search: Search,
        range: TextRange,
        running: &Running<'_>,
        from: u32,
        sink: &mut impl Sink,
    ) {
        let where_to = match search {
            Search::Forward => "after the jump, where GOTOF looks for it",
            Search::Backward => "before the jump, where GOTOB looks for it",
            _ => "in this program",
        };
        let message = match label {
            Key::Number(number) => format!("there is no block N{number} {where_to}"),
            Key::Name(name) => format!("there is no label {name} {where_to}"),
        };
        let kind = if self.core.dialect.quirks.user_names() {
            sinumerik::no_label(message, self.core.dialect.quirks.declares_names())
        } else {
            rejected(self.core.dialect, Mistake::NumberNotFound, Refusal::Label, message)
        };
        self.tell_of_flow(running, from, (range, kind), sink);
        self.stop();
    }

    /// The block belongs to an incomplete loop: the run ends. For Macro B the end of the run reports what is wrong in the main
    /// program's file.
    fn broken(&mut self, index: &Index, running: &Running<'_>, from: u32, sink: &mut impl Sink) {
        let told_at_end = self.core.dialect.quirks.macro_b() && running.called.is_none();
        let here = index
            .broken
            .iter()
            .find(|broken| broken.block == from && self.core.dialect.quirks.user_names());
        if let (false, Some(broken)) = (told_at_end, here.or(index.broken.first())) {
            let kind = rejected(
                self.core.dialect,
                broken.mistake,
                Refusal::Structure,
                broken.message.clone(),
            );
            self.tell_of_flow(running, from, (broken.range, kind), sink);
        }
        self.stop();
    }

    /// Continues at a block of the program that runs.
    pub(crate) fn jump(&mut self, to: u32) {
        let end = self.flow.next;
        if let Some(trail) = &mut self.flow.trail {
            trail.course.jump(end, to);
        }
        self.flow.next = to;
    }

    /// The same to a block before the jump.
    pub(crate) fn jump_back(&mut self, to: u32) {
        let (end, changes) = (self.flow.next, self.changes());
        if let Some(trail) = &mut self.flow.trail {
            trail.course.jump_back(end, to, changes);
        }
        self.flow.next = to;
    }

    /// A section of the program runs this many times; then the run continues here.
    fn repeat(
        &mut self,
        (first, last): (u32, u32),
        times: u32,
        running: &Running<'_>,
        from: u32,
        sink: &mut impl Sink,
    ) {
        if self.index(running).is_none() {
            return;
        }
        let (chain, back) = (self.core.chain, self.flow.next);
        let Some(trail) = &mut self.flow.trail else { return };
        if trail.course.depth() >= MOST_OPEN {
            let what = format!("more than {MOST_OPEN} repeated sections inside each other");
            let range = running.program().block(BlockId(from)).range();
            self.tell_of_flow(running, from, (range, FaultKind::NotDecided { what }), sink);
            return self.stop();
        }
        let place = trail.course.place();
        let going = PendingCall {
            from,
            back,
            file: place.file,
            start: first,
            section: place.section,
            times,
            ends: Ends::Section { last },
            level: Level::Section,
        };
        let range = super::call::main_range(running, from);
        trail
            .course
            .enter(going, chain, range, || super::call::frame_of(running, from));
        self.flow.next = first;
    }

    /// The last block of a repeated section has run: the section starts again, or the run continues after its REPEAT.
    pub(crate) fn section_ends(&mut self) {
        while let Some(trail) = &mut self.flow.trail
            && trail
                .course
                .repeated()
                .is_some_and(|(_, last)| self.flow.next == last + 1)
            && !self.core.state.ended
        {
            let end = self.flow.next;
            if let Some((start, _)) = trail.course.once_more() {
                self.memory.own.changes += 1;
                self.flow.next = trail.course.jump(end, start);
                return;
            }
            let Some(call) = trail.course.leave(end) else { return };
            self.flow.next = call.back;
        }
    }
}
