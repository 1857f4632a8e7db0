//! Programs for LinuxCNC: run by its own interpreter (`trunnion-ngc`), whose canonical calls become motions.
mod bridge;
mod calls;
mod chords;
mod faults;
mod feed;
mod frames;
mod modal;
mod places;
mod setup;
mod steady;

use crate::{FaultKind, Frame, Interpreter, Sink};
use bridge::{Bridge, LINEAR_AXES, Told};
use frames::Shift;
use std::sync::Arc;
use trunnion_ngc::{Engine, FileId, Source, Step};
use trunnion_syntax::{BlockId, Program, TextRange};

/// A run between two lines.
#[derive(Clone)]
pub(crate) struct Rs274 {
    engine: Engine,
    told: Told,
    /// Nothing is left to run.
    done: bool,
}

/// The block in which each line (from 0) has its first word; `None` where blocks are lines. A lone CR ends blocks and no lines.
fn blocks_of_lines(program: &Program) -> Option<std::sync::Arc<[u32]>> {
    let source = program.source();
    let lone = |at: usize| source.get(at + 1) != Some(&b'\n');
    if !memchr::memchr_iter(b'\r', source).any(lone) {
        return None;
    }
    let mut start = 0;
    let lines = source.split_inclusive(|byte| *byte == b'\n').map(|line| {
        let blanks = line.iter().take_while(|byte| byte.is_ascii_whitespace()).count();
        let first = start + blanks.min(line.len() - 1) as u32;
        start += line.len() as u32;
        program.block_at(first).unwrap_or_default().0
    });
    Some(lines.collect())
}

impl Rs274 {
    fn begin(program: &Program, interpreter: &Interpreter<'_>) -> Self {
        let told = setup::told(&interpreter.setup, &interpreter.memory.declared, interpreter.dialect);
        let source = Source::shared(String::new(), program.shared_source());
        Self {
            engine: Engine::new(Arc::new(source), &told),
            told: Told {
                blocks: blocks_of_lines(program),
                ..Told::default()
            },
            done: false,
        }
    }
    /// Whether compensation of the cutter radius may hold motions back.
    pub(crate) fn motions_wait(&self) -> bool {
        self.engine.state.side != trunnion_ngc::Side::Off && !self.done
    }
    /// The value of a parameter as it is written.
    pub(crate) fn variable(&self, text: &str) -> Option<f64> {
        self.engine.variable(text)
    }
    /// The calls of a chain.
    pub(crate) fn chain(&self, id: crate::ChainId) -> Vec<Frame> {
        let place = self.told.places.place(id);
        let calls = self.engine.chain(place.chain).into_iter();
        let mut frames: Vec<Frame> = calls
            .map(|frame| Frame {
                file: self.engine.path(frame.file).to_owned(),
                line: frame.line + 1,
                what: frame.what,
                is_place: false,
            })
            .collect();
        if place.file != FileId::MAIN {
            frames.push(Frame {
                file: self.engine.path(place.file).to_owned(),
                line: place.line + 1,
                what: self.engine.text_of(place.file, place.line),
                is_place: true,
            });
        }
        frames
    }
}

impl Interpreter<'_> {
    /// Runs the next line of a LinuxCNC program; see [`Interpreter::advance`].
    pub(crate) fn advance_rs274(&mut self, program: &Program, sink: &mut impl Sink) -> Option<BlockId> {
        let empty = || program.source().iter().all(|byte| *byte <= b' ');
        if self.rs274.is_none() && empty() {
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
            self.step_rs274(&mut run, program, sink)
        };
        self.rs274 = Some(run);
        block
    }

    fn step_rs274(&mut self, run: &mut Rs274, program: &Program, sink: &mut impl Sink) -> Option<BlockId> {
        let Rs274 { engine, told, done } = run;
        // a line of a file runs in a step after the one that opened it
        if told.paths.len() != engine.file_count() {
            told.paths = (0..engine.file_count() as u32)
                .map(|file| engine.path(FileId(file)).into())
                .collect();
        }
        let mut bridge = Bridge {
            interpreter: self,
            told,
            program,
            sink,
        };
        if let Some(steady) = &mut bridge.told.steady {
            steady.settled = false;
        }
        bridge.interpreter.state.clamps.begin_block();
        let step = engine.step(&mut bridge);
        let at = engine.at();
        // after the last line nothing runs, and nothing in a program without any content
        let nothing_ran = matches!(step, Step::Ended);
        let block = bridge.block(at);
        let ran = matches!(step, Step::Line);
        let in_main = (at.file == FileId::MAIN).then_some(block);
        bridge.told.places.ran(at.chain, in_main);
        match step {
            Step::Line => {}
            Step::Refused => {
                let refused = engine.refused();
                let named: Vec<usize> = (0..9).filter(|axis| refused.axes & (1 << axis) != 0).collect();
                forget(engine, bridge.told, &named);
                if refused.spindle {
                    bridge.interpreter.state.spindle_on = None;
                }
            }
            Step::Ended => *done = true,
            Step::Undecided(what) => {
                bridge.fault(at, TextRange::default(), FaultKind::NotDecided { what });
                *done = true;
            }
            Step::OutOfFuel(opens) => {
                let blocks = bridge.interpreter.setup.limits.blocks;
                let kind = FaultKind::EndlessLoop { blocks, proved: false };
                bridge.fault(opens, TextRange::default(), kind);
                *done = true;
            }
            Step::Endless(opens, blocks) => {
                let kind = FaultKind::EndlessLoop { blocks, proved: true };
                bridge.fault(opens, TextRange::default(), kind);
                *done = true;
            }
        }
        bridge.radius_unset(&engine.state, at);
        if *done {
            engine.read_rest(&mut bridge);
            self.state.ended = true;
        }
        self.memory.last_content = Some(block);
        let lost = [std::mem::take(&mut told.lost), std::mem::take(&mut told.lost_rotary)];
        let settled = told.steady.as_ref().is_some_and(|steady| steady.settled);
        if ran && settled && lost == [false; 2] {
            return Some(block);
        }
        told.steady = None;
        if lost[0] {
            forget(engine, told, &LINEAR_AXES);
        }
        if lost[1] {
            forget(engine, told, &[3, 4, 5]);
            self.state.clamps.lose();
        }
        let shift = Shift::of(&engine.state, &told.g92, &told.tool_offset);
        modal::refresh(&mut self.state, &engine.state, &shift);
        self.state.position = shift.coordinates(&engine.state.current);
        (!nothing_ran).then_some(block)
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
