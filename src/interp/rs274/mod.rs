//! Programs for LinuxCNC: run by its own interpreter (`trunnion-ngc`), whose canonical calls become motions.
mod bridge;
mod call_state;
mod calls;
mod chords;
mod effects;
mod faults;
mod feed;
mod frames;
mod handed;
mod line_effects;
mod modal;
mod offsets;
mod places;
mod setup;
mod steady;
mod stored;

use crate::core::Core;
use crate::engine::Engine;
use crate::written::Values;
use crate::{FaultKind, Frame, Sink};
use bridge::{Bridge, LINEAR_AXES};
use call_state::CallState;
use frames::Shift;
use std::sync::Arc;
use trunnion_dialect::Dialect;
use trunnion_ngc::{FileId, Source, Step};
use trunnion_syntax::{BlockId, Program, TextRange};

/// A run between two lines.
#[derive(Clone)]
pub(crate) struct Rs274 {
    engine: trunnion_ngc::Engine,
    calls: CallState,
    /// Nothing is left to run.
    done: bool,
}

/// The block in which each line (from 0) has its first word; `None` where blocks are lines. A lone CR ends blocks but not lines.
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
    fn begin(program: &Program, core: &Core<'_>) -> Self {
        let mut calls = setup::at_start(&core.setup, core.tools.declared(), core.dialect);
        // as for all controls, the blocks of the text itself are not counted
        calls.limits.blocks = calls.limits.blocks.saturating_add(program.block_count() as u64);
        let source = Source::shared(String::new(), program.shared_source());
        Self {
            engine: trunnion_ngc::Engine::new(Arc::new(source), &calls),
            calls: CallState {
                blocks: blocks_of_lines(program),
                ..CallState::default()
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
    /// Variables that keep their values after the program ends, as far as they are known.
    pub(crate) fn outliving(&self) -> Vec<(String, f64)> {
        self.engine.outliving()
    }
    /// The calls of a chain.
    pub(crate) fn chain(&self, id: crate::ChainId) -> Vec<Frame> {
        let place = self.calls.places.place(id);
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

/// The engine of LinuxCNC programs.
#[derive(Clone)]
pub(crate) struct Ngc<'d> {
    core: Core<'d>,
    /// Once begun.
    run: Option<Box<Rs274>>,
}

impl<'d> Ngc<'d> {
    /// At the start of a program.
    pub(crate) fn new(core: Core<'d>) -> Self {
        Self { core, run: None }
    }
}

impl<'d> Engine<'d> for Ngc<'d> {
    #[inline]
    fn core(&self) -> &Core<'d> {
        &self.core
    }
    fn core_mut(&mut self) -> &mut Core<'d> {
        &mut self.core
    }
    fn read_whole(&mut self, program: &Program) {
        self.core.declare(program);
        if self.run.is_none() && program.source().iter().any(|byte| *byte > b' ') {
            self.run = Some(Box::new(Rs274::begin(program, &self.core)));
        }
    }
    fn advance(&mut self, program: &Program, sink: &mut impl Sink) -> Option<BlockId> {
        self.read_whole(program);
        let mut run = self.run.take()?;
        let block = if run.done {
            None
        } else {
            self.step_rs274(&mut run, program, sink)
        };
        let at = run.engine.at();
        self.run = Some(run);
        if let Some(block) = block.filter(|_| self.core.effects.wanted()) {
            self.line_effect(program, block, at, sink);
        }
        block
    }
    fn resolved_text(&self, text: &str) -> String {
        crate::written::resolved(self, text)
    }
    fn chain(&self, chain: crate::ChainId) -> Vec<Frame> {
        self.run.as_ref().map_or_else(Vec::new, |run| run.chain(chain))
    }
    fn motions_wait(&self) -> bool {
        self.run.as_ref().is_some_and(|run| run.motions_wait())
    }
    fn cycle_work(&self) -> u64 {
        self.run.as_ref().map_or(0, |run| run.calls.curve_work.count())
    }
    fn copied(&self) -> usize {
        let run = self.run.as_ref();
        run.map_or(0, |run| run.engine.copied() + run.calls.places.copied())
    }
    fn variable(&self, text: &str) -> Option<f64> {
        self.run.as_ref()?.variable(text)
    }
    fn outliving(&self) -> Vec<(String, f64)> {
        self.run.as_ref().map_or_else(Vec::new, |run| run.outliving())
    }
}

impl Values for Ngc<'_> {
    fn dialect(&self) -> &Dialect {
        self.core.dialect
    }
    fn value(&self, text: &str) -> Option<f64> {
        self.variable(text).filter(|value| !value.is_nan())
    }
}

impl Ngc<'_> {
    fn hand_on(&mut self, sink: &mut impl Sink) {
        if let Some(run) = &mut self.run {
            // the next motion states again how many effects came before it
            run.calls.steady = None;
        }
        self.core.emit_effects(sink);
    }

    fn step_rs274(&mut self, run: &mut Rs274, program: &Program, sink: &mut impl Sink) -> Option<BlockId> {
        let Rs274 { engine, calls, done } = run;
        // a line of a file runs in a step after the one that opened it
        while calls.paths.len() < engine.file_count() {
            calls.paths.push(engine.path(FileId(calls.paths.len() as u32)).into());
        }
        let mut bridge = Bridge {
            core: &mut self.core,
            calls,
            program,
            sink,
        };
        if let Some(steady) = &mut bridge.calls.steady {
            steady.settled = false;
        }
        bridge.core.state.clamps.begin_block();
        let step = engine.step(&mut bridge);
        let at = engine.at();
        // after the last line nothing runs, and nothing in a program without any content
        let nothing_ran = matches!(step, Step::Ended);
        let block = bridge.block(at);
        let left = engine.left_spline(nothing_ran);
        if !left.is_empty() && !bridge.calls.spline_said {
            bridge.open_spline(left, at);
        }
        bridge.calls.spline_said = !left.is_empty();
        let ran = matches!(step, Step::Line);
        let in_main = (at.file == FileId::MAIN).then_some(block);
        bridge.calls.places.ran(at.chain, in_main);
        match step {
            Step::Line => {}
            Step::Refused => {
                let refused = engine.refused();
                let named: Vec<usize> = (0..9).filter(|axis| refused.axes & (1 << axis) != 0).collect();
                forget(engine, bridge.calls, &named);
                if refused.spindle {
                    bridge.core.state.spindle.lose();
                }
            }
            Step::Ended => *done = true,
            Step::Undecided(what) => {
                bridge.fault(at, TextRange::default(), FaultKind::NotDecided { what });
                *done = true;
            }
            Step::OutOfFuel(opens) => {
                let blocks = bridge.core.setup.limits.blocks;
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
            self.core.state.ended = true;
        }
        self.core.last_content = Some(block);
        let lost = [std::mem::take(&mut calls.lost), std::mem::take(&mut calls.lost_rotary)];
        let settled = calls.steady.as_ref().is_some_and(|steady| steady.settled);
        if ran && settled && lost == [false; 2] {
            return Some(block);
        }
        calls.steady = None;
        if lost[0] {
            forget(engine, calls, &LINEAR_AXES);
        }
        if lost[1] {
            forget(engine, calls, &[3, 4, 5]);
            self.core.state.clamps.lose();
        }
        let shift = Shift::of(&engine.state, &calls.g92, &calls.tool_offset);
        modal::refresh(&mut self.core.state, &engine.state, &shift);
        self.core.state.position = shift.coordinates(&engine.state.current);
        (!nothing_ran).then_some(block)
    }
}

/// Effects of the codes of a line that no canonical call shows.
#[derive(Default)]
struct Codes {
    /// M99.
    returns: bool,
    /// G10, G52, G53, G92: they are relative to the present position, or set the zero of coordinates.
    shifts: bool,
    /// It contains the machine's own codes.
    own: bool,
    /// G10 L11 is relative to the ninth coordinate system, which may not be declared.
    ninth: bool,
}

impl Codes {
    fn of(block: Option<&trunnion_ngc::Block>) -> Self {
        block.map_or_else(Self::default, |block| Self {
            returns: block.m_code(4) == Some(99),
            shifts: matches!(block.g_code(0), Some(100 | 520 | 530 | 920..=923)),
            own: !block.own.is_empty(),
            ninth: block.g_code(0) == Some(100) && block.word(b'L') == Some(11.0),
        })
    }
}

/// Axes become unknown.
fn forget(engine: &mut trunnion_ngc::Engine, calls: &mut CallState, axes: &[usize]) {
    for &axis in axes {
        engine.state.current[axis] = f64::NAN;
        engine.state.compensated[axis] = f64::NAN;
        calls.machine.forget(axis);
    }
}
