//! Splines: ASPLINE and CSPLINE go through their points, those of BSPLINE are poles, and the path ends at the last one.
//!
//! Over which parameter a control runs them is in no manual. Where the settings declare it (`[control] splines`), the points of a spline are kept
//! until it ends, and become lines: see [`super::course`]. Else a motion has an unknown shape between ends that are known where they are.
//!
//! Source: Sinumerik 840D sl Programming Manual, Job Planning (07/2010), p. 234: spline interpolation; G groups 19 and 20.
use super::course::{Course, Point};
use crate::codes::{BlockCodes, Found};
use crate::core::{LINEAR, Report};
use crate::iso::Iso;
use crate::reader::Reader;
use crate::words::Words;
use crate::{FaultKind, FeedMode, Motion, MotionKind, SplineReading};
use trunnion_dialect::Action;
use trunnion_syntax::{TextRange, Word};

/// Points of a spline that are kept.
const MOST_POINTS: usize = 20_000;

/// How a spline uses its points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Spline {
    /// Through them, by Akima.
    Akima,
    /// Through them, with continuous curvature.
    Cubic,
    /// Poles: the path goes to the first and the last one.
    Poles,
}

impl Spline {
    /// The one that a code begins.
    pub(super) fn of(id: &str) -> Option<Self> {
        match id {
            "ASPLINE" => Some(Self::Akima),
            "CSPLINE" => Some(Self::Cubic),
            "BSPLINE" => Some(Self::Poles),
            _ => None,
        }
    }

    pub(super) fn id(self) -> &'static str {
        match self {
            Self::Akima => "ASPLINE",
            Self::Cubic => "CSPLINE",
            Self::Poles => "BSPLINE",
        }
    }
}

/// PW= and SD= of a block; NaN: the value is not known.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct SplineWords {
    weight: Option<f64>,
    degree: Option<f64>,
}

/// Ends of splines by BTAN, BAUTO, ETAN and EAUTO, which are not followed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct SplineEnds {
    begins: bool,
    ends: bool,
}

impl SplineEnds {
    pub(super) fn any(self) -> bool {
        self.begins || self.ends
    }
}

/// What is remembered of splines.
#[derive(Clone, Debug, Default)]
pub(crate) struct Splines {
    /// PW and SD of the current block.
    pub(crate) words: SplineWords,
    /// SD of the spline that runs.
    degree: Option<f64>,
    /// The points of the spline that runs, where it is followed.
    pub(crate) course: Option<Box<Course>>,
    /// The path of the spline that runs is not known.
    is_lost: bool,
    /// BTAN and the like.
    pub(super) ends: SplineEnds,
    /// The kind of spline, where the motion in effect is one.
    pub(crate) kind: Option<Spline>,
    /// The last pole of a B-spline, where it ends if it does not go on.
    pub(crate) pole: Option<crate::Position>,
}

impl Splines {
    /// How many entries of lists that grow with the program a clone copies.
    pub(crate) fn copied(&self) -> usize {
        crate::compensation::WAITS * self.waiting()
    }

    /// Points whose motions wait for the end of their spline.
    pub(crate) fn waiting(&self) -> usize {
        self.course.as_ref().map_or(0, |course| course.points.len())
    }
}

impl<F: FnMut(TextRange, FaultKind)> Reader<'_, '_, F> {
    /// PW= and SD=. False: another word.
    pub(crate) fn spline_word(&mut self, name: &[u8], word: &Word) -> bool {
        let is_weight = name.eq_ignore_ascii_case(b"PW");
        if !is_weight && !name.eq_ignore_ascii_case(b"SD") || self.own.is_none() {
            return false;
        }
        self.words.has_values = true;
        let value = self.value_of(word);
        let value = Some(value.unwrap_or(f64::NAN));
        if let Some(own) = self.own.as_mut() {
            let words = &mut own.splines.words;
            *(if is_weight {
                &mut words.weight
            } else {
                &mut words.degree
            }) = value;
        }
        true
    }
}

impl<'d> Iso<'d> {
    /// Whether the settings say how splines run.
    pub(crate) fn follows_splines(&self) -> bool {
        self.core.setup.control.splines == Some(SplineReading::ChordLength)
    }

    /// What to say of a spline whose path is not declared; `None`: another code, or it is followed.
    pub(crate) fn undeclared_spline(found: &Found<'_>) -> Option<String> {
        let spline = Spline::of(&found.code.id)?;
        Some(format!(
            "{}: the path between its points (declare [control] splines)",
            spline.id()
        ))
    }

    /// A code of the motion group that is not modelled: a spline, or another.
    pub(crate) fn spline_begins(&mut self, id: &str) {
        self.memory.own.splines.kind = Spline::of(id);
    }

    /// The spline to which the motion of a block belongs.
    pub(crate) fn spline(&self, codes: &[Found<'_>], words: &Words, block: &BlockCodes) -> Option<Spline> {
        let spline = self
            .memory
            .own
            .splines
            .kind
            .filter(|_| self.core.state.motion == Some(Action::NotModelled))?;
        let other = |found: &Found<'_>| {
            found.code.action == Action::NotModelled && found.code.group.as_deref() != self.motion_group()
        };
        let plain = words.axes.any() && !words.unknown_code && !words.forgets_all && !block.takes_coordinates;
        (plain && !words.polynomial && !block.machine_coordinates && !codes.iter().any(other)).then_some(spline)
    }

    /// Before the codes of a block act: a B-spline that ended there is at its last pole; whether one that is followed goes on, ends here, or is lost.
    #[inline]
    pub(crate) fn spline_before(&mut self, codes: &[Found<'d>], words: &Words, report: &mut Report<'_>) {
        if self.core.setup.control.splines.is_some() {
            self.followed_spline_before(codes, words, report);
        }
        if let Some(pole) = self.memory.own.splines.pole {
            self.core.state.position = pole;
        }
    }

    fn followed_spline_before(&mut self, codes: &[Found<'d>], words: &Words, report: &mut Report<'_>) {
        for found in codes {
            let ends = &mut self.memory.own.splines.ends;
            match found.code.id.as_str() {
                "BNAT" => ends.begins = false,
                "BTAN" | "BAUTO" => ends.begins = true,
                "ENAT" => ends.ends = false,
                "ETAN" | "EAUTO" => ends.ends = true,
                _ => {}
            }
        }
        let own = &mut self.memory.own;
        let runs = own.splines.course.is_some() || own.splines.is_lost;
        let begins = codes.iter().any(|found| Spline::of(&found.code.id).is_some());
        // SD may stand alone in the block of BSPLINE
        if own.splines.words.degree.is_some() || begins && !runs {
            own.splines.degree = own.splines.words.degree;
        }
        if !runs {
            return;
        }
        let spline = own.splines.kind;
        let group = self.motion_group();
        let of_motion = |found: &Found<'_>| group.is_some() && found.code.group.as_deref() == group;
        let same = |found: &Found<'_>| spline.is_some() && Spline::of(&found.code.id) == spline;
        let other_motion = |found: &Found<'_>| of_motion(found) && !same(found);
        let ends = |found: &Found<'_>| other_motion(found) || found.code.action == Action::ProgramEnd;
        let harmless = |found: &Found<'_>| {
            matches!(
                found.code.action,
                Action::NoMotion
                    | Action::PathMode
                    | Action::Absolute
                    | Action::Incremental
                    | Action::SpindleClockwise
                    | Action::SpindleCounterClockwise
                    | Action::SpindleStop
            )
        };
        if codes.iter().any(ends) {
            self.spline_ends(report);
            self.memory.own.splines.is_lost = false;
            return;
        }
        let other = codes.iter().find(|found| !same(found) && !harmless(found));
        let own = &self.memory.own;
        let alone = !words.axes.any() && (own.splines.words.weight.is_some() || own.polynomial.length.is_some());
        let changes = words.forgets_all || words.writes_system || words.unknown_code || words.flow || alone;
        if let Some(found) = other {
            let why = format!("{} between its points", found.code.id);
            self.spline_is_lost(&why, report);
        } else if changes {
            self.spline_is_lost("a word between its points that may change coordinates", report);
        } else if words.tool.is_given() || words.edge.is_given() {
            self.spline_is_lost("T or D between its points", report);
        }
    }

    /// A motion of unknown shape to the programmed end, or none where the spline is followed: it comes with its end.
    pub(crate) fn spline_motion(
        &mut self,
        spline: Spline,
        words: &Words,
        block: &BlockCodes,
        report: &mut Report<'_>,
    ) -> Option<Motion> {
        let goes_on = self.memory.own.splines.pole.take().is_some();
        let state = self.follows_splines().then(|| self.core.state.clone());
        self.core.state.motion = Some(Action::Linear);
        let motion = self.modelled_motion(words, block, report);
        self.core.state.motion = Some(Action::NotModelled);
        self.memory.own.contour.heading_is_lost();
        if let Some(state) = state.filter(|_| !self.memory.own.splines.is_lost) {
            let splines = &mut self.memory.own.splines;
            let weight = splines.words.weight.unwrap_or(1.0);
            let course = splines.course.get_or_insert_with(|| Box::new(Course::new(spline)));
            course.points.push(Point { motion, state, weight });
            course.degree = splines.degree.unwrap_or(course.degree);
            if let Some(why) = self.why_not_followed(words) {
                self.spline_is_lost(why, report);
            }
            return None;
        }
        let motion = Self::of_unknown_shape(motion, spline, goes_on);
        if spline == Spline::Poles {
            self.memory.own.splines.pole = Some(self.core.state.position);
            self.core.state.position.known &= !LINEAR;
        }
        Some(motion)
    }

    /// The motion to a point whose path is not known.
    fn of_unknown_shape(mut motion: Motion, spline: Spline, goes_on: bool) -> Motion {
        motion.kind = MotionKind::Unknown;
        if spline == Spline::Poles {
            if goes_on {
                motion.start.known &= !LINEAR;
            }
            motion.end.known &= !LINEAR;
        }
        motion
    }

    /// Why the last point cannot be part of a spline that is followed.
    fn why_not_followed(&self, words: &Words) -> Option<&'static str> {
        let (own, state) = (&self.memory.own, &self.core.state);
        let course = own.splines.course.as_ref()?;
        let (first, point) = (course.points.first()?, course.points.last()?);
        let motion = &point.motion;
        let turns = (3..9).any(|axis| motion.start.get(axis) != motion.end.get(axis));
        let beside = turns || (words.axes.given | words.axes.unread) & !0b111 != 0 || motion.tcp;
        let through = course.kind != Spline::Poles;
        let open = [
            (
                motion.start.xyz().is_none() || motion.end.xyz().is_none(),
                "a point that is not known",
            ),
            (
                own.polynomial.length.is_some() || own.polynomial.unread,
                "PL, the distances between knots",
            ),
            (
                !(point.weight > 0.0 && point.weight <= 3.0),
                "PW outside 0 to 3, or not known",
            ),
            (beside, "with rotary axes or further axes"),
            (state.compensation != 0, "under radius compensation"),
            (state.feed.mode() == FeedMode::InverseTime, "under G93"),
            (own.path.any(), "with words that give a path"),
            (
                first.motion.zero != motion.zero,
                "another zero point between its points",
            ),
            (
                through && own.splines.ends.any(),
                "its ends by BTAN, BAUTO, ETAN or EAUTO",
            ),
            (
                through && self.memory.frames.shape.linear.is_some(),
                "in a frame that turns or scales",
            ),
            (course.points.len() > MOST_POINTS, "more points than are kept"),
        ];
        open.into_iter().find_map(|(open, why)| open.then_some(why))
    }

    /// The points read so far, and those that follow up to another motion code, have no known path between them.
    fn spline_is_lost(&mut self, why: &str, report: &mut Report<'_>) {
        self.memory.own.splines.is_lost = true;
        let Some(course) = self.memory.own.splines.course.take() else {
            return;
        };
        let what = format!("{}: {why}", course.kind.id());
        report.fault(report.whole(), FaultKind::NotModelled { what });
        self.give_up(&course);
        if course.kind == Spline::Poles {
            self.memory.own.splines.pole = Some(self.core.state.position);
            self.core.state.position.known &= !LINEAR;
        }
    }

    /// Its points as motions of unknown shape.
    fn give_up(&mut self, course: &Course) {
        for (at, point) in course.points.iter().enumerate() {
            let motion = Self::of_unknown_shape(point.motion, course.kind, at > 0);
            self.memory.compensation.ready.push((motion, point.state.clone()));
        }
    }

    /// The spline ends at its last point: its lines.
    pub(crate) fn spline_ends(&mut self, report: &mut Report<'_>) {
        let Some(course) = self.memory.own.splines.course.take() else {
            return;
        };
        let mut looked_at = 0;
        let growth = self.memory.frames.most_growth();
        let lines = if self.is_full() {
            Err(self.full())
        } else {
            course.lines(growth, &mut looked_at).map_err(str::to_owned)
        };
        self.cycle_motions.add_in_vain(looked_at);
        let lines = match lines {
            Ok(lines) => lines,
            Err(why) => {
                let what = format!("{}: {why}", course.kind.id());
                report.fault(report.whole(), FaultKind::NotModelled { what });
                return self.give_up(&course);
            }
        };
        for (motion, at) in lines {
            self.cycle_motions.add();
            let state = course.points[at].state.clone();
            self.memory.compensation.ready.push((motion, state));
        }
    }
}
