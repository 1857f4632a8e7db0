//! What the codes of a block change, in the order in which a control acts on them.
use crate::core::Report;
use crate::cycles::{Pattern, Repeated};
use crate::frames::Return;
use crate::iso::Iso;
use crate::tcp::tcp_variant;
use crate::travel::Travel;
use crate::words::{WordValue, Words};
use crate::{FaultKind, LengthOf, TcpMistake};
use trunnion_dialect::{Action, Code, CodeKind, Macros, Plane};
use trunnion_syntax::TextRange;

/// A code in a block.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found<'d> {
    pub(crate) code: &'d Code,
    pub(crate) range: TextRange,
    /// A name with something between its parentheses.
    pub(crate) with_arguments: bool,
}

/// What the codes of a block mean for this block alone.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct BlockCodes {
    /// Number of codes.
    pub(crate) count: usize,
    /// The motion code in the block.
    pub(crate) motion: Option<Action>,
    /// A code whose motion is not modelled.
    pub(crate) not_modelled: bool,
    /// A code that uses up the coordinates of the block without moving there.
    pub(crate) takes_coordinates: bool,
    pub(crate) dwell: bool,
    pub(crate) machine_coordinates: bool,
    pub(crate) end: bool,
    /// A return to a reference point.
    pub(crate) returns: Option<(Return, TextRange)>,
    /// A pattern of holes.
    pub(crate) pattern: Option<Pattern>,
    /// A turning cycle of many cuts.
    pub(crate) repeated: Option<Repeated>,
    /// A circular pocket.
    pub(crate) pocket: bool,
    /// Which code of the block is a drilling cycle with its numbers.
    pub(crate) hole_call: Option<usize>,
    /// MCALL comes before it.
    pub(crate) modal_call: bool,
    /// M5: after the motion of the block.
    pub(crate) stops_spindle: bool,
    /// M0 or M1, after the motion of the block; whether it is the optional one.
    pub(crate) stops_program: Option<bool>,
}

/// Place in the order of execution (RS274/NGC, version 3, section 3.8: feed mode, F, S, T, tool change, spindle, dwell, plane,
/// units, compensation, length, work offset, distance mode, motion, stop). Units come first, so that F of the same block has them.
fn rank(code: &Code) -> u8 {
    if crate::feed_speed::meaning_of_feed(code).is_some() {
        return 1;
    }
    match code.action {
        Action::Inch | Action::InchLengthsOnly | Action::Metric => 0,
        Action::ConstantSurfaceSpeed | Action::ConstantSpindleSpeed => 2,
        Action::Dwell => 3,
        Action::ToolChange => FIRST_AFTER_WORDS,
        Action::SpindleClockwise | Action::SpindleCounterClockwise | Action::SpindleStop => 5,
        Action::PlaneXy | Action::PlaneZx | Action::PlaneYz => 6,
        Action::CompensationOff | Action::CompensationLeft | Action::CompensationRight => 7,
        Action::ToolLengthOn | Action::ToolLengthOff => 8,
        Action::TcpOn | Action::TcpVectorOn | Action::TcpOff => 9,
        Action::WorkOffset
        | Action::WorkOffsetNone
        | Action::WorkSystem
        | Action::WorkSystemOnce
        | Action::MachineCoordinates => 10,
        Action::Absolute | Action::Incremental => 11,
        Action::FrameReset | Action::RotationOff | Action::ScalingOff | Action::MirrorOff | Action::PolarOff => 12,
        Action::TiltedPlaneTurn | Action::TiltedPlaneTurnTip | Action::ProgramStop | Action::ProgramEnd => 14,
        _ => 13,
    }
}

/// Codes of this rank and above act after F, S and T.
const FIRST_AFTER_WORDS: u8 = 4;

impl<'d> Iso<'d> {
    /// Applies all codes and the words F S T D; returns what concerns the block's motion.
    pub(crate) fn apply(&mut self, codes: &mut [Found<'d>], words: &Words, report: &mut Report<'_>) -> BlockCodes {
        if codes.len() > 1 {
            conflicts(codes, report);
            codes.sort_by_key(|found| rank(found.code));
        }
        let mut block = BlockCodes {
            count: codes.len(),
            hole_call: codes.iter().position(|found| found.code.action == Action::HoleCall),
            ..BlockCodes::default()
        };
        let goes_on = codes.iter().any(|found| found.code.action == Action::TiltedPlane);
        if self.memory.frames.pending.is_some() && !goes_on && (!codes.is_empty() || words.axes.any()) {
            self.plane_broken_off(report);
        }
        let shaped = !self.memory.frames.shape.is_identity();
        let mut rest = &*codes;
        while let Some((found, after)) = rest
            .split_first()
            .filter(|(found, _)| rank(found.code) < FIRST_AFTER_WORDS)
        {
            self.apply_code(found, words, &mut block, report);
            rest = after;
        }
        self.feed_word(codes, words);
        self.override_words(words, report);
        if self.core.dialect.quirks.whole_numbers.lengths_ambiguous() {
            self.whole_feed(codes, words, report);
        }
        self.speed_word(codes, words);
        self.tool_word(words, report);
        if self.writes_feed_reference() {
            self.feed_references(report);
        }
        for found in rest {
            self.apply_code(found, words, &mut block, report);
        }
        if words.edge.is_given() {
            self.edge_word(words.edge, report);
        }
        if words.length_offset.is_given() {
            self.length_word_alone(codes, words, report);
        }
        if self.core.dialect.quirks.offset_compensation && self.core.state.compensation == 0 {
            self.cutter_number_ahead(words);
        }
        if let Some(at) = self.memory.frames.dynamic {
            self.dynamic_offset_holds(&at, words, report);
        }
        if words.axes.any() {
            crate::unmodelled::data_codes(codes, words, &mut block, report);
        }
        if shaped {
            self.not_in_shapes(codes, &mut block, report);
        }
        let lost = self.core.unknown.any() || self.memory.frames.pending.is_some();
        self.core.state.zero.lose(lost);
        block
    }

    fn apply_code(&mut self, found: &Found<'d>, words: &Words, block: &mut BlockCodes, report: &mut Report<'_>) {
        if let Some(mode) = crate::feed_speed::meaning_of_feed(found.code) {
            self.feed_mode(mode);
        }
        self.note_group(found);
        let state = &mut self.core.state;
        self.core.unknown.restore_known(found.code);
        match found.code.action {
            motion @ (Action::Rapid
            | Action::Linear
            | Action::ArcClockwise
            | Action::ArcCounterClockwise
            | Action::ArcThroughPoint
            | Action::ArcTangent
            | Action::Polynomial
            | Action::Thread
            | Action::VariableThread) => {
                state.motion = Some(motion);
                self.memory.cycle.rigid = false;
                block.motion = Some(motion);
                if matches!(motion, Action::Thread | Action::VariableThread) {
                    self.memory.cycle.letters = crate::unused::letters(found.code);
                }
            }
            Action::Dwell => block.dwell = true,
            Action::PlaneXy => state.coordinates.set_plane(Plane::Xy),
            Action::PlaneZx => state.coordinates.set_plane(Plane::Zx),
            Action::PlaneYz => state.coordinates.set_plane(Plane::Yz),
            Action::Absolute => state.coordinates.set_incremental(false),
            Action::Incremental => state.coordinates.set_incremental(true),
            Action::ArcCentreAbsolute => state.coordinates.set_arc_centre_absolute(true),
            Action::ArcCentreIncremental => state.coordinates.set_arc_centre_absolute(false),
            Action::Inch => state.units(25.4, 25.4),
            Action::InchLengthsOnly => state.units(25.4, 1.0),
            Action::Metric => state.units(1.0, 1.0),
            Action::ConstantSurfaceSpeed => {
                state.spindle.set_surface_speed(true);
            }
            Action::ConstantSpindleSpeed => state.spindle.set_surface_speed(false),
            Action::SpindleClockwise | Action::SpindleCounterClockwise => {
                state.spindle.switch(true);
                let counter_clockwise = found.code.action == Action::SpindleCounterClockwise;
                self.memory.cycle.counter_clockwise = Some(counter_clockwise);
            }
            Action::SpindleStop => block.stops_spindle = true,
            Action::ToolChange => self.change_tool(words, report),
            Action::MachineCoordinates => block.machine_coordinates = true,
            Action::OrientationAxes => state.tool_axis.set_great_circle(Some(false)),
            Action::OrientationVector => state.tool_axis.set_great_circle(Some(true)),
            Action::ProgramEnd => block.end = true,
            Action::NoMotion if found.code.group.as_deref() == Some("thread-chamfer") => {
                self.memory.thread_chamfer_off = found.code.id == "M24";
            }
            Action::NoMotion if found.code.id == "M29" && self.core.dialect.quirks.macros == Macros::Fanuc => {
                self.memory.cycle.rigid = true;
            }
            // S and M3 to M5 are those of another spindle from here on (SINUMERIK Programming Manual, Fundamentals: SETMS)
            Action::NoMotion if found.code.group.as_deref() == Some("master-spindle") => {
                self.names_main_spindle(found, report);
            }
            Action::NoMotion if found.code.group.as_deref() == Some("orientation-angles") => {
                self.memory.own.contour.euler = found.code.id == "ORIEULER";
            }
            Action::ProgramStop => block.stops_program = Some(found.code.id != "M0"),
            Action::PathMode if found.with_arguments && found.code.id == "CYCLE832" => self.high_speed(found, report),
            // B-63944EN, high-speed cycle machining: P calls a cycle from P10001 on, whose data lie in the control
            Action::PathMode
                if found.code.id == "G5" && words.p.index().is_some_and(|p| (10001..=10999).contains(&p)) =>
            {
                self.high_speed_cycle(found, block, report);
            }
            Action::FeedInverseTime
            | Action::FeedPerMinute
            | Action::FeedPerRevolution
            | Action::NoMotion
            | Action::PathMode
            | Action::Declaration => {}
            _ => self.apply_rare(found, words, block, report),
        }
    }

    fn high_speed_cycle(&mut self, found: &Found<'d>, block: &mut BlockCodes, report: &mut Report<'_>) {
        let what = "G5 P10001 to P10999: high-speed cycle machining, whose path lies in the control".to_owned();
        report.fault(found.range, FaultKind::NotModelled { what });
        block.not_modelled = true;
        self.core.forget_everything();
    }

    /// MCALL followed by a cycle begins, MCALL alone ends; any other cycle is not modelled.
    fn cycle_code(&mut self, found: &Found<'d>, words: &Words, block: &mut BlockCodes, report: &mut Report<'_>) {
        let alone = block.count == 1 && !words.forgets_all;
        let ends = found.code.kind == CodeKind::Name && !found.with_arguments && alone;
        self.memory.own.modal = None;
        if ends && words.has_values {
            let what = "words beside MCALL without a cycle or a program".to_owned();
            report.fault(found.range, FaultKind::NotModelled { what });
            block.not_modelled = true;
        }
        if ends {
            self.cycle_off(found.code);
        } else if block.hole_call.is_some() {
            block.modal_call = true;
        } else {
            self.canned_cycle(found, block, report);
        }
    }

    fn apply_rare(&mut self, found: &Found<'d>, words: &Words, block: &mut BlockCodes, report: &mut Report<'_>) {
        self.zero_in_compensation(found, words, report);
        match found.code.action {
            Action::CompensationOff => self.core.state.compensation = 0,
            Action::CompensationLeft => self.compensation(41, found, words, report),
            Action::CompensationRight => self.compensation(42, found, words, report),
            Action::ToolLengthOn => {
                self.note_length();
                self.end_tcp_of_group(found.code);
                // H is modal, and which one is in effect at the start of the program is not known
                let no_number = !words.length_offset.is_given() && self.memory.length_offset.is_none();
                if no_number && self.core.dialect.quirks.macro_b() {
                    self.unstated_length("a length offset without H", found.range, report);
                } else {
                    self.length_on(words.length_offset, found.range, report);
                }
            }
            Action::ToolLengthOff => {
                self.note_length();
                self.end_tcp_of_group(found.code);
                self.set_length(None, LengthOf::Nothing);
            }
            Action::TcpOn | Action::TcpVectorOn => self.tcp_code(found, words, report),
            Action::TcpOff => {
                self.core.unknown.end(found.code);
                self.tcp_off();
                self.length_after_tip_control();
            }
            Action::WorkOffset => self.work_offset(found, words, report),
            Action::WorkSystem | Action::WorkSystemOnce => self.work_system(found, words, block, report),
            Action::WorkOffsetNone => self.no_work_offset(&found.code.id),
            Action::FrameReset => self.frame_reset(found, words, block, report),
            Action::FrameChange if found.code.id == "G254" => self.dynamic_offset(found, words, block, report),
            Action::FrameChange => self.frame_change(found, words, block, report),
            Action::FrameLost => self.frame_lost(found, words, block, report),
            Action::CannedCycle => self.cycle_code(found, words, block, report),
            Action::CycleOff => self.cycle_off(found.code),
            Action::PointToPoint | Action::PointToPointRapid | Action::ContinuousPath => {
                self.memory.travel = Travel::of(found.code.action).unwrap_or_default();
            }
            Action::Skip => {
                let what = format!(
                    "{}: the position at which the skip signal ends the motion",
                    found.code.id
                );
                report.fault(found.range, FaultKind::NotModelled { what });
                block.not_modelled = true;
                if words.axes.any() {
                    self.feed_of(crate::MotionKind::Linear, words, report);
                }
            }
            Action::HoleCall => {}
            Action::NotFollowed => {
                block.takes_coordinates |= found.code.kind == CodeKind::G;
                // a limit of the speed alone
                if found.code.kind == CodeKind::Name || words.axes.any() {
                    not_modelled(found, report);
                }
            }
            Action::SubprogramCall => {
                block.not_modelled = true;
                self.memory.cycle.hole.not_read();
                not_modelled(found, report);
                self.core.forget_everything();
                if found.code.group.as_deref() == Some("macro-call") {
                    // a macro runs after each motion, or instead of each block, until G67
                    self.core.unknown.begin(found.code, false);
                    self.core.unknown.turns_axes(found.code);
                }
            }
            _ => self.apply_frame(found, words, block, report),
        }
    }

    /// G43.4, G43.5 and their kind.
    fn tcp_code(&mut self, found: &Found<'d>, words: &Words, report: &mut Report<'_>) {
        let along = self.core.setup.length_along();
        let unread = tcp_variant(found, words, along, report);
        let wants_number = found.code.words.iter().any(|word| word == "H");
        if wants_number && !words.length_offset.is_given() && self.lacks_length_number() {
            report.fault(found.range, FaultKind::TcpState(TcpMistake::NoLengthNumber));
        }
        let user_task = self.core.dialect.quirks.user_task();
        if wants_number && user_task && !words.length_offset.is_given() {
            self.tip_length_unstated(found, report);
        } else if words.length_offset.is_given() || wants_number {
            self.length_on(words.length_offset, found.range, report);
        }
        self.tcp_on(found.code, found.code.action == Action::TcpVectorOn, report);
        if let Some(what) = unread {
            report.fault(found.range, FaultKind::NotModelled { what });
            self.core.unknown.begin(found.code, true);
            self.core.forget_position();
        }
    }
}

/// The fact that a code is not modelled.
pub(crate) fn not_modelled(found: &Found<'_>, report: &mut Report<'_>) {
    let what = found.code.id.clone();
    report.fault(found.range, FaultKind::NotModelled { what });
}

/// Whether a dwell of the block takes the word for itself.
pub(crate) fn dwell_reads(codes: &[Found<'_>], word: &str) -> bool {
    codes
        .iter()
        .any(|found| found.code.action == Action::Dwell && found.code.words.iter().any(|known| known == word))
}

/// Two different codes of one group.
fn conflicts(codes: &[Found<'_>], report: &mut Report<'_>) {
    for (at, second) in codes.iter().enumerate() {
        let Some(group) = second.code.group.as_deref() else {
            continue;
        };
        let first = codes[..at]
            .iter()
            .find(|first| first.code.group.as_deref() == Some(group));
        if let Some(first) = first.filter(|first| !std::ptr::eq(first.code, second.code)) {
            let kind = FaultKind::GroupConflict {
                group: group.to_owned(),
                first: first.code.id.clone(),
                second: second.code.id.clone(),
                first_range: first.range,
            };
            report.fault(second.range, kind);
        }
    }
}

impl WordValue {
    /// A whole number that is not negative, as numbers of tools and offsets are.
    pub(crate) fn index(self) -> Option<u32> {
        let value = self.number()?.value;
        (value >= 0.0 && value.fract() == 0.0 && value <= f64::from(u32::MAX)).then_some(value as u32)
    }
}
