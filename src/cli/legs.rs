//! Runs a program on its machine and hands on each motion with its joints and its line.
use super::load::{Loaded, not_followed};
use trunnion_interp::{Fault, ModalState, Motion, Sink};
use trunnion_machine::{Follower, Leg, Machine};
use trunnion_syntax::LineIndex;

/// Calls `take`, with the line and what is in effect, for each motion of the blocks between two lines (from 1, both included; `None`: of all), in the order of execution.
/// Returns why the run did not reach the end of the program, if it was stopped.
pub(super) fn each_leg(
    loaded: &Loaded,
    machine: &Machine,
    index: &LineIndex,
    lines: Option<(u32, u32)>,
    take: impl FnMut(&Leg, u32, &ModalState),
) -> Option<String> {
    let mut legs = Legs {
        loaded,
        index,
        follower: Follower::new(machine),
        lines,
        take,
        given_up: None,
    };
    let resolved = &loaded.resolved;
    trunnion_interp::run(&loaded.program, resolved.dialect, &resolved.setup, &mut legs);
    legs.given_up
}

struct Legs<'a, F> {
    loaded: &'a Loaded,
    index: &'a LineIndex,
    follower: Follower<'a>,
    lines: Option<(u32, u32)>,
    take: F,
    given_up: Option<String>,
}

impl<F: FnMut(&Leg, u32, &ModalState)> Sink for Legs<'_, F> {
    fn motion(&mut self, motion: &Motion, state: &ModalState) {
        let leg = self.follower.follow(motion);
        let program = &self.loaded.program;
        let start = program.block(motion.block).range().start;
        let line = self.index.line_column(program.source(), start).0;
        if self.lines.is_none_or(|(from, to)| (from..=to).contains(&line)) {
            (self.take)(&leg, line, state);
        }
    }
    fn fault(&mut self, fault: Fault) {
        self.given_up = self.given_up.take().or_else(|| not_followed(self.loaded, &fault));
    }
}
