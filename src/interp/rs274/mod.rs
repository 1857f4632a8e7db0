//! Programs for LinuxCNC: run by its own interpreter (`trunnion-ngc`), whose canonical calls become motions.
mod bridge;
mod calls;
mod chords;
mod faults;
mod frames;
mod modal;
mod setup;

use crate::{AXIS_LETTERS, FaultKind, Frame, Interpreter, Sink};
use bridge::{Bridge, LINEAR_AXES, Told};
use frames::Shift;
use std::sync::Arc;
use trunnion_ngc::{ChainId, Engine, Source, Step};
use trunnion_syntax::{Address, BlockId, Program, TextRange};

/// A run between two lines.
#[derive(Clone)]
pub(crate) struct Rs274 {
    engine: Engine,
    told: Told,
    /// Nothing is left to run.
    done: bool,
}

/// The block that holds a line (from 0): the same number, but where a lone CR ends blocks and no lines.
fn block_of_line(program: &Program, line: u32) -> BlockId {
    let last = (program.block_count() as u32).saturating_sub(1);
    BlockId(line.min(last))
}

impl Rs274 {
    fn begin(program: &Program, interpreter: &Interpreter<'_>) -> Self {
        let told = setup::told(&interpreter.setup, &interpreter.memory.declared, interpreter.dialect);
        let source = Source::new(String::new(), program.source().into());
        Self {
            engine: Engine::new(Arc::new(source), &told),
            told: Told::default(),
            done: false,
        }
    }
    /// The calls of a chain.
    pub(crate) fn chain(&self, id: crate::ChainId) -> Vec<Frame> {
        let frames = self.engine.chain(ChainId(id.0)).into_iter();
        frames
            .map(|frame| Frame {
                file: self.engine.path(frame.file).to_owned(),
                line: frame.line + 1,
                what: frame.what,
                is_place: false,
            })
            .collect()
    }
}

impl Interpreter<'_> {
    /// Runs the next line of a LinuxCNC program; see [`Interpreter::advance`].
    pub(crate) fn advance_rs274(&mut self, program: &Program, sink: &mut impl Sink) -> Option<BlockId> {
        if program.block_count() == 0 {
            return None;
        }
        if !self.memory.directives_read {
            self.declare(program);
        }
        let mut run = match self.rs274.take() {
            Some(run) => run,
            None => Box::new(Rs274::begin(program, self)),
        };
        let block = if run.done {
            None
        } else {
            Some(self.step_rs274(&mut run, program, sink))
        };
        self.rs274 = Some(run);
        block
    }

    fn step_rs274(&mut self, run: &mut Rs274, program: &Program, sink: &mut impl Sink) -> BlockId {
        let Rs274 { engine, told, done } = run;
        let mut bridge = Bridge {
            interpreter: self,
            told,
            program,
            sink,
        };
        let step = engine.step(&mut bridge);
        let at = engine.at();
        let block = bridge.block(at);
        match step {
            Step::Line => {}
            Step::Refused => {
                forget(engine, bridge.told, &named_axes(program, block));
                bridge.refused_spindle(block);
            }
            Step::Ended => *done = true,
            Step::Undecided(what) => {
                bridge.fault(at, TextRange::default(), FaultKind::NotDecided { what });
                *done = true;
            }
            Step::OutOfFuel(opens) => {
                let blocks = bridge.interpreter.setup.limits.blocks;
                bridge.fault(opens, TextRange::default(), FaultKind::EndlessLoop { blocks });
                *done = true;
            }
        }
        bridge.radius_unset(&engine.state, at);
        if *done {
            engine.read_rest(&mut bridge);
            self.state.ended = true;
        }
        self.memory.last_content = Some(block);
        if std::mem::take(&mut told.lost) {
            forget(engine, told, &LINEAR_AXES);
        }
        if std::mem::take(&mut told.lost_rotary) {
            forget(engine, told, &[3, 4, 5]);
        }
        let shift = Shift::of(&engine.state);
        modal::refresh(&mut self.state, &engine.state, &shift);
        self.state.position = shift.coordinates(&engine.state.current);
        block
    }
}

/// Axes are not known any more.
fn forget(engine: &mut Engine, told: &mut Told, axes: &[usize]) {
    for &axis in axes {
        engine.state.current[axis] = f64::NAN;
        engine.state.compensated[axis] = f64::NAN;
        told.machine.forget(axis);
    }
}

/// Axes that a refused block names: the control would have stopped, so that nobody knows where they would be.
fn named_axes(program: &Program, block: BlockId) -> Vec<usize> {
    let letters = program.block(block).words().filter_map(|word| match word.address {
        Address::Letter(letter) => AXIS_LETTERS.iter().position(|axis| *axis == letter),
        _ => None,
    });
    letters.collect()
}
