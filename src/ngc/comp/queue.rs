//! Moves that are held back because their end depends on the corner that follows, and calls that wait after them.
use super::plane::{self, Point};
use super::problems;
use crate::{At, Canon, DistanceMode, Engine, Error, FeedMode, Pose, Sink, State, Units};
use std::f64::consts::TAU;
use trunnion_syntax::TextRange;

/// One queued call.
#[derive(Clone, Debug)]
enum Held {
    /// Not a motion.
    Call(Canon, At),
    /// A straight motion.
    Line(Line, Modes, At),
    /// An arc.
    Bow(Bow, Modes, At),
}

/// What was active when a motion was held: it is emitted with that, unaffected by later lines.
#[derive(Clone, Copy, Debug)]
struct Modes {
    motion: i16,
    distance: DistanceMode,
    arc_distance: DistanceMode,
    feed_mode: FeedMode,
    inverse_time: f64,
    named_axes: u16,
}

impl Modes {
    fn of(state: &State) -> Self {
        Self {
            motion: state.motion,
            distance: state.distance,
            arc_distance: state.arc_distance,
            feed_mode: state.feed_mode,
            inverse_time: state.inverse_time,
            named_axes: state.named_axes,
        }
    }
    /// Puts these in effect; returns what was in effect before.
    fn swap(self, state: &mut State) -> Self {
        let before = Self::of(state);
        state.motion = self.motion;
        state.distance = self.distance;
        state.arc_distance = self.arc_distance;
        state.feed_mode = self.feed_mode;
        state.inverse_time = self.inverse_time;
        state.named_axes = self.named_axes;
        before
    }
}

/// A straight motion of the centre.
#[derive(Clone, Debug)]
pub(super) struct Line {
    pub(super) rapid: bool,
    /// End, centre.
    pub(super) end: Pose,
    /// The contour's direction, or zero where a reversal is harmless (entry, motion along the axis).
    pub(super) along: Point,
}

/// An arc of the centre.
#[derive(Clone, Debug)]
pub(super) struct Bow {
    /// End, centre.
    pub(super) end: Pose,
    /// Middle of the arc.
    pub(super) centre: Point,
    /// As in [`Canon::Arc`].
    pub(super) turns: i32,
    /// Sweep before corners are fitted, rad, within one turn; `None`: any is right (entry).
    pub(super) sweep: Option<f64>,
    /// The end cannot be moved: entry of a turning tool.
    pub(super) fixed: bool,
}

/// The next move decides where the last one ends; until then it and the calls after it are held here.
#[derive(Clone, Debug, Default)]
pub(crate) struct Queue {
    held: Vec<Held>,
    /// Centre of the cutter after the last call that was emitted.
    told: Point,
    /// Middle and turns of the last move of the contour in the plane, if it was an arc.
    last_arc: Option<(Point, i32)>,
}

impl Queue {
    /// Whether calls must wait.
    pub(crate) fn is_empty(&self) -> bool {
        self.held.is_empty()
    }
    /// How many calls wait.
    pub(crate) fn count(&self) -> usize {
        self.held.len()
    }
    /// The centre is here, nothing is held.
    pub(super) fn start(&mut self, at: Point) {
        self.held.clear();
        self.told = at;
        self.last_arc = None;
    }
    /// A call that is not a motion is queued in order.
    pub(crate) fn hold(&mut self, call: Canon, at: At) {
        self.held.push(Held::Call(call, at));
    }
    /// Other units: lengths are multiplied.
    pub(crate) fn scale(&mut self, factor: f64) {
        self.told = plane::scaled(self.told, factor);
        if let Some((centre, _)) = &mut self.last_arc {
            *centre = plane::scaled(*centre, factor);
        }
        let scale_pose = |pose: &mut Pose| {
            for axis in [0, 1, 2, 6, 7, 8] {
                pose[axis] *= factor;
            }
        };
        for held in &mut self.held {
            match held {
                Held::Call(..) => {}
                Held::Line(line, ..) => scale_pose(&mut line.end),
                Held::Bow(bow, ..) => {
                    scale_pose(&mut bow.end);
                    bow.centre = plane::scaled(bow.centre, factor);
                }
            }
        }
    }
    /// Middle and turns of the last move of the contour in the plane, if it was an arc.
    pub(super) fn last_arc(&self) -> Option<(Point, i32)> {
        self.last_arc
    }
    /// Sets the last move of the contour in the plane.
    pub(super) fn moves(&mut self, arc: Option<(Point, i32)>) {
        self.last_arc = arc;
    }
}

/// Holds a straight motion.
pub(super) fn line(engine: &mut Engine, line: Line, at: At) {
    let modes = Modes::of(&engine.state);
    engine.queue.held.push(Held::Line(line, modes, at));
}

/// Holds an arc.
pub(super) fn bow(engine: &mut Engine, bow: Bow, at: At) {
    let modes = Modes::of(&engine.state);
    engine.queue.held.push(Held::Bow(bow, modes, at));
}

/// Emits everything that is held unchanged.
pub(super) fn release(engine: &mut Engine, sink: &mut dyn Sink) {
    let mut held = std::mem::take(&mut engine.queue.held);
    for one in held.drain(..) {
        tell(engine, one, sink);
    }
    engine.queue.held = held;
}

/// The held motions end at `corner` instead; then everything is emitted.
pub(super) fn settle(engine: &mut Engine, corner: Point, range: TextRange, sink: &mut dyn Sink) -> Result<(), Error> {
    let plane = engine.state.plane;
    let mut held = std::mem::take(&mut engine.queue.held);
    for one in &held {
        if let Held::Bow(bow, ..) = one
            && bow.fixed
            && plane::point(plane, &bow.end) != corner
        {
            return Err(mismatch(bow, engine.queue.told, corner, range));
        }
    }
    for mut one in held.drain(..) {
        match &mut one {
            Held::Call(..) => {}
            Held::Line(line, ..) => {
                if plane::dot(line.along, plane::sub(corner, engine.queue.told)) < 0.0 {
                    let problem = if line.rapid {
                        &problems::GOUGE_RAPID
                    } else {
                        &problems::GOUGE_LINE
                    };
                    return Err(Error::new(problem, range));
                }
                line.end = plane::with_point(plane, line.end, corner);
            }
            Held::Bow(bow, ..) => {
                let further = overrun(engine.state.units);
                let told = engine.queue.told;
                if bow
                    .sweep
                    .is_some_and(|sweep| sweep_of(told, bow.centre, corner, bow.turns) > sweep + further)
                {
                    return Err(Error::new(&problems::GOUGE_ARC, range));
                }
                bow.end = plane::with_point(plane, bow.end, corner);
            }
        }
        tell(engine, one, sink);
    }
    engine.queue.held = held;
    Ok(())
}

/// An arc whose cutter sweeps more than the contour by this angle, rad, is refused: so is one whose end is before its start, and one
/// that a nearly tangent line leads too early into. Observed from `rs274` by bisection: the same for every radius, another one for inches.
fn overrun(units: Units) -> f64 {
    match units {
        Units::Inch => 0.001,
        Units::Millimetre => 0.0254,
    }
}

/// The control cannot cut the entry arc of a turning tool.
fn mismatch(bow: &Bow, start: Point, corner: Point, range: TextRange) -> Error {
    let radius = |at: Point| plane::length(plane::sub(at, bow.centre));
    let text = problems::MISMATCH
        .message
        .replacen("{}", &format!("{:.6}", radius(start)), 1);
    Error::with(
        &problems::MISMATCH,
        range,
        text.replacen("{}", &format!("{:.6}", radius(corner)), 1),
    )
}

/// Angle that an arc sweeps, rad, within one turn.
pub(super) fn sweep_of(start: Point, centre: Point, end: Point, turns: i32) -> f64 {
    let angle = plane::turn(plane::sub(start, centre), plane::sub(end, centre));
    let swept = if turns > 0 { angle } else { TAU - angle };
    // back at the start means a full turn
    if swept <= 0.0 { TAU } else { swept }
}

/// Tells one call.
fn tell(engine: &mut Engine, held: Held, sink: &mut dyn Sink) {
    let plane = engine.state.plane;
    let shift = plane::shift(&engine.state);
    let (call, modes, at) = match held {
        Held::Call(call, at) => (call, None, at),
        Held::Line(line, modes, at) => {
            let centre = plane::point(plane, &line.end);
            engine.queue.told = centre;
            let end = plane::with_point(plane, line.end, plane::add(centre, shift));
            (
                if line.rapid {
                    Canon::Traverse(end)
                } else {
                    Canon::Feed(end)
                },
                Some(modes),
                at,
            )
        }
        Held::Bow(bow, modes, at) => {
            let end = plane::point(plane, &bow.end);
            engine.queue.told = end;
            let pose = &bow.end;
            let reached = plane::with_point(plane, bow.end, plane::add(end, shift));
            engine.state.told.reach(&reached);
            let arc = Canon::Arc {
                end: plane::add(end, shift),
                centre: plane::add(bow.centre, shift),
                turns: bow.turns,
                axis_end: pose[plane::places(plane)[2]],
                others: [pose[3], pose[4], pose[5], pose[6], pose[7], pose[8]],
            };
            (arc, Some(modes), at)
        }
    };
    engine.state.told.follow(&call);
    let now = modes.map(|modes| modes.swap(&mut engine.state));
    engine.state.emitting_line = Some(engine.at());
    sink.call(&call, at, &engine.state);
    engine.state.emitting_line = None;
    if let Some(now) = now {
        now.swap(&mut engine.state);
    }
}
