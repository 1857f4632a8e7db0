//! Canned cycles, expanded into the motions that a control makes of them.
mod call_levels;
mod called;
mod called_feed;
mod contour;
mod data;
mod deep;
mod full;
mod groove;
mod hole;
mod levels;
mod modes;
mod pass;
mod pattern;
mod pocket;
mod repeat;
mod rough;
mod row;
mod steps;
mod thread;
mod way_down;

pub(crate) use called::HoleCall;
pub(crate) use data::{Hole, Stored};
pub(crate) use pattern::Pattern;
pub(crate) use repeat::{Kept, Repeated};
pub(crate) use row::is_row;

use crate::Argument;
use crate::codes::{BlockCodes, Found, not_modelled};
use crate::core::Report;
use crate::iso::Iso;
use trunnion_dialect::{Action, Code};

/// What a cycle keeps from block to block.
#[derive(Clone, Debug, Default)]
pub(crate) struct Cycle {
    /// The code as it is written, for messages.
    pub(crate) id: String,
    /// The direction that M3 or M4 programmed last.
    pub(crate) counter_clockwise: Option<bool>,
    /// M29: the taps that follow are rigid.
    pub(crate) rigid: bool,
    /// The spindle turned before a tap, and nothing but taps may have stopped it since.
    pub(crate) tapped: bool,
    /// Letters that the code reads (A is bit 0).
    pub(crate) letters: u32,
    /// Whether K or L counts the repeats.
    pub(crate) repeats: u8,
    /// Whether the code reads I, J, K as shifts or depths.
    pub(crate) reads: [bool; 3],
    /// G99: back to the R level, else to the level before the cycle.
    pub(crate) to_r: bool,
    /// M53 of an Okuma: back to the level that G71 gave.
    pub(crate) to_level: bool,
    /// That level, as a coordinate of the words.
    pub(crate) level: Stored,
    /// The position of the hole while the tool is off it by an unknown distance.
    pub(crate) hole_place: [Option<f64>; 2],
    /// Data of drilling cycles.
    pub(crate) hole: Hole,
    /// The cycle that runs after every motion (MCALL).
    pub(crate) call: Option<std::sync::Arc<HoleCall>>,
    /// Data of turning cycles of many cuts.
    pub(crate) kept: Kept,
    /// Data of turning cycles: end of the cut in X and Z, taper.
    pub(crate) pass: [Stored; 3],
}

impl Cycle {
    /// Whether its code reads a letter.
    fn reads_letter(&self, letter: u8) -> bool {
        self.letters & crate::unused::letter_bit(letter) != 0
    }
    /// The dwell at the bottom, seconds: P stays from cycle to cycle, and a cycle that does not read it does not wait.
    fn dwell(&self) -> Option<f64> {
        self.hole.dwell.filter(|_| self.reads_letter(b'P'))
    }
}

impl Cycle {
    /// What is kept for the blocks that follow; empty where that is nothing.
    pub(crate) fn data(&self, motion: Option<Action>) -> Vec<Argument> {
        let mut numbers: Vec<f64> = Vec::new();
        if motion.is_some_and(Action::is_hole_cycle) {
            numbers.extend(self.hole.numbers());
        }
        if motion.is_some_and(Action::is_pass_cycle) {
            numbers.extend(self.pass.iter().flat_map(|stored| stored.numbers()));
        }
        numbers.extend(self.kept.numbers());
        if self.to_level || self.level != Stored::Nothing {
            numbers.push(f64::from(u8::from(self.to_level)));
            numbers.extend(self.level.numbers());
        }
        let numbers = numbers.into_iter().map(|value| Argument::number("", value));
        numbers
            .chain(self.call.as_ref().map(|call| call.said.clone()))
            .collect()
    }
}

impl<'d> Iso<'d> {
    /// Begins a cycle whose motions are modelled.
    pub(crate) fn begin_cycle(&mut self, found: &Found<'d>) {
        let action = found.code.action;
        let in_cycle = self.core.state.motion.is_some_and(Action::is_hole_cycle);
        if !in_cycle {
            if self.core.state.motion != Some(Action::CannedCycle)
                && !self.core.state.motion.is_some_and(Action::is_pass_cycle)
            {
                self.memory.before_cycle = self.core.state.motion;
            }
            let position = self.core.state.position;
            let here = self.memory.frames.programmed(&position);
            let initial = self.drilling_axis().and_then(|axis| here.get(axis));
            self.memory.cycle.hole = Hole::from(initial);
        }
        if action.is_pass_cycle() && self.core.state.motion != Some(action) {
            self.memory.cycle.pass = [Stored::Nothing; 3];
        }
        let reads = |word: &str| found.code.words.iter().any(|known| known == word);
        let cycle = &mut self.memory.cycle;
        cycle.id.clone_from(&found.code.id);
        cycle.letters = crate::unused::letters(found.code);
        cycle.repeats = match (reads("L"), reads("K")) {
            (true, _) => b'L',
            // of an Okuma no source names a word for repeats
            (false, false) if self.core.dialect.quirks.user_task() => 0,
            (false, _) => b'K',
        };
        // what I and J of an Okuma do is not followed
        let depths = !self.core.dialect.quirks.user_task();
        cycle.reads = [
            reads("I") && depths,
            reads("J") && reads("I") && depths,
            reads("K") && reads("L"),
        ];
        self.core.state.motion = Some(action);
    }

    pub(crate) fn canned_cycle(&mut self, found: &Found<'d>, block: &mut BlockCodes, report: &mut Report<'_>) {
        not_modelled(found, report);
        self.memory.cycle.call = None;
        block.not_modelled = true;
        if !self
            .core
            .state
            .motion
            .is_some_and(|motion| motion == Action::CannedCycle || motion.is_hole_cycle())
        {
            self.memory.before_cycle = self.core.state.motion;
        }
        self.core.state.motion = Some(Action::CannedCycle);
    }

    /// Ends a cycle: where it belongs to the motion group (LinuxCNC) no motion code is in effect then, else the one before.
    pub(crate) fn cycle_off(&mut self, code: &Code) {
        self.memory.cycle.rigid = false;
        self.memory.cycle.call = None;
        let of_motion_group = code.group.is_some() && code.group.as_deref() == self.motion_group();
        if of_motion_group {
            self.core.state.motion = None;
        } else if self
            .core
            .state
            .motion
            .is_some_and(|motion| motion == Action::CannedCycle || motion.is_hole_cycle())
        {
            self.core.state.motion = self.memory.before_cycle;
        }
    }
}
