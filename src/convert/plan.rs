//! From motions to words of the target: joints chosen, arcs kept or cut into lines, feeds carried over.
use crate::job::{Event, Job};
use crate::posture::{TargetPose, WhyUnreachable, choose};
use crate::sample::{Between, Frame, PartEnd, joints, words};
use crate::{Options, Refused};
use std::cell::OnceCell;
use trunnion_certify::conversion::{Known, Posed, Reading, Track, rotary};
use trunnion_dialect::Dialect;
use trunnion_geometry::{Vec3, arc::Arc, deg};
use trunnion_interp::{Feed, MotionKind, Orientation, Setup};
use trunnion_machine::{Joints, Machine};

/// What X Y Z are in the output program.
#[derive(Clone, Copy)]
pub(crate) enum Mode<'m> {
    /// The tip; the tool axis as vector or straight up.
    Tip,
    /// The tip; rotary words.
    TipRotary(&'m Machine),
    /// Joints.
    Joints(&'m Machine),
}

impl<'m> Mode<'m> {
    pub(crate) fn machine(self) -> Option<&'m Machine> {
        match self {
            Self::Tip => None,
            Self::TipRotary(machine) | Self::Joints(machine) => Some(machine),
        }
    }
}

/// How a motion of the output is made.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Shape {
    Rapid,
    Line,
    /// In the output's words.
    Arc(Arc),
}

/// A motion of the output.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Move {
    pub(crate) shape: Shape,
    /// X Y Z as [`Mode`] says, mm.
    pub(crate) xyz: Vec3,
    /// Rotary joints, rad.
    pub(crate) q: [f64; 2],
    pub(crate) axis: Vec3,
    pub(crate) feed: Feed,
}

/// What a motion is converted to.
#[derive(Clone, Debug)]
pub(crate) enum Out {
    /// Its end is unknown.
    Left,
    /// A rapid of which only some axes are known.
    Words {
        /// Their words, by index of the axis, mm or deg.
        known: Vec<(usize, f64)>,
        /// Tool centre point control is on.
        led: bool,
        /// A tool length is active.
        length: bool,
    },
    Dwell(f64),
    Moves(Vec<Move>),
}

/// What a plan is made from.
pub(crate) struct Planner<'a> {
    pub(crate) reading: &'a Reading,
    /// The machine that the original program was read with.
    pub(crate) source: Option<&'a Machine>,
    pub(crate) mode: Mode<'a>,
    /// Dialect of the output.
    pub(crate) dialect: &'a Dialect,
    /// Whether the output knows inverse time, and feed per revolution.
    pub(crate) inverse_time: bool,
    pub(crate) per_revolution: bool,
    /// Whether the output compensates the tool's length.
    pub(crate) compensates: bool,
    /// APT: arcs in any plane, but flat and of one turn.
    pub(crate) apt: bool,
    pub(crate) setup: &'a Setup,
    pub(crate) options: &'a Options,
    /// The work offset of the output, where the program names none.
    pub(crate) work_offset: &'a str,
    pub(crate) tolerance_mm: f64,
    /// How far the tool axis may be from where it was inside a cut, deg, where that is judged.
    pub(crate) axis_deg: Option<f64>,
    /// Where the known poses are, once it was asked.
    pub(crate) known: OnceCell<Known>,
    /// [`Planner::keeps`], once it was asked: it looks at all motions, and is asked at each.
    pub(crate) kept: OnceCell<bool>,
}

/// The motions of the output for each original motion, and the blocks with a swap.
pub(crate) type Plan = (Vec<Out>, Vec<usize>);

impl Planner<'_> {
    pub(crate) fn plan(&self, job: &Job) -> Result<Plan, Refused> {
        let motions = &self.reading.motions;
        let (q, swaps) = self.rotary()?;
        let frames = self.frames(job);
        let mut outs = Vec::with_capacity(motions.len());
        let mut before = [0.0; 2];
        for (index, posed) in motions.iter().enumerate() {
            let out = self.out(index, posed, (before, q[index]), &frames[index])?;
            if let Out::Moves(_) = out {
                before = q[index];
            }
            outs.push(out);
        }
        let known = |out: &Out| matches!(out, Out::Moves(_));
        if let Some(posed) = motions.first().filter(|_| !outs.iter().any(known)) {
            return Err(self.refuse(posed, "no motion of this program ends at a known position".to_owned()));
        }
        Ok((outs, swaps))
    }

    pub(crate) fn refuse(&self, posed: &Posed, message: String) -> Refused {
        Refused::at(&self.reading.program, posed.motion.block, message)
    }

    /// Rotary joints at the ends of all motions.
    fn rotary(&self) -> Result<(Vec<[f64; 2]>, Vec<usize>), Refused> {
        let motions = &self.reading.motions;
        let mut q = vec![[0.0; 2]; motions.len()];
        let Some(machine) = self.mode.machine() else {
            return Ok((q, Vec::new()));
        };
        if self.keeps() {
            for (slot, posed) in q.iter_mut().zip(motions) {
                if let Some(Ok(stance)) = posed.leg.as_ref().map(|leg| &leg.end) {
                    *slot = rotary(machine, &stance.joints);
                }
            }
            return Ok((q, Vec::new()));
        }
        let (mut wishes, mut whose) = (Vec::new(), Vec::new());
        for (index, posed) in motions.iter().enumerate() {
            if let (Ok(pose), MotionKind::Rapid | MotionKind::Linear | MotionKind::Arc(_)) =
                (&posed.end, posed.motion.kind)
            {
                wishes.push(TargetPose {
                    axis: pose.axis,
                    cuts: posed.motion.kind != MotionKind::Rapid && posed.start.is_some(),
                });
                whose.push(index);
            }
        }
        let chosen = choose(machine, &wishes).map_err(|(at, never)| {
            let posed = &motions[whose[at]];
            let axis = wishes[at].axis;
            let tells = format!("the tool axis ({:.6}, {:.6}, {:.6})", axis.x, axis.y, axis.z);
            let message = match never {
                WhyUnreachable::Unreachable(off) => format!(
                    "{} cannot point the tool along {tells}: the nearest it reaches is {:.4} deg away",
                    machine.id,
                    deg(off)
                ),
                WhyUnreachable::Limits => format!(
                    "{} reaches {tells} only outside the travel of its rotary axes",
                    machine.id
                ),
            };
            self.refuse(posed, message)
        })?;
        let mut swaps = Vec::new();
        for (one, &index) in chosen.iter().zip(&whose) {
            q[index] = one.q;
            if one.swap {
                swaps.push(index);
            }
        }
        if let Some(&index) = swaps.first().filter(|_| !self.options.allow_swap) {
            let message = format!(
                "in this cut the table must turn to the other posture, or wind back ({} such places in all): retract there, turn and come \
                 back, or add --allow-swap",
                swaps.len()
            );
            return Err(self.refuse(&motions[index], message));
        }
        Ok((q, swaps))
    }

    /// Whether joints of the original program are those of the output: the same machine, and words.
    fn keeps(&self) -> bool {
        *self.kept.get_or_init(|| self.all_keep())
    }

    fn all_keep(&self) -> bool {
        let same = match (self.source, self.mode.machine()) {
            (Some(source), Some(target)) => source.id == target.id && source.axes == target.axes,
            _ => false,
        };
        let words = |posed: &Posed| matches!(posed.motion.orientation, Orientation::Words);
        same && self
            .reading
            .motions
            .iter()
            .all(|posed| posed.leg.is_some() && words(posed))
    }

    /// Zero point and active tool length at each motion of the output.
    fn frames(&self, job: &Job) -> Vec<Frame> {
        let zero_of = |name: &str| {
            let known = self.setup.work_offsets.iter();
            let mut known = known.filter(|offset| offset.name.eq_ignore_ascii_case(name));
            known.next().map_or([0.0; 9], |offset| offset.values)
        };
        let length_of = |number: u32| {
            let declared = job.tool(number);
            let own = declared.and_then(|(_, tool)| tool.as_ref()?.length_mm);
            own.filter(|_| self.compensates).unwrap_or(0.0)
        };
        let mut frame = Frame {
            zero: zero_of(self.work_offset),
            length: 0.0,
        };
        let mut frames = vec![frame; self.reading.motions.len()];
        for placed in &job.events {
            match &placed.event {
                Event::WorkOffset(name) => frame.zero = zero_of(name),
                Event::Tool(number) => frame.length = length_of(*number),
                Event::Motion(index) => frames[*index] = frame,
                _ => {}
            }
        }
        frames
    }

    fn out(&self, index: usize, posed: &Posed, q: ([f64; 2], [f64; 2]), frame: &Frame) -> Result<Out, Refused> {
        if let MotionKind::Dwell(seconds) = posed.motion.kind {
            let why = "a dwell of unknown length";
            return seconds
                .map(Out::Dwell)
                .ok_or_else(|| self.refuse(posed, why.to_owned()));
        }
        if let Err(why) = &posed.end {
            let motions = &self.reading.motions;
            if self.known().is_outside(motions, index) {
                if self.known().leaves_a_cut(motions, index) {
                    let message = format!(
                        "this rapid leaves a cut, and its end is unknown: {why}. Without it the tool would stay in the cut: declare what is missing, or \
                         program a rapid to a known position before it"
                    );
                    return Err(self.refuse(posed, message));
                }
                return self.partial(index, posed, frame);
            }
            return Err(self.refuse(posed, format!("the end of this motion is unknown: {why}")));
        }
        let is_rapid = posed.motion.kind == MotionKind::Rapid;
        let track = Track::new(posed, self.source);
        let Some(track) = track.filter(|_| !is_rapid) else {
            if !is_rapid && !matches!(posed.motion.kind, MotionKind::Linear) {
                return Err(self.refuse(posed, "an arc from an unknown position".to_owned()));
            }
            if !is_rapid && posed.start.is_some() {
                return Err(self.refuse(posed, "the path of the tool to this point is unknown".to_owned()));
            }
            return self.at_once(posed, q.1, frame, is_rapid).map(Out::Moves);
        };
        let between = Between {
            machine: self.mode.machine(),
            from: q.0,
            to: q.1,
            keep: self.keeps(),
            frame: *frame,
        };
        if let Some(arcs) = self.arcs(&track, q, frame, posed) {
            return Ok(Out::Moves(arcs));
        }
        let ends = self
            .parts(posed, &track, &between)
            .map_err(|why| self.refuse(posed, why))?;
        self.lines(posed, &track, (q.0, &ends), frame).map(Out::Moves)
    }

    pub(crate) fn known(&self) -> &Known {
        self.known.get_or_init(|| Known::of(&self.reading.motions))
    }

    fn parts(&self, posed: &Posed, track: &Track<'_>, between: &Between<'_>) -> Result<Vec<PartEnd>, String> {
        let Mode::Joints(machine) = self.mode else {
            return between.chords(track, self.tolerance_mm, self.axis_deg);
        };
        if between.keep && !posed.tip_words() && !matches!(posed.motion.kind, MotionKind::Arc(_)) {
            // the same joints, which move as they did
            return between.ends(track, 1, true);
        }
        let start = track.at(0.0);
        let start =
            joints(machine, between.from, &start.tip, &between.frame).ok_or("the linear axes do not span space")?;
        between.joint_parts(track, &start, self.tolerance_mm)
    }

    fn xyz(&self, end: &PartEnd, frame: &Frame) -> Option<Vec3> {
        match self.mode {
            Mode::Tip | Mode::TipRotary(_) => Some(end.tip),
            Mode::Joints(machine) => {
                let joints = end.joints.or_else(|| joints(machine, end.q, &end.tip, frame))?;
                words(machine, &joints, frame)
            }
        }
    }

    /// A rapid, or a line from a position that is unknown.
    fn at_once(&self, posed: &Posed, q: [f64; 2], frame: &Frame, is_rapid: bool) -> Result<Vec<Move>, Refused> {
        let Ok(pose) = &posed.end else { return Ok(Vec::new()) };
        let end = PartEnd {
            tip: pose.tip,
            axis: pose.axis,
            q,
            joints: None,
        };
        let xyz = self
            .xyz(&end, frame)
            .ok_or_else(|| self.refuse(posed, "X Y Z of the machine do not reach it".to_owned()))?;
        Ok(vec![Move {
            shape: if is_rapid { Shape::Rapid } else { Shape::Line },
            xyz,
            q,
            axis: pose.axis,
            feed: self.plain_feed(posed)?,
        }])
    }

    fn lines(
        &self,
        posed: &Posed,
        track: &Track<'_>,
        (start, ends): ([f64; 2], &[PartEnd]),
        frame: &Frame,
    ) -> Result<Vec<Move>, Refused> {
        let feed = match posed.motion.feed {
            feed @ Feed::InverseTime(_) => feed,
            _ => self.plain_feed(posed)?,
        };
        let turns = matches!(self.mode, Mode::Joints(_)) && ends.iter().any(|end| end.q != start);
        let standing = posed.leg.as_ref().filter(|leg| leg.rotary_change == [0.0; 2]);
        let by_path = posed.feeds_the_tip() || standing.is_some();
        // the path along which F is now the speed, if not that of the tip: a share of it for each part
        let counted = standing.filter(|_| !posed.feeds_the_tip());
        let counted = counted.map(|leg| leg.length / ends.len() as f64);
        // whether or not X Y Z move as far as the tip: F is the speed along them
        let mut before = match self.mode {
            Mode::Joints(machine) if !turns => {
                joints(machine, start, &track.at(0.0).tip, frame).map(|joints| (machine, joints))
            }
            _ => None,
        };
        let mut from = track.at(0.0).tip;
        let mut moves = Vec::with_capacity(ends.len());
        for end in ends {
            let xyz = self
                .xyz(end, frame)
                .ok_or_else(|| self.refuse(posed, "X Y Z of the machine do not reach it".to_owned()))?;
            let way = (end.tip - from).norm();
            from = end.tip;
            let runs = before.as_mut().map_or(way, |(machine, last)| {
                let next = end.joints.or_else(|| joints(machine, end.q, &end.tip, frame));
                next.map_or(way, |next| xyz_way(machine, &std::mem::replace(last, next), &next))
            });
            let stretch =
                Some(runs / counted.unwrap_or(way)).filter(|ratio| (ratio - 1.0).abs() > 1e-6 && ratio.is_finite());
            let stretch = stretch.filter(|ratio| *ratio > 0.0).unwrap_or(1.0);
            let feed = match feed {
                Feed::PerMinute(feed) if by_path && !turns => Feed::PerMinute(feed * stretch),
                Feed::PerRevolution(feed) if by_path && !turns => Feed::PerRevolution(feed * stretch),
                Feed::Rapid | Feed::Unknown => feed,
                Feed::InverseTime(rate) if !self.inverse_time && by_path && !turns && runs > 0.0 => {
                    // each of equal parts takes 1/(F n) minutes
                    Feed::PerMinute(runs * rate * ends.len() as f64)
                }
                _ => self.timed(posed, way, ends.len(), end)?,
            };
            moves.push(Move {
                shape: Shape::Line,
                xyz,
                q: end.q,
                axis: end.axis,
                feed,
            });
        }
        Ok(moves)
    }
}

/// How far the axes X Y Z run between two stances, mm.
fn xyz_way(machine: &Machine, from: &Joints, to: &Joints) -> f64 {
    let linear = machine.joint_of_letter.iter().take(3).flatten();
    let ways = linear.map(|&joint| to[usize::from(joint)] - from[usize::from(joint)]);
    ways.map(|way| way * way).sum::<f64>().sqrt()
}
