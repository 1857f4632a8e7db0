//! APPR and DEP: tangential ways to a contour and away from it.
//!
//! With t the direction of travel at the contour point, s = +1 for RL and -1 for RR, n = s times the left normal: LT begins at PA - LEN t; LN
//! at PA + (LEN + r) n with the tool radius r; CT on the circle about PA + R n, CCA before PA; LCT the same with a line from PS that is
//! tangent. DEP is the mirror of each. Sources: TNC 640 DIN/ISO p. 213, TNC 410 p. 84 and 85, TNC 407 p. 106, TNC 320 p. 147.
use super::corner::Waiting;
use super::path_words::PathWords;
use super::words::Words;
use super::{Klartext, Made};
use crate::core::Report;
use crate::frames::Tilted;
use crate::{Feed, Motion, MotionKind, Position};
use trunnion_geometry::Vec3;
use trunnion_geometry::arc::{Arc, Turning};
use trunnion_geometry::math::{asin, atan2, rotate};

/// The form of an approach or departure.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    Tangent,
    Normal,
    Circle,
    LineAndCircle,
}

/// An approach whose contour direction is not known yet.
#[derive(Clone, Debug)]
pub(crate) struct Approach {
    form: Form,
    /// A motion from PS to PA, with everything modal.
    template: Motion,
    tilt: Option<Tilted>,
    normal: Vec3,
    length: Option<f64>,
    radius: Option<f64>,
    angle_deg: Option<f64>,
    /// +1 where the tool is left of the contour.
    side: f64,
    first_is_rapid: bool,
    first_feed: Feed,
}

impl Klartext<'_> {
    pub(crate) fn approach(&mut self, words: &mut Words<'_>, report: &mut Report<'_>) {
        self.flush(report);
        let Some((form, polar)) = form(words) else {
            Self::not_modelled("APPR in a form that is not known", report);
            return self.unknown_motion(report);
        };
        let (first_is_rapid, first_feed) = (self.memory.was_rapid, self.last_feed());
        let (found, _, end) = self.contour_words(words, polar, report);
        let feed = if self.memory.rapid_arc {
            Feed::Unknown
        } else {
            self.core.feed(MotionKind::Linear, Default::default, report)
        };
        let side = match self.core.state.compensation {
            41 => 1.0,
            42 => -1.0,
            _ => 0.0,
        };
        let flips = self.memory.frames.shape.flips(self.core.state.coordinates.plane());
        let side = if flips { -side } else { side };
        let orientation = self.core.held_orientation();
        // the first contour element is in work coordinates too
        let start = self.core.state.position;
        let end = self.memory.frames.arrive(end);
        self.core.state.position = end;
        let scaled = self.scales_lengths("APPR", report);
        let kind = MotionKind::Linear;
        let template = self.core.motion_in_frame(kind, [start, end], orientation, feed, report);
        let unit = self.core.state.coordinates.unit_mm();
        let mm = |value: Option<Option<f64>>| value.flatten().map(|value| value * unit);
        let whole = form == Form::LineAndCircle;
        let approach = Approach {
            form,
            template,
            tilt: self.memory.frames.tilt,
            normal: self.plane_normal(),
            length: mm(found.length).filter(|_| !scaled),
            radius: mm(found.radius.filter(|_| found.compensation != Some(0))).filter(|_| !scaled),
            // CCA is positive
            angle_deg: found.centre_angle.flatten().filter(|angle| *angle > 0.0),
            side,
            first_is_rapid: first_is_rapid && !whole,
            first_feed: if whole { feed } else { first_feed },
        };
        self.memory.waiting = Some(Waiting::Approach(Box::new(approach)));
        self.memory.was_rapid = false;
        self.memory.heading = None;
        self.codes_after(&found);
    }

    /// The words of a block, where it begins and ends, in the coordinates of the words.
    fn contour_words(
        &mut self,
        words: &mut Words<'_>,
        polar: bool,
        report: &mut Report<'_>,
    ) -> (PathWords, Position, Position) {
        let found = self.path_words(words, report);
        self.codes_before(&found, report);
        self.memory.rapid_arc = self.take_feed(found.feed, report);
        if self.memory.rapid_arc {
            self.not_modelled_once("FMAX in APPR or DEP: which parts of the path are rapids", report);
        }
        if let Some(compensation) = found.compensation {
            self.core.state.compensation = compensation;
            if compensation != 0 && !std::mem::replace(&mut self.core.compensation_reported, true) {
                let what = "cutter radius compensation: the programmed path is used instead";
                Self::not_modelled(what, report);
            }
        }
        let start = self.memory.frames.programmed(&self.core.state.position);
        let mut end = start;
        self.place(&found, &mut end);
        if polar {
            self.polar_end(super::path::Path::PolarLine, &found, &start, &mut end, report);
        }
        (found, start, end)
    }

    fn last_feed(&self) -> Feed {
        match self.core.state.feed.value() {
            Some(value) if value > 0.0 => Feed::PerMinute(value),
            _ => Feed::Unknown,
        }
    }

    /// The way to the contour, once its first element is known.
    pub(crate) fn finish_approach(&mut self, approach: &Approach, next: &Made, report: &mut Report<'_>) {
        let (Some(start), Some(end)) = (approach.template.start.xyz(), approach.template.end.xyz()) else {
            return self.approach_unknown(approach);
        };
        let normal = approach.normal;
        let way = match &next.motion.kind {
            MotionKind::Arc(Some(arc)) => {
                let radius = arc.start - arc.centre;
                Some(rotate(
                    &normal,
                    arc.sweep.signum() * arc.normal.dot(&normal) * core::f64::consts::FRAC_PI_2,
                    &radius,
                ))
            }
            MotionKind::Linear => next
                .motion
                .start
                .xyz()
                .zip(next.motion.end.xyz())
                .map(|(from, to)| to - from),
            _ => None,
        };
        let tangent = way.and_then(|way| (way - normal * normal.dot(&way)).try_normalize(1e-9));
        let parts = tangent.and_then(|tangent| approach.parts(start, end, tangent));
        let Some((from, arc)) = parts else {
            let what = match approach.form {
                Form::Normal => "APPR LN: the tool radius",
                _ => "APPR: its words, the side of the tool, or the direction of the contour",
            };
            Self::not_modelled(what, report);
            return self.approach_unknown(approach);
        };
        // in the plane first, then to the depth
        let mut level = from;
        let depth = normal.dot(&(end - start));
        level -= normal * normal.dot(&(from - start));
        let mut legs = vec![(level, None, true)];
        if depth.abs() > 1e-9 {
            legs.push((level + normal * depth, None, true));
        }
        let lifted = |point: Vec3| point - normal * normal.dot(&(point - end));
        legs.push((lifted(end), arc, false));
        let mut at = approach.template.start;
        for (target, arc, first) in legs {
            let mut motion = approach.template;
            motion.start = at;
            let mut to = at;
            for axis in 0..3 {
                to.set(axis, target[axis]);
            }
            motion.end = to;
            if to == at {
                continue;
            }
            if first && approach.first_is_rapid {
                (motion.kind, motion.feed) = (MotionKind::Rapid, Feed::Rapid);
            } else if first {
                motion.feed = approach.first_feed;
            }
            if let Some(arc) = arc {
                motion.kind = MotionKind::Arc(Some(arc));
            }
            self.finish_motion(&Made {
                motion,
                tilt: approach.tilt,
            });
            at = to;
        }
    }

    /// The way is not known, its end is.
    pub(crate) fn approach_unknown(&mut self, approach: &Approach) {
        let mut motion = approach.template;
        (motion.kind, motion.feed) = (MotionKind::Unknown, Feed::Unknown);
        self.finish_motion(&Made {
            motion,
            tilt: approach.tilt,
        });
    }

    /// DEP: the mirror of APPR at the last contour point; R0 from its end on.
    pub(crate) fn depart(&mut self, words: &mut Words<'_>, report: &mut Report<'_>) {
        self.flush(report);
        let Some((form, polar)) = form(words) else {
            Self::not_modelled("DEP in a form that is not known", report);
            return self.unknown_motion(report);
        };
        let side = match self.core.state.compensation {
            41 => 1.0,
            42 => -1.0,
            _ => 0.0,
        };
        let (found, start, end) = self.contour_words(words, polar, report);
        self.core.state.compensation = 0;
        let unit = self.core.state.coordinates.unit_mm();
        let mm = |value: Option<Option<f64>>| value.flatten().map(|value| value * unit);
        let scaled = self.scales_lengths("DEP", report);
        let (length, radius) = (
            mm(found.length).filter(|_| !scaled),
            mm(found.radius).filter(|_| !scaled),
        );
        let normal = self.plane_normal();
        let flat = |vector: Vec3| vector - normal * normal.dot(&vector);
        let tangent = self
            .memory
            .heading
            .and_then(|heading| flat(heading).try_normalize(1e-9));
        let steps = (|| {
            let (from, tangent) = (start.xyz()?, tangent?);
            let inward = normal.cross(&tangent) * side;
            Some(match form {
                Form::Tangent => vec![(from + tangent * length?, None)],
                Form::Normal => return None,
                Form::Circle => {
                    // CCA is positive
                    let angle = found.centre_angle.flatten().filter(|angle| *angle > 0.0)?;
                    let radius = radius.filter(|_| side != 0.0)?;
                    let centre = from + inward * radius;
                    let turn = side * angle.to_radians() * radius.signum();
                    let to = centre + rotate(&normal, turn, &(from - centre));
                    vec![(to, about(from, to, centre, normal, turn))]
                }
                Form::LineAndCircle => {
                    let radius = radius.filter(|radius| *radius > 0.0 && side != 0.0)?;
                    let goal = end.xyz()?;
                    let centre = from + inward * radius;
                    let touch = touch(
                        centre,
                        radius,
                        goal - normal * normal.dot(&(goal - from)),
                        normal,
                        -side,
                    )?;
                    let turn = angle(centre, from, touch, normal, side);
                    let level = goal - normal * normal.dot(&(goal - from));
                    vec![(touch, about(from, touch, centre, normal, turn)), (level, None)]
                }
            })
        })();
        let steps = steps.and_then(|steps| depth_last(steps, normal, start.xyz()?, end.xyz()?));
        let Some(steps) = steps else {
            if form == Form::Normal {
                Self::not_modelled("DEP LN: the tool radius", report);
            } else {
                Self::not_modelled(
                    "DEP: its words, the side of the tool, or the direction of the contour",
                    report,
                );
            }
            self.unknown_motion(report);
            return self.codes_after(&found);
        };
        let mut at = start;
        for (target, arc) in steps {
            let mut to = at;
            for axis in 0..3 {
                to.set(axis, target[axis]);
            }
            let kind = arc.map_or(MotionKind::Linear, |arc| MotionKind::Arc(Some(arc)));
            self.go(kind, at, to, &PathWords::default(), report);
            at = to;
        }
        self.codes_after(&found);
    }
}

impl Approach {
    /// PH, and the arc to PA, at the height of PA.
    fn parts(&self, start: Vec3, end: Vec3, tangent: Vec3) -> Option<(Vec3, Option<Arc>)> {
        let inward = self.normal.cross(&tangent) * self.side;
        let turned = self.side != 0.0;
        match self.form {
            Form::Tangent => Some((end - tangent * self.length?, None)),
            // the tool radius enters
            Form::Normal => None,
            Form::Circle => {
                let (radius, degrees) = (self.radius.filter(|_| turned)?, self.angle_deg?);
                // a negative radius: to the other side
                let centre = end + inward * radius;
                let turn = self.side * degrees.to_radians() * radius.signum();
                let from = centre + rotate(&self.normal, -turn, &(end - centre));
                Some((from, Some(about(from, end, centre, self.normal, turn)?)))
            }
            Form::LineAndCircle => {
                let radius = self.radius.filter(|radius| *radius > 0.0 && turned)?;
                let centre = end + inward * radius;
                let level = start - self.normal * self.normal.dot(&(start - end));
                let from = touch(centre, radius, level, self.normal, self.side)?;
                let turn = angle(centre, from, end, self.normal, self.side);
                Some((from, about(from, end, centre, self.normal, turn)))
            }
        }
    }
}

/// The points and arcs of a way.
type Steps = Vec<(Vec3, Option<Arc>)>;

/// A departure in the plane, and its depth behind it (TNC 640).
fn depth_last(mut steps: Steps, normal: Vec3, start: Vec3, end: Vec3) -> Option<Steps> {
    let depth = normal.dot(&(end - start));
    if depth.abs() > 1e-9 {
        steps.push((steps.last()?.0 + normal * depth, None));
    }
    Some(steps)
}

/// The arc of a given turn; `None` where it turns by nothing.
fn about(from: Vec3, to: Vec3, centre: Vec3, normal: Vec3, turn: f64) -> Option<Arc> {
    let turning = if turn < 0.0 {
        Turning::Clockwise
    } else {
        Turning::CounterClockwise
    };
    let arc = Arc::from_centre(from, to, centre, normal, turning, 0)?;
    (turn.abs() > 1e-9).then_some(Arc { sweep: turn, ..arc })
}

/// The turn about a centre from one point to another, with the sign of `side`.
fn angle(centre: Vec3, from: Vec3, to: Vec3, normal: Vec3, side: f64) -> f64 {
    let (a, b) = (from - centre, to - centre);
    let turn = side * atan2(normal.dot(&a.cross(&b)), a.dot(&b));
    side * turn.rem_euclid(core::f64::consts::TAU)
}

/// The point of a circle where the line from `from` touches it, travelling on counter-clockwise for `side` +1.
fn touch(centre: Vec3, radius: f64, from: Vec3, normal: Vec3, side: f64) -> Option<Vec3> {
    let way = centre - from;
    let distance = way.norm();
    if distance <= radius + 1e-9 {
        return None;
    }
    // the centre is left of the line for a counter-clockwise circle
    let turn = -side * asin(radius / distance);
    let line = rotate(&normal, turn, &way).try_normalize(1e-12)?;
    Some(from + line * (distance * distance - radius * radius).sqrt())
}

/// LT, LN, CT, LCT and their polar forms.
fn form(words: &mut Words<'_>) -> Option<(Form, bool)> {
    let word = words.next()?;
    let name = word.name();
    let (name, polar) = match name {
        [b'P', rest @ ..] => (rest, true),
        name => (name, false),
    };
    let form = match name {
        b"LT" => Form::Tangent,
        b"LN" => Form::Normal,
        b"CT" => Form::Circle,
        b"LCT" => Form::LineAndCircle,
        _ => return None,
    };
    Some((form, polar))
}
