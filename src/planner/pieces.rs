//! From a leg of the machine to pieces of path with constant limits.
use crate::corner::{Passage, Side};
use crate::sampled::sampled;
use crate::{Bounds, Limit, Piece};
use core::f64::consts::PI;
use trunnion_geometry::math::{atan2, cos, hypot, sin};
use trunnion_geometry::{arc::Arc, deg};
use trunnion_interp::{Feed, MotionKind};
use trunnion_machine::{BlockPath, Joints, Leg, Machine, leads_tip};

/// A leg as the planner takes it.
pub(crate) struct Course {
    /// Joints per mm at its start and end.
    pub(crate) tangents: [Joints; 2],
    /// mm, or deg where only rotary axes turn.
    pub(crate) length: f64,
    pub(crate) turns_only: bool,
    /// F, mm/s; infinite in rapid.
    pub(crate) feed: f64,
    /// Every axis that moves declares its acceleration.
    pub(crate) complete: bool,
    /// The lowest acceleration along the path, mm/s^2.
    pub(crate) acceleration: f64,
    /// Where bends hold the feed clearly below F and below what the speeds of the axes allow: that speed, mm/s, and the joint.
    pub(crate) bend: Option<(f64, u8)>,
    /// Where the time for a block sets a lower one, mm/s.
    pub(crate) block_time: Option<f64>,
    /// The lowest of the highest planned speeds, mm/s.
    pub(crate) cap: f64,
    /// Rotary axes turn; it is an arc.
    pub(crate) turning: bool,
    pub(crate) bent: bool,
    /// Its pieces.
    pub(crate) count: usize,
    /// What corners take of its acceleration: a share, and half of the rest.
    pub(crate) loss: f64,
    pub(crate) halved: bool,
}

impl Course {
    /// As a side of the corner at its start (0) or its end (1).
    pub(crate) fn side(&self, end: usize) -> Side<'_> {
        Side {
            tangent: &self.tangents[end],
            length: self.length,
            cap: self.cap,
            acceleration: self.acceleration,
            turning: self.turning,
            bent: self.bent,
            rapid: self.feed.is_infinite(),
        }
    }

    /// Takes what a corner takes of the acceleration of its pieces.
    pub(crate) fn lose(&mut self, passage: &Passage, pieces: &mut [Piece]) {
        let share = |course: &Self| (1.0 - course.loss) * if course.halved { 0.5 } else { 1.0 };
        let before = share(self);
        self.loss = self.loss.max(passage.loss);
        self.halved |= passage.halved;
        let factor = share(self) / before;
        if factor < 1.0 {
            for piece in pieces {
                piece.planned.acceleration *= factor;
            }
        }
    }
}

/// What a leg becomes.
pub(crate) enum Taken {
    /// Its pieces were added.
    Course(Box<Course>),
    /// Nothing moves.
    Still,
    /// Not known.
    Unknown,
}

/// The share of the acceleration that bends take: the rest is left along the path. On a circle both are at right angles.
pub(crate) const BEND: f64 = 0.5;
const ROUND: f64 = 0.866_025_403_784_438_6;

/// Adds the pieces of a leg.
pub(crate) fn take(machine: &Machine, leg: &Leg, motion: u32, pieces: &mut Vec<Piece>) -> Taken {
    take_at(machine, leg, &feed, motion, pieces)
}

/// The highest feed of the tip at which no axis needs more than its acceleration in the bends of a leg, mm/min, and the axis; `None` where bends do
/// not limit it below the speeds of the axes, or the leg is not known.
pub fn bend_limit(machine: &Machine, leg: &Leg) -> Option<(f64, usize)> {
    // faster than any axis, but a number
    const FREE: f64 = 1e12;
    if leg.length <= 0.0 {
        return None;
    }
    let mut pieces = Vec::new();
    let Taken::Course(_) = take_at(machine, leg, &|_, _| Some(FREE), 0, &mut pieces) else {
        return None;
    };
    let bends = pieces.iter().filter_map(|piece| match piece.optimistic.by {
        Limit::Bend(joint) => Some((piece.optimistic.cap * 60.0, usize::from(joint))),
        _ => None,
    });
    bends.min_by(|a, b| a.0.total_cmp(&b.0))
}

/// The same at any feed: `feed` gives it in mm/s.
fn take_at(
    machine: &Machine,
    leg: &Leg,
    feed: &dyn Fn(&Leg, f64) -> Option<f64>,
    motion: u32,
    pieces: &mut Vec<Piece>,
) -> Taken {
    let (Some(start), Ok(end)) = (&leg.start, &leg.end) else {
        return Taken::Unknown;
    };
    let turned = deg(hypot(leg.rotary_change[0], leg.rotary_change[1]));
    let turns_only = leg.length <= 0.0;
    let length = if turns_only { turned } else { leg.length };
    let mut change = end.joints;
    for (change, from) in change.iter_mut().zip(&start.joints) {
        *change -= from;
    }
    if !matches!(leg.motion.kind, MotionKind::Arc(_)) && change.iter().all(|way| way.abs() < 1e-12) {
        return Taken::Still;
    }
    if !(length > 0.0 && length.is_finite()) {
        return Taken::Unknown;
    }
    let Some(feed) = feed(leg, length) else {
        return Taken::Unknown;
    };
    let first = pieces.len();
    let straight = !leads_tip(&leg.motion) || leg.rotary_change == [0.0; 2];
    let mut course = Course {
        tangents: [change.map(|way| way / length); 2],
        length,
        turns_only,
        feed,
        complete: true,
        acceleration: f64::INFINITY,
        bend: None,
        block_time: None,
        cap: f64::INFINITY,
        turning: leg.rotary_change != [0.0; 2],
        bent: matches!(leg.motion.kind, MotionKind::Arc(_)),
        count: 0,
        loss: 0.0,
        halved: false,
    };
    let done = match &leg.motion.kind {
        MotionKind::Arc(Some(arc)) if leg.rotary_change == [0.0; 2] => {
            round(machine, leg, arc, motion, &mut course, pieces)
        }
        MotionKind::Rapid | MotionKind::Linear if straight => {
            let rates = course.tangents[0];
            push(machine, &mut course, motion, (length, &rates, &[0.0; _], BEND), pieces)
        }
        MotionKind::Rapid | MotionKind::Linear | MotionKind::Arc(Some(_)) => {
            sampled(machine, leg, motion, &mut course, pieces)
        }
        _ => None,
    };
    if done.is_none() {
        pieces.truncate(first);
        return Taken::Unknown;
    }
    if let (Some(seconds), true) = (
        machine.control.block_time.filter(|seconds| *seconds > 0.0),
        feed.is_finite(),
    ) {
        let most = length / seconds;
        course.block_time = (most < feed * (1.0 - 1e-9)).then_some(most);
        for piece in &mut pieces[first..] {
            if most < piece.planned.cap {
                (piece.planned.cap, piece.planned.by) = (most, Limit::BlockTime);
            }
        }
    }
    if machine.control.corner_model.as_deref() == Some("linuxcnc-g64") {
        // no block is shorter than a cycle
        let most = length / crate::linuxcnc::cycle(machine);
        for piece in &mut pieces[first..] {
            if most < piece.planned.cap {
                (piece.planned.cap, piece.planned.by) = (most, Limit::BlockTime);
            }
        }
    }
    course.count = pieces.len() - first;
    let caps = pieces[first..].iter().map(|piece| piece.planned.cap);
    course.cap = caps.fold(f64::INFINITY, f64::min);
    Taken::Course(Box::new(course))
}

/// F in mm/s along a path of this length; infinite in rapid.
fn feed(leg: &Leg, length: f64) -> Option<f64> {
    let per_minute = match leg.motion.feed {
        Feed::Rapid => return Some(f64::INFINITY),
        Feed::PerMinute(feed) => feed,
        Feed::PerRevolution(feed) => feed * leg.motion.mean_rpm()?,
        Feed::InverseTime(per_minute) => per_minute * length,
        Feed::Unknown => return None,
    };
    let feed = per_minute / 60.0;
    (feed > 0.0 && feed.is_finite()).then_some(feed)
}

/// Adds a piece: its length, the highest rates of the joints per mm, their highest second derivatives per mm^2, and the share that bends take.
/// `None` where a rapid has no limit, or something is not a number.
#[expect(clippy::too_many_lines, reason = "one limit after the other")]
pub(crate) fn push(
    machine: &Machine,
    course: &mut Course,
    motion: u32,
    (length, rates, bends, share): (f64, &Joints, &Joints, f64),
    pieces: &mut Vec<Piece>,
) -> Option<()> {
    let (mut cap, mut by) = (course.feed, Limit::Feed);
    let (mut free_cap, mut free_by, mut limited) = (cap, by, cap.is_finite());
    let (mut acceleration, mut jerk, mut jerk_time, mut slowest) = (f64::INFINITY, f64::INFINITY, 0.0_f64, 0);
    let (mut speed_cap, mut bend_cap, mut bend_jerk) = (course.feed, (f64::INFINITY, 0), f64::INFINITY);
    let mut fastest = f64::INFINITY;
    for (joint, axis) in machine.axes.iter().enumerate() {
        let (rate, bend, number) = (rates[joint], bends[joint], joint as u8);
        if !(rate.is_finite() && bend.is_finite()) {
            return None;
        }
        let rate = rate.abs();
        if rate <= 1e-12 && bend <= 1e-12 {
            continue;
        }
        match axis.max_speed {
            Some(speed) if rate > 0.0 => {
                limited = true;
                speed_cap = speed_cap.min(speed / rate);
                fastest = fastest.min(speed / rate);
                if speed / rate < cap {
                    (cap, by) = (speed / rate, Limit::Speed(number));
                }
                if speed / rate < free_cap {
                    (free_cap, free_by) = (speed / rate, Limit::Speed(number));
                }
            }
            None if course.feed.is_infinite() => return None,
            Some(_) | None => {}
        }
        let Some(most) = axis.max_acceleration else {
            course.complete = false;
            continue;
        };
        if bend > 0.0 {
            let (shared, whole) = ((share * most / bend).sqrt(), (most / bend).sqrt());
            fastest = fastest.min(shared);
            if shared < cap {
                (cap, by) = (shared, Limit::Bend(number));
            }
            if whole < free_cap {
                (free_cap, free_by) = (whole, Limit::Bend(number));
            }
            if whole < bend_cap.0 {
                bend_cap = (whole, number);
            }
        }
        if rate > 0.0 && most / rate < acceleration {
            (acceleration, slowest) = (most / rate, number);
        }
        if let Some(most_jerk) = axis.extra.max_jerk {
            jerk_time = jerk_time.max(most / most_jerk);
            if rate > 0.0 {
                jerk = jerk.min(most_jerk / rate);
            }
            if bend > 0.0 {
                bend_jerk = bend_jerk.min(share * most_jerk / bend);
            }
        }
    }
    if !limited || cap <= 0.0 || cap.is_nan() {
        return None;
    }
    // what axes cannot run anyway is not held back by a bend
    if bend_cap.0 < 0.7 * speed_cap && course.bend.is_none_or(|(least, _)| bend_cap.0 < least) {
        course.bend = Some(bend_cap);
    }
    // what bends leave along the path: of each axis at the speed that F and its own acceleration allow, so that a higher limit of another one takes
    // nothing. LinuxCNC divides the acceleration for the fastest that its axes allow, without F
    let mut along = acceleration;
    for (joint, axis) in machine.axes.iter().enumerate() {
        if let (Some(most), true) = (axis.max_acceleration, bends[joint] > 0.0) {
            let own = if machine.control.corner_model.as_deref() == Some("linuxcnc-g64") {
                fastest
            } else {
                course.feed.min((share * most / bends[joint]).sqrt())
            };
            let used = bends[joint] * own * own;
            let left = if share == ROUND {
                (most * most - used * used).max(0.0).sqrt()
            } else {
                most - used
            };
            if rates[joint].abs() > 1e-12 {
                along = along.min(left.max(0.25 * most) / rates[joint].abs());
            }
        }
    }
    course.acceleration = course.acceleration.min(along);
    pieces.push(Piece {
        length,
        optimistic: Bounds {
            cap: free_cap,
            by: free_by,
            acceleration,
        },
        planned: Bounds {
            cap,
            by,
            acceleration: along,
        },
        jerk,
        bend_jerk,
        bends: bends.iter().any(|bend| *bend > 1e-12),
        slowest,
        jerk_time,
        entry: [f64::INFINITY; 2],
        feed: course.feed,
        motion,
    });
    Some(())
}

/// The largest shares that an axis has in the direction of the motion and in the one to the centre, anywhere on an arc, 0..=1. Both are a cosine
/// of the angle that the arc has turned; that of a spiral, and all with `whole`, are taken over a whole turn.
fn shares(arc: &Arc, letter: usize, whole: bool) -> [f64; 2] {
    let arm = (arc.start - arc.centre) / arc.radius_start.max(1e-9);
    let side = arc.normal.cross(&arm) * arc.sweep.signum();
    let (x, y, way) = (arm[letter], side[letter], arc.sweep.abs());
    let whole = whole || (arc.radius_start - arc.radius_end).abs() > 1e-6 * arc.radius_start;
    // x cos + y sin to the centre, and its derivative
    [[y, -x], [x, y]].map(|[cosine, sine]| {
        let first_peak = atan2(sine, cosine).rem_euclid(PI);
        if whole || first_peak <= way {
            return hypot(cosine, sine);
        }
        let end = cosine * cos(way) + sine * sin(way);
        cosine.abs().max(end.abs())
    })
}

/// An arc without rotary motion: one piece. Along the tangent and at right angles to it the joints need a together, sqrt(at^2 + an^2) per axis.
fn round(
    machine: &Machine,
    leg: &Leg,
    arc: &Arc,
    motion: u32,
    course: &mut Course,
    pieces: &mut Vec<Piece>,
) -> Option<()> {
    let path = BlockPath::new(machine, leg)?;
    course.tangents = [0.0, 1.0].map(|t| path.rates(t).map(|rate| rate / course.length));
    let (mut rates, mut bends) = ([0.0; _], [0.0; _]);
    // the longest way round and the sharpest bend per mm, of helix and spiral too
    let radius = arc.radius_start.min(arc.radius_end);
    let flat = arc.sweep.abs() * arc.radius_start.max(arc.radius_end) / course.length;
    let bend = arc.sweep * arc.sweep * radius.max(1e-9) / (course.length * course.length);
    let turned = leads_tip(&leg.motion);
    let rise = (arc.height() / course.length).abs();
    // LinuxCNC holds an arc to what its axes allow on a whole circle
    let whole = machine.control.corner_model.as_deref() == Some("linuxcnc-g64");
    for (letter, joint) in machine.joint_of_letter.iter().enumerate().take(3) {
        let Some(joint) = joint.map(usize::from) else { continue };
        // with the table turned, any axis may take any part
        let ([along, inward], up) = if turned {
            ([1.0; 2], 1.0)
        } else {
            (shares(arc, letter, whole), arc.normal[letter].abs())
        };
        rates[joint] = if turned {
            hypot(flat.min(1.0), rise)
        } else {
            flat.min(1.0) * along + rise * up
        };
        bends[joint] = if inward > 1e-9 { bend * inward } else { 0.0 };
    }
    push(machine, course, motion, (course.length, &rates, &bends, ROUND), pieces)
}
