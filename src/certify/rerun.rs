//! A program run again, one leg at a time: text, dialect and machine in, legs out, nothing kept.
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
    legs: Legs<'a>,
}

/// A leg, and the ball it is made with.
pub(crate) struct Step {
    /// What the machine does.
    pub leg: Leg,
    /// Radius of the tool if it is declared to be a ball, mm.
    pub ball_radius: Option<f64>,
}

/// Legs of the blocks that ran and were not fetched yet.
struct Legs<'a> {
    follower: Follower<'a>,
    waiting: VecDeque<Step>,
}

impl Sink for Legs<'_> {
    fn motion(&mut self, motion: &Motion, state: &ModalState) {
        let leg = self.follower.follow(motion);
        let ball_radius = match state.tool_shape() {
            Some((ToolShape::Ball, diameter)) => Some(0.5 * diameter),
            _ => None,
        };
        self.waiting.push_back(Step { leg, ball_radius });
    }
    fn fault(&mut self, _: Fault) {}
}

impl<'a> Rerun<'a> {
    /// At the program's start.
    pub(crate) fn new(program: &'a Program, dialect: &'a Dialect, machine: &'a Machine, setup: &Setup) -> Self {
        Self {
            program,
            interpreter: Interpreter::new(dialect, setup),
            next_block: 0,
            legs: Legs {
                follower: Follower::new(machine),
                waiting: VecDeque::new(),
            },
        }
    }
}

impl Iterator for Rerun<'_> {
    type Item = Step;

    fn next(&mut self) -> Option<Step> {
        while self.legs.waiting.is_empty() && (self.next_block as usize) < self.program.block_count() {
            let block = BlockId(self.next_block);
            self.next_block += 1;
            self.interpreter.step(self.program, block, &mut self.legs);
        }
        self.legs.waiting.pop_front()
    }
}
