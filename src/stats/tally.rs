//! Counts what a run reports.
use crate::calls::{Call, calls};
use crate::stop::Stops;
use std::collections::BTreeMap;
use trunnion_geometry::{Vec3, deg};
use trunnion_interp::{
    AXIS_LETTERS, AxisLetter, Fault, FaultKind, Feed, Interpreter, ModalState, Motion, MotionKind, ProgramRun, Sink,
    Tool, is_program_end,
};
use trunnion_machine::{AxisKind, Follower, Leg, Machine, excursions, leads_tip, linear_travel, turns};
use trunnion_same::Input;
use trunnion_syntax::{BlockId, LineIndex};

/// Lowest and highest of the values seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Range {
    /// Lowest.
    pub low: f64,
    /// Highest.
    pub high: f64,
}

/// Widens a range by a value.
fn widen(range: &mut Option<Range>, value: f64) {
    if value.is_finite() {
        let known = range.get_or_insert(Range {
            low: value,
            high: value,
        });
        known.low = known.low.min(value);
        known.high = known.high.max(value);
    }
}

/// What is done with one tool.
#[derive(Clone, Copy, Debug, Default)]
pub struct ToolUse {
    /// First block with it.
    pub line: u32,
    /// Motions with it.
    pub motions: u64,
    /// mm along the programmed X Y Z path.
    pub feed_mm: f64,
    /// What the settings or a comment of the program declare of it.
    pub declared: Option<Tool>,
}

/// Everything counted. Lengths mm along the programmed X Y Z path, times s.
#[derive(Default)]
pub struct Tally {
    /// The program moves in inch.
    pub inch: bool,
    /// Blocks with content, counted as the coverage of a check counts them.
    pub blocks: u64,
    /// Those of them that ran at least once.
    pub run: u64,
    /// How often one of them ran: repeated ones each time.
    pub runs: u64,
    /// Motions by kind.
    pub motions: BTreeMap<&'static str, u64>,
    /// Rapid motions.
    pub rapid_mm: f64,
    /// Feed motions.
    pub feed_mm: f64,
    /// Of `feed_mm`, with the spindle off.
    pub spindle_off_mm: f64,
    /// Motions whose length is unknown: their start or end in the part is not known.
    pub unmeasured: u64,
    /// Their lines, in the order of the run, each once; no more than [`MOST_LINES`].
    pub unmeasured_lines: Vec<u32>,
    /// X is a radius here, though words of X are diameters.
    pub radii: bool,
    /// Time of feed motions at the programmed feed.
    pub feed_s: f64,
    /// Feed motions whose time is not known.
    pub untimed: u64,
    /// Dwells.
    pub dwell_s: f64,
    /// Programmed, in the order of the letters.
    pub axes: [Option<Range>; AXIS_LETTERS.len()],
    /// Of the machine, in chain order, mm or deg.
    pub joints: Vec<(char, bool, Option<Range>)>,
    /// F per minute, per turn, inverse time.
    pub feed: [Option<Range>; 3],
    /// Spindle speed of motions with the spindle on, 1/min.
    pub spindle: Option<Range>,
    /// By number; `None`: before the first tool.
    pub tools: BTreeMap<Option<u32>, ToolUse>,
    /// How often the tool changed.
    pub tool_changes: u64,
    /// Programs that it calls, as written.
    pub calls: Vec<Call>,
    /// What is recognised and not modelled, with how often.
    pub not_modelled: BTreeMap<String, u64>,
    /// Line where the run stopped before the end, and why: nothing after it is counted.
    pub stop: Option<(u32, String)>,
}

/// Lines of motions of unknown length that are kept.
pub const MOST_LINES: usize = 4;

/// Excursions between the ends of a motion that are smaller are left out, mm: no digit of them is shown.
const SMALLEST_MM: f64 = 1e-4;

/// Counts while a program runs.
struct Counting<'a> {
    input: Input<'a>,
    lines: &'a LineIndex,
    follower: Option<Follower<'a>>,
    tally: Tally,
    tool: Option<u32>,
    stops: Stops,
    /// By block: it ran.
    ran: Vec<bool>,
}

impl Tally {
    /// Runs a program and counts.
    pub fn of(input: Input<'_>) -> Self {
        let program = input.program;
        let lines = LineIndex::new(program.source());
        let mut tally = Self {
            calls: calls(program, &lines),
            ..Self::default()
        };
        if let Some(machine) = input.machine {
            let axes = machine.own_axes();
            tally.joints = axes
                .map(|(_, axis)| (char::from(axis.letter), axis.kind == AxisKind::Rotary, None))
                .collect();
        }
        let mut counting = Counting {
            input,
            lines: &lines,
            follower: input.machine.map(Follower::new),
            tally,
            tool: None,
            stops: Stops::default(),
            ran: vec![false; program.block_count()],
        };
        let mut setup = input.setup.clone();
        // on a chain of linear axes an axis that is never named changes nothing of the others, wherever it stands
        setup.unnamed_stand = input.machine.is_none_or(|machine| machine.rotary.is_empty());
        let mut interpreter = Interpreter::new(input.dialect, &setup);
        let mut standing = interpreter.standing();
        while let Some(block) = interpreter.advance(program, &mut counting) {
            standing |= interpreter.standing();
            counting.block_done(block, &interpreter);
        }
        let stop = counting.stops.last();
        let stop = stop.map(|stop| (counting.line(stop.block), stop.why.clone()));
        counting.count_blocks();
        let mut tally = counting.tally;
        tally.stop = stop;
        // what always stands is no extent
        for (axis, range) in tally.axes.iter_mut().enumerate() {
            *range = range.take_if(|_| standing & (1 << axis) == 0);
        }
        for (letter, _, range) in &mut tally.joints {
            let stands = |axis: AxisLetter| standing & (1 << axis.0) != 0;
            *range = range.take_if(|_| !AxisLetter::new(*letter as u8).is_some_and(stands));
        }
        tally
    }

    /// All motions.
    pub fn motions(&self) -> u64 {
        self.motions.values().sum()
    }
}

/// The name of a motion's kind, as `trace` has it.
fn kind(motion: &Motion) -> &'static str {
    match motion.kind {
        MotionKind::Rapid => "rapid",
        MotionKind::Linear => "linear",
        MotionKind::Arc(_) => "arc",
        MotionKind::Dwell(_) => "dwell",
        MotionKind::Unknown => "unknown",
    }
}

/// Length of the programmed X Y Z path, mm.
fn length(motion: &Motion) -> Option<f64> {
    match motion.kind {
        MotionKind::Arc(arc) => arc.map(|arc| arc.length()),
        MotionKind::Dwell(_) => Some(0.0),
        MotionKind::Rapid | MotionKind::Linear => {
            let length = (motion.end.xyz()? - motion.start.xyz()?).norm();
            length.is_finite().then_some(length)
        }
        MotionKind::Unknown => None,
    }
}

/// Widens the ranges of linear joints by what they run beyond both ends of a motion: along arcs, and in lines of a guided tip.
/// `own`: the axis of each range.
fn inside(machine: &Machine, leg: &Leg, own: &[usize], ranges: &mut [(char, bool, Option<Range>)]) {
    let bends = matches!(leg.motion.kind, MotionKind::Arc(Some(_))) || leads_tip(&leg.motion) && turns(leg);
    let (true, Some(start), Ok(end)) = (bends, &leg.start, &leg.end) else {
        return;
    };
    // what is surely inside the range so far needs no search
    let reach = linear_travel(machine, leg, f64::INFINITY).map_or(f64::INFINITY, |travel| travel.most_mm);
    let is_inside = |&joint: &usize| {
        let known = own.iter().position(|&axis| axis == joint);
        let known = known.and_then(|slot| ranges[slot].2);
        let (from, to) = (start.joints[joint], end.joints[joint]);
        known.is_some_and(|known| from.min(to) - reach >= known.low && from.max(to) + reach <= known.high)
    };
    if machine.linear.iter().all(is_inside) {
        return;
    }
    for found in excursions(machine, leg, SMALLEST_MM) {
        let ends = [start.joints[found.axis], end.joints[found.axis]];
        let value = if found.upward {
            ends[0].max(ends[1]) + found.beyond_mm
        } else {
            ends[0].min(ends[1]) - found.beyond_mm
        };
        let slots = own.iter().zip(ranges.iter_mut());
        for (_, (_, _, range)) in slots.filter(|(axis, _)| **axis == found.axis) {
            widen(range, value);
        }
    }
}

impl Counting<'_> {
    fn line(&self, block: BlockId) -> u32 {
        let program = self.input.program;
        self.lines
            .line_column(program.source(), program.block(block).range().start)
            .0
    }

    /// The end of a Klartext program counts only where it ran.
    fn count_blocks(&mut self) {
        for block in self.input.program.blocks().filter(trunnion_syntax::Block::has_code) {
            let ran = self.ran.get(block.id().0 as usize).is_some_and(|ran| *ran);
            self.tally.run += u64::from(ran);
            self.tally.blocks += u64::from(ran || !is_program_end(&block, self.input.dialect));
        }
    }

    /// Of what is programmed in the part: machine coordinates (G53, SUPA, M91) are others.
    fn extents(&mut self, motion: &Motion) {
        if motion.machine_coordinates {
            return;
        }
        for (axis, range) in self.tally.axes.iter_mut().enumerate() {
            if let Some(value) = motion.end.get(axis) {
                widen(range, value);
            }
        }
        if let MotionKind::Arc(Some(arc)) = &motion.kind {
            for (axis, direction) in [Vec3::x(), Vec3::y(), Vec3::z()].iter().enumerate() {
                if motion.end.get(axis).is_none() {
                    continue;
                }
                let (low, high) = arc.extent(direction);
                widen(&mut self.tally.axes[axis], low);
                widen(&mut self.tally.axes[axis], high);
            }
        }
    }

    fn joints(&mut self, motion: &Motion) {
        let Some(follower) = &mut self.follower else { return };
        let leg = follower.follow(motion);
        let (joints, known) = match &leg.end {
            Ok(stance) => (stance.joints, u16::MAX),
            Err(_) => leg.known_joints,
        };
        let Some(machine) = self.input.machine else { return };
        let own: Vec<usize> = machine.own_axes().map(|(index, _)| index).collect();
        for (&index, (_, rotary, range)) in own.iter().zip(&mut self.tally.joints) {
            if known & (1 << index) != 0 {
                widen(range, if *rotary { deg(joints[index]) } else { joints[index] });
            }
        }
        inside(machine, &leg, &own, &mut self.tally.joints);
    }

    /// Distances, feeds and times.
    fn path(&mut self, motion: &Motion, line: u32) {
        let length = length(motion);
        let tally = &mut self.tally;
        tally.unmeasured += u64::from(length.is_none());
        let lines = &mut tally.unmeasured_lines;
        if length.is_none() && lines.len() < MOST_LINES && !lines.contains(&line) {
            lines.push(line);
        }
        let known = length.unwrap_or_default();
        if let MotionKind::Dwell(seconds) = motion.kind {
            tally.dwell_s += seconds.unwrap_or_default();
            return;
        }
        if !motion.is_feed() {
            tally.rapid_mm += known;
            return;
        }
        tally.feed_mm += known;
        if motion.spindle_on != Some(true) {
            tally.spindle_off_mm += known;
        }
        let (slot, value, minutes) = match motion.feed {
            Feed::PerMinute(feed) => (
                0,
                feed,
                length.filter(|_| known > 0.0 && feed > 0.0).map(|length| length / feed),
            ),
            Feed::PerRevolution(feed) => {
                let rate = motion.mean_rpm().map(|rpm| rpm * feed).filter(|rate| *rate > 0.0);
                (1, feed, length.zip(rate).map(|(length, rate)| length / rate))
            }
            Feed::InverseTime(rate) => (2, rate, (rate > 0.0).then(|| 1.0 / rate)),
            Feed::Unknown | Feed::Rapid => (0, f64::NAN, None),
        };
        widen(&mut tally.feed[slot], value);
        match minutes.filter(|minutes| minutes.is_finite()) {
            Some(minutes) => tally.feed_s += 60.0 * minutes,
            None => tally.untimed += 1,
        }
    }
}

impl Sink for Counting<'_> {
    fn motion(&mut self, motion: &Motion, state: &ModalState) {
        self.tally.inch |= state.coordinates.is_inch();
        *self.tally.motions.entry(kind(motion)).or_default() += 1;
        self.extents(motion);
        self.joints(motion);
        self.tally.radii |= motion.radii;
        let line = self.line(motion.block);
        let before = self.tally.feed_mm;
        self.path(motion, line);
        if motion.spindle_on == Some(true)
            && let Some(speed) = motion.spindle_rpm
        {
            widen(&mut self.tally.spindle, speed);
        }
        let added = self.tally.feed_mm - before;
        let used = self.tally.tools.entry(motion.tool).or_insert(ToolUse {
            line,
            ..ToolUse::default()
        });
        used.motions += 1;
        used.feed_mm += added;
        used.declared = used.declared.or_else(|| state.tool.data());
    }

    fn fault(&mut self, fault: Fault) {
        self.stops.fault(&fault, self.input.dialect);
        if let FaultKind::NotModelled { what } = fault.kind {
            *self.tally.not_modelled.entry(what).or_default() += 1;
        }
    }

    fn block_done(&mut self, block: BlockId, run: &dyn ProgramRun) {
        self.stops.block_done();
        self.tally.runs += u64::from(self.input.program.block(block).has_code());
        if let Some(ran) = self.ran.get_mut(block.0 as usize) {
            *ran = true;
        }
        if run.state().tool.number() != self.tool {
            self.tool = run.state().tool.number();
            self.tally.tool_changes += 1;
        }
    }
}
