//! A program run from scratch, with the pose of the tool at both ends of every motion.
use super::ask::{Asked, asks};
use super::folded::{SHIFT, folded, shift_of};
use super::posed::keeps_lengths;
use super::reason::reason;
use std::collections::BTreeSet;
use std::sync::Arc;
use trunnion_dialect::Dialect;
use trunnion_geometry::Vec3;
use trunnion_interp::{
    AllClampCodes, ChainId, Fault, FaultKind, Interpreter, LengthOf, ModalState, Motion, MotionKind, Orientation,
    ProgramRun, Refusal, Setup, Sink, Tilt, Tool, UNNAMED_ZERO,
};
use trunnion_machine::{Follower, Leg, Machine, Pose, forward};
use trunnion_syntax::{BlockId, Format, Program, parse};

/// The state at the start of a program that does not set it: an excerpt.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Assume {
    /// Tool centre point control is on.
    pub tcp: bool,
    /// Active feed, mm/min.
    pub feed_mm_min: Option<f64>,
}

/// A program with all it is read with.
#[derive(Clone, Copy)]
pub struct Run<'a> {
    /// Its bytes.
    pub text: &'a [u8],
    /// Its dialect.
    pub dialect: &'a Dialect,
    /// The machine that runs it; `None`: poses are read from the words alone, which rotary words do not allow. CL data, which say
    /// where the tool is, never need one.
    pub machine: Option<&'a Machine>,
    /// Tools, offsets, bounds.
    pub setup: &'a Setup,
    /// The state at its start.
    pub assume: Assume,
}

/// A motion with its poses.
#[derive(Clone, Debug)]
pub struct Posed {
    /// As programmed.
    pub motion: Motion,
    /// Where the tool is before, workpiece frame without work offset, mm; `None`: unknown. Where its length is off: with its last or declared one.
    pub start: Option<Pose>,
    /// Where the tool is after, or why that is unknown.
    pub end: Result<Pose, String>,
    /// What the machine does, where there is one.
    pub leg: Option<Box<Leg>>,
    /// Length of the tool for which the poses are given, mm.
    pub tool_length: f64,
    /// Which tool's length is active.
    pub length_of: LengthOf,
    /// Whether the tip runs as far as X Y Z do, whichever way they run: they are perpendicular to each other, and so is what turns them.
    pub square: bool,
    /// Direction of the spindle, where the program says it: counter-clockwise.
    pub counter_clockwise: Option<bool>,
    /// The spindle turned before a stop, a tool change or a tap that may have ended it.
    pub spindle_left: bool,
    /// What the active zero point adds for good to the declared values of the work offset (G52, G92, G10, TRANS), mm and deg; not what the program takes back.
    pub shift: [f64; 9],
    /// Name of the active work offset.
    pub work_offset: Option<Arc<str>>,
}

/// A block that ran.
#[derive(Clone, Debug, PartialEq)]
pub struct Ran {
    /// Which.
    pub block: BlockId,
    /// How many motions there are after it.
    pub motions: usize,
    /// Motions are held back after it until a later one is known (cutter radius compensation, rounded corners).
    pub motions_wait: bool,
    /// Spindle after it.
    pub spindle_on: Option<bool>,
    /// It turned before a stop, a tool change or a tap that may have ended it.
    pub spindle_left: bool,
    /// Its speed, 1/min.
    pub spindle_rpm: Option<f64>,
    /// Its direction, where the program says it: counter-clockwise.
    pub counter_clockwise: Option<bool>,
    /// Tool in the spindle after it.
    pub tool: Option<u32>,
    /// What is declared of it.
    pub tool_data: Option<Tool>,
    /// Active work offset after it.
    pub work_offset: Option<Arc<str>>,
    /// mm per length unit after it.
    pub unit_mm: f64,
}

/// A program that was read.
pub struct Reading {
    /// Parsed.
    pub program: Program,
    /// Name of its dialect.
    pub dialect: String,
    /// Motions in the order the control makes them.
    pub motions: Vec<Posed>,
    /// Blocks in the order the control runs them.
    pub blocks: Vec<Ran>,
    /// The block with which the run was given up: more motions or grave faults than are held ([`trunnion_interp::Limits::held`]).
    pub given_up: Option<BlockId>,
    /// Faults that make it unknown what the program does.
    pub faults: Vec<Fault>,
    /// Words that nothing reads, the first thousand.
    pub unused: Vec<Fault>,
    /// The first block that continues in another file.
    pub elsewhere: Option<BlockId>,
    /// What the blocks request apart from their motions, in the order they ran.
    pub asks: Vec<Asked>,
    /// Codes of clamps that the machine names.
    pub clamp_codes: AllClampCodes,
    /// The control changes tools itself; where it does not, the tool in the spindle is unknown.
    pub changes_tools: bool,
    /// The control adds the length of its tools itself; where it does not, the operator sets it.
    pub tells_lengths: bool,
}

/// Runs a program.
pub fn read(run: &Run<'_>) -> Reading {
    let program = parse(run.text.to_vec(), run.dialect.lex);
    let is_apt = run.dialect.lex.format == Format::Apt;
    let machine = run.machine.filter(|_| !is_apt);
    let mut sink = Collector {
        follower: machine.map(Follower::new),
        machine,
        is_apt,
        last: None,
        length: (None, 0.0),
        tells_lengths: tells_lengths(run.dialect),
        motions: Vec::new(),
        blocks: Vec::new(),
        faults: Vec::new(),
        unused: Vec::new(),
        chains: BTreeSet::new(),
        elsewhere: None,
        setup: run.setup,
        given_up: None,
    };
    let mut setup = run.setup.clone();
    setup.limits = setup.limits.of_held();
    let mut interpreter = Interpreter::new(run.dialect, &setup);
    if run.assume.tcp {
        interpreter.state_mut().tool_axis.set_tcp(true);
    }
    if let Some(feed) = run.assume.feed_mm_min {
        interpreter.state_mut().feed.set(Some(feed));
    }
    while let Some(block) = interpreter.advance(&program, &mut sink) {
        sink.block_done(block, &interpreter);
        if sink.given_up.is_some() {
            break;
        }
    }
    let state = interpreter.state();
    let left = shift_of(&state.zero.values(), state, run.setup, sink.unnamed());
    if left.iter().all(|left| left.abs() <= SHIFT) {
        // it is taken back: what it did is in the coordinates
        for posed in &mut sink.motions {
            let finite = posed.shift.iter().all(|shift| shift.is_finite());
            posed.shift = if finite { [0.0; 9] } else { posed.shift };
        }
    }
    let Collector {
        mut motions,
        mut blocks,
        faults,
        unused,
        elsewhere,
        given_up,
        ..
    } = sink;
    let clamp_codes = run.setup.control.clamp_codes;
    let (asks, turns) = asks(&program, run.dialect, &clamp_codes, &blocks);
    let mut first = 0;
    for (ran, turn) in blocks.iter_mut().zip(turns) {
        ran.counter_clockwise = turn;
        for posed in &mut motions[first..ran.motions] {
            posed.counter_clockwise = turn;
        }
        first = ran.motions;
    }
    Reading {
        dialect: run.dialect.name.clone(),
        asks,
        clamp_codes,
        program,
        motions,
        blocks,
        given_up,
        faults,
        unused,
        elsewhere,
        tells_lengths: tells_lengths(run.dialect),
        changes_tools: is_apt || run.dialect.quirks.tool_word.changes() || run.dialect.m(60).is_some(),
    }
}

/// Whether a control adds the length of its tools itself.
fn tells_lengths(dialect: &Dialect) -> bool {
    let by_itself = matches!(dialect.lex.format, Format::Apt | Format::Klartext);
    by_itself || dialect.quirks.edge_at_tool_change || dialect.g(430).is_some()
}

struct Collector<'m> {
    follower: Option<Follower<'m>>,
    machine: Option<&'m Machine>,
    is_apt: bool,
    /// Where the last motion ended, without a machine.
    last: Option<Pose>,
    /// Tool and its own length that was last in effect, mm.
    length: (Option<u32>, f64),
    /// The control adds the length of its tools itself.
    tells_lengths: bool,
    motions: Vec<Posed>,
    blocks: Vec<Ran>,
    faults: Vec<Fault>,
    unused: Vec<Fault>,
    /// Chains of calls that were looked at.
    chains: BTreeSet<ChainId>,
    elsewhere: Option<BlockId>,
    setup: &'m Setup,
    given_up: Option<BlockId>,
}

impl Sink for Collector<'_> {
    fn motion(&mut self, motion: &Motion, state: &ModalState) {
        if self.motions.len() as u64 >= self.setup.limits.held {
            self.given_up.get_or_insert(motion.block);
            return;
        }
        let length = self.length_of(motion, state);
        let added = shift_of(&motion.zero, state, self.setup, self.unnamed());
        let own = folded(motion, &added);
        let posed = if let (Some(follower), Some(machine)) = (&mut self.follower, self.machine) {
            let leg = follower.follow(motion);
            let pose = |joints| {
                let mut pose = forward(machine, joints, length);
                for (axis, zero) in own.zero.iter().enumerate().take(3) {
                    pose.tip[axis] -= zero;
                }
                pose
            };
            let start = leg.start.as_ref().map(|stance| pose(&stance.joints));
            let undeclared =
                Some(state.zero.offset().unwrap_or(UNNAMED_ZERO)).filter(|name| self.setup.work_offset(name).is_none());
            // LinuxCNC gives the ends of G53, G28 and G30 in program coordinates: what they depend on says that they are another place
            let by_machine = motion.machine_coordinates || motion.undeclared.zero != state.zero.undeclared();
            let end = match &leg.end {
                Ok(_) if undeclared.is_some() && by_machine => Err(format!(
                    "where machine coordinates are in the part depends on {}: declare it in [work_offsets]",
                    undeclared.unwrap_or_default()
                )),
                Ok(stance) => Ok(pose(&stance.joints)),
                Err(why) => Err(reason(why)),
            };
            (start, end, Some(Box::new(leg)))
        } else {
            let (start, end) = self.plain(&own);
            self.last = end.as_ref().ok().copied();
            (start, end, None)
        };
        let square = match (&posed.2, self.machine, &motion.kind) {
            (Some(leg), Some(machine), MotionKind::Arc(Some(_))) => leg
                .end
                .as_ref()
                .is_ok_and(|stance| keeps_lengths(machine, &stance.joints)),
            _ => true,
        };
        self.motions.push(Posed {
            motion: own,
            start: posed.0,
            end: posed.1,
            leg: posed.2,
            tool_length: length,
            length_of: state.length.of(),
            square,
            counter_clockwise: None,
            spindle_left: state.spindle.is_left_to_machine(),
            shift: added,
            work_offset: state.zero.offset_name(),
        });
    }

    fn fault(&mut self, fault: Fault) {
        if !is_grave(&fault.kind) {
            if fault.kind == FaultKind::UnusedWord && self.unused.len() < 1000 {
                self.unused.push(fault);
            }
            return;
        }
        if self.faults.len() as u64 >= self.setup.limits.held {
            self.given_up.get_or_insert(fault.block);
            return;
        }
        self.faults.push(fault);
    }

    fn block_done(&mut self, block: BlockId, run: &dyn ProgramRun) {
        if let Some(posed) = self.motions.last()
            && self.elsewhere.is_none()
            && self.chains.insert(posed.motion.chain)
        {
            let frames = run.chain(posed.motion.chain);
            if frames.iter().any(|frame| !frame.file.is_empty()) {
                self.elsewhere = Some(block);
            }
        }
        let state = run.state();
        self.blocks.push(Ran {
            block,
            motions: self.motions.len(),
            motions_wait: run.motions_wait(),
            spindle_on: state.spindle.on(),
            spindle_left: state.spindle.is_left_to_machine(),
            spindle_rpm: state.spindle.rpm(),
            counter_clockwise: None,
            tool: state.tool.number(),
            tool_data: state.tool.data(),
            work_offset: state.zero.offset_name(),
            unit_mm: state.coordinates.unit_mm(),
        });
    }
}

impl Collector<'_> {
    /// The work offset where the program names none.
    fn unnamed(&self) -> &'static str {
        if self.is_apt { "G54" } else { UNNAMED_ZERO }
    }

    /// The length of the tool for which a pose is given, mm: the one in effect. Where none is, the tool is still as long as it is: as declared, else as
    /// long as its own length that was in effect before; 0 where that is unknown.
    fn length_of(&mut self, motion: &Motion, state: &ModalState) -> f64 {
        if motion.tool_length_mm != 0.0 {
            if state.length.of() == LengthOf::Tool(motion.tool) {
                self.length = (motion.tool, motion.tool_length_mm);
            }
            return motion.tool_length_mm;
        }
        let declared = state.tool.data();
        let declared = declared.filter(|tool| self.tells_lengths && motion.tool == Some(tool.number));
        let last = Some(self.length.1).filter(|_| self.length.0 == motion.tool);
        declared.and_then(|tool| tool.length_mm).or(last).unwrap_or(0.0)
    }

    /// Poses by the words alone.
    fn plain(&self, motion: &Motion) -> (Option<Pose>, Result<Pose, String>) {
        let rotary = motion.end.known & 0b11_1000 != 0;
        let axis = match motion.orientation {
            _ if motion.tilt != Tilt::default() => {
                Err("turning to a tilted plane depends on the machine: add --machine".to_owned())
            }
            Orientation::Vector(_, axis) => Ok(axis),
            Orientation::Words if self.is_apt => Err("the tool axis is unknown: program i, j, k".to_owned()),
            Orientation::Words if rotary => {
                Err("where the tool points for given rotary words depends on the machine: add --machine".to_owned())
            }
            Orientation::Words => Ok(Vec3::z()),
        };
        let end = match (motion.kind, motion.end.xyz(), axis) {
            (MotionKind::Unknown, ..) => Err("the motion is not modelled".to_owned()),
            (MotionKind::Dwell(_), ..) => self.last.ok_or_else(|| "the position is unknown".to_owned()),
            (_, Some(_), Ok(_)) if motion.machine_coordinates => {
                Err("where machine coordinates are in the part depends on the machine: add --machine".to_owned())
            }
            (_, Some(tip), Ok(axis)) => Ok(Pose { tip, axis }),
            (_, None, _) => Err("the position of X, Y or Z is unknown".to_owned()),
            (_, _, Err(why)) => Err(why),
        };
        let start = match (motion.start.xyz(), motion.orientation) {
            (Some(tip), Orientation::Vector(Some(axis), _)) => Some(Pose { tip, axis }),
            (Some(tip), _) => self.last.map(|pose| Pose { tip, ..pose }),
            (None, _) => None,
        };
        (start, end)
    }
}

/// Why a fault makes it unsafe to say what the program does; `None` where poses do not depend on it.
pub(crate) fn is_grave(kind: &FaultKind) -> bool {
    match kind {
        FaultKind::WorkOffsetUnset { .. }
        | FaultKind::ToolLengthUnset { .. }
        | FaultKind::ToolDefinedTwice { .. }
        | FaultKind::MissingProgramEnd
        | FaultKind::CompensationLeft
        | FaultKind::AptVectorMissing
        | FaultKind::UnusedWord
        | FaultKind::UnknownCode { machine_builder: true } => false,
        FaultKind::VectorNotUnit { norm } => (norm - 1.0).abs() > 1e-2,
        FaultKind::Rejected { refusal, .. } => *refusal != Refusal::ProgramEnd,
        _ => true,
    }
}
