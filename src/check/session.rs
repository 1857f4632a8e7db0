//! A program that stays open: check-points let any block be described without running the whole file again.
use crate::analysis::{CHECK_POINT_BLOCKS, analyse};
use crate::{Report, Settings};
use core::ops::ControlFlow;
use trunnion_interp::{Fault, Interpreter, ModalState, Motion, Sink};
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
    interpreter: Interpreter<'static>,
    machine: Option<Memory>,
}

/// An analysed program with check-points (one each 1024 blocks).
#[derive(Clone)]
pub struct Session {
    /// The report.
    pub report: Report,
    check_points: Vec<CheckPoint>,
}

impl Session {
    /// Checks and keeps check-points. `cancelled` is polled each 1024 blocks; `None` when it said true.
    pub fn new(program: &Program, settings: &Settings<'_>, cancelled: &dyn Fn() -> bool) -> Option<Self> {
        let mut check_points = Vec::new();
        let report = analyse(program, settings, &mut |interpreter, follower| {
            let machine = follower.map(Follower::memory);
            check_points.push(CheckPoint {
                interpreter: interpreter.clone(),
                machine,
            });
            if cancelled() {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        })?;
        Some(Self { report, check_points })
    }

    /// Describes a block of the program the session was made of, with the same settings: at most 1024 blocks are run
    /// again. A block behind the end is described as the last one.
    pub fn describe(&self, program: &Program, settings: &Settings<'_>, block: BlockId) -> BlockInfo {
        let end = program.block_count() as u32;
        let wanted = BlockId(block.0.min(end.saturating_sub(1)));
        let at = wanted.0 / CHECK_POINT_BLOCKS;
        let point = self.check_points.get(at as usize);
        let fresh = || Interpreter::new(settings.dialect, &settings.setup);
        let mut interpreter = point.map_or_else(fresh, |point| point.interpreter.clone());
        let from = if point.is_some() { at * CHECK_POINT_BLOCKS } else { 0 };
        let memory = point.and_then(|point| point.machine.as_ref());
        let follower = settings.machine.map(|machine| match memory {
            Some(memory) => Follower::resume(machine, memory),
            None => Follower::new(machine),
        });
        let mut walk = Walk {
            follower,
            rows: Vec::new(),
            wanted,
        };
        for id in (from..wanted.0).map(BlockId) {
            interpreter.step(program, id, &mut walk);
        }
        let before = interpreter.state.clone();
        if wanted.0 < end {
            interpreter.step(program, wanted, &mut walk);
        }
        BlockInfo {
            before,
            after: interpreter.state,
            rows: walk.rows,
        }
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
