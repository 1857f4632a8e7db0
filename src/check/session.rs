//! A program that stays open: check-points let any block be described without running the whole file again.
use crate::analysis::{CHECK_POINT_BLOCKS, analyse, declared};
use crate::{Report, Settings};
use core::ops::ControlFlow;
use trunnion_interp::{Fault, Interpreter, ModalState, Motion, Setup, Sink, directives};
use trunnion_machine::{Follower, Memory, Row, row};
use trunnion_syntax::{BlockId, Program};

/// What is known about one block.
#[derive(Clone, Debug)]
pub struct BlockInfo {
    /// In force before it.
    pub before: ModalState,
    /// In force after it.
    pub after: ModalState,
    /// What the machine does in it (empty without motion or machine).
    pub rows: Vec<Row>,
}

/// What is in force before a block.
#[derive(Clone)]
struct CheckPoint {
    state: ModalState,
    machine: Option<Memory>,
}

/// An analysed program with check-points (one each 1024 blocks).
#[derive(Clone)]
pub struct Session {
    /// The report.
    pub report: Report,
    setup: Setup,
    check_points: Vec<CheckPoint>,
}

impl Session {
    /// Checks and keeps check-points. `cancelled` is polled each 1024 blocks; `None` when it said true.
    pub fn new(program: &Program, settings: &Settings<'_>, cancelled: &dyn Fn() -> bool) -> Option<Self> {
        let mut check_points = Vec::new();
        let report = analyse(program, settings, &mut |_, interpreter, follower| {
            let machine = follower.map(Follower::memory);
            check_points.push(CheckPoint { state: interpreter.state.clone(), machine });
            if cancelled() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        })?;
        Some(Self { report, setup: declared(&settings.setup, &directives(program)), check_points })
    }

    /// Describes a block of the program the session was made of, with the same settings: at most 1024 blocks are run again.
    pub fn describe(&self, program: &Program, settings: &Settings<'_>, block: BlockId) -> BlockInfo {
        let mut interpreter = Interpreter::new(settings.dialect, &self.setup);
        let mut walk = Walk { follower: settings.machine.map(Follower::new), rows: Vec::new(), wanted: block };
        let at = (block.0 / CHECK_POINT_BLOCKS) as usize;
        if let Some(point) = self.check_points.get(at) {
            interpreter.state = point.state.clone();
            if let (Some(machine), Some(memory)) = (settings.machine, &point.machine) {
                walk.follower = Some(Follower::resume(machine, memory));
            }
        }
        let from = at as u32 * CHECK_POINT_BLOCKS;
        let last = block.0.min((program.block_count() as u32).saturating_sub(1));
        let mut before = interpreter.state.clone();
        for id in from..=last {
            if id == last {
                before = interpreter.state.clone();
            }
            if (id as usize) < program.block_count() {
                interpreter.step(program, BlockId(id), &mut walk);
            }
        }
        BlockInfo { before, after: interpreter.state, rows: walk.rows }
    }
}

/// Follows motions and keeps the rows of one block.
struct Walk<'m> {
    follower: Option<Follower<'m>>,
    rows: Vec<Row>,
    wanted: BlockId,
}

impl Sink for Walk<'_> {
    fn motion(&mut self, motion: &Motion, _state: &ModalState) {
        let Some(follower) = &mut self.follower else { return };
        let leg = follower.follow(motion);
        if motion.block == self.wanted {
            self.rows.push(row(follower.machine(), &leg));
        }
    }

    fn fault(&mut self, _fault: Fault) {}
}
