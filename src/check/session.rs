//! A program that stays open: check-points let any block be described without running the whole file again.
use crate::analysis::{Watch, judge};
use crate::pass::{Pass, PassMemory};
use crate::suppress::Suppressions;
use crate::{Report, Settings};
use core::ops::ControlFlow;
use trunnion_interp::{Fault, Interpreter, ModalState, Motion, ProgramRun, Sink};
use trunnion_machine::{Follower, Row, row};
use trunnion_syntax::{BlockId, Program};

/// At most this many blocks are run again to describe one, where a program of loops leaves no check-point nearer to it.
const MOST_AGAIN: u64 = 1_000_000;

/// A motion that is emitted late, because its end depends on a later one, is waited for this many blocks.
const LATE: u64 = 64;

/// What is known about one block.
#[derive(Clone, Debug)]
pub struct BlockInfo {
    /// In effect before it.
    pub before: ModalState,
    /// In effect after it.
    pub after: ModalState,
    /// What the machine does in it (empty without motion or machine), the first time it runs.
    pub rows: Vec<Row>,
    /// Whether it runs: false after the end of the program and where every path skips it. Then the states are those at the end.
    pub runs: bool,
    /// What it cost: blocks that ran again, and entries of lists that were copied.
    pub cost: u64,
    /// The values of variables before and after it.
    pub variables: Variables,
}

/// The run before and after a block, asked for variables.
#[derive(Clone)]
pub struct Variables(Box<[Interpreter<'static>; 2]>);

impl core::fmt::Debug for Variables {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        f.write_str("Variables")
    }
}

impl Variables {
    /// The value of a variable as it is written (`#1`, `#<name>`), before and after the block; NaN where it is unknown, `None` where
    /// there is none or it is vacant.
    pub fn value(&self, text: &str) -> [Option<f64>; 2] {
        [0, 1].map(|at| self.0[at].variable(text))
    }
}

/// What is in effect between two blocks.
#[derive(Clone)]
struct CheckPoint {
    /// How many blocks ran before.
    executed: u64,
    interpreter: Interpreter<'static>,
    pass: PassMemory,
}

/// An analysed program with check-points, 1024 executed blocks or more apart: where a run has named many labels, reported many faults or set many
/// variables, each check-point copies them, and they are as many blocks apart, so that all together take memory in proportion to the program.
#[derive(Clone)]
pub struct Session {
    /// The report.
    pub report: Report,
    check_points: Vec<CheckPoint>,
    order: Order,
    /// Rules that comments allow in the whole program.
    allowed: Vec<String>,
}

/// In which order the blocks ran for the first time.
#[derive(Clone)]
enum Order {
    /// Block after block; this many of them.
    Straight(u64),
    /// Block after block, of a part of the program: the first, and one past the last.
    Part(u64, u64),
    /// How many ran before it, for each block; `u64::MAX`: it never ran.
    First(Vec<u64>),
}

impl Order {
    /// How many blocks ran before the first run of a block, if it ran.
    fn of(&self, block: BlockId) -> Option<u64> {
        match self {
            Self::Straight(ran) => Some(u64::from(block.0)).filter(|at| at < ran),
            Self::Part(first, end) => Some(u64::from(block.0)).filter(|at| (first..end).contains(&at)),
            Self::First(first) => first.get(block.0 as usize).copied().filter(|at| *at != u64::MAX),
        }
    }
}

/// Keeps check-points while a program runs.
struct Keeper<'c> {
    program: &'c Program,
    check_points: Vec<CheckPoint>,
    order: Order,
    /// Some block ran for the first time since the last check-point: without, no further one is needed.
    news: bool,
    /// No check-point before so many blocks ran.
    next: u64,
    cancelled: &'c dyn Fn() -> bool,
}

impl Watch for Keeper<'_> {
    fn pause(&mut self, executed: u64, interpreter: &Interpreter<'static>, pass: &Pass<'_>) -> ControlFlow<()> {
        if (self.news && executed >= self.next) || executed == 0 {
            self.news = false;
            self.next = executed + interpreter.copied() as u64;
            let mut interpreter = interpreter.clone();
            if executed == 0 {
                // once, not for each of the first blocks that is described
                interpreter.reads_whole(self.program);
            }
            self.check_points.push(CheckPoint {
                executed,
                interpreter,
                pass: pass.memory(),
            });
        }
        if (self.cancelled)() {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    }

    fn ran(&mut self, executed: u64, block: BlockId, first: bool) {
        self.news |= first;
        match &mut self.order {
            Order::Straight(ran) if u64::from(block.0) == executed => *ran = executed + 1,
            Order::Straight(ran) => {
                let mut order: Vec<u64> = (0..*ran).collect();
                order.resize(self.program.block_count(), u64::MAX);
                self.order = Order::First(order);
                self.ran(executed, block, first);
            }
            Order::First(order) if first => {
                if let Some(at) = order.get_mut(block.0 as usize) {
                    *at = executed;
                }
            }
            Order::First(_) | Order::Part(..) => {}
        }
    }
}

impl Session {
    /// Checks and keeps check-points. `cancelled` is polled every 1024 executed blocks; `None` when it returned true.
    pub fn new(program: &Program, settings: &Settings<'_>, cancelled: &dyn Fn() -> bool) -> Option<Self> {
        let mut keeper = Keeper {
            program,
            check_points: Vec::new(),
            order: Order::Straight(0),
            news: false,
            next: 0,
            cancelled,
        };
        let report = judge(program, settings, &mut keeper)?;
        Some(Self {
            report,
            check_points: keeper.check_points,
            order: keeper.order,
            allowed: Suppressions::new(program, &trunnion_interp::directives(program)).of_program(),
        })
    }

    /// Describes a block of the program the session was made of, with the same settings, as it runs the first time: few
    /// blocks are run again, or a limited number if there are loops or many labels before it. A block after the end is described as
    /// the last one.
    pub fn describe(&self, program: &Program, settings: &Settings<'_>, block: BlockId) -> BlockInfo {
        let wanted = BlockId(block.0.min((program.block_count() as u32).saturating_sub(1)));
        let first = self.order.of(wanted);
        let wanted_at = first.unwrap_or(u64::MAX);
        let after = self.check_points.partition_point(|point| point.executed <= wanted_at);
        let point = self.check_points.get(after.wrapping_sub(1));
        let mut interpreter = point.map_or_else(|| settings.interpreter(), |point| point.interpreter.clone());
        let memory = point.and_then(|point| point.pass.follower());
        let follower = settings.machine.map(|machine| match memory {
            Some(memory) => Follower::resume(machine, memory),
            None => Follower::new(machine),
        });
        let mut walk = Walk {
            follower,
            rows: Vec::new(),
            wanted: None,
        };
        let from = point.map_or(0, |point| point.executed);
        for _ in from..wanted_at.min(from.saturating_add(MOST_AGAIN)) {
            if interpreter.advance(program, &mut walk).is_none() {
                break;
            }
        }
        let before = interpreter.clone();
        let copied = before.copied() as u64;
        walk.wanted = Some(wanted);
        let reached = first.is_some_and(|at| at - from <= MOST_AGAIN);
        let runs = reached && interpreter.advance(program, &mut walk) == Some(wanted);
        let after = interpreter.clone();
        for _ in 0..LATE {
            let waits = runs && walk.rows.is_empty() && interpreter.motions_wait();
            if !waits || interpreter.advance(program, &mut walk).is_none() {
                break;
            }
        }
        BlockInfo {
            before: before.state().clone(),
            after: after.state().clone(),
            rows: walk.rows,
            runs,
            cost: wanted_at.saturating_sub(from).min(MOST_AGAIN) + 3 * copied,
            variables: Variables(Box::new([before, after])),
        }
    }
}

mod part;
#[cfg(test)]
mod tests;

/// Follows motions and keeps the rows of one block.
struct Walk<'m> {
    follower: Option<Follower<'m>>,
    rows: Vec<Row>,
    wanted: Option<BlockId>,
}

impl Sink for Walk<'_> {
    fn motion(&mut self, motion: &Motion, _state: &ModalState) {
        let Some(follower) = &mut self.follower else { return };
        let leg = follower.follow(motion);
        if self.wanted == Some(motion.block) {
            self.rows.push(row(follower.machine(), &leg));
        }
    }

    fn fault(&mut self, _fault: Fault) {}
    fn reads_faults(&self) -> bool {
        false
    }
}
