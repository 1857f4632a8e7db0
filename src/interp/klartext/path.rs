//! L, LN, C, CR, CT, LP, CP, CTP and CC.
use super::path_words::PathWords;
use super::values::Value;
use super::words::Words;
use super::{Klartext, Made};
use crate::arc::plane_axes;
use crate::core::{LINEAR, ROTARY, Report};
use crate::frames::Tilted;
use crate::rotary_way::shorter;
use crate::{FaultKind, Feed, Motion, MotionKind, Orientation, Position, Refusal, Swivel, Ways};
use trunnion_geometry::Vec3;
use trunnion_syntax::TextRange;

/// A path function.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Path {
    /// Words without one.
    None,
    Line,
    Vectors,
    AboutPole,
    Radius,
    Tangent,
    PolarLine,
    PolarArc,
    PolarTangent,
}

impl Klartext<'_> {
    /// A block with a path function.
    #[inline]
    pub(crate) fn path_block(&mut self, path: Path, words: &mut Words<'_>, report: &mut Report<'_>) {
        let found = self.path_words(words, report);
        self.run_path(path, &found, report);
    }

    pub(crate) fn run_path(&mut self, path: Path, words: &PathWords, report: &mut Report<'_>) {
        if !words.codes().is_empty() {
            self.codes_before(words, report);
        }
        let rapid = if words.has(140) {
            // the F after MB is the block's
            false
        } else {
            self.take_feed(words.feed, report)
        };
        if let Some(compensation) = words.compensation {
            self.compensate(path, compensation, report);
        }
        if words.radius.is_some() && words.compensation != Some(0) && path != Path::Radius {
            Self::rejected(
                Refusal::Syntax,
                "R with a value belongs to CR, RND, APPR and DEP",
                report,
            );
        }
        let polar = matches!(path, Path::PolarLine | Path::PolarArc | Path::PolarTangent);
        let moves = words.moves() || polar || words.tool.iter().any(Option::is_some) || path == Path::AboutPole;
        if words.has(140) {
            self.back_along_tool(words, report);
        } else if moves && (words.has(91) || words.has(92)) && !matches!(path, Path::None | Path::Line) {
            Self::not_modelled("M91 or M92 in another block than L", report);
            self.core.forget_position();
            self.unknown_motion(report);
        } else if moves && (words.has(91) || words.has(92)) {
            self.machine_motion(words, rapid, report);
        } else if moves {
            self.motion(path, words, rapid, report);
        }
        if words.has(99) || self.memory.runs_after_each && moves {
            self.run_cycle(report);
            // M99 ends M89
            self.memory.runs_after_each &= !words.has(99);
        }
        if !words.codes().is_empty() {
            self.codes_after(words);
        }
    }

    /// RL and RR begin in a straight line, and change sides only over R0 (manual 34059x, tool radius compensation).
    fn compensate(&mut self, path: Path, compensation: u8, report: &mut Report<'_>) {
        let before = std::mem::replace(&mut self.core.state.compensation, compensation);
        let straight = matches!(path, Path::None | Path::Line | Path::Vectors | Path::PolarLine);
        if before != compensation && compensation != 0 {
            if !straight {
                let message = "radius compensation begins in an arc: it begins in a straight line";
                Self::rejected(Refusal::Other, message, report);
            } else if before != 0 {
                let message = "RL and RR follow each other: R0 must come between them";
                Self::rejected(Refusal::Other, message, report);
            }
        }
        if compensation != 0 {
            let what = "cutter radius compensation: the programmed path is used instead";
            if !std::mem::replace(&mut self.core.compensation_reported, true) {
                Self::not_modelled(what, report);
            }
        }
    }

    fn motion(&mut self, path: Path, words: &PathWords, rapid: bool, report: &mut Report<'_>) {
        let start = self.core.state.position;
        let from = self.memory.frames.programmed(&start);
        if words.plane_angles.count_ones() == 2 && words.plane_angles == words.given {
            return self.turn_to_plane(report);
        }
        if words.plane_angles != 0 {
            self.not_modelled_once("Q120 to Q122: one of them alone, or with other axes", report);
        }
        let mut end = from;
        self.place(words, &mut end);
        // with TCPM and without it (iTNC 530 manual 60642x, 3-D tool compensation, face milling)
        if path == Path::Vectors && self.memory.deltas {
            self.not_modelled_once("LN with DL, DR or DR2: the shift along the normal", report);
            end.known &= !LINEAR;
        }
        let kind = match path {
            Path::None | Path::Line | Path::Vectors => self.straight(rapid),
            Path::AboutPole => self.about_pole(&from, &end, words, report),
            Path::Radius => self.by_radius(&from, &end, words, report),
            Path::Tangent => self.tangent(&from, &end, false, report),
            Path::PolarLine | Path::PolarArc | Path::PolarTangent => {
                let turned = self.polar_end(path, words, &from, &mut end, report);
                match path {
                    Path::PolarLine => self.straight(rapid),
                    Path::PolarArc => self.polar_arc(&from, &end, turned, words, report),
                    _ => self.tangent(&from, &end, true, report),
                }
            }
        };
        self.scale_parallel_axes(words, &mut end, report);
        self.memory.rapid_arc = rapid && !matches!(kind, MotionKind::Rapid);
        if self.memory.rapid_arc {
            self.not_modelled_once("FMAX beside an arc: how fast it is", report);
        }
        self.go(kind, from, end, words, report);
        self.memory.rapid_arc = false;
    }

    pub(crate) fn straight(&mut self, rapid: bool) -> MotionKind {
        self.memory.was_rapid = rapid;
        if rapid { MotionKind::Rapid } else { MotionKind::Linear }
    }

    /// The end of a block in the coordinates of the words.
    #[inline]
    pub(crate) fn place(&self, words: &PathWords, end: &mut Position) {
        let unit = self.core.state.coordinates.unit_mm();
        let mut rest = words.given;
        while rest != 0 {
            let axis = rest.trailing_zeros() as usize;
            let bit = 1 << axis;
            rest &= rest - 1;
            let rotary = ROTARY & bit != 0;
            let value = words.values[axis].map(|value| if rotary { value } else { value * unit });
            let before = end.get(axis);
            let target = if words.incremental & bit != 0 {
                before.zip(value).map(|(before, value)| before + value)
            } else if rotary && self.memory.shortest {
                // M126: 350 to 10 is 20 degrees
                before
                    .zip(value)
                    .map(|(before, value)| shorter(before, value))
                    .or(value)
            } else {
                value
            };
            match target.filter(|_| !(rotary && self.memory.spatial)) {
                Some(target) => end.set(axis, target),
                None => end.forget(axis),
            }
        }
    }

    /// A motion between two places in the coordinates of the words.
    pub(crate) fn go(
        &mut self,
        kind: MotionKind,
        from: Position,
        end: Position,
        words: &PathWords,
        report: &mut Report<'_>,
    ) {
        let start = self.core.state.position;
        self.note_heading(&kind, &from, &end);
        let ways = self.rotary_ways(words, [&from, &end], report);
        let (mut end, mut kind) = if self.memory.frames.active {
            let in_work = self.memory.frames.kind_to_work(kind);
            self.distorted(&kind, &in_work, report);
            (self.memory.frames.arrive(end), in_work)
        } else {
            (end, kind)
        };
        // spatial angles turn the rotary axes that the machine has, whichever letters they have
        let spatial = self.memory.spatial && words.given & ROTARY != 0;
        if spatial {
            kind = MotionKind::Unknown;
            end.known &= !ROTARY;
        }
        self.core.state.position = end;
        let orientation = self.tool_orientation(words, report);
        if let Orientation::Vector(..) = orientation {
            self.core.state.position.known &= !ROTARY;
        }
        if words.given & ROTARY != 0 && words.given & LINEAR == 0 && self.memory.frames.tilt.is_some() {
            // rotary words alone turn the tool away from where it was in the plane
            if !self.core.state.tool_axis.tcp() {
                self.core.state.position.known &= !LINEAR;
            }
        }
        end.known &= self.core.state.position.known;
        if self.memory.other_point {
            end.known &= !LINEAR;
        }
        let feed = if self.memory.rapid_arc {
            Feed::Unknown
        } else {
            self.core.feed(kind, TextRange::default, report)
        };
        let mut motion = self.core.motion_in_frame(kind, [start, end], orientation, feed, report);
        motion.says_way |= words.incremental | unread(words) | ways.shortest;
        motion.says_way |= words.given & !motion.end.known;
        if spatial {
            motion.says_way &= !ROTARY;
        }
        self.core.moves_all(&mut motion);
        motion.ways = ways;
        self.emit(&motion, report);
    }

    /// The directions in which the words turn rotary axes.
    pub(super) fn rotary_ways(
        &mut self,
        words: &PathWords,
        positions: [&Position; 2],
        report: &mut Report<'_>,
    ) -> Ways {
        let absolute = words.given & ROTARY & !words.incremental;
        let (shortest, plain) = if self.memory.shortest {
            (absolute, 0)
        } else {
            (0, absolute)
        };
        let ways = Ways {
            shortest,
            ..Ways::default()
        };
        self.core
            .ways(ways, plain, |axis| words.values[axis], positions, report)
    }

    /// The orientation of a block, and what is wrong with its vectors.
    fn tool_orientation(&mut self, words: &PathWords, report: &mut Report<'_>) -> Orientation {
        for (vector, names) in [(&words.tool, "TX, TY and TZ"), (&words.normal, "NX, NY and NZ")] {
            let given = vector.iter().filter(|value| value.is_some()).count();
            if !matches!(given, 0 | 3) {
                Self::rejected(Refusal::MissingWord, format!("a vector needs {names}"), report);
            }
        }
        let orientation = self.vector_or_words(words, report);
        if words.normal.iter().any(Option::is_some) {
            let values = words.normal.map(Option::flatten);
            if let [Some(x), Some(y), Some(z)] = values {
                let norm = Vec3::new(x, y, z).norm();
                if (norm - 1.0).abs() > 1e-5 {
                    report.fault(TextRange::default(), FaultKind::VectorNotUnit { norm });
                }
            }
            if words.delta {
                self.not_modelled_once("DR, DL in a block with a surface normal", report);
            }
        }
        self.core.state.orientation = orientation;
        orientation
    }

    /// The tool axis that a block gives. Under M128 and FUNCTION TCPM a surface normal without TX, TY and TZ is the tool axis: the control keeps
    /// the tool perpendicular to the contour (iTNC 530 60642x-03, p. 519; TNC7 81762x-17, face milling).
    fn vector_or_words(&mut self, words: &PathWords, report: &mut Report<'_>) -> Orientation {
        let tcp = self.core.state.tool_axis.tcp();
        let given = |vector: &[Option<Value>; 3]| vector.iter().any(Option::is_some);
        let turns = words.given & ROTARY != 0;
        let (vector, name) = if given(&words.tool) {
            (&words.tool, "TX, TY and TZ")
        } else if tcp && given(&words.normal) {
            (&words.normal, "a surface normal")
        } else if turns {
            return Orientation::Words;
        } else {
            return self.core.held_orientation();
        };
        if turns {
            let what = format!("{name} with words of rotary axes: which of them turn the tool");
            Self::not_modelled(&what, report);
            return self.core.unknown_orientation();
        }
        match vector.map(Option::flatten) {
            [Some(x), Some(y), Some(z)] if tcp => {
                self.core
                    .unit_vector(Vec3::new(x, y, z), given(&words.tool), TextRange::default(), report)
            }
            [Some(_), Some(_), Some(_)] => {
                Self::not_modelled("a tool vector without M128 or FUNCTION TCPM", report);
                self.core.unknown_orientation()
            }
            _ => self.core.unknown_orientation(),
        }
    }

    /// Gives a motion out, or holds it back for the corner or contour that comes.
    pub(crate) fn emit(&mut self, motion: &Motion, report: &mut Report<'_>) {
        if self.memory.waiting.is_some() || super::corner::comes(report) {
            let made = Made {
                motion: *motion,
                tilt: self.memory.frames.tilt,
            };
            self.join(made, report);
        } else {
            self.out.push(*motion);
            if let (Some(tilt), Some(made)) = (&self.memory.frames.tilt, self.out.last_mut()) {
                *made = in_work(motion, tilt, self.core.state.zero.is_lost());
            }
        }
    }

    pub(crate) fn finish_motion(&mut self, made: &Made) {
        let is_lost = self.core.state.zero.is_lost();
        let in_work = |tilt| in_work(&made.motion, tilt, is_lost);
        self.out.push(made.tilt.as_ref().map_or(made.motion, in_work));
    }

    /// A motion of which nothing is known.
    pub(crate) fn unknown_motion(&mut self, report: &mut Report<'_>) {
        let start = self.core.state.position;
        self.core.forget_linear();
        let end = self.core.state.position;
        let orientation = self.core.held_orientation();
        let motion = self
            .core
            .motion_in_frame(MotionKind::Unknown, [start, end], orientation, Feed::Unknown, report);
        self.memory.heading = None;
        self.emit(&motion, report);
    }

    /// Rotary words that are the angles which PLANE has computed.
    fn turn_to_plane(&mut self, report: &mut Report<'_>) {
        // which axes the machine has, and the feed, are not in the motion
        self.memory.unfollowed = true;
        let posture = self.memory.angles_wait.unwrap_or_default();
        self.swivel((Swivel::AxesStay, Feed::Rapid), posture, report);
    }

    pub(crate) fn axes(&self) -> [usize; 3] {
        plane_axes(self.core.state.coordinates.plane())
    }

    pub(crate) fn plane_normal(&self) -> Vec3 {
        let mut normal = Vec3::zeros();
        normal[self.axes()[2]] = 1.0;
        normal
    }
}

/// Letters whose values are not known.
pub(super) fn unread(words: &PathWords) -> u16 {
    (0..9)
        .filter(|axis| words.values[*axis].is_none())
        .fold(0, |all, axis| all | 1 << axis)
        & words.given
}

/// A motion in a tilted plane, in the workpiece frame.
fn in_work(motion: &Motion, tilt: &Tilted, is_lost: bool) -> Motion {
    match motion.orientation {
        // a turn onto a plane of a system that is not known
        Orientation::Vector(None, _) if is_lost => Motion {
            kind: MotionKind::Unknown,
            orientation: Orientation::Words,
            ..*motion
        },
        _ if motion.machine_coordinates || is_lost => *motion,
        _ => tilt.motion_to_work(motion),
    }
}
