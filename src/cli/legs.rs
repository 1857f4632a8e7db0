//! Runs a program on its machine and hands on each motion with its joints and its line.
use super::load::{Loaded, not_followed};
use trunnion_interp::{Fault, ModalState, Motion, Setup, Sink};
use trunnion_machine::{Follower, Leg, Machine};
use trunnion_syntax::LineIndex;

/// The setup in which a linear axis that the program never names stands at 0: on a chain of linear axes path and time of the others are the
/// same wherever it is. What is shown of it is to be left out.
pub(super) fn flat_setup(loaded: &Loaded, machine: &Machine) -> Setup {
    let mut setup = loaded.resolved.setup.clone();
    setup.unnamed_stand = machine.rotary.is_empty();
    setup
}

/// Calls `take`, with the line and what is in effect, for each motion of the blocks between two lines (from 1, both included; `None`: of all), in the order of execution.
/// Returns why the run did not reach the end of the program, if it was stopped.
pub(super) fn each_leg(
    loaded: &Loaded,
    machine: &Machine,
    index: &LineIndex,
    lines: Option<(u32, u32)>,
    take: impl FnMut(&Leg, u32, &ModalState),
) -> Option<String> {
    each_leg_in(loaded, (machine, &loaded.resolved.setup), index, lines, take)
}

/// The same in another setup than that of the settings.
pub(super) fn each_leg_in(
    loaded: &Loaded,
    (machine, setup): (&Machine, &Setup),
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
    trunnion_interp::run(&loaded.program, loaded.resolved.dialect, setup, &mut legs);
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
