//! The engine of ISO programs: its parts, and the order in which blocks run.
use crate::Sink;
use crate::codes::Found;
use crate::core::Core;
use crate::cycle_motions::CycleMotions;
use crate::engine::Engine;
use crate::flow::Flow;
use crate::frames::OffsetValues;
use crate::memory::Memory;
use crate::words::Words;
use crate::written::Values;
use trunnion_dialect::{Action, Dialect, Language};
use trunnion_syntax::{BlockId, Program};

/// The engine of all controls whose programs are blocks of words: Fanuc, Haas, grbl, ISO 6983, Sinumerik, Okuma.
#[derive(Clone)]
pub(crate) struct Iso<'d> {
    pub(crate) core: Core<'d>,
    pub(crate) memory: Memory<'d>,
    /// Codes of the current block: kept only for its storage.
    pub(crate) codes: Vec<Found<'d>>,
    pub(crate) flow: Flow,
    pub(crate) cycle_motions: CycleMotions,
}

impl<'d> Engine<'d> for Iso<'d> {
    #[inline]
    fn core(&self) -> &Core<'d> {
        &self.core
    }
    fn core_mut(&mut self) -> &mut Core<'d> {
        &mut self.core
    }
    #[inline]
    fn advance(&mut self, program: &Program, sink: &mut impl Sink) -> Option<BlockId> {
        if self.flow.finished || program.block_count() == 0 {
            return None;
        }
        if self.flow.trail.is_some() {
            return self.advance_deep(program, sink);
        }
        if !self.flow.follows {
            self.flow.next = self.flow.next.max(crate::leader(program, self.core.dialect));
            self.flow.follows = true;
        }
        let block = BlockId(self.flow.next);
        self.flow.next += 1;
        self.run_one(program, block, sink);
        if self.flow.deep.is_some() || self.memory.own.pending.is_some() {
            self.first_statement(program, block, sink);
        }
        if self.core.state.ended || self.flow.next as usize >= program.block_count() {
            self.end(program, sink);
        }
        Some(block)
    }
    fn copied(&self) -> usize {
        let memory = &self.memory;
        let waits = memory.compensation.copied() + memory.contours_reported.len();
        self.flow.copied() + memory.own.copied() + memory.frames.copied() + waits
    }
    fn returns_to_r(&self) -> bool {
        self.memory.cycle.to_r
    }
    fn turned(&self) -> Vec<f64> {
        let mut numbers = self.memory.frames.turned();
        let rounding = self.memory.own.contour.rounding;
        numbers.extend(Some(rounding).filter(|rounding| *rounding != 0.0));
        numbers
    }
    fn cycle_work(&self) -> u64 {
        self.cycle_motions.count()
    }
    fn cycle_data(&self) -> Vec<crate::Argument> {
        let mut data = self.memory.cycle.data(self.core.state.motion);
        data.extend(self.flow.deep.iter().flat_map(|deep| deep.modal_words()));
        data.extend(self.modal_task_data());
        data.extend(self.memory.travel.word());
        data.extend(
            self.memory
                .status
                .map(|status| crate::Argument::number("STAT", f64::from(status))),
        );
        let own = &self.memory.own;
        data.extend(self.memory.x_words.code().map(crate::Argument::code));
        data.extend(own.feed_group.data());
        let waiting = Some(own.splines.waiting()).filter(|waiting| *waiting > 0);
        data.extend(waiting.map(|points| crate::Argument::number("points of a spline", points as f64)));
        let polar = own.contour.numbers();
        data.extend(polar.map(|value| crate::Argument::number("", value)));
        data
    }
    fn known_variables(&self) -> Vec<crate::Argument> {
        let mut found = self.flow.all_variables();
        found.extend(self.memory.own.all());
        found
    }
    fn values_in(&self, text: &str) -> Vec<crate::Argument> {
        if self.core.dialect.quirks.user_names() {
            return self.memory.own.named_in(text);
        }
        let mut found = Vec::new();
        for argument in crate::written::values(text, |name| self.variable(name)) {
            let lost = matches!(argument.value, crate::Value::Text(_));
            let name = argument.name.trim_start_matches("where ").to_owned();
            found.push(argument);
            if lost {
                // it may still have the value from before it was lost
                found.extend(self.flow.known_variable(&name));
            }
        }
        found
    }
    fn resolved_text(&self, text: &str) -> String {
        crate::written::resolved(self, text)
    }
    fn chain(&self, chain: crate::ChainId) -> Vec<crate::Frame> {
        self.flow.chain(chain)
    }
    fn motions_wait(&self) -> bool {
        self.memory.compensation.is_busy() || self.memory.corners.is_busy()
    }
    fn variable(&self, text: &str) -> Option<f64> {
        self.flow.variable(text)
    }
    fn outliving(&self) -> Vec<(String, f64)> {
        let mut kept = self.flow.outliving(self.first_kept());
        kept.extend(self.memory.own.parameters());
        kept
    }
    fn outliving_texts(&self) -> Vec<(String, String)> {
        let vacant = self.flow.vacant(self.first_kept()).into_iter();
        vacant.map(|name| (name, "no value (vacant)".to_owned())).collect()
    }
}

impl Iso<'_> {
    /// The first common variable that keeps its value when the program ends: where it is not known which do, all count.
    fn first_kept(&self) -> u32 {
        if self.core.dialect.quirks.macros == trunnion_dialect::Macros::Fanuc {
            500
        } else {
            100
        }
    }

    /// A drilling cycle is in effect, and the dwell at its bottom has a decimal point, which Fanuc's P does not take.
    pub(crate) fn dwells_in_hole(&self, words: &Words) -> bool {
        let macros = self.core.dialect.quirks.macros == trunnion_dialect::Macros::Fanuc;
        macros
            && words.p.number().is_some_and(|p| p.has_point)
            && self.core.state.motion.is_some_and(Action::is_hole_cycle)
    }
}

impl Values for Iso<'_> {
    fn dialect(&self) -> &Dialect {
        self.core.dialect
    }
    fn value(&self, text: &str) -> Option<f64> {
        match self.core.dialect.quirks.language {
            Language::Sinumerik | Language::UserTask => self.memory.own.value(text.trim()),
            Language::Words | Language::MacroB | Language::Linuxcnc => {
                self.variable(text.trim()).filter(|value| !value.is_nan())
            }
        }
    }
}

impl<'d> Iso<'d> {
    /// At the start of a program.
    pub(crate) fn new(core: Core<'d>) -> Self {
        let mut engine = Self {
            core,
            memory: Memory::default(),
            codes: Vec::new(),
            flow: Flow::default(),
            cycle_motions: CycleMotions::default(),
        };
        engine.memory.own.is_task = engine.core.dialect.quirks.user_task();
        engine.memory.own.main_spindle = engine.core.setup.control.main_spindle;
        let setup = std::sync::Arc::clone(&engine.core.setup);
        engine.memory.own.take_declared(&setup.named_variables);
        let (name, key) = if engine.core.dialect.quirks.first_offset_at_start {
            (Some("G54".into()), "G54")
        } else {
            (None, crate::UNNAMED_ZERO)
        };
        if let Some(offset) = setup.work_offset(key) {
            engine.set_zero(name, OffsetValues::declared(offset.values));
        }
        engine.memory.tcp_used = engine.core.state.tool_axis.tcp() && setup.control.tcp_codes.is_some();
        engine
    }

    /// Whether the blocks so far ran one after the other, each for itself.
    pub(crate) fn is_straight(&self) -> bool {
        let trail = self.flow.trail.as_ref();
        trail.is_none_or(|trail| trail.follows_nothing()) && self.memory.passed_over.is_none() && !self.flow.finished
    }

    /// Runs one block, for callers that choose the blocks themselves.
    pub(crate) fn step(&mut self, program: &Program, block: BlockId, sink: &mut impl Sink) {
        self.flow.follows = false;
        if block.0 == 0 {
            self.memory.leader = crate::leader(program, self.core.dialect);
        }
        if block.0 < self.memory.leader {
            return;
        }
        self.run_one(program, block, sink);
    }

    #[inline]
    fn run_one(&mut self, program: &Program, block: BlockId, sink: &mut impl Sink) {
        self.core.declare(program);
        if !self.core.state.ended {
            self.step_iso(&program.block(block), sink);
        }
    }

    /// What is pending at the end of the text, and a missing program end.
    pub(crate) fn finish(&mut self, program: &Program, sink: &mut impl Sink) {
        if let Some(block) = self.core.last_content {
            self.put_out_rest(&program.block(block), sink);
        }
        self.core.missing_end(program, sink);
    }
}
