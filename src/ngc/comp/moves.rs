//! One move of the contour: entry, the corner before it, the centre's path.
use super::corner::{self, Corner, Way};
use super::plane::{self, Point};
use super::{problems, queue};
use crate::{At, Block, Engine, Error, FeedMode, Pose, Side, Sink, exec};

/// The purpose of a straight motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// G0.
    Rapid,
    /// G1.
    Feed,
    /// G33, G33.1, G76: the control moves along the contour.
    Thread,
}

/// An arc of the contour.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Arc {
    /// Pose at the end, program coordinates.
    pub(crate) end: Pose,
    /// Centre in the plane: first and second coordinate (ZX: Z, X).
    pub(crate) centre: [f64; 2],
    /// As in [`cexec::Canon::Arc`].
    pub(crate) turns: i32,
    /// Length of the contour's arc in space, program units: what F of G93 is measured along.
    pub(crate) length: f64,
}

/// The corner at the contour point where the move begins.
struct Here {
    /// Contour.
    contour: Point,
    /// Centre.
    centre: Point,
    /// A point of the straight path before, where it is cut with an arc whose radii differ.
    fitted: Point,
    radius: f64,
    /// From the contour to the cutter.
    normal: Point,
}

impl Here {
    fn new(engine: &Engine) -> Self {
        let state = &engine.state;
        let contour = plane::point(state.plane, &state.current);
        let centre = plane::point(state.plane, &state.compensated);
        let normal = plane::unit(plane::sub(centre, contour));
        Self {
            contour,
            centre,
            fitted: centre,
            radius: state.radius,
            normal,
        }
    }
    /// The centre for another direction to the cutter.
    fn beside(&self, normal: Point) -> Point {
        plane::add(self.contour, plane::scaled(normal, self.radius))
    }
}

/// One straight motion (G0 or G1) to `end` (program coordinates of the contour) while compensation is on.
pub(crate) fn straight(
    engine: &mut Engine,
    rapid: bool,
    end: Pose,
    block: &Block,
    at: At,
    sink: &mut dyn Sink,
) -> Result<(), Error> {
    let kind = if rapid { Kind::Rapid } else { Kind::Feed };
    along(engine, kind, end, block, at, sink)
}

/// One straight motion of any kind while compensation is on.
pub(crate) fn along(
    engine: &mut Engine,
    kind: Kind,
    end: Pose,
    block: &Block,
    at: At,
    sink: &mut dyn Sink,
) -> Result<(), Error> {
    let rapid = kind == Kind::Rapid;
    if kind == Kind::Feed && engine.state.feed_mode == FeedMode::InverseTime {
        exec::inverse_time(engine, block, exec::length(&engine.state.current, &end), at, sink);
    }
    let plane = engine.state.plane;
    let target = plane::point(plane, &end);
    let here = Here::new(engine);
    let way = plane::sub(target, here.contour);
    let direction = plane::scaled(plane::left_of(plane::unit(way)), corner::sign(engine.state.side));
    let mut centre = plane::add(target, plane::scaled(direction, here.radius));
    let mut along = way;
    if here.radius == 0.0 {
        engine.queue.start(here.contour);
        centre = target;
        along = [0.0; 2];
    } else if engine.state.first_compensated {
        // what is unknown is not refused
        if plane::length(way) <= here.radius {
            return Err(Error::new(&problems::ENTRY_LENGTH, block.range));
        }
        refuse_thread(kind, block)?;
        engine.queue.start(here.contour);
        along = [0.0; 2];
    } else if way == [0.0; 2] {
        refuse_thread(kind, block)?;
        // nothing in the plane: the centre stays, and this move ends at the corner together with the one before
        centre = here.centre;
    } else {
        let found = corner::corner(engine.state.side, here.normal, direction, bulging(engine));
        let coming = NextMove {
            kind,
            direction,
            way: Way::Line(here.beside(direction), way),
            end,
        };
        turn(engine, found, &here, &coming, block, at, sink)?;
    }
    let line = queue::Line {
        rapid,
        end: plane::with_point(plane, end, centre),
        along,
    };
    // a motion along the axis leaves the path before it in effect as long as that is still held
    if way != [0.0; 2] || engine.queue.is_empty() {
        engine.queue.moves(None);
    }
    queue::line(engine, line, at);
    arrive(engine, end, centre, sink);
    Ok(())
}

/// The control has no threads that begin compensation, that do not move in the plane, or that go around an outside corner.
fn refuse_thread(kind: Kind, block: &Block) -> Result<(), Error> {
    match kind {
        Kind::Thread => Err(Error::new(&problems::NOT_G0_G1, block.range)),
        Kind::Rapid | Kind::Feed => Ok(()),
    }
}

/// One arc while compensation is on.
pub(crate) fn arc(engine: &mut Engine, arc: &Arc, block: &Block, at: At, sink: &mut dyn Sink) -> Result<(), Error> {
    if engine.state.feed_mode == FeedMode::InverseTime {
        exec::inverse_time(engine, block, arc.length, at, sink);
    }
    let plane = engine.state.plane;
    let target = plane::point(plane, &arc.end);
    let here = Here::new(engine);
    // from the centre of the arc to the cutter: outward or inward
    let outward = if (arc.turns > 0) == (corner::sign(engine.state.side) > 0.0) {
        -1.0
    } else {
        1.0
    };
    let radial = plane::unit(plane::sub(target, arc.centre));
    let centre = plane::add(target, plane::scaled(radial, outward * here.radius));
    let bow = if here.radius == 0.0 {
        engine.queue.start(here.contour);
        queue::Bow {
            end: arc.end,
            centre: arc.centre,
            turns: arc.turns,
            sweep: None,
            fixed: false,
        }
    } else if engine.state.first_compensated {
        let chord = plane::length(plane::sub(target, here.contour));
        if chord <= here.radius {
            return Err(Error::new(&problems::ENTRY_ARC, block.range));
        }
        tight(
            outward,
            here.radius,
            plane::length(plane::sub(target, arc.centre)),
            block,
        )?;
        entry(engine, arc, &here, centre, at)
    } else {
        let start = plane::sub(here.contour, arc.centre);
        let radius = plane::length(start);
        tight(
            outward,
            here.radius,
            plane::length(plane::sub(target, arc.centre)),
            block,
        )?;
        let direction = plane::scaled(start, outward / radius);
        let found = corner::corner(engine.state.side, here.normal, direction, outward > 0.0);
        // the control fits the corner to the radius at the end of the arc, as if the contour reached that circle
        let fitted = plane::length(plane::sub(target, arc.centre));
        let coming = NextMove {
            kind: Kind::Feed,
            direction,
            way: Way::Circle(arc.centre, fitted + outward * here.radius, arc.turns > 0),
            end: arc.end,
        };
        let mut here = here;
        if engine.queue.last_arc().is_none() {
            here.fitted = plane::add(here.centre, plane::scaled(start, fitted / radius - 1.0));
        }
        turn(engine, found, &here, &coming, block, at, sink)?;
        queue::Bow {
            end: plane::with_point(plane, arc.end, centre),
            centre: arc.centre,
            turns: arc.turns,
            sweep: Some(queue::sweep_of(here.contour, arc.centre, target, arc.turns)),
            fixed: false,
        }
    };
    // the control does not remember the entry arc of a turning tool as an arc
    engine.queue.moves((!bow.fixed).then_some((bow.centre, bow.turns)));
    queue::bow(engine, bow, at);
    arrive(engine, arc.end, centre, sink);
    Ok(())
}

/// Conditions of an arc that begins compensation, before its centre is computed.
pub(crate) fn check_entry_arc(engine: &Engine, end: &Pose, clockwise: bool, block: &Block) -> Result<(), Error> {
    let state = &engine.state;
    if state.side == Side::Off || !state.first_compensated || state.radius == 0.0 {
        return Ok(());
    }
    let [from, to] = [&state.current, end].map(|pose| plane::point(state.plane, pose));
    if plane::length(plane::sub(to, from)) <= state.radius {
        return Err(Error::new(&problems::ENTRY_ARC, block.range));
    }
    let inside = clockwise != (state.side == Side::Left);
    let outward = if inside { -1.0 } else { 1.0 };
    block
        .word(b'R')
        .map_or(Ok(()), |radius| tight(outward, state.radius, radius.abs(), block))
}

/// Whether the last move is an arc with the cutter on its outside.
fn bulging(engine: &Engine) -> bool {
    let left = corner::sign(engine.state.side) > 0.0;
    engine.queue.last_arc().is_some_and(|(_, turns)| (turns > 0) != left)
}

/// An arc with the cutter on its inside must be larger than the cutter.
fn tight(outward: f64, radius: f64, arc_radius: f64, block: &Block) -> Result<(), Error> {
    if outward < 0.0 && radius >= arc_radius {
        return Err(Error::new(&problems::TIGHT_ARC, block.range));
    }
    Ok(())
}

/// Compensation begins with an arc: another arc from the cutter's position that touches the compensated end in the same direction.
fn entry(engine: &mut Engine, arc: &Arc, here: &Here, end: Point, at: At) -> queue::Bow {
    let plane = engine.state.plane;
    engine.queue.start(here.contour);
    let edge = (1..=8).contains(&engine.state.orientation);
    if edge {
        // the edge of a turning tool is put in place first
        let line = queue::Line {
            rapid: false,
            end: engine.state.current,
            along: [0.0; 2],
        };
        queue::line(engine, line, at);
    }
    let inward = plane::unit(plane::sub(arc.centre, end));
    let back = plane::sub(here.contour, end);
    let radius = plane::dot(back, back) / (2.0 * plane::dot(back, inward));
    queue::Bow {
        end: plane::with_point(plane, arc.end, end),
        centre: plane::add(end, plane::scaled(inward, radius)),
        turns: arc.turns,
        sweep: None,
        fixed: edge,
    }
}

/// The move after a corner.
struct NextMove {
    kind: Kind,
    /// From the contour to the cutter, at its start.
    direction: Point,
    way: Way,
    /// Where it leads.
    end: Pose,
}

/// Ends the held moves at the corner before the new one, and goes around it where it is an outside corner. On the path around the control
/// turns the rotary axes to where the new move ends.
fn turn(
    engine: &mut Engine,
    found: Corner,
    here: &Here,
    coming: &NextMove,
    block: &Block,
    at: At,
    sink: &mut dyn Sink,
) -> Result<(), Error> {
    let NextMove {
        kind,
        direction,
        way: new,
        end: target,
    } = *coming;
    match found {
        Corner::Flat => queue::release(engine, sink),
        Corner::Inside => {
            let last = corner::last_way(engine, here.fitted, here.normal);
            let Some(meeting) = corner::meeting(engine.state.side, last, new) else {
                let problem = match (last, new) {
                    (Way::Circle(..), Way::Circle(..)) => &problems::ARC_TO_ARC,
                    (Way::Circle(..), Way::Line(..)) => &problems::ARC_TO_STRAIGHT,
                    (Way::Line(..), _) => &problems::GOUGE_ARC,
                };
                return Err(Error::new(problem, block.range));
            };
            queue::settle(engine, meeting, block.range, sink)?;
        }
        Corner::Outside => {
            match new {
                Way::Line(..) => queue::settle(engine, here.centre, block.range, sink)?,
                Way::Circle(..) => queue::release(engine, sink),
            }
            let plane = engine.state.plane;
            let mut end = plane::with_point(plane, engine.state.current, here.beside(direction));
            end[3..].copy_from_slice(&target[3..]);
            match kind {
                Kind::Rapid => {
                    let line = queue::Line {
                        rapid: true,
                        end,
                        along: [0.0; 2],
                    };
                    queue::line(engine, line, at);
                }
                Kind::Feed => {
                    let bow = queue::Bow {
                        end,
                        centre: here.contour,
                        turns: -(corner::sign(engine.state.side) as i32),
                        sweep: None,
                        fixed: false,
                    };
                    queue::bow(engine, bow, at);
                }
                Kind::Thread => return refuse_thread(kind, block),
            }
            queue::release(engine, sink);
        }
    }
    Ok(())
}

/// The contour has reached `end`, the centre `centre`.
fn arrive(engine: &mut Engine, end: Pose, centre: Point, sink: &mut dyn Sink) {
    let state = &mut engine.state;
    state.current = end;
    state.compensated = plane::with_point(state.plane, end, centre);
    if state.radius == 0.0 {
        // without radius there is no corner to wait for
        queue::release(engine, sink);
    } else {
        state.first_compensated = false;
    }
}
