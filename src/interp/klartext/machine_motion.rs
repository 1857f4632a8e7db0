//! Motions in machine coordinates (M91, M92), and back along the tool (M140).
use super::Klartext;
use super::path::unread;
use super::path_words::PathWords;
use crate::core::{LINEAR, ROTARY, Report};
use crate::{FaultKind, Feed, MotionKind, Orientation, Position};
use trunnion_geometry::Vec3;
use trunnion_syntax::TextRange;

/// Places that differ by no more than this are one, mm or degrees: sums of offsets are rounded.
const SAME_PLACE: f64 = 1e-9;

impl Klartext<'_> {
    /// M91 and M92: from the machine's zero; from a point that only the builder knows.
    pub(super) fn machine_motion(&mut self, words: &PathWords, rapid: bool, report: &mut Report<'_>) {
        self.flush(report);
        let builder = words.has(92);
        let mut start = self.core.state.position;
        self.to_machine(&mut start, 1.0);
        let mut end = start;
        self.place(words, &mut end);
        let ways = self.rotary_ways(words, [&start, &end], report);
        for axis in (0..9).filter(|axis| words.incremental & (1 << axis) != 0) {
            // from the last M91 position; where the axis has left it since, the distance may count from either place
            let last = self.memory.m91[axis].filter(|_| !builder);
            let stands = last
                .zip(start.get(axis))
                .is_some_and(|(last, at)| (last - at).abs() <= SAME_PLACE);
            if !stands {
                end.forget(axis);
            }
        }
        if builder {
            self.not_modelled_once("M92: the point of the machine builder", report);
            end.known &= !words.given;
        }
        for axis in (0..9).filter(|axis| words.given & (1 << axis) != 0 && !builder) {
            self.memory.m91[axis] = end.get(axis);
        }
        let mut back = end;
        self.to_machine(&mut back, -1.0);
        let led = self.core.state.tool_axis.tcp() && words.given & LINEAR != 0;
        if led {
            report.fault(
                TextRange::default(),
                FaultKind::TcpState(crate::TcpMistake::MachineCoordinates),
            );
        }
        self.core.state.position = back;
        let mut kind = self.straight(rapid);
        let feed = self.core.feed(kind, TextRange::default, report);
        if led {
            // M128 is reset before M91 and M92 (TNC 620 34056x-04, p. 340)
            Self::not_modelled(
                "machine coordinates under tool centre point control: where the axes go",
                report,
            );
            kind = MotionKind::Unknown;
            self.core.forget_linear();
            end.known &= !LINEAR;
        }
        if words.given & ROTARY != 0 {
            self.core.state.orientation = Orientation::Words;
        }
        let orientation = self.core.held_orientation();
        let mut motion = self.core.new_motion(kind, start, end, orientation, feed, report);
        motion.in_machine_coordinates(words.given);
        motion.says_way = words.incremental | unread(words) | ways.shortest;
        motion.says_way |= words.given & !motion.end.known;
        motion.ways = ways;
        self.memory.heading = None;
        self.out.push(motion);
    }

    /// Between programmed (sign -1) and machine coordinates (sign 1); see the engine of ISO programs.
    fn to_machine(&self, position: &mut Position, sign: f64) {
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
        position.known &= !self.core.turned;
    }

    /// M140 MB: back along the tool axis.
    pub(super) fn back_along_tool(&mut self, words: &PathWords, report: &mut Report<'_>) {
        let unit = self.core.state.coordinates.unit_mm();
        let mut distance = words.back.map(|distance| distance * unit);
        if words.given != 0 {
            Self::not_modelled("M140 in a block with coordinates: the order of both motions", report);
            distance = None;
        }
        let feed = if words.own_feed == super::path_words::FeedSaid::Nothing {
            words.feed
        } else {
            words.own_feed
        };
        let rapid = self.take_feed(feed, report);
        let said = feed != super::path_words::FeedSaid::Nothing;
        let kind = if said {
            self.straight(rapid)
        } else {
            MotionKind::Unknown
        };
        if !said {
            self.not_modelled_once("M140 without F: at which feed", report);
        }
        let feed = if said {
            self.core.feed(kind, TextRange::default, report)
        } else {
            Feed::Unknown
        };
        // words of the block make both motions one that is not known
        self.core.state.position.known &= !words.given;
        self.retract(distance, kind, feed, report);
    }

    /// Back along the tool axis, by a distance in mm; `None`: it is not known.
    pub(super) fn retract(&mut self, distance: Option<f64>, kind: MotionKind, feed: Feed, report: &mut Report<'_>) {
        let start = self.core.state.position;
        let stands = (3..6).all(|axis| start.get(axis).is_none_or(|value| value == 0.0));
        let along = match self.core.state.orientation {
            _ if self.memory.frames.tilt.is_some() => Some(Vec3::z()),
            Orientation::Vector(_, vector) => Some(vector),
            Orientation::Words => stands.then(|| self.plane_normal()),
        };
        let along = along.filter(|_| !self.scales_lengths("a retract along the tool (M140, PLANE)", report));
        let mut end = start;
        match distance.zip(along) {
            Some((distance, along)) => {
                for axis in 0..3 {
                    match start.get(axis) {
                        Some(value) => end.set(axis, value + distance * along[axis]),
                        None => end.forget(axis),
                    }
                }
            }
            None => end.known &= !LINEAR,
        }
        self.core.state.position = end;
        let orientation = self.core.held_orientation();
        let mut motion = self.core.motion_in_frame(kind, [start, end], orientation, feed, report);
        // it moves axes that the block does not name
        let along = distance.and(along).unwrap_or(Vec3::new(1.0, 1.0, 1.0));
        let moved = (0..3)
            .filter(|axis| along[*axis] != 0.0)
            .fold(0, |all, axis| all | 1 << axis);
        motion.says_way |= moved & !end.known;
        self.memory.heading = None;
        self.emit(&motion, report);
    }
}
