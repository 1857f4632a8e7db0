//! A program run again, one leg at a time: text, dialect and machine in, legs out, nothing kept.
use crate::side::{Side, Told, of_fault, text};
use std::collections::VecDeque;
use trunnion_dialect::Dialect;
use trunnion_interp::{Fault, Interpreter, ModalState, Motion, Setup, Sink, ToolShape};
use trunnion_machine::{Follower, Leg, Machine};
use trunnion_syntax::{BlockId, Program};

/// Runs a program leg by leg.
pub(crate) struct Rerun<'a> {
    program: &'a Program,
    interpreter: Interpreter<'a>,
    next_block: u32,
    dialect: &'a Dialect,
    motions: u64,
    /// What the blocks that ran say beside their motions, in order; only those that say something.
    pub sides: Vec<Side>,
    legs: Legs<'a>,
}

/// A leg, and the ball it is made with.
pub(crate) struct Step {
    /// What the machine does.
    pub leg: Leg,
    /// Radius of the tool if it is declared to be a ball, mm.
    pub ball_radius: Option<f64>,
    /// Side of the cutter radius compensation: 0 off, 41, 42.
    pub compensation: u8,
    /// Name of the active work offset.
    pub work_offset: Option<std::sync::Arc<str>>,
}

/// Legs of the blocks that ran and were not fetched yet.
struct Legs<'a> {
    follower: Follower<'a>,
    waiting: VecDeque<Step>,
    /// Of the block that runs: it says more than its motions.
    whole: bool,
    unset: String,
}

impl Sink for Legs<'_> {
    fn motion(&mut self, motion: &Motion, state: &ModalState) {
        let leg = self.follower.follow(motion);
        let ball_radius = match state.tool_shape() {
            Some((ToolShape::Ball, diameter)) => Some(0.5 * diameter),
            _ => None,
        };
        self.whole |= leg.end.is_err();
        self.waiting.push_back(Step {
            leg,
            ball_radius,
            compensation: state.compensation,
            work_offset: state.work_offset.clone(),
        });
    }
    fn fault(&mut self, fault: Fault) {
        match of_fault(&fault.kind) {
            Told::Nothing => {}
            Told::Block => self.whole = true,
            Told::Unset(name) => {
                self.unset.push_str(&name);
                self.unset.push(' ');
            }
        }
    }
}

impl<'a> Rerun<'a> {
    /// At the program's start.
    pub(crate) fn new(program: &'a Program, dialect: &'a Dialect, machine: &'a Machine, setup: &Setup) -> Self {
        Self {
            program,
            interpreter: Interpreter::new(dialect, setup),
            next_block: 0,
            dialect,
            motions: 0,
            sides: Vec::new(),
            legs: Legs {
                follower: Follower::new(machine),
                waiting: VecDeque::new(),
                whole: false,
                unset: String::new(),
            },
        }
    }

    fn run(&mut self, block: BlockId) {
        self.interpreter.step(self.program, block, &mut self.legs);
        let side = Side {
            motions: self.motions,
            block,
            whole: std::mem::take(&mut self.legs.whole),
            unset: std::mem::take(&mut self.legs.unset),
        };
        self.motions += self.legs.waiting.len() as u64;
        if !text(self.program, self.dialect, &side).is_empty() {
            self.sides.push(side);
        }
    }
}

impl Iterator for Rerun<'_> {
    type Item = Step;

    fn next(&mut self) -> Option<Step> {
        while self.legs.waiting.is_empty() && (self.next_block as usize) < self.program.block_count() {
            let block = BlockId(self.next_block);
            self.next_block += 1;
            self.run(block);
        }
        self.legs.waiting.pop_front()
    }
}
