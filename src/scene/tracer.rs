//! Records legs, or motions where there is no machine.
use crate::scene::{Kind, Scene, Vertex};
use trunnion_geometry::Vec3;
use trunnion_interp::{Feed, Motion, MotionKind, Orientation};
use trunnion_machine::{BlockPath, Joints, Leg, MAX_AXES, Machine, block_duration_s, feed_limit, tip_deviation};

/// Most vertices of a block.
const MOST: f64 = 120.0;
/// Vertices of a whole scene. Blocks after them are recorded by their ends.
const MOST_VERTICES: usize = 3_000_000;
/// How far the tip may lie off the line between two vertices, mm.
const NEAR: f64 = 0.02;
/// How far the tool axis or an arc may turn between two vertices, rad.
const TURN: f64 = 0.1;
/// A deviation up to this needs no tighter bound in a picture, mm.
const SMALL: f64 = 1e-3;

/// Builds a scene.
#[derive(Default)]
pub struct Tracer {
    scene: Scene,
    time: f64,
    /// Where the last strand ends; `None`: the next motion starts a strand.
    last: Option<Vec3>,
}

/// What all vertices of a block have in common.
struct Common {
    line: u32,
    kind: Kind,
    duration: f64,
    deviation: f64,
    feed_limit: f64,
    feed: f64,
    posture: Option<i8>,
}

impl Tracer {
    /// Nothing recorded.
    pub fn new() -> Self {
        Self::default()
    }

    /// Records a leg of the machine that ends at a line (from 1).
    pub fn leg(&mut self, machine: &Machine, leg: &Leg, line: u32) {
        let motion = &leg.motion;
        if let MotionKind::Dwell(seconds) = motion.kind {
            self.time += block_duration_s(machine, leg).or(seconds).unwrap_or(f64::NAN);
            return;
        }
        let Some(path) = BlockPath::new(machine, leg) else {
            // the first motion has no known start: nothing of it is missing
            self.lose(leg.start.is_some() || leg.end.is_err());
            return;
        };
        let duration = block_duration_s(machine, leg).unwrap_or(f64::NAN);
        let turn = leg.rotary_change[0].max(leg.rotary_change[1]);
        let pieces = (path.tip_bend() / (8.0 * NEAR)).sqrt().max(turn / TURN);
        let posture = leg.end.as_ref().ok().filter(|_| machine.constants.has_pair());
        let common = Common {
            line,
            kind: kind(motion),
            duration,
            deviation: tip_deviation(machine, leg, SMALL).map_or(f64::NAN, |found| found.bound_mm),
            feed_limit: feed_limit(machine, leg).map_or(f64::NAN, |limit| limit.feed_mm_min),
            feed: programmed(motion, leg.length),
            posture: posture.map(|stance| stance.branch),
        };
        self.strand(&common, pieces, |t| {
            let moment = path.at(t);
            (moment.tip, moment.axis, moment.joints)
        });
    }

    /// Records a motion as it is programmed, where no machine is named.
    pub fn motion(&mut self, motion: &Motion, line: u32) {
        if let MotionKind::Dwell(seconds) = motion.kind {
            self.time += seconds.unwrap_or(f64::NAN);
            return;
        }
        let (Some(start), Some(end), false) = (motion.start.xyz(), motion.end.xyz(), motion.machine_coordinates) else {
            self.lose(motion.start.known != 0 || motion.kind == MotionKind::Unknown);
            return;
        };
        let (from, to) = match motion.orientation {
            Orientation::Words => (Vec3::z(), Vec3::z()),
            Orientation::Vector(from, to) => (from.unwrap_or(to), to),
        };
        let (arc, pieces, length) = match motion.kind {
            MotionKind::Arc(Some(arc)) => {
                let bend = arc.sweep * arc.sweep * arc.radius_start.max(arc.radius_end);
                (
                    Some(arc),
                    (bend / (8.0 * NEAR)).sqrt().max(arc.sweep.abs() / TURN),
                    arc.length(),
                )
            }
            MotionKind::Arc(None) | MotionKind::Unknown => {
                self.lose(true);
                return;
            }
            MotionKind::Rapid | MotionKind::Linear | MotionKind::Dwell(_) => {
                (None, (to - from).norm() / TURN, (end - start).norm())
            }
        };
        let feed = programmed(motion, length);
        let common = Common {
            line,
            kind: kind(motion),
            duration: if length > 0.0 { length / feed * 60.0 } else { 0.0 },
            deviation: f64::NAN,
            feed_limit: f64::NAN,
            feed,
            posture: None,
        };
        self.strand(&common, pieces, |t| {
            let tip = arc.map_or_else(|| start + (end - start) * t, |arc| arc.point_at(t));
            let axis = (from + (to - from) * t).try_normalize(1e-9).unwrap_or(to);
            (tip, axis, [f64::NAN; MAX_AXES])
        });
    }

    /// The scene.
    pub fn finish(self) -> Scene {
        self.scene
    }

    fn lose(&mut self, counts: bool) {
        self.scene.unknown += usize::from(counts);
        self.last = None;
    }

    fn strand(&mut self, common: &Common, pieces: f64, at: impl Fn(f64) -> (Vec3, Vec3, Joints)) {
        let pieces = if self.scene.vertices.len() < MOST_VERTICES {
            pieces.ceil().clamp(1.0, MOST) as u32
        } else {
            self.scene.coarse_from.get_or_insert(common.line);
            1
        };
        let begun = self.scene.vertices.len();
        for i in 0..=pieces {
            let t = f64::from(i) / f64::from(pieces);
            let (tip, axis, joints) = at(t);
            if !tip.iter().chain(axis.iter()).all(|value| value.is_finite()) {
                self.scene.vertices.truncate(begun);
                self.lose(true);
                return;
            }
            if i == 0 {
                // a motion that starts where the one before ended goes on with its strand
                if self.last.is_some_and(|last| (last - tip).norm() < 1e-6) {
                    continue;
                }
            }
            self.scene.vertices.push(Vertex {
                tip,
                axis,
                time: self.time + common.duration * t,
                deviation: common.deviation,
                feed_limit: common.feed_limit,
                feed: common.feed,
                posture: common.posture,
                line: common.line,
                kind: if i == 0 { Kind::Start } else { common.kind },
                ends_block: i == pieces,
                joints,
            });
            self.last = Some(tip);
        }
        self.time += common.duration;
    }
}

fn kind(motion: &Motion) -> Kind {
    if motion.is_feed() { Kind::Feed } else { Kind::Rapid }
}

/// Programmed feed of a motion of this length (mm), mm/min; not a number where it is not known.
fn programmed(motion: &Motion, length: f64) -> f64 {
    match motion.feed {
        Feed::PerMinute(feed) if motion.is_feed() => feed,
        Feed::PerRevolution(feed) if motion.is_feed() => motion.mean_rpm().map_or(f64::NAN, |rpm| feed * rpm),
        Feed::InverseTime(per_minute) if motion.is_feed() => per_minute * length,
        _ => f64::NAN,
    }
}
