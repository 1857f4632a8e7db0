//! The motion of an ISO block, from its words and the modal state.
use crate::arc::{ArcSetting, arc};
use crate::codes::BlockCodes;
use crate::core::Report;
use crate::core::{LINEAR, ROTARY};
use crate::frames::XYZ;
use crate::iso::Iso;
use crate::rotary_way::shorter;
use crate::tools::Chosen;
use crate::travel::Travel;
use crate::words::{Places, WordValue, Words};
use crate::{FaultKind, Feed, Motion, MotionKind, Orientation, Position, Ways};
use trunnion_dialect::Action;
use trunnion_geometry::arc::{Arc, Turning};

/// A coordinate that differs by no more than this has not moved, mm: sums of offsets are rounded.
const STANDS_MM: f64 = 1e-9;

impl Iso<'_> {
    pub(crate) fn modelled_motion(&mut self, words: &Words, block: &BlockCodes, report: &mut Report<'_>) -> Motion {
        // what a turned frame does to vectors and rotary words under tool centre point control is not followed
        let turned_tip = self.memory.frames.shape.linear.is_some() && self.core.state.tool_axis.tcp();
        let frame_hides = (self.core.state.zero.is_lost() || turned_tip) && !block.machine_coordinates;
        let mut start = self.core.state.position;
        if block.machine_coordinates {
            self.to_machine(&mut start, 1.0);
        }
        let shaped = self.memory.frames.active && !block.machine_coordinates;
        // a new tool length may make the words count from another place
        let base = self.memory.length_base.take().unwrap_or(start);
        let from = if shaped {
            self.memory.frames.programmed(&base)
        } else {
            base
        };
        let mut end = from;
        if shaped {
            self.place(words, &mut end);
        } else {
            self.targets(&words.axes, block.machine_coordinates, &mut end);
        }
        if !block.machine_coordinates {
            self.after_offsets(words, &mut end, report);
        }
        if block.machine_coordinates {
            self.suppressed_length(words, &mut end, report);
        }
        self.turned_by_hand(words, &mut end, block.machine_coordinates);
        let ways = self.rotary_ways(&words.axes, block.machine_coordinates, [&from, &end], report);
        let mut kind = match self.core.state.motion {
            _ if self.rapid_to_machine(block) => MotionKind::Rapid,
            Some(Action::Rapid) => MotionKind::Rapid,
            Some(Action::ArcClockwise) => self.arc(words, from, end, Turning::Clockwise, report),
            Some(Action::ArcCounterClockwise) => self.arc(words, from, end, Turning::CounterClockwise, report),
            Some(Action::ArcThroughPoint) => curve(self.arc_through(from, end), "CIP", words, report),
            Some(Action::ArcTangent) => curve(self.arc_tangent(from, end), "CT", words, report),
            _ => MotionKind::Linear,
        };
        if shaped {
            end = self.memory.frames.arrive(end);
            kind = self.shaped_kind(kind, report);
        }
        self.core.state.position = end;
        let orientation = self.orientation(words, report);
        if let Orientation::Vector(..) = orientation {
            self.memory.led_by_vector = true;
            self.core.state.position.known &= !ROTARY;
            end.known &= !ROTARY;
        }
        end.known &= self.core.state.position.known;
        if block.machine_coordinates {
            let mut position = end;
            self.to_machine(&mut position, -1.0);
            self.core.state.position = position;
        }
        let feed = self.feed_along(kind, words, [&start, &end], report);
        if block.machine_coordinates {
            self.machine_words(words, &mut kind, &mut end, report);
        }
        let mut motion = self.core.new_motion(kind, start, end, orientation, feed, report);
        if block.machine_coordinates {
            self.in_machine_coordinates(&mut motion, words.axes.given | words.axes.unread);
        }
        motion.says_way = self.says_way(&words.axes, block.machine_coordinates);
        motion.ways = ways;
        self.hidden_ends(&mut motion, words, report);
        if self.memory.tcp_used {
            self.tcp_mistakes(&motion, words, report);
        }
        if motion.is_feed() && *self.core.tools.in_spindle() == Chosen::Nothing {
            self.tool_never_changed(words, report);
        }
        if self.memory.travel != Travel::Continuous || words.posture.any() {
            self.travel(&mut motion, words, report);
        }
        if frame_hides {
            self.core.hide(&mut motion);
        }
        if self.core.dialect.quirks.declares_names() {
            self.note_heading(&motion.kind, &motion.start, &motion.end);
        }
        motion
    }

    /// Between programmed (sign -1) and machine coordinates (sign 1): the zero point and, along the tool at home, its length. Under tool
    /// centre point control the linear axes of one do not give those of the other.
    pub(crate) fn to_machine(&self, position: &mut Position, sign: f64) {
        for (value, zero) in position.values.iter_mut().zip(self.core.state.zero.values()) {
            *value += sign * zero;
        }
        let length = sign * self.core.state.length.mm().unwrap_or(0.0);
        for (value, along) in position.values.iter_mut().zip(self.core.setup.length_along()) {
            *value += length * along;
        }
        if self.core.state.tool_axis.tcp() || self.core.state.zero.is_lost() || self.memory.frames.tilt.is_some() {
            position.known &= !LINEAR;
        }
        if self.core.unknown.hides_rotary() {
            position.known &= !ROTARY;
        }
    }

    /// G53, G153 and SUPA of a Sinumerik: machine data 10760 MN_G53_TOOLCORR decides whether they suppress the tool's length too.
    /// With D0 there is none. Of G16 H0 of an Okuma no source states it.
    fn suppressed_length(&self, words: &Words, end: &mut Position, report: &mut Report<'_>) {
        let named = words.axes.given | words.axes.unread;
        if self.core.dialect.quirks.user_task() && self.core.state.coordinates.incremental() && named != 0 {
            let what = "G16 H0 with G91: whether its words are distances".to_owned();
            report.fault(words.first.unwrap_or_default(), FaultKind::NotModelled { what });
            end.known &= !named;
        }
        let linear = named & LINEAR;
        let length = self.core.state.length.mm();
        let active = length.is_some_and(|length| length != 0.0 || self.memory.tool_data_written);
        if self.core.dialect.quirks.machine_data_suppress_length && active && linear != 0 {
            let what = if self.core.dialect.quirks.user_task() {
                "G16 H0 with a tool length: whether it acts in machine coordinates"
            } else {
                "SUPA with tool length (MN_G53_TOOLCORR)"
            };
            let kind = FaultKind::NotModelled { what: what.to_owned() };
            report.fault(words.first.unwrap_or_default(), kind);
            end.known &= !linear;
        }
    }

    /// The end of the block: coordinates that are not given stay, those that cannot be computed become unknown.
    pub(crate) fn targets(&self, axes: &Places<9>, machine: bool, end: &mut Position) {
        let mut rest = axes.given;
        while rest != 0 {
            let axis = rest.trailing_zeros() as usize;
            let bit = 1 << axis;
            rest &= rest - 1;
            let scale = if LINEAR & bit != 0 {
                self.core.state.coordinates.unit_mm()
            } else {
                1.0
            };
            let value = axes.values[axis] * scale;
            let directed = axes.shortest | axes.positive | axes.negative;
            let absolute = axes.absolute | directed;
            let incremental = axes.incremental & bit != 0
                || (self.core.state.coordinates.incremental() && !machine && absolute & bit == 0);
            let before = end.get(axis);
            let target = match (incremental, before) {
                (true, before) => before.map(|before| before + value),
                // a vector has turned the axis: from which position it turns, and how far, is unknown here
                (false, None) if directed & bit != 0 && self.memory.led_by_vector => None,
                (false, Some(before)) if axes.shortest & bit != 0 => Some(shorter(before, value)),
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

    /// In a tilted plane, without the tip being guided, rotary words alone turn the tool away from where it was in the plane.
    fn turned_by_hand(&self, words: &Words, end: &mut Position, machine: bool) {
        let named = words.axes.given | words.axes.unread;
        if self.memory.frames.tilt.is_some()
            && !self.core.state.tool_axis.tcp()
            && !machine
            && named & ROTARY != 0
            && named & XYZ == 0
        {
            end.known &= !XYZ;
        }
    }

    /// Letters whose words are not plain positions: [`Motion::says_way`].
    fn says_way(&self, axes: &Places<9>, machine: bool) -> u16 {
        let directed = axes.shortest | axes.positive | axes.negative;
        let modal = if self.core.state.coordinates.incremental() && !machine {
            axes.given & !axes.absolute
        } else {
            0
        };
        axes.incremental | directed | modal | axes.unread
    }

    /// The directions in which the words turn rotary axes.
    fn rotary_ways(
        &mut self,
        axes: &Places<9>,
        machine: bool,
        positions: [&Position; 2],
        report: &mut Report<'_>,
    ) -> Ways {
        let ways = Ways {
            shortest: axes.shortest,
            forward: axes.positive,
            back: axes.negative,
            carried: 0,
        };
        let plain = (axes.given | axes.unread) & !self.says_way(axes, machine);
        self.core.ways(ways, plain, |axis| axes.get(axis), positions, report)
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
            dialect: self.core.dialect,
            plane: self.core.state.coordinates.plane(),
            turning,
            centre_absolute: self.core.state.coordinates.arc_centre_absolute(),
            length_unit_mm: self.core.state.coordinates.unit_mm(),
            start,
            end,
            turns: self.turns(words),
            lathe: self.core.radii,
        };
        if setting.turns.is_none() {
            let what = "the turns of an arc (TURN or P): write a whole number from 0 to 1000000".to_owned();
            report.fault(words.first.unwrap_or_default(), FaultKind::NotModelled { what });
        }
        if self.is_spiral(words) {
            let what = "a spiral or cone: Q or L in the block of an arc".to_owned();
            report.fault(words.first.unwrap_or_default(), FaultKind::NotModelled { what });
            return MotionKind::Arc(None);
        }
        let [first, second, _] = crate::arc::plane_axes(setting.plane);
        let named = words.axes.given | words.axes.unread;
        if named & ((1 << first) | (1 << second)) == 0
            && let Some(alarm) = self.core.dialect.alarm("arc-end-missing")
        {
            // other controls run a full circle
            let letter = |axis: usize| char::from(crate::AXIS_LETTERS[axis]);
            let kind = FaultKind::Rejected {
                refusal: crate::Refusal::MissingWord,
                message: format!(
                    "the arc has no end point: name {} or {}, for a full circle with the coordinates of its start",
                    letter(first),
                    letter(second)
                ),
                alarm: Some(alarm.number.clone()),
            };
            report.fault(words.first.unwrap_or_default(), kind);
            return MotionKind::Arc(None);
        }
        let (arc, fault) = arc(&setting, words);
        if let Some(kind) = fault {
            report.fault(words.first.unwrap_or_default(), kind);
        }
        MotionKind::Arc(arc)
    }

    /// The kind of a motion in work coordinates.
    fn shaped_kind(&mut self, kind: MotionKind, report: &mut Report<'_>) -> MotionKind {
        let shaped = self.memory.frames.kind_to_work(kind);
        if matches!((kind, shaped), (MotionKind::Arc(Some(_)), MotionKind::Arc(None))) {
            let what =
                "an arc whose two axes are scaled by different factors, or that is turned out of its plane".to_owned();
            report.fault(report.whole(), FaultKind::NotModelled { what });
        }
        shaped
    }

    /// Further full turns: TURN= counts them; P, where the arc codes read it, counts all turns begun.
    fn turns(&self, words: &Words) -> Option<u32> {
        let limit = |turns: &u32| *turns <= 1_000_000;
        if words.turns.is_given() {
            return words.turns.index().filter(limit);
        }
        let reads_p = || {
            self.core
                .dialect
                .g(20)
                .is_some_and(|code| code.words.iter().any(|word| word == "P"))
        };
        match words.p {
            WordValue::Nothing => Some(0),
            p if reads_p() => p.index().and_then(|turns| turns.checked_sub(1)).filter(limit),
            _ => Some(0),
        }
    }

    /// The feed of the block's motion; reports when there is none.
    pub(crate) fn feed_of(&mut self, kind: MotionKind, words: &Words, report: &mut Report<'_>) -> Feed {
        let range = || {
            let range = words.feed.number().map(|number| number.range).or(words.first);
            range.unwrap_or_default()
        };
        self.core.feed(kind, range, report)
    }

    /// F is in degrees, not inches, where only rotary axes move and X Y Z are axis positions; a linear axis that is named without moving does
    /// not move. A full circle names none of them and still moves.
    pub(crate) fn turning_feed(
        &self,
        kind: MotionKind,
        feed: Feed,
        words: &Words,
        [start, end]: [&Position; 2],
    ) -> Feed {
        let named = words.axes.given | words.axes.unread;
        let inch = self.core.state.feed.unit_mm();
        let stands = |axis: usize| matches!((start.get(axis), end.get(axis)), (Some(from), Some(to)) if (from - to).abs() < STANDS_MM);
        let moves = |axis: &usize| named & LINEAR & (1 << axis) != 0 && !stands(*axis);
        if inch == 1.0
            || matches!(kind, MotionKind::Arc(_))
            || self.core.state.tool_axis.tcp()
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

    /// A motion that is not modelled: the axes that it names, and in a cycle the plane's third axis, are not known after it.
    pub(crate) fn unknown_motion(&mut self, words: &Words, report: &Report<'_>) -> Motion {
        let start = self.core.state.position;
        let mut forgotten = words.axes.given | words.axes.unread;
        if words.centre.any() || words.vector.any() || self.core.state.motion == Some(Action::CannedCycle) {
            forgotten |= LINEAR;
        }
        if words.vector.any() || self.core.state.tool_axis.vectors() {
            forgotten |= ROTARY;
            self.core.state.orientation = Orientation::Words;
        }
        self.core.state.position.known &= !forgotten;
        self.core.motion_in_frame(
            MotionKind::Unknown,
            [start, self.core.state.position],
            self.core.state.orientation,
            Feed::Unknown,
            report,
        )
    }
}

/// An arc that its code gives whole; a fault where it is not known.
fn curve(arc: Option<Arc>, code: &str, words: &Words, report: &mut Report<'_>) -> MotionKind {
    if arc.is_none() {
        let what = code.to_owned();
        report.fault(words.first.unwrap_or_default(), FaultKind::NotModelled { what });
    }
    MotionKind::Arc(arc)
}
