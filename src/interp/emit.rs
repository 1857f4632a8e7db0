//! The motion of an ISO block, from its words and what is in force.
use crate::arc::{ArcSetting, arc};
use crate::codes::BlockCodes;
use crate::frames::XYZ;
use crate::memory::Chosen;
use crate::offsets::{LINEAR, ROTARY};
use crate::run::{Interpreter, Report};
use crate::travel::Travel;
use crate::words::{Places, Said, Words};
use crate::{FaultKind, Feed, FeedMode, Motion, MotionKind, Orientation, Position};
use trunnion_dialect::Action;
use trunnion_geometry::arc::Turning;

/// A coordinate that differs by no more than this has not moved, mm: sums of offsets round.
const STANDS_MM: f64 = 1e-9;

impl Interpreter<'_> {
    pub(crate) fn modelled_motion(&mut self, words: &Words, block: &BlockCodes, report: &mut Report<'_>) -> Motion {
        let frame_hides = self.state.frame_unknown && !block.machine_coordinates;
        let mut start = self.state.position;
        if block.machine_coordinates {
            self.to_machine(&mut start, 1.0);
        }
        let shaped = self.memory.frames.active && !block.machine_coordinates;
        let from = if shaped {
            self.memory.frames.programmed(&start)
        } else {
            start
        };
        let mut end = from;
        if shaped {
            self.place(words, &mut end);
        } else {
            self.targets(&words.axes, block.machine_coordinates, &mut end);
        }
        if block.machine_coordinates {
            self.suppressed_length(words, &mut end, report);
        }
        self.turned_by_hand(words, &mut end, block.machine_coordinates);
        let mut kind = match self.state.motion {
            Some(Action::Rapid) => MotionKind::Rapid,
            Some(Action::ArcClockwise) => self.arc(words, from, end, Turning::Clockwise, report),
            Some(Action::ArcCounterClockwise) => self.arc(words, from, end, Turning::CounterClockwise, report),
            _ => MotionKind::Linear,
        };
        if shaped {
            end = self.memory.frames.arrive(end);
            kind = self.memory.frames.kind_to_work(kind);
        }
        self.state.position = end;
        let orientation = self.orientation(words, report);
        if let Orientation::Vector(..) = orientation {
            self.memory.led_by_vector = true;
            self.state.position.known &= !ROTARY;
            end.known &= !ROTARY;
        }
        end.known &= self.state.position.known;
        if block.machine_coordinates {
            let mut position = end;
            self.to_machine(&mut position, -1.0);
            self.state.position = position;
        }
        let feed = if self.state.motion == Some(Action::Thread) {
            self.lead(words, report)
        } else if self.state.motion == Some(Action::VariableThread) {
            // the lead changes along the path
            self.feed_of(kind, words, report);
            Feed::Unknown
        } else {
            let feed = self.feed_of(kind, words, report);
            self.turning_feed(kind, feed, words, [&start, &end])
        };
        let mut motion = self.new_motion(kind, start, end, orientation, feed, report);
        if block.machine_coordinates {
            motion.machine_coordinates = true;
            motion.tcp = false;
        }
        motion.says_way = self.says_way(&words.axes, block.machine_coordinates);
        if self.memory.tcp_used {
            self.tcp_mistakes(&motion, words, report);
        }
        if motion.is_feed() && self.memory.in_spindle == Chosen::Nothing {
            self.tool_never_changed(words, report);
        }
        if self.memory.travel != Travel::Continuous || words.posture.any() {
            self.travel(&mut motion, words, report);
        }
        if frame_hides {
            self.hide(&mut motion);
        }
        motion
    }

    /// Between programmed (sign -1) and machine coordinates (sign 1): the zero point and, along the tool at home, its length. Under tool
    /// centre point control the linear axes of one are not known from the other.
    pub(crate) fn to_machine(&self, position: &mut Position, sign: f64) {
        for (value, zero) in position.values.iter_mut().zip(self.state.zero) {
            *value += sign * zero;
        }
        let length = sign * self.state.tool_length_mm.unwrap_or(0.0);
        for (value, along) in position.values.iter_mut().zip(self.setup.length_along()) {
            *value += length * along;
        }
        if self.state.tcp || self.state.frame_unknown || self.memory.frames.tilt.is_some() {
            position.known &= !LINEAR;
        }
        if self.memory.rotary_unknown() {
            position.known &= !ROTARY;
        }
    }

    /// G53, G153 and SUPA of a Sinumerik: machine data 10760 MN_G53_TOOLCORR decides whether they suppress the tool's length too.
    /// With D0 there is none.
    fn suppressed_length(&self, words: &Words, end: &mut Position, report: &mut Report<'_>) {
        let linear = (words.axes.given | words.axes.unread) & LINEAR;
        let length = self.state.tool_length_mm;
        let active = length.is_some_and(|length| length != 0.0 || self.memory.tool_data_written);
        if self.dialect.quirks.machine_data_suppress_length && active && linear != 0 {
            let what = "SUPA with tool length (MN_G53_TOOLCORR)";
            let kind = FaultKind::NotModelled { what: what.to_owned() };
            report.fault(words.first.unwrap_or_default(), kind);
            end.known &= !linear;
        }
    }

    /// Where the coordinates of the block lead: what is not given stays, what cannot be computed is forgotten.
    pub(crate) fn targets(&self, axes: &Places<9>, machine: bool, end: &mut Position) {
        let mut rest = axes.given;
        while rest != 0 {
            let axis = rest.trailing_zeros() as usize;
            let bit = 1 << axis;
            rest &= rest - 1;
            let scale = if LINEAR & bit != 0 {
                self.state.length_unit_mm
            } else {
                1.0
            };
            let value = axes.values[axis] * scale;
            let directed = axes.shortest | axes.positive | axes.negative;
            let absolute = axes.absolute | directed;
            let incremental =
                axes.incremental & bit != 0 || (self.state.incremental && !machine && absolute & bit == 0);
            let before = end.get(axis);
            let target = match (incremental, before) {
                (true, before) => before.map(|before| before + value),
                // a vector has turned the axis: from which position it turns, and how far, is unknown here
                (false, None) if directed & bit != 0 && self.memory.led_by_vector => None,
                (false, Some(before)) if axes.shortest & bit != 0 => Some(before + turn_to(value - before)),
                (false, Some(before)) if axes.positive & bit != 0 => Some(before + (value - before).rem_euclid(360.0)),
                (false, Some(before)) if axes.negative & bit != 0 => Some(before - (before - value).rem_euclid(360.0)),
                (false, _) => Some(value),
            };
            match target {
                Some(target) => end.set(axis, target),
                None => end.forget(axis),
            }
        }
        end.known &= !axes.unread;
    }

    /// In a tilted plane, without the tip being led, rotary words alone turn the tool away from where it was in the plane.
    fn turned_by_hand(&self, words: &Words, end: &mut Position, machine: bool) {
        let named = words.axes.given | words.axes.unread;
        if self.memory.frames.tilt.is_some() && !self.state.tcp && !machine && named & ROTARY != 0 && named & XYZ == 0 {
            end.known &= !XYZ;
        }
    }

    /// Letters whose words are no plain places: [`Motion::says_way`].
    fn says_way(&self, axes: &Places<9>, machine: bool) -> u16 {
        let directed = axes.shortest | axes.positive | axes.negative;
        let modal = if self.state.incremental && !machine {
            axes.given & !axes.absolute
        } else {
            0
        };
        axes.incremental | directed | modal | axes.unread
    }

    fn arc(
        &mut self,
        words: &Words,
        start: Position,
        end: Position,
        turning: Turning,
        report: &mut Report<'_>,
    ) -> MotionKind {
        let setting = ArcSetting {
            dialect: self.dialect,
            plane: self.state.plane,
            turning,
            centre_absolute: self.state.arc_centre_absolute,
            length_unit_mm: self.state.length_unit_mm,
            start,
            end,
            turns: self.turns(words),
        };
        if self.is_spiral(words) {
            let what = "a spiral or cone: Q or L in the block of an arc".to_owned();
            report.fault(words.first.unwrap_or_default(), FaultKind::NotModelled { what });
            return MotionKind::Arc(None);
        }
        let (arc, fault) = arc(&setting, words);
        if let Some(kind) = fault {
            report.fault(words.first.unwrap_or_default(), kind);
        }
        MotionKind::Arc(arc)
    }

    /// Further full turns: TURN= counts them; P, where the arc codes read it, counts all turns begun.
    fn turns(&self, words: &Words) -> Option<u32> {
        let limit = |turns: &u32| *turns <= 1_000_000;
        if words.turns.is_said() {
            return words.turns.index().filter(limit);
        }
        let reads_p = || {
            self.dialect
                .g(20)
                .is_some_and(|code| code.words.iter().any(|word| word == "P"))
        };
        match words.p {
            Said::Nothing => Some(0),
            p if reads_p() => p.index().and_then(|turns| turns.checked_sub(1)).filter(limit),
            _ => Some(0),
        }
    }

    /// The feed of the block's motion; says when there is none.
    pub(crate) fn feed_of(&mut self, kind: MotionKind, words: &Words, report: &mut Report<'_>) -> Feed {
        if kind == MotionKind::Rapid {
            return Feed::Rapid;
        }
        let inverse_time = self.state.feed_mode == FeedMode::InverseTime;
        match self.state.feed {
            Some(feed) if feed > 0.0 => match self.state.feed_mode {
                FeedMode::PerMinute => Feed::PerMinute(feed),
                FeedMode::PerRevolution => Feed::PerRevolution(feed),
                FeedMode::InverseTime => Feed::InverseTime(feed),
            },
            None if self.memory.feed_unread => Feed::Unknown,
            feed => {
                let range = words.feed.number().map(|number| number.range).or(words.first);
                let zero = feed.is_some();
                report.fault(range.unwrap_or_default(), FaultKind::MissingFeed { inverse_time, zero });
                Feed::Unknown
            }
        }
    }

    /// F counts degrees, not inches, where only rotary axes move and X Y Z are axis positions; a linear axis that is named without moving does
    /// not move. A full circle names none of them and runs all the same.
    fn turning_feed(&self, kind: MotionKind, feed: Feed, words: &Words, [start, end]: [&Position; 2]) -> Feed {
        let named = words.axes.given | words.axes.unread;
        let inch = self.state.feed_unit_mm;
        let stands = |axis: usize| matches!((start.get(axis), end.get(axis)), (Some(from), Some(to)) if (from - to).abs() < STANDS_MM);
        let moves = |axis: &usize| named & LINEAR & (1 << axis) != 0 && !stands(*axis);
        if inch == 1.0
            || matches!(kind, MotionKind::Arc(_))
            || self.state.tcp
            || words.vector.any()
            || (0..start.values.len()).any(|axis| moves(&axis))
            || named & ROTARY == 0
        {
            return feed;
        }
        match feed {
            Feed::PerMinute(feed) => Feed::PerMinute(feed / inch),
            Feed::PerRevolution(feed) => Feed::PerRevolution(feed / inch),
            feed => feed,
        }
    }

    /// A motion with what is in force.
    pub(crate) fn new_motion(
        &self,
        kind: MotionKind,
        start: Position,
        end: Position,
        orientation: Orientation,
        feed: Feed,
        report: &Report<'_>,
    ) -> Motion {
        let state = &self.state;
        Motion {
            block: self.flow.main_block(report.block),
            chain: self.chain,
            kind,
            start,
            end,
            says_way: 0,
            orientation,
            tcp: state.tcp,
            great_circle: state.great_circle,
            feed,
            spindle_on: state.spindle_on,
            spindle_rpm: state.spindle_rpm,
            zero: state.zero,
            tool_length_mm: state.tool_length_mm.unwrap_or(0.0),
            machine_coordinates: false,
            radii: self.dialect.quirks.diameter,
            tool: state.tool,
            tilt: crate::Tilt::default(),
            effects: self.memory.effects.count,
        }
    }

    /// Under a frame that is not modelled X Y Z and vectors say nothing about the machine; rotary axes neither where it moves them.
    pub(crate) fn hide(&self, motion: &mut Motion) {
        let hidden = if self.memory.rotary_unknown() {
            LINEAR | ROTARY
        } else {
            LINEAR
        };
        motion.start.known &= !hidden;
        motion.end.known &= !hidden;
        if let MotionKind::Arc(arc) = &mut motion.kind {
            *arc = None;
        }
        if let Orientation::Vector(..) = motion.orientation {
            motion.orientation = Orientation::Words;
        }
    }

    /// A motion that is not modelled: the axes that it names, and in a cycle the plane's third axis, are not known after it.
    pub(crate) fn unknown_motion(&mut self, words: &Words, report: &Report<'_>) -> Motion {
        let start = self.state.position;
        let mut forgotten = words.axes.given | words.axes.unread;
        if words.centre.any() || words.vector.any() || self.state.motion == Some(Action::CannedCycle) {
            forgotten |= LINEAR;
        }
        if words.vector.any() || self.state.vector_mode {
            forgotten |= ROTARY;
            self.state.orientation = Orientation::Words;
        }
        self.state.position.known &= !forgotten;
        let mut motion = self.new_motion(
            MotionKind::Unknown,
            start,
            self.state.position,
            self.state.orientation,
            Feed::Unknown,
            report,
        );
        if self.state.frame_unknown {
            self.hide(&mut motion);
        }
        motion
    }
}

/// The turn in the shorter direction, -180 < turn <= 180 deg.
fn turn_to(difference: f64) -> f64 {
    let turn = difference.rem_euclid(360.0);
    if turn > 180.0 { turn - 360.0 } else { turn }
}
