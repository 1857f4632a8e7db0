//! APT / CL records to motions.
mod args;
mod auxiliary;
pub(crate) mod cycle;
mod drill;
mod drive;
mod feed;
mod frame;
mod ignored;
mod remark;

pub(crate) use args::{Args, is};
pub use ignored::{IgnoredRecords, ignored_records};

use crate::Sink;
use crate::core::{Core, Report};
use crate::cycle_motions::CycleMotions;
use crate::engine::Engine;
use crate::{FaultKind, FeedMode, Motion, Orientation};
use trunnion_dialect::Action;
use trunnion_geometry::Vec3;
use trunnion_syntax::{Block, BlockId, Program, Record, TextRange};

/// What APT keeps between records in addition to the modal state.
#[derive(Clone, Debug, Default)]
pub(crate) struct AptState {
    /// RAPID: the next motion is a rapid.
    pub(crate) rapid: bool,
    /// RAPID had words that are not understood: which motions are rapids is not known from here on.
    pub(crate) rapid_unread: bool,
    /// The last direction of SPINDL is CCLW.
    pub(crate) counter_clockwise: bool,
    /// COOLNT/MIST came after the last FLOOD.
    pub(crate) mist: bool,
    /// What F means and mm per unit, as the last FEDRAT with a unit says.
    pub(crate) feed_unit: Option<(FeedMode, f64)>,
    /// CIRCLE: the next GOTO is the end of this arc.
    pub(crate) circle: Option<Circle>,
    /// TLAXIS: the orientation of the next motion.
    pub(crate) axis: Option<Orientation>,
    /// The last vector could not be read, so no orientation is in effect.
    pub(crate) axis_lost: bool,
    /// MULTAX/OFF was programmed while the tool was tilted, and no point came after it.
    pub(crate) axis_open: bool,
    /// MULTAX/OFF was programmed: tool axes of motions are not expected until MULTAX/ON.
    pub(crate) axis_fixed: bool,
    /// Where the coordinates of the records are in the part.
    pub(crate) frame: frame::Frame,
    /// The last cycle that was described; `None`: there is none, or what it does is not known.
    pub(crate) hole: Option<cycle::Hole>,
    /// What is not known of this cycle was reported.
    pub(crate) cycle_said: bool,
    /// INDIRV: the direction in which the next TLON begins.
    pub(crate) direction: Option<Vec3>,
    /// A frame in `$$` remarks of which the last lines are still to come.
    pub(crate) remark: Option<remark::Started>,
}

/// An arc that waits for its end.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Circle {
    /// Centre mm and unit axis; `None` where the record could not be read.
    pub(crate) shape: Option<(Vec3, Vec3)>,
    /// mm, where it is written.
    pub(crate) radius: Option<f64>,
}

/// A major word in upper case, as far as it fits.
fn upper<'b>(program: &Program, range: TextRange, buffer: &'b mut [u8; 12]) -> &'b [u8] {
    let text = program.source().get(range.as_usize()).unwrap_or_default();
    let length = text.len().min(buffer.len());
    for (to, from) in buffer.iter_mut().zip(text) {
        *to = from.to_ascii_uppercase();
    }
    if text.len() > buffer.len() {
        b""
    } else {
        &buffer[..length]
    }
}

/// The engine of APT / CL programs.
#[derive(Clone)]
pub(crate) struct Apt<'d> {
    pub(crate) core: Core<'d>,
    pub(crate) kept: AptState,
    /// Motions of a cycle, before the one that its record returns.
    pub(crate) more: Vec<Motion>,
    /// The orientation of the first of them.
    pub(crate) first_vector: Option<Orientation>,
    cycle_motions: CycleMotions,
    /// The record that runs next.
    next: u32,
    finished: bool,
}

impl<'d> Engine<'d> for Apt<'d> {
    fn core(&self) -> &Core<'d> {
        &self.core
    }
    fn cycle_work(&self) -> u64 {
        self.cycle_motions.count()
    }

    fn core_mut(&mut self) -> &mut Core<'d> {
        &mut self.core
    }
    fn advance(&mut self, program: &Program, sink: &mut impl Sink) -> Option<BlockId> {
        if self.finished || program.block_count() == 0 {
            return None;
        }
        let block = BlockId(self.next);
        self.next += 1;
        self.step(program, block, sink);
        if self.core.state.ended || self.next as usize >= program.block_count() {
            self.finished = true;
            self.core.missing_end(program, sink);
        }
        Some(block)
    }
}

impl<'d> Apt<'d> {
    /// At the start of a program.
    /// CL data name no work offset: the part's zero is where the settings declare that G54 is.
    pub(crate) fn new(mut core: Core<'d>) -> Self {
        let setup = std::sync::Arc::clone(&core.setup);
        if let Some(offset) = setup.work_offset("G54") {
            core.state.zero.set(offset.values);
            core.state.zero.declare_all();
        }
        Self {
            core,
            kept: AptState::default(),
            more: Vec::new(),
            cycle_motions: CycleMotions::default(),
            first_vector: None,
            next: 0,
            finished: false,
        }
    }
    /// Runs one record.
    pub(crate) fn step(&mut self, program: &Program, block: BlockId, sink: &mut impl Sink) {
        self.core.declare(program);
        if !self.core.state.ended {
            self.step_apt(&program.block(block), sink);
        }
    }
}

impl Apt<'_> {
    /// Runs one APT record.
    pub(crate) fn step_apt(&mut self, block: &Block<'_>, sink: &mut impl Sink) {
        self.frame_remarks(block, sink);
        let refused = self
            .core
            .effects
            .wanted()
            .then(|| crate::effects::refused(block))
            .flatten();
        let has_record = block.record().is_some();
        if let Some(effect) = refused {
            let block = self.core.main_block(block.id());
            self.core.effects.add(block, effect);
            if !has_record {
                self.core.emit_effects(sink);
            }
        }
        let Some(record) = block.record() else { return };
        self.core.last_content = Some(block.id());
        let mut has_other_effects = false;
        if self.core.effects.wanted() {
            self.record_effects(&record, block);
        }
        let motion = {
            let mut report = Report {
                program: block.program(),
                block: block.id(),
                record: Some(record.range),
                faults: &mut |fault| {
                    has_other_effects |= crate::effects::has_other_effects(&fault.kind);
                    sink.fault(fault);
                },
            };
            self.record(&record, &mut report)
        };
        if self.core.effects.wanted() {
            let motion = motion.or(self.more.last().copied());
            self.late_record_effects(&record, block, motion.as_ref(), has_other_effects);
            self.core.emit_effects(sink);
        }
        for motion in self.more.drain(..).chain(motion) {
            sink.motion(&motion, &self.core.state);
        }
    }

    fn record(&mut self, record: &Record<'_>, report: &mut Report<'_>) -> Option<Motion> {
        let args = Args::new(record);
        let program = report.program;
        match upper(program, record.major, &mut [0; 12]) {
            b"GOTO" => return self.goto(&args, report),
            b"GODLTA" => return self.godlta(&args, report),
            b"FROM" => self.from(&args, report),
            b"RAPID" => self.rapid_record(&args, report),
            b"CIRCLE" => self.circle(&args, report),
            b"INDIRV" if matches!(args.numbers(), [_, _, _]) && !args.odd => {
                let &[i, j, k] = args.numbers() else { return None };
                self.kept.direction = Some(self.kept.frame.vector(Vec3::new(i, j, k)));
            }
            b"TLON" => return self.drive_circle(record, report),
            b"DELAY" => return Some(self.delay(&args, report)),
            b"FEDRAT" => self.fedrat(&args, report),
            b"UNITS" | b"UNIT" => self.units(&args, report),
            b"MULTAX" => self.multax(args.has(program, "OFF")),
            b"TLAXIS" => self.tool_axis(&args, report),
            b"SPINDL" => self.spindl(&args, report),
            b"CUTTER" => self.cutter(&args, report),
            b"TLDATA" => self.tool_data(&args, program),
            b"LOADTL" => self.load_tool(&args, report),
            b"LOAD" | b"TOOLNO" if args.has(program, "TOOL") || record.is("TOOLNO") => self.load_tool(&args, report),
            b"CUTCOM" => self.cutcom(&args, report),
            b"CYCLE" => self.cycle(record, report),
            b"AUXFUN" => self.auxiliary(&args, report),
            b"END" | b"FINI" => {
                self.core.state.ended = true;
                self.core.proper_end = true;
            }
            _ => self.other_record(record, report),
        }
        None
    }

    /// Records that only the dialect's table knows.
    fn other_record(&mut self, record: &Record<'_>, report: &mut Report<'_>) {
        let text = report.program.text(record.major).into_owned();
        let Some(code) = self.core.dialect.name(&text) else {
            report.fault(record.major, FaultKind::AptUnknownRecord);
            return self.unknown_record(text, report);
        };
        let args = Args::new(record);
        let program = report.program;
        match code.action {
            _ if self.frame_record(record, &args, report) => {}
            _ if record.is("INSERT") => {
                let what = "INSERT: the text that it passes to the machine is not read".to_owned();
                report.fault(record.range, FaultKind::NotModelled { what });
                self.lose_place();
            }
            Action::FrameChange
                if (args.has(program, "OFF") || args.has(program, "NOMORE"))
                    && !self.kept.frame.is_shifted_by(record) =>
            {
                let ended = self.core.unknown.end(code);
                self.core.forget_if(ended);
            }
            Action::NotModelled | Action::FrameChange | Action::CannedCycle | Action::SubprogramCall => {
                report.fault(record.range, FaultKind::NotModelled { what: text });
                self.forget_everything_of(code.action);
                if code.action == Action::FrameChange {
                    self.core.unknown.begin(code, false);
                }
                self.kept.circle = None;
                self.kept.axis_lost = true;
            }
            _ => {}
        }
        self.core
            .state
            .zero
            .lose(self.core.unknown.any() || self.kept.frame.is_lost());
    }

    /// An unknown record may move the tool or the coordinates: neither is known until the end of the program.
    fn unknown_record(&mut self, what: String, report: &mut Report<'_>) {
        report.fault(report.whole(), FaultKind::NotModelled { what });
        self.lose_place();
        self.core.unknown.for_good();
        self.core.state.zero.lose(true);
    }

    /// Where the tool is, and along which axis, is not known until a GOTO says so.
    fn lose_place(&mut self) {
        self.core.forget_position();
        self.kept.circle = None;
        self.kept.axis = None;
        self.kept.axis_lost = true;
    }

    fn forget_everything_of(&mut self, action: Action) {
        if action == Action::SubprogramCall {
            self.core.forget_everything();
        } else {
            self.core.forget_position();
        }
    }

    fn units(&mut self, args: &Args, report: &mut Report<'_>) {
        let unit = match args.words().first() {
            Some(&word) if is(report.program, word, "MM") => 1.0,
            Some(&word) if is(report.program, word, "CM") => 10.0,
            Some(&word)
                if ["INCHES", "INCH", "IN"]
                    .iter()
                    .any(|inch| is(report.program, word, inch)) =>
            {
                25.4
            }
            _ => {
                let what = report.program.text(report.whole()).into_owned();
                report.fault(TextRange::default(), FaultKind::NotModelled { what });
                self.core.forget_position();
                return;
            }
        };
        self.core.state.units(unit, unit);
    }

    /// SPINDL/n[,RPM][,CLW|CCLW], SPINDL/ON, SPINDL/OFF; a cutting speed (SFM, SMM) leaves the turns unknown.
    fn spindl(&mut self, args: &Args, report: &Report<'_>) {
        let program = report.program;
        if args.has(program, "OFF") {
            self.core.state.spindle.switch(false);
            return;
        }
        if args.has(program, "LOCK") || args.has(program, "ORIENT") {
            self.core.state.spindle.switch(false);
            return;
        }
        self.core.state.spindle.switch(true);
        if let Some(&speed) = args.numbers().first() {
            let cutting_speed = args.has(program, "SFM") || args.has(program, "SMM");
            self.core
                .state
                .spindle
                .set_rpm(Some(speed).filter(|_| !cutting_speed && !args.odd));
            if speed == 0.0 {
                self.core.state.spindle.switch(false);
            }
        }
    }

    fn cutcom(&mut self, args: &Args, report: &mut Report<'_>) {
        let program = report.program;
        self.core.state.compensation = if args.has(program, "LEFT") {
            41
        } else if args.has(program, "RIGHT") {
            42
        } else {
            0
        };
        let on = self.core.state.compensation != 0 || args.has(program, "ON");
        if on && !std::mem::replace(&mut self.core.compensation_reported, true) {
            let what = "cutter radius compensation: the programmed path is used instead".to_owned();
            report.fault(TextRange::default(), FaultKind::NotModelled { what });
        }
    }

    /// CYCLE/...: each GOTO until CYCLE/OFF runs it; CYCLE/ON resumes the last one, CYCLE/INIT announces one.
    fn cycle(&mut self, record: &Record<'_>, report: &mut Report<'_>) {
        match cycle::describes_none(record, report.program) {
            Some("OFF" | "NOMORE") => self.core.state.motion = Some(Action::Linear),
            Some("INIT") => {}
            Some(_) => self.core.state.motion = Some(Action::CannedCycle),
            None => {
                self.core.state.motion = Some(Action::CannedCycle);
                self.kept.cycle_said = false;
                let hole = cycle::hole(record, self.core.state.coordinates.unit_mm());
                if let Err(why) = &hole {
                    let what = format!("CYCLE/{why}");
                    report.fault(TextRange::default(), FaultKind::NotModelled { what });
                }
                self.kept.hole = hole.ok();
            }
        }
    }
}
