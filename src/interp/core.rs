//! What every engine has: the settings of the run, the modal state, tools, unknown coordinates, effects.
use crate::effects::Effects;
use crate::reported::Reported;
use crate::spin::spin;
use crate::tools::Tools;
use crate::unknown::Unknown;
use crate::{
    Argument, ChainId, Effect, Fault, FaultKind, Feed, FeedMode, ModalState, Motion, MotionKind, Orientation, Position,
    Setup, Sink, Tilt,
};
use std::sync::Arc;
use trunnion_dialect::Dialect;
use trunnion_geometry::Vec3;
use trunnion_syntax::{BlockId, Program, TextRange};

/// X, Y, Z, U, V, W in [`crate::AXIS_LETTERS`].
pub(crate) const LINEAR: u16 = 0b1_1100_0111;
/// X, Y, Z.
const XYZ: u16 = 0b111;
/// A, B, C.
pub(crate) const ROTARY: u16 = 0b0_0011_1000;
/// A norm may differ from 1 by this because of six written decimals.
const UNIT_NORM: f64 = 1e-5;

/// See the module.
#[derive(Clone)]
pub(crate) struct Core<'d> {
    pub(crate) dialect: &'d Dialect,
    pub(crate) setup: Arc<Setup>,
    /// What is in effect.
    pub(crate) state: ModalState,
    /// The calls in which the current block runs.
    pub(crate) chain: ChainId,
    /// The block of the main program whose call led to the other file that runs.
    pub(crate) called_at: Option<BlockId>,
    pub(crate) tools: Tools,
    /// Codes that made coordinates unknown.
    pub(crate) unknown: Unknown<'d>,
    /// What the program does apart from its motions.
    pub(crate) effects: Effects,
    /// How often everything may have changed: missing programs, words that are not understood.
    pub(crate) losses: u64,
    /// How often the machine has moved without a motion: tool changes.
    pub(crate) relocations: u32,
    /// F has a value that is not evaluated.
    pub(crate) feed_unread: bool,
    /// The feed changes along each motion (FLIN, FCUB, FPO of a Sinumerik).
    pub(crate) feed_profile: bool,
    /// The program sets another share of the feed, or of the rapid, than 100 %.
    pub(crate) overridden: (bool, bool),
    /// What F means is not modelled (G931).
    pub(crate) feed_mode_unread: bool,
    /// It was reported that cutter compensation is not followed.
    pub(crate) compensation_reported: bool,
    /// Work offsets that were reported as missing.
    pub(crate) offsets_reported: Reported,
    /// The last block with content, for a missing program end.
    pub(crate) last_content: Option<BlockId>,
    /// A code or character that ends the program was seen.
    pub(crate) proper_end: bool,
    /// Rotary axes that a word with a direction has carried to a coordinate beyond what it said, bits as in [`Position::known`].
    pub(crate) carried: u16,
    /// Rotary axes whose zero point is not known, bits as in [`Position::known`].
    pub(crate) turned: u16,
    /// Axes that are always at 0.
    pub(crate) standing: crate::standing::Standing,
    /// Coordinates along X are radii, whatever the machine file says about words.
    pub(crate) radii: bool,
    /// What A and C of a lathe mean.
    pub(crate) drawing: crate::drawing::Drawing,
}

/// Where facts about the current block are sent.
pub(crate) struct Report<'a> {
    pub(crate) program: &'a Program,
    pub(crate) block: BlockId,
    /// Bytes of the record, in APT.
    pub(crate) record: Option<TextRange>,
    pub(crate) faults: &'a mut dyn FnMut(Fault),
}

impl Report<'_> {
    /// Bytes of the current record or block.
    #[cold]
    pub(crate) fn whole(&self) -> TextRange {
        self.record.unwrap_or_else(|| self.program.block(self.block).range())
    }
    /// A fact; an empty range means the whole block.
    #[cold]
    pub(crate) fn fault(&mut self, range: TextRange, kind: FaultKind) {
        let range = if range == TextRange::default() {
            self.whole()
        } else {
            range
        };
        (self.faults)(Fault {
            place: None,
            block: self.block,
            range,
            kind,
        });
    }
}

impl<'d> Core<'d> {
    /// How many entries of lists that grow with the program a clone copies.
    pub(crate) fn copied(&self) -> usize {
        self.tools.copied() + self.offsets_reported.copied()
    }

    /// At the start of a program.
    pub(crate) fn new(dialect: &'d Dialect, setup: &Setup) -> Self {
        let mut state = crate::start::power_on_state(dialect, &setup.control);
        let standing = crate::standing::Standing::new(dialect, setup);
        standing.hold(&mut state.position);
        Self {
            dialect,
            setup: Arc::new(setup.clone()),
            state,
            chain: ChainId::MAIN,
            called_at: None,
            tools: Tools::new(setup),
            unknown: Unknown::default(),
            effects: Effects::default(),
            losses: 0,
            relocations: 0,
            feed_unread: false,
            feed_profile: false,
            overridden: (false, false),
            feed_mode_unread: false,
            compensation_reported: false,
            carried: 0,
            turned: 0,
            offsets_reported: Reported::default(),
            last_content: None,
            proper_end: false,
            standing,
            drawing: crate::drawing::Drawing::new(dialect, setup),
            radii: dialect.quirks.diameter,
        }
    }

    /// The block of the main program to which a block of the program that runs belongs.
    #[inline]
    pub(crate) fn main_block(&self, block: BlockId) -> BlockId {
        self.called_at.unwrap_or(block)
    }

    /// A zero point is set at the current position of the machine. If that depends on undeclared values, the order matters: the same words
    /// after another offset, another length, or a motion in machine coordinates mean another position. `by`: the code, where it writes a stored value, which depends on them in any case.
    #[cold]
    pub(crate) fn set_from_here(&mut self, block: BlockId, by: Option<&'static str>) {
        if self.effects.wanted() && self.state.undeclared().any() {
            let offset = self.state.zero.offset().unwrap_or("no work offset");
            let mut words = vec![
                Argument::code("zero point set from here"),
                Argument::text("in", offset),
                Argument::text("with", &self.state.length.of().to_string()),
            ];
            words.extend(by.map(Argument::code));
            self.effects.add(block, Effect::Event(words));
        }
    }

    /// The position is unknown from now on.
    pub(crate) fn forget_position(&mut self) {
        self.state.position.known = 0;
        self.standing.hold(&mut self.state.position);
        self.state.orientation = Orientation::Words;
    }
    /// Makes coordinates unknown if they have changed their meaning.
    pub(crate) fn forget_if(&mut self, changed: bool) {
        if changed {
            self.forget_position();
        }
    }
    /// X Y Z U V W are unknown from now on.
    pub(crate) fn forget_linear(&mut self) {
        self.state.position.known &= !LINEAR;
        self.standing.hold(&mut self.state.position);
    }
    /// The machine moves its linear axes without a motion: to that place, which the caller sets, or to an unknown one.
    pub(crate) fn relocate(&mut self, place: Option<&Position>) {
        if place.is_none_or(|place| place.known != 0) {
            self.relocations = self.relocations.wrapping_add(1);
        }
    }
    /// A subprogram may have changed anything.
    pub(crate) fn forget_everything(&mut self) {
        self.losses += 1;
        self.standing.end_unnamed();
        self.forget_position();
        self.state.clamps.lose();
        self.state.spindle.forget();
        self.state.feed.set(None);
        self.feed_unread = true;
    }

    /// To be called whenever the tool in use or what is declared about it changes.
    pub(crate) fn merge_tool(&mut self) {
        self.state.tool.declare(self.tools.data(self.state.tool.number()));
    }

    /// The program's own declarations of tools apply to the whole program, wherever they are.
    pub(crate) fn declare(&mut self, program: &Program) {
        if self.tools.read_directives(program) {
            self.merge_tool();
        }
        self.standing.read(program, self.dialect);
        self.drawing.read(program);
        self.standing.hold(&mut self.state.position);
    }

    /// The feed of a motion; reports at `range` when there is none.
    pub(crate) fn feed(&self, kind: MotionKind, range: impl FnOnce() -> TextRange, report: &mut Report<'_>) -> Feed {
        if kind == MotionKind::Rapid {
            return if self.overridden.1 { Feed::Unknown } else { Feed::Rapid };
        }
        match self.state.feed.value() {
            _ if self.feed_mode_unread => Feed::Unknown,
            Some(_) if self.feed_profile || self.overridden.0 => Feed::Unknown,
            Some(feed) if feed > 0.0 => match self.state.feed.mode() {
                FeedMode::PerMinute => Feed::PerMinute(feed),
                FeedMode::PerRevolution => Feed::PerRevolution(feed),
                FeedMode::InverseTime => Feed::InverseTime(feed),
            },
            None if self.feed_unread => Feed::Unknown,
            feed => {
                let (inverse_time, zero) = (self.state.feed.mode() == FeedMode::InverseTime, feed.is_some());
                report.fault(range(), FaultKind::MissingFeed { inverse_time, zero });
                Feed::Unknown
            }
        }
    }

    /// The orientation that is in effect with nothing programmed.
    pub(crate) fn held_orientation(&self) -> Orientation {
        match self.state.orientation {
            Orientation::Words => Orientation::Words,
            Orientation::Vector(_, vector) => Orientation::Vector(Some(vector), vector),
        }
    }

    pub(crate) fn unknown_orientation(&mut self) -> Orientation {
        self.state.position.known &= !ROTARY;
        Orientation::Words
    }

    /// The orientation along a vector of any length; reports a length that should be 1, and 0.
    pub(crate) fn unit_vector(
        &mut self,
        vector: Vec3,
        unit: bool,
        range: TextRange,
        report: &mut Report<'_>,
    ) -> Orientation {
        let norm = vector.norm();
        if norm <= f64::MIN_POSITIVE || !norm.is_finite() {
            report.fault(range, FaultKind::VectorNotUnit { norm: 0.0 });
            return self.unknown_orientation();
        }
        if unit && (norm - 1.0).abs() > UNIT_NORM {
            report.fault(range, FaultKind::VectorNotUnit { norm });
        }
        let before = match self.state.orientation {
            Orientation::Vector(_, before) => Some(before),
            Orientation::Words => None,
        };
        Orientation::Vector(before, vector / norm)
    }

    /// A motion with the modal state.
    #[inline]
    pub(crate) fn new_motion(
        &self,
        kind: MotionKind,
        mut start: Position,
        mut end: Position,
        orientation: Orientation,
        feed: Feed,
        report: &Report<'_>,
    ) -> Motion {
        let state = &self.state;
        self.standing.hold(&mut start);
        self.standing.hold(&mut end);
        Motion {
            block: self.main_block(report.block),
            chain: self.chain,
            kind,
            start,
            end,
            says_way: 0,
            ways: crate::Ways::default(),
            orientation,
            tcp: state.tool_axis.tcp(),
            great_circle: state.tool_axis.great_circle(),
            feed,
            spindle_on: state.spindle.on(),
            spindle_rpm: state.spindle.rpm(),
            spin: spin(state, self.radii, kind, [&start, &end]),
            zero: state.zero.values(),
            tool_length_mm: state.length.mm().unwrap_or(0.0),
            undeclared: state.undeclared(),
            machine_coordinates: false,
            radii: self.radii,
            tool: state.tool.number(),
            tilt: Tilt::default(),
            effects: self.effects.count(),
            relocations: self.relocations,
            slack_mm: 0.0,
        }
    }

    /// Gives a motion the spindle's state in effect.
    pub(crate) fn spindle_of(&self, motion: &mut Motion) {
        (motion.spindle_on, motion.spindle_rpm) = (self.state.spindle.on(), self.state.spindle.rpm());
        motion.spin = spin(&self.state, motion.radii, motion.kind, [&motion.start, &motion.end]);
    }

    /// The same, its coordinates unknown where a frame is not modelled.
    pub(crate) fn motion_in_frame(
        &self,
        kind: MotionKind,
        [start, end]: [Position; 2],
        orientation: Orientation,
        feed: Feed,
        report: &Report<'_>,
    ) -> Motion {
        let mut motion = self.new_motion(kind, start, end, orientation, feed, report);
        if self.state.zero.is_lost() {
            self.hide(&mut motion);
        } else if self.turned != 0 {
            hide_axes(&mut motion, self.turned);
        }
        motion
    }

    /// Under a frame that is not modelled X Y Z and vectors say nothing about the machine; nor do rotary axes if it moves them.
    pub(crate) fn hide(&self, motion: &mut Motion) {
        let hidden = if self.unknown.hides_rotary() {
            LINEAR | ROTARY
        } else {
            LINEAR
        };
        hide_axes(motion, hidden | self.turned);
        self.moves_all(motion);
        if let MotionKind::Arc(arc) = &mut motion.kind {
            *arc = None;
        }
        if let Orientation::Vector(before, vector) = motion.orientation {
            motion.orientation = Orientation::Words;
            if before != Some(vector) {
                // it turns the rotary axes to an unknown place
                motion.kind = MotionKind::Unknown;
            }
        }
    }

    /// In a system that is not known, and may be turned, a word of one linear axis moves all of X, Y and Z.
    pub(crate) fn moves_all(&self, motion: &mut Motion) {
        let lost = self.state.zero.is_lost() || self.unknown.any();
        if lost && !motion.machine_coordinates && motion.says_way & !motion.end.known & LINEAR != 0 {
            motion.says_way |= XYZ & !motion.end.known;
        }
    }

    /// Emits the effects that were collected.
    pub(crate) fn emit_effects(&mut self, sink: &mut impl Sink) {
        for effect in self.effects.take() {
            sink.effect(effect);
        }
    }

    /// Reports a missing program end.
    pub(crate) fn missing_end(&self, program: &Program, sink: &mut impl Sink) {
        if let Some(block) = self.last_content.filter(|_| !self.proper_end) {
            let range = program.block(block).range();
            let kind = FaultKind::MissingProgramEnd;
            sink.fault(Fault {
                place: None,
                block,
                range,
                kind,
            });
        }
    }
}

/// Coordinates of some axes say nothing about the machine.
fn hide_axes(motion: &mut Motion, hidden: u16) {
    // such a coordinate moves its axis to an unknown place
    for axis in (0..9).filter(|axis| hidden & 1 << axis != 0) {
        let to = motion.end.get(axis);
        let moves = to.is_some() && to != motion.start.get(axis);
        motion.says_way |= u16::from(moves) << axis;
    }
    motion.start.known &= !hidden;
    motion.end.known &= !hidden;
}
