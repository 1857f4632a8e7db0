//! HEIDENHAIN Klartext blocks to motions.
//!
//! Sources: HEIDENHAIN TNC 640 user's manuals 34059x (Klartext and DIN/ISO programming, cycles); TNC 410 and TNC 407 for approach and
//! departure. What they leave open is unknown by name.
mod approach;
mod arcs;
mod axial;
mod calls;
mod contradiction;
mod corner;
mod datum;
mod drill;
mod effects;
mod flow;
mod fn_block;
mod formula;
mod hole;
mod labels;
mod machine_motion;
mod old_cycle;
mod path;
mod path_words;
mod pattern;
mod plane;
mod plane_shift;
mod positioning;
mod reason;
mod scaling;
mod seen;
mod sentence;
mod shape;
mod stray;
mod tool;
mod trans_datum;
mod values;
mod words;

use crate::core::{Core, Report};
use crate::cycle_motions::CycleMotions;
use crate::engine::Engine;
use crate::frames::{Frames, Tilted};
use crate::reported::Reported;
use crate::{Fault, FaultKind, LengthOf, Motion, Position, Sink};
use flow::{Flow, Request};
use std::sync::Arc;
use trunnion_geometry::Vec3;
use trunnion_syntax::{BlockId, Program, TextRange};
use values::Parameters;
pub use words::{SentenceWord, sentence_words};

/// A motion in the coordinates of the tilted plane that was active when it was made.
#[derive(Clone, Debug)]
pub(crate) struct Made {
    motion: Motion,
    tilt: Option<Tilted>,
}

/// What the language keeps between blocks in addition to the modal state.
#[derive(Clone, Debug, Default)]
pub(crate) struct Memory {
    parameters: Parameters,
    frames: Frames,
    /// Angle of cycle 10, deg.
    rotation: f64,
    /// Why coordinates say nothing.
    lost: reason::Reasons,
    /// What cycles 11 and 26 have set.
    scales: scaling::Scales,
    /// Cycle 7 has shifted in a plane of zero angles: before a plane that turns, or inside one.
    level_shift: bool,
    /// X Y Z that cycle 7 has given since then.
    shifted: u16,
    /// The shift of some axis is not known, until each of X, Y, Z is given anew.
    shift_unknown: bool,
    /// Rotary axes whose zero is unknown: by a shift, by a preset.
    turned: [u16; 2],
    /// CC: coordinates of the pole, and whether there was one.
    pole: [Option<f64>; 3],
    has_pole: bool,
    /// The plane of the two coordinates that CC gave; `None`: that of the tool axis.
    pole_plane: Option<trunnion_dialect::Plane>,
    /// The last polar radius.
    polar_radius: Option<f64>,
    /// Direction of the last motion, in the coordinates of the words.
    heading: Option<Vec3>,
    /// Coordinates that M91 has given last, mm and degrees from the machine's zero.
    m91: [Option<f64>; 9],
    /// TOOL CALL has named the tool axis.
    has_tool_axis: bool,
    /// The last block with effects had a surface normal.
    had_normal: bool,
    /// F of TOOL CALL, mm/min.
    tool_feed: Option<f64>,
    /// TOOL CALL gives a feed whose value is not known.
    tool_feed_unread: bool,
    /// The last CYCL DEF, whose lines may follow.
    opened_cycle: Option<u32>,
    /// The cycle that CYCL CALL runs.
    cycle: hole::Cycle,
    /// mm per unit of the program that defines it.
    cycle_unit: f64,
    /// The points of PATTERN DEF; copies of the state share them.
    pattern: Option<Arc<[Position]>>,
    /// M89.
    runs_after_each: bool,
    /// M136.
    per_turn: bool,
    /// M126.
    shortest: bool,
    /// Rotary words are spatial angles (FUNCTION TCPM AXIS SPAT).
    spatial: bool,
    /// FUNCTION TCPM with a programmed point that is not the tip.
    other_point: bool,
    /// The last block was a rapid.
    was_rapid: bool,
    /// TOOL CALL has given DL, DR or DR2 that is not 0.
    deltas: bool,
    /// The block that runs has FMAX and an arc.
    rapid_arc: bool,
    /// PLANE ... STAY: the angles in Q120 to Q122 have not been gone to.
    angles_wait: Option<crate::Posture>,
    waiting: Option<corner::Waiting>,
    said: Reported,
    /// The block has words that are not followed, reported or not: two programs are the same only if they have the same ones.
    unfollowed: bool,
    /// The length of the tool in use without DL, mm.
    tool_length: Option<f64>,
}

/// The engine of Klartext programs.
#[derive(Clone)]
pub(crate) struct Klartext<'d> {
    pub(crate) core: Core<'d>,
    memory: Memory,
    flow: Flow,
    /// Motions of the block that are ready.
    out: Vec<Motion>,
    cycle_motions: CycleMotions,
}

impl<'d> Engine<'d> for Klartext<'d> {
    fn core(&self) -> &Core<'d> {
        &self.core
    }
    fn cycle_work(&self) -> u64 {
        self.cycle_motions.count()
    }

    fn core_mut(&mut self) -> &mut Core<'d> {
        &mut self.core
    }
    fn copied(&self) -> usize {
        let flow = &self.flow;
        flow.course.copied() + flow.reported.copied() + flow.library.copied() + self.memory.parameters.copied()
    }
    fn advance(&mut self, program: &Program, sink: &mut impl Sink) -> Option<BlockId> {
        self.run_next(program, sink)
    }
    fn chain(&self, chain: crate::ChainId) -> Vec<crate::Frame> {
        self.flow.course.frames(chain)
    }
    fn motions_wait(&self) -> bool {
        self.memory.waiting.is_some()
    }
    fn variable(&self, text: &str) -> Option<f64> {
        let mut words = words::Words::new(text.trim().as_bytes());
        let found = words.parameter()?;
        self.memory.parameters.get(found)
    }
    fn outliving(&self) -> Vec<(String, f64)> {
        self.memory.parameters.known()
    }
    fn outliving_texts(&self) -> Vec<(String, String)> {
        let texts = self.memory.parameters.known_texts();
        texts.map(|(name, text)| (name, text.to_owned())).collect()
    }
    fn known_variables(&self) -> Vec<crate::Argument> {
        self.memory.parameters.readable()
    }
    fn cycle_data(&self) -> Vec<crate::Argument> {
        self.what_calls_see()
    }
    fn turned(&self) -> Vec<f64> {
        self.memory.frames.turned()
    }
}

impl<'d> Klartext<'d> {
    /// At the start of a program.
    pub(crate) fn new(core: Core<'d>) -> Self {
        let base = core.setup.work_offset(crate::UNNAMED_ZERO).map(|offset| offset.values);
        let mut engine = Self {
            core,
            memory: Memory::default(),
            flow: Flow::default(),
            out: Vec::new(),
            cycle_motions: CycleMotions::default(),
        };
        // TNC positions are those of the tip: until a TOOL CALL they hold the length of the tool that is in the spindle, which nothing declares
        engine.core.state.length.set_declared(None, LengthOf::Tool(None));
        let setup = std::sync::Arc::clone(&engine.core.setup);
        for (name, value) in &setup.named_variables.0 {
            if let Some(parameter) = words::Words::new(name.as_bytes()).parameter() {
                engine.memory.parameters.set(parameter, Some(*value));
            }
        }
        if let Some(values) = base {
            engine.core.state.zero.choose(None, 0);
            engine.memory.frames.selected = values;
            engine.refresh_zero();
        }
        engine
    }

    /// Runs one block, for callers that choose the blocks themselves.
    pub(crate) fn step(&mut self, program: &Program, block: BlockId, sink: &mut impl Sink) {
        self.core.declare(program);
        if !self.core.state.ended {
            let request = self.run_block(program, block, sink);
            match request {
                Request::Next => {}
                Request::Program(_) => self.call_is_not_followed(),
                _ => {
                    self.core.forget_everything();
                    self.memory.parameters.lose();
                }
            }
        }
    }

    /// What waits for a further motion, and a missing program end.
    pub(crate) fn finish(&mut self, program: &Program, block: BlockId, sink: &mut impl Sink) {
        self.flush_in(program, block, sink);
        self.core.missing_end(program, sink);
    }

    /// Puts out the motions that wait, in a run of their own.
    fn flush_in(&mut self, program: &Program, block: BlockId, sink: &mut impl Sink) {
        if self.memory.waiting.is_some() {
            let mut faults = |fault| sink.fault(fault);
            let mut report = Report {
                program,
                block,
                record: None,
                faults: &mut faults,
            };
            self.flush(&mut report);
            self.put_out(sink);
        }
    }

    fn put_out(&mut self, sink: &mut impl Sink) {
        for motion in &self.out {
            sink.motion(motion, &self.core.state);
        }
        self.out.clear();
    }

    /// Runs one block; what it requests of the flow.
    fn run_block(&mut self, program: &Program, block: BlockId, sink: &mut impl Sink) -> Request {
        let view = program.block(block);
        let Some(sentence) = view.sentence() else {
            return Request::Next;
        };
        if sentence.skips && self.core.setup.control.block_delete == Some(true) {
            return Request::Next;
        }
        self.core.last_content = Some(block);
        (self.memory.unfollowed, self.memory.rapid_arc) = (false, false);
        let text = sentence.text();
        let mut other = false;
        let request = {
            let mut faults = |fault: Fault| {
                other |= crate::effects::has_other_effects(&fault.kind);
                sink.fault(fault);
            };
            let mut report = Report {
                program,
                block,
                record: Some(sentence.range),
                faults: &mut faults,
            };
            if self.memory.frames.shape.scaling.is_some() {
                self.review_scaling(&mut report);
            }
            self.sentence(&text, &mut report)
        };
        other |= self.memory.unfollowed;
        if self.core.effects.wanted() {
            self.block_effects(&text, block, other, sentence.skips);
            self.core.emit_effects(sink);
        }
        self.put_out(sink);
        request
    }

    /// Reports once that something is not followed.
    fn not_modelled_once(&mut self, what: &str, report: &mut Report<'_>) {
        self.memory.unfollowed = true;
        if self.memory.said.first(what) {
            report.fault(TextRange::default(), FaultKind::NotModelled { what: what.to_owned() });
        }
    }
    fn not_modelled(what: impl Into<String>, report: &mut Report<'_>) {
        report.fault(TextRange::default(), FaultKind::NotModelled { what: what.into() });
    }
    fn rejected(refusal: crate::Refusal, message: impl Into<String>, report: &mut Report<'_>) {
        let kind = FaultKind::Rejected {
            refusal,
            message: message.into(),
            alarm: None,
        };
        report.fault(TextRange::default(), kind);
    }
}
