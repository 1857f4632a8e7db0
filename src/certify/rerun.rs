//! A program run again, one leg at a time: text, dialect and machine in, legs out, nothing kept.
use crate::side::{Side, Told, of_fault, text};
use std::collections::VecDeque;
use trunnion_dialect::Dialect;
use trunnion_interp::{Fault, Interpreter, LengthOf, ModalState, Motion, MotionKind, Setup, Sink, ToolShape};
use trunnion_machine::{Follower, Leg, Machine};
use trunnion_syntax::{BlockId, LineIndex, Program};

/// More blocks that speak, without a motion between them, are not kept for comparison.
const MOST_SIDES: usize = 1_000_000;

/// Runs a program leg by leg.
pub(crate) struct Rerun<'a> {
    program: &'a Program,
    interpreter: Interpreter<'a>,
    /// Bit by bit: the blocks that ran.
    ran: Vec<u64>,
    dialect: &'a Dialect,
    motions: u64,
    /// What the blocks that ran say beside their motions, in order; only those that say something and are not compared yet.
    pub sides: VecDeque<Side>,
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
    /// Whose length is in force.
    pub length_of: LengthOf,
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
    /// Where and why the program is not followed to its end.
    broken: Option<(BlockId, String)>,
}

impl Sink for Legs<'_> {
    fn motion(&mut self, motion: &Motion, state: &ModalState) {
        let leg = self.follower.follow(motion);
        let ball_radius = match state.tool_shape() {
            Some((ToolShape::Ball, diameter)) => Some(0.5 * diameter),
            _ => None,
        };
        // where the posture is not settled, or the way between known ends is not known, the same text is all that can be said
        let no_way = matches!(motion.kind, MotionKind::Arc(None) | MotionKind::Unknown);
        self.whole |= leg.end.is_err() || leg.open.is_some() || no_way;
        self.waiting.push_back(Step {
            leg,
            ball_radius,
            compensation: state.compensation,
            length_of: state.length_of,
            work_offset: state.work_offset.clone(),
        });
    }
    fn fault(&mut self, fault: Fault) {
        match of_fault(&fault.kind) {
            Told::Nothing => {}
            Told::Block => self.whole = true,
            Told::End(why) => {
                self.whole = true;
                self.broken.get_or_insert((fault.block, why));
            }
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
            ran: vec![0; program.block_count().div_ceil(64)],
            dialect,
            motions: 0,
            sides: VecDeque::new(),
            legs: Legs {
                follower: Follower::new(machine),
                waiting: VecDeque::new(),
                whole: false,
                unset: String::new(),
                broken: None,
            },
        }
    }

    /// Whether a block of the program ran.
    pub(crate) fn has_run(&self, block: BlockId) -> bool {
        let word = self.ran.get(block.0 as usize / 64);
        word.is_some_and(|word| word >> (block.0 % 64) & 1 == 1)
    }

    /// Why the program was not followed to its end, with the line.
    pub(crate) fn broken(&self) -> Option<String> {
        let (block, why) = self.legs.broken.as_ref()?;
        let source = self.program.source();
        let start = self.program.block(*block).range().start;
        let (line, _) = LineIndex::new(source).line_column(source, start);
        Some(format!("line {line}: {why}"))
    }

    /// Runs the next block in the control's order; false at the end.
    fn run(&mut self) -> bool {
        if self.sides.len() > MOST_SIDES {
            let block = self.sides.back().map_or(BlockId(0), |side| side.block);
            let why = format!("more than {MOST_SIDES} blocks without a motion");
            self.legs.broken.get_or_insert((block, why));
            return false;
        }
        let Some(block) = self.interpreter.advance(self.program, &mut self.legs) else {
            return false;
        };
        if let Some(word) = self.ran.get_mut(block.0 as usize / 64) {
            *word |= 1 << (block.0 % 64);
        }
        let side = Side {
            motions: self.motions,
            block,
            whole: std::mem::take(&mut self.legs.whole),
            unset: std::mem::take(&mut self.legs.unset),
        };
        self.motions += self.legs.waiting.len() as u64;
        if !text(self.program, self.dialect, &side).is_empty() {
            self.sides.push_back(side);
        }
        true
    }
}

impl Iterator for Rerun<'_> {
    type Item = Step;

    fn next(&mut self) -> Option<Step> {
        while self.legs.waiting.is_empty() {
            if !self.run() {
                return None;
            }
        }
        self.legs.waiting.pop_front()
    }
}
