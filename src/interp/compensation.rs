//! Cutter radius compensation in the plane (G41, G42 of a Fanuc or Haas mill): the tool's centre runs next to the programmed path. A motion
//! waits until the next one in the plane is known, since the corner between them depends on both.
//!
//! Start-up and cancel are of type A (parameter 5003: bits SUP and SUV 0): the first motion ends beside the start of the next, the last
//! motion of the contour ends beside its own end. Source: Fanuc Series 30i operator's manual, details of cutter compensation.
mod corner;
mod element;
mod lost;
mod nose;
mod select;
mod unmeasured;

use crate::core::Report;
use crate::frames::XYZ;
use crate::iso::Iso;
use crate::{FaultKind, ModalState, Motion, MotionKind, Refusal};
use corner::{Join, Link, Trouble, join};
use element::{Element, Point};
use trunnion_dialect::Plane;

/// A motion and the modal state after its block.
pub(crate) type PendingMotion = (Motion, ModalState);

/// The state of the compensation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) enum Stage {
    /// Off.
    #[default]
    Off,
    /// G41 or G42 is active, the next motion in the plane moves to the contour.
    Start,
    /// Along the contour.
    On,
    /// Stopped: motions are the programmed ones until G40.
    Lost,
}

/// A motion that waits for the next.
#[derive(Clone, Debug)]
struct Held {
    pending: PendingMotion,
    element: Element,
    /// Where its compensated path begins.
    from: Point,
    /// It moves to the contour and is not compensated itself.
    leads: bool,
}

/// See the module.
#[derive(Clone, Debug, Default)]
pub(crate) struct Compensation {
    pub(crate) stage: Stage,
    /// 1: left of the path, -1: right, before mirroring.
    pub(crate) side: f64,
    /// With a radius that is zero or not known.
    pub(crate) unmeasured: unmeasured::Unmeasured,
    /// mm.
    pub(crate) radius: f64,
    /// From the centre of the tool to the point that motions move, Z and X on a lathe, mm.
    tip: Point,
    /// D in effect.
    pub(crate) d: Option<u32>,
    /// The coordinates are mirrored, so that left and right change places.
    pub(crate) mirrored: bool,
    plane: Option<Plane>,
    held: Option<Box<Held>>,
    /// Motions without a path in the plane, after the held one.
    between: Vec<PendingMotion>,
    /// Blocks after the held motion that move nothing: M, S, F or G codes alone.
    still_blocks: usize,
    /// Motions that can be emitted now.
    pub(crate) ready: Vec<PendingMotion>,
}

const PLANE_CHANGES: &str = "the plane changes during cutter compensation: cancel it with G40 first";
const STARTS_WITH_ARC: &str = "cutter compensation starts with an arc: start it with a straight motion";
const ENDS_WITH_ARC: &str = "cutter compensation ends with an arc: end it with a straight motion";

/// So many motions without a path in the plane wait for the next corner: controls read a few blocks ahead.
const MOST_BETWEEN: usize = 10_000;

/// A motion that waits is as large as so many entries of other lists.
pub(crate) const WAITS: usize = 16;

impl Compensation {
    /// How many entries of lists that grow with the program a clone copies.
    pub(crate) fn copied(&self) -> usize {
        WAITS * (self.between.len() + self.ready.len())
    }

    /// Whether motions must pass through here.
    pub(crate) fn is_busy(&self) -> bool {
        self.held.is_some() || matches!(self.stage, Stage::Start | Stage::On)
    }
}

/// The motion with its path in the plane replaced.
fn moved(pending: &PendingMotion, element: &Element, from: Point, to: Point) -> Option<PendingMotion> {
    let (motion, state) = pending;
    let mut motion = *motion;
    element.put(&mut motion.start, from);
    element.put(&mut motion.end, to);
    if let MotionKind::Arc(Some(arc)) = &mut motion.kind {
        *arc = element.arc_between(arc, from, to)?;
    }
    Some((motion, state.clone()))
}

/// A motion at a corner, at the height where the motion before it ends, with its feed.
fn link(pending: &PendingMotion, element: &Element, from: Point, link: Link) -> PendingMotion {
    let to = link.to;
    let (motion, state) = pending;
    let mut motion = *motion;
    motion.start = motion.end;
    element.put(&mut motion.start, from);
    element.put(&mut motion.end, to);
    motion.kind = match (motion.kind, link.about) {
        (_, Some((corner, sign))) => MotionKind::Arc(Some(element.corner_arc(&motion.end, corner, from, to, sign))),
        (MotionKind::Rapid, None) => MotionKind::Rapid,
        _ => MotionKind::Linear,
    };
    (motion, state.clone())
}

impl Iso<'_> {
    /// Takes a motion of the program while compensation is busy.
    pub(crate) fn compensate(&mut self, mut pending: PendingMotion, report: &mut Report<'_>) {
        let motion = &pending.0;
        let now = pending.1.compensation;
        let plane = *self
            .memory
            .compensation
            .plane
            .get_or_insert(self.core.state.coordinates.plane());
        let Some(element) = Element::of(motion, plane) else {
            self.motion_out_of_plane(pending, report);
            return;
        };
        if let Some(held) = &self.memory.compensation.held
            && !held.element.meets(&element, &held.pending.0, motion)
        {
            self.lose("part of the path is unknown", report);
        }
        if pending.1.coordinates.plane() != plane && now != 0 && self.memory.compensation.stage == Stage::On {
            self.reject(PLANE_CHANGES, "plane-change", report);
            self.lose("the plane changes", report);
        }
        let cancels = now == 0;
        match (self.memory.compensation.stage, cancels) {
            (Stage::Start, false) => self.start(pending, element, report),
            (Stage::On, false) => self.follow(pending, element, report),
            (_, true) => self.cancel(pending, &element, report),
            (Stage::Off | Stage::Lost, false) => {
                self.mark_lost(&mut pending);
                self.memory.compensation.ready.push(pending);
            }
        }
    }

    /// A motion that does not move in the plane, or whose path is unknown.
    fn motion_out_of_plane(&mut self, mut pending: PendingMotion, report: &mut Report<'_>) {
        let motion = &pending.0;
        let still = Element::rests(
            motion,
            self.memory
                .compensation
                .plane
                .unwrap_or(self.core.state.coordinates.plane()),
        );
        let waits = still && self.memory.compensation.held.is_some();
        if waits && self.memory.compensation.between.len() < MOST_BETWEEN {
            self.memory.compensation.between.push(pending);
            return;
        }
        if waits {
            self.lose("more than 10 000 motions out of the plane wait for a corner", report);
            self.mark_lost(&mut pending);
        } else if !still {
            self.lose("part of the path is unknown", report);
            self.mark_lost(&mut pending);
        }
        self.memory.compensation.ready.push(pending);
    }

    fn start(&mut self, mut pending: PendingMotion, element: Element, report: &mut Report<'_>) {
        self.memory.compensation.stage = Stage::On;
        if element.is_arc() {
            self.reject(STARTS_WITH_ARC, "arc-start-or-cancel", report);
            self.lose("it starts with an arc", report);
            self.mark_lost(&mut pending);
            self.memory.compensation.ready.push(pending);
            return;
        }
        self.memory.compensation.held = Some(Box::new(Held {
            from: element.start,
            pending,
            element,
            leads: true,
        }));
    }

    /// Side with mirrored coordinates taken into account.
    fn side(&self) -> f64 {
        let plane = self
            .memory
            .compensation
            .plane
            .unwrap_or(self.core.state.coordinates.plane());
        if self.memory.frames.shape.flips(plane) {
            -self.memory.compensation.side
        } else {
            self.memory.compensation.side
        }
    }

    /// The next motion of the contour: the held one can be emitted.
    fn follow(&mut self, mut pending: PendingMotion, element: Element, report: &mut Report<'_>) {
        let offset = self.side() * self.memory.compensation.radius;
        let Some(held) = self.memory.compensation.held.take() else {
            self.memory.compensation.still_blocks = 0;
            // after a start-up that was already emitted
            self.memory.compensation.held = Some(Box::new(Held {
                from: element.start,
                pending,
                element,
                leads: true,
            }));
            return;
        };
        let result = if held.leads {
            let beside = element.beside_start(offset);
            Ok(Join {
                end: beside,
                links: Vec::new(),
                start: beside,
            })
        } else {
            join(&held.element, &element, offset, self.core.setup.control.outer_corner)
        };
        let joined = result.and_then(|join| {
            let end = join.end;
            let pending = if held.leads {
                moved(&held.pending, &held.element, held.from, end)
            } else {
                held.element
                    .keeps_direction(offset, held.from, end)
                    .then(|| moved(&held.pending, &held.element, held.from, end))
                    .flatten()
            };
            pending.map(|pending| (pending, join)).ok_or(Trouble::Interference)
        });
        match joined {
            Ok((mut ready, join)) => {
                let tip = self.memory.compensation.tip;
                let starts = !held.leads;
                held.element.shift(&mut ready.0, tip, [starts, true]);
                let still = std::mem::take(&mut self.memory.compensation.still_blocks);
                // without a corner the end is beside that of the motion, wherever the control looks
                let beside = held.element.beside_end(offset);
                let turns = !join.links.is_empty() || (0..2).any(|axis| (beside[axis] - join.end[axis]).abs() > 1e-9);
                let unsure = self.memory.compensation.between.len() + still > 1 && (turns || held.leads);
                self.release(ready, &held.element, element::add(join.end, tip, 1.0), unsure, report);
                let mut from = join.end;
                for next in join.links {
                    let mut pending = link(&held.pending, &held.element, from, next);
                    held.element.shift(&mut pending.0, tip, [true, true]);
                    self.memory.compensation.ready.push(pending);
                    from = next.to;
                }
                self.memory.compensation.held = Some(Box::new(Held {
                    pending,
                    element,
                    from: join.start,
                    leads: false,
                }));
            }
            Err(trouble) => {
                let (text, alarm) = trouble.words();
                self.reject(text, alarm, report);
                self.memory.compensation.held = Some(held);
                self.lose("it has no path here", report);
                self.mark_lost(&mut pending);
                self.memory.compensation.ready.push(pending);
            }
        }
    }

    /// Emits a motion, and after it, at its end, those without a path in the plane.
    fn release(
        &mut self,
        mut pending: PendingMotion,
        element: &Element,
        end: Point,
        unsure: bool,
        report: &mut Report<'_>,
    ) {
        let between = std::mem::take(&mut self.memory.compensation.between);
        if unsure {
            let what =
                "cutter radius compensation: a corner after several blocks that do not move in the plane".to_owned();
            report.fault(report.whole(), FaultKind::NotModelled { what });
            element.forget(&mut pending.0.end);
        }
        self.memory.compensation.ready.push(pending);
        for (mut motion, state) in between {
            element.put(&mut motion.start, end);
            element.put(&mut motion.end, end);
            if unsure {
                element.forget(&mut motion.start);
                element.forget(&mut motion.end);
            }
            self.memory.compensation.ready.push((motion, state));
        }
    }

    /// A block that moves nothing, while a motion waits for the next one: a control reads only a few blocks ahead (Fanuc Series 15i operator's
    /// manual, 14.4.3: M, S, T and dwell in blocks of their own count). Other languages count other blocks.
    pub(crate) fn note_still_block(&mut self, block: &trunnion_syntax::Block<'_>) {
        let says = |word: trunnion_syntax::Word| {
            matches!(
                word.address,
                trunnion_syntax::Address::Letter(b'M' | b'S' | b'T' | b'F' | b'G')
            )
        };
        if self.memory.compensation.held.is_some() && !self.core.dialect.quirks.declares_names() {
            self.memory.compensation.still_blocks += usize::from(block.words().any(says));
        }
    }

    /// The last motion of the contour ends beside its end.
    fn settle(&mut self, report: &mut Report<'_>) -> Option<Point> {
        self.memory.compensation.still_blocks = 0;
        let held = self.memory.compensation.held.take()?;
        let offset = self.side() * self.memory.compensation.radius;
        let end = if held.leads {
            held.element.end
        } else {
            held.element.beside_end(offset)
        };
        let fits = held.leads || held.element.keeps_direction(offset, held.from, end);
        let mut at = end;
        if let Some(mut pending) = moved(&held.pending, &held.element, held.from, end).filter(|_| fits) {
            if !held.leads {
                let tip = self.memory.compensation.tip;
                held.element.shift(&mut pending.0, tip, [true, true]);
                at = element::add(end, tip, 1.0);
            }
            self.release(pending, &held.element, at, false, report);
        } else {
            let (text, alarm) = Trouble::Interference.words();
            self.reject(text, alarm, report);
            let pending = held.pending.clone();
            self.release(pending, &held.element, held.element.end, false, report);
        }
        Some(at)
    }

    /// The first motion in the plane after G40 leaves the contour.
    fn cancel(&mut self, pending: PendingMotion, element: &Element, report: &mut Report<'_>) {
        let from = self.settle(report);
        self.memory.compensation.stage = Stage::Off;
        self.memory.compensation.plane = None;
        let Some(from) = from else {
            self.memory.compensation.ready.push(pending);
            return;
        };
        if element.is_arc() {
            self.reject(ENDS_WITH_ARC, "arc-start-or-cancel", report);
        }
        let ready = moved(&pending, element, from, element.end).filter(|_| !element.is_arc());
        self.memory.compensation.ready.push(ready.unwrap_or(pending));
    }

    /// Everything pending is emitted: the program ends.
    pub(crate) fn end_compensation(&mut self, report: &mut Report<'_>) {
        self.settle(report);
        let between = std::mem::take(&mut self.memory.compensation.between);
        self.memory.compensation.ready.extend(between);
        self.memory.compensation.stage = Stage::Off;
    }

    fn reject(&self, text: &str, mistake: &str, report: &mut Report<'_>) {
        let alarm = self.core.dialect.alarm(mistake).map(|alarm| alarm.number.clone());
        let kind = FaultKind::Rejected {
            refusal: Refusal::Compensation,
            message: text.to_owned(),
            alarm,
        };
        report.fault(report.whole(), kind);
    }
}

/// Linear axes of the plane are known at both ends.
fn known(motion: &Motion) -> bool {
    let known = motion.start.known & motion.end.known & XYZ;
    // a lathe moves in its plane alone: Y need not be known, as long as it stays
    known == XYZ || motion.radii && known == 0b101 && (motion.start.known | motion.end.known) & XYZ == known
}
