//! A program run once for a rewrite: each motion with what the machine does, kept small.
use trunnion_check::Settings;
use trunnion_interp::{
    ChainId, Fault, Feed, Interpreter, ModalState, Motion, MotionKind, Orientation, Setup, Sink, ToolShape, run,
};
use trunnion_machine::{Follower, Machine, NoStance, Stance};
use trunnion_syntax::{BlockId, LineIndex, Program};

/// What is declared about the tool's tip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Tip {
    /// Nothing.
    Undeclared,
    /// A ball of this radius, mm.
    Ball(f64),
    /// Another shape.
    Other,
}

/// One motion and the point it ends at.
#[derive(Clone, Debug)]
pub(crate) struct Point {
    /// Its block.
    pub block: BlockId,
    /// Feed along a line.
    pub linear: bool,
    /// Feed along a line or an arc.
    pub feed: bool,
    /// Tool centre point control, or tool vectors.
    pub tcp: bool,
    /// Tool vectors are programmed.
    pub vector: bool,
    /// G91.
    pub incremental: bool,
    /// mm per programmed length unit.
    pub unit_mm: f64,
    /// The tool's tip.
    pub tip: Tip,
    /// Where it ends; else why that is unknown.
    pub end: Result<Stance, NoStance>,
    /// The start is known.
    pub from_known: bool,
    /// Sizes of the rotary steps, rad.
    pub rotary_change: [f64; 2],
    /// Smallest angle to the pole along the path, rad.
    pub pole_angle_min: f64,
    /// The posture changes by a swap.
    pub swap: bool,
    /// Length of the programmed tip path, mm.
    pub length: f64,
    /// Work offsets of the rotary axes, workpiece side first, deg; 0 in machine coordinates.
    pub rotary_zero: [f64; 2],
    /// G53: X Y Z and the rotary words are positions of the machine.
    pub machine_coordinates: bool,
    /// Rapid.
    pub rapid: bool,
    /// Time of the motion under G93, s.
    pub time: Option<f64>,
    /// Feed per minute, mm/min.
    pub feed_mm_min: Option<f64>,
}

impl Point {
    /// What the slope of a rotary axis is measured by: length of the path, mm; under G93 the time in units of 1/60 s.
    pub(crate) fn extent(&self) -> f64 {
        self.time.map_or(self.length, |seconds| seconds * 60.0)
    }

    /// Time of the motion as programmed, s.
    pub(crate) fn seconds(&self) -> Option<f64> {
        self.time.or_else(|| Some(60.0 * self.length / self.feed_mm_min?))
    }

    /// It turns the rotary axis nearest the workpiece by more than a whole turn.
    pub(crate) fn many_turns(&self) -> bool {
        self.rotary_change[0] > core::f64::consts::TAU
    }
}

struct Collector<'m> {
    follower: Follower<'m>,
    machine: &'m Machine,
    points: Vec<Point>,
}

impl Sink for Collector<'_> {
    fn motion(&mut self, motion: &Motion, state: &ModalState) {
        let leg = self.follower.follow(motion);
        let vector = matches!(motion.orientation, Orientation::Vector(..));
        let mut rotary_zero = [0.0; 2];
        for (zero, &joint) in rotary_zero.iter_mut().zip(&self.machine.rotary) {
            let axis = trunnion_interp::AxisLetter::new(self.machine.axes[joint].letter);
            if let (Some(axis), false) = (axis, motion.machine_coordinates) {
                *zero = motion.zero[usize::from(axis.0)];
            }
        }
        self.points.push(Point {
            block: motion.block,
            linear: motion.kind == MotionKind::Linear,
            feed: motion.is_feed(),
            tcp: motion.tcp || vector,
            vector,
            incremental: state.coordinates.incremental(),
            unit_mm: state.coordinates.unit_mm(),
            tip: match state.tool.shape() {
                None => Tip::Undeclared,
                Some((ToolShape::Ball, diameter)) => Tip::Ball(0.5 * diameter),
                Some(_) => Tip::Other,
            },
            from_known: leg.start.is_some(),
            end: leg.end,
            rotary_change: leg.rotary_change,
            pole_angle_min: leg.pole_angle_min,
            swap: leg.rotary_excess > self.machine.tolerances.swap_excess,
            length: leg.length,
            rotary_zero,
            machine_coordinates: motion.machine_coordinates,
            rapid: motion.kind == MotionKind::Rapid,
            time: match motion.feed {
                Feed::InverseTime(per_minute) if per_minute > 0.0 => Some(60.0 / per_minute),
                _ => None,
            },
            feed_mm_min: match motion.feed {
                Feed::PerMinute(feed) if feed > 0.0 => Some(feed),
                _ => None,
            },
        });
    }
    fn fault(&mut self, _: Fault) {}
    fn reads_faults(&self) -> bool {
        false
    }
}

/// Runs the program on the machine.
pub(crate) fn survey(program: &Program, settings: &Settings<'_>, machine: &Machine) -> Vec<Point> {
    let mut collector = Collector {
        follower: Follower::new(machine),
        machine,
        points: Vec::new(),
    };
    run(program, settings.dialect, &settings.setup, &mut collector);
    collector.points
}

/// A program's programmed rotary positions, for rewrites that read words rather than joints.
pub(crate) struct Programmed {
    /// Each motion.
    pub motions: Vec<ProgrammedMotion>,
}

/// One motion as programmed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ProgrammedMotion {
    /// Its block.
    pub block: BlockId,
    /// A, B, C after the motion plus work offset, deg: machine values.
    pub rotary: [Option<f64>; 3],
    /// G91.
    pub incremental: bool,
    /// Tool vectors are programmed.
    pub vector: bool,
}

impl Sink for Programmed {
    fn motion(&mut self, motion: &Motion, state: &ModalState) {
        let share = if motion.machine_coordinates { 0.0 } else { 1.0 };
        let rotary = [3, 4, 5].map(|axis| motion.end.get(axis).map(|value| value + share * motion.zero[axis]));
        self.motions.push(ProgrammedMotion {
            block: motion.block,
            rotary,
            incremental: state.coordinates.incremental(),
            vector: matches!(motion.orientation, Orientation::Vector(..)),
        });
    }
    fn fault(&mut self, _: Fault) {}
    fn reads_faults(&self) -> bool {
        false
    }
}

/// Runs the program without a machine.
pub(crate) fn programmed(program: &Program, dialect: &trunnion_dialect::Dialect, setup: &Setup) -> Programmed {
    let mut programmed = Programmed { motions: Vec::new() };
    run(program, dialect, setup, &mut programmed);
    programmed
}

/// Records whether motions come from inside a call.
#[derive(Default)]
struct Calls(bool);

impl Sink for Calls {
    fn motion(&mut self, motion: &Motion, _: &ModalState) {
        self.0 |= motion.chain != ChainId::MAIN;
    }
    fn fault(&mut self, _: Fault) {}
    fn reads_faults(&self) -> bool {
        false
    }
}

/// Whether the program runs linearly, each block once and in the order of the text; else why an edit of one block is not the
/// edit of one motion.
pub(crate) fn runs_straight(program: &Program, settings: &Settings<'_>) -> Result<(), String> {
    let mut interpreter = Interpreter::new(settings.dialect, &settings.setup);
    let mut calls = Calls::default();
    let mut last = None;
    while let Some(block) = interpreter.advance(program, &mut calls) {
        let back = last.is_some_and(|last| block <= last);
        last = Some(block);
        if !(back || calls.0) {
            continue;
        }
        let source = program.source();
        let (line, _) = LineIndex::new(source).line_column(source, program.block(block).range().start);
        return Err(format!(
            "the program has loops or calls (line {line}): there one word drives many motions, and rewrites change one motion at a time"
        ));
    }
    Ok(())
}
