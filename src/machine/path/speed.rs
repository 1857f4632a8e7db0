//! How fast a block can run, and how long it takes.
use crate::follow::follower::leads_path;
use crate::path::curvature::rough_bends;
use crate::path::joint_path::{JointPath, on_great_circle};
use crate::path::length::rotary_part;
use crate::path::peak::{Piece, peak};
use crate::path::rotary_path::RotaryPath;
use crate::{AxisKind, Leg, Machine, Stance};
use trunnion_geometry::math::hypot;
use trunnion_geometry::{Vec3, deg};
use trunnion_interp::{Feed, MotionKind};

/// The highest feed of a block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FeedLimit {
    /// Highest tip feed at which no axis exceeds its speed at any moment of the block, mm/min; infinite if nothing moves.
    pub feed_mm_min: f64,
    /// Index of the limiting axis.
    pub axis: usize,
    /// Speed that axis has at the programmed feed at its worst moment, mm/s or rad/s; `None` without a known feed.
    pub axis_speed: Option<f64>,
    /// Its limit.
    pub axis_limit: f64,
}

/// Relative width to which the worst moment of a linear axis is closed in.
const TIGHT: f64 = 1e-3;

/// The worst moment inside the block. `None`: stance or path unknown, no length, or no axis that moves has a declared speed.
///
/// Never above the true limit. Where the programmed feed is above it, it is within 1e-3 of the true limit; where the program stays
/// below, a coarser bound with any of the linear axes may be given, which only proves that no axis is overrun; so it may on chains whose linear axes lie in different places, near postures where they hardly
/// span space. Without TCP the joints run linearly and the feed is that of the programmed X Y Z path; with
/// TCP (or vectors) the rotary joints run linearly and the linear joints' rates change within the block: samples of their exact rates
/// and a bound of their second derivative (docs/kinematics.md#axis-speed-and-feed).
pub fn feed_limit(machine: &Machine, leg: &Leg) -> Option<FeedLimit> {
    limit(machine, leg, programmed_feed(leg).unwrap_or(f64::INFINITY))
}

/// [`feed_limit`], always within 1e-3: the number to print.
pub fn feed_limit_tight(machine: &Machine, leg: &Leg) -> Option<FeedLimit> {
    limit(machine, leg, f64::INFINITY)
}

/// An axis and how much of its speed limit one block per second takes.
#[derive(Clone, Copy)]
struct Load {
    axis: usize,
    limit: f64,
    rate: f64,
}

impl Load {
    fn share(&self) -> f64 {
        self.rate / self.limit
    }
}

/// `enough_mm_min`: a feed above which a coarse answer is enough.
fn limit(machine: &Machine, leg: &Leg, enough_mm_min: f64) -> Option<FeedLimit> {
    if leg.length <= 0.0 {
        return None;
    }
    let (worst, slowest) = worst_load(machine, leg, |slowest| slowest * 60.0 / enough_mm_min)?;
    let feed = programmed_feed(leg);
    Some(FeedLimit {
        feed_mm_min: 60.0 * slowest / worst.share(),
        axis: worst.axis,
        axis_speed: feed.map(|feed| worst.rate * feed / (60.0 * slowest)),
        axis_limit: worst.limit,
    })
}

/// The shortest time of a block, and the axis that needs it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShortestTime {
    /// Time in which no axis exceeds its speed at any moment of the block, s.
    pub seconds: f64,
    /// Index of the limiting axis.
    pub axis: usize,
    /// Speed that this axis has at its worst moment where the block takes one second, mm/s or rad/s.
    pub rate: f64,
    /// Its limit.
    pub axis_limit: f64,
}

/// The shortest time of a block, which needs no path of the tip: F under inverse time (G93) says how long the block takes. Never below
/// the true time; where it is above `enough_s` it is within 1e-3 of it. `None`: as [`feed_limit`], but a tip that stands still is judged.
pub fn shortest_time(machine: &Machine, leg: &Leg, enough_s: f64) -> Option<ShortestTime> {
    let (worst, _) = worst_load(machine, leg, |_| enough_s)?;
    Some(ShortestTime {
        seconds: worst.share(),
        axis: worst.axis,
        rate: worst.rate,
        axis_limit: worst.limit,
    })
}

/// The worst load, and the length along which its feed counts, mm; `enough_s`: the time below which a coarse answer is enough, for that length.
fn worst_load(machine: &Machine, leg: &Leg, enough_s: impl Fn(f64) -> f64) -> Option<(Load, f64)> {
    let (start, end) = (leg.start.as_ref()?, leg.end.as_ref().ok()?);
    let changes = Changes::of(machine, leg)?;
    let mut worst = constant_load(machine, (start, end), changes);
    let mut slowest = leg.length;
    if changes != Changes::Nothing {
        let above = worst.map_or(0.0, |load| load.share());
        let rough = rough_bends(machine, leg).map(|(rate, _)| fastest_share(machine, rate));
        match rough {
            // the linear axes cannot be the worst
            Some(Some(load)) if load.share() <= above => {}
            Some(Some(load)) if load.share() <= enough_s(leg.length) => worst = Some(load),
            Some(None) => {}
            _ => {
                let course = JointPath::new(machine, leg)?;
                if matches!(course.spin, RotaryPath::Even) {
                    // also where the tool axis does not move on its great circle
                    worst = constant_load(machine, (start, end), Changes::Solved);
                }
                let above = worst.map_or(0.0, |load| load.share());
                // rates are per block; the track's slowest moment carries the feed (a spiral's speed differs a little along it)
                let (_, slowest_tip, _) = course.track.bounds();
                if slowest_tip > 0.0 {
                    slowest = hypot(slowest_tip, rotary_part(machine, leg));
                }
                if let Some(load) = changing_load(&course, above, enough_s(slowest))? {
                    worst = Some(load);
                }
            }
        }
    }
    Some((worst?, slowest))
}

/// The load of the solved linear axis with the lowest speed limit at the given rate; `None` where no such limit is declared.
fn fastest_share(machine: &Machine, rate: f64) -> Option<Load> {
    let joints = machine
        .constants
        .solved
        .map(|index| machine.constants.linear[index].joint);
    let loads = joints.iter().filter_map(|&axis| {
        Some(Load {
            axis,
            limit: machine.axes[axis].max_speed?,
            rate,
        })
    });
    loads.min_by(|a, b| a.limit.total_cmp(&b.limit))
}

/// Which joints' rates change within a block.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Changes {
    /// Joints run straight.
    Nothing,
    /// The linear joints that inverse kinematics solves for.
    Solved,
    /// These and the rotary ones: great circle.
    All,
}

impl Changes {
    /// `None` where the path is unknown.
    fn of(machine: &Machine, leg: &Leg) -> Option<Self> {
        match leg.motion.kind {
            MotionKind::Dwell(_) | MotionKind::Unknown | MotionKind::Arc(None) => return None,
            // along a line without rotary motion the linear joints move linearly as well, also under TCP
            MotionKind::Rapid | MotionKind::Linear if !leads_path(&leg.motion) || leg.rotary_change == [0.0; 2] => {
                return Some(Self::Nothing);
            }
            MotionKind::Rapid | MotionKind::Linear | MotionKind::Arc(Some(_)) => {}
        }
        Some(if on_great_circle(machine, &leg.motion) {
            Self::All
        } else {
            Self::Solved
        })
    }
}

/// The worst of the axes that run at a constant rate.
fn constant_load(machine: &Machine, (start, end): (&Stance, &Stance), changes: Changes) -> Option<Load> {
    let constants = &machine.constants;
    let is_solved = |joint: usize| {
        constants
            .solved
            .iter()
            .any(|&index| constants.linear[index].joint == joint)
    };
    let is_constant = |joint: usize, kind: AxisKind| match (changes, kind) {
        (Changes::Nothing, _) | (Changes::Solved, AxisKind::Rotary) => true,
        (Changes::All, AxisKind::Rotary) => false,
        (_, AxisKind::Linear) => !is_solved(joint),
    };
    let way = |joint: usize| (end.joints[joint] - start.joints[joint]).abs();
    let (mut worst, mut most): (Option<(usize, f64)>, f64) = (None, 0.0);
    for (joint, axis) in machine.axes.iter().enumerate() {
        let rate = way(joint);
        if rate > 0.0
            && let Some(limit) = axis.max_speed
            && (changes == Changes::Nothing || is_constant(joint, axis.kind))
        {
            let share = rate / limit;
            if worst.is_none() || share > most {
                (worst, most) = (Some((joint, limit)), share);
            }
        }
    }
    worst.map(|(axis, limit)| Load {
        axis,
        limit,
        rate: way(axis),
    })
}

/// The joints whose rates change within the block: the three solved linear ones and, on a great circle, the two rotary ones.
struct Changing<'c, 'm> {
    course: &'c JointPath<'m>,
    joints: [usize; 5],
    /// Share of the limit per rate; zero where no speed is declared.
    per_rate: [f64; 5],
    count: usize,
}

impl<'c, 'm> Changing<'c, 'm> {
    fn new(course: &'c JointPath<'m>) -> Self {
        let constants = &course.machine.constants;
        let [a, b, c] = constants.solved.map(|index| constants.linear[index].joint);
        let joints = [a, b, c, constants.rotary[0].joint, constants.rotary[1].joint];
        let per_rate = joints.map(|joint| course.machine.axes[joint].max_speed.map_or(0.0, |speed| 1.0 / speed));
        let count = if matches!(course.spin, RotaryPath::Even) { 3 } else { 5 };
        Self {
            course,
            joints,
            per_rate,
            count,
        }
    }

    /// Largest share and its slot.
    fn worst(&self, rates: &[f64; 5]) -> (f64, usize) {
        let mut worst = (0.0, 0);
        for (slot, (rate, per_rate)) in rates.iter().zip(&self.per_rate).enumerate().take(self.count) {
            let share = rate.abs() * per_rate;
            // NaN is taken as infinite
            let share = if share.is_nan() { f64::INFINITY } else { share };
            if share > worst.0 {
                worst = (share, slot);
            }
        }
        worst
    }

    /// Worst share at a moment.
    fn at(&self, t: f64) -> (f64, usize) {
        let [x, y, z] = self.course.solved_rates(t).into();
        let [first, second] = if self.count > 3 {
            self.course.rates(t, &self.course.turns(t))
        } else {
            [0.0; 2]
        };
        self.worst(&[x, y, z, first, second])
    }

    /// Bounds on a piece: of the worst share, of its slot, and of the slope of the worst share.
    fn bounds(&self, from: f64, to: f64) -> (f64, usize, f64) {
        let (rates, bends) = self.course.bends(from, to);
        let spin = self.course.spin_bounds(from, to);
        let all = |linear: &Vec3, rotary: &[f64; 2]| [linear.x, linear.y, linear.z, rotary[0], rotary[1]];
        let (share, slot) = self.worst(&all(&rates, &spin.rate));
        (share, slot, self.worst(&all(&bends, &spin.bend)).0)
    }

    fn load(&self, slot: usize, share: f64) -> Option<Load> {
        let axis = self.joints[slot];
        let limit = self.course.machine.axes[axis].max_speed?;
        Some(Load {
            axis,
            limit,
            rate: share * limit,
        })
    }
}

/// The worst of the axes whose rates change, if it takes more than the share `above` of its limit. A bound below `coarse` need not be
/// closed in further. The outer `None`: no bound could be proven.
#[expect(clippy::option_option, reason = "not proven and not limiting are different answers")]
fn changing_load(course: &JointPath<'_>, above: f64, coarse: f64) -> Option<Option<Load>> {
    let axes = Changing::new(course);
    let (share, slot, slope) = axes.bounds(0.0, 1.0);
    if share <= above {
        return Some(None);
    }
    if slope == 0.0 {
        // constant rates need no bound
        let (share, slot) = axes.at(0.5);
        return Some(if share <= above { None } else { axes.load(slot, share) });
    }
    if share <= coarse {
        return Some(axes.load(slot, share));
    }
    let at_once = course.bends_at_once();
    let found = peak(
        |t| axes.at(t).0,
        |piece: &Piece| {
            piece.below_roof(if at_once {
                slope
            } else {
                axes.bounds(piece.from, piece.to).2
            })
        },
        |bound, sampled, _| bound <= above || bound <= coarse || bound <= sampled * (1.0 + TIGHT),
    );
    let bound = found.bound.min(share);
    if !bound.is_finite() {
        return None;
    }
    if bound <= above {
        return Some(None);
    }
    Some(axes.load(axes.at(found.at).1, bound))
}

/// Programmed feed along the path, mm/min, at its highest where the spindle speed changes; `None` for rapids and where it is unknown.
fn programmed_feed(leg: &Leg) -> Option<f64> {
    match leg.motion.feed {
        Feed::PerMinute(feed) => Some(feed),
        Feed::PerRevolution(feed) => Some(feed * leg.motion.most_rpm()?),
        Feed::InverseTime(per_minute) => Some(per_minute * leg.length),
        Feed::Unknown | Feed::Rapid => None,
    }
}

/// How long the block takes at the programmed feed, without acceleration, s. `None`: unknown.
///
/// Rapid: the slowest axis. Feed: length over F, or the angle (root of the sum of squares of the rotary increments, degrees) over F
/// where no linear axis moves (RS274/NGC); in both cases not less than the slowest axis needs for its travel.
pub fn block_duration_s(machine: &Machine, leg: &Leg) -> Option<f64> {
    match leg.motion.kind {
        MotionKind::Dwell(seconds) => return seconds,
        MotionKind::Unknown | MotionKind::Arc(None) => return None,
        MotionKind::Rapid | MotionKind::Linear | MotionKind::Arc(Some(_)) => {}
    }
    let axes = axes_time(machine, leg);
    let programmed = match leg.motion.feed {
        Feed::Rapid => return axes.filter(|time| time.complete).map(|time| time.seconds),
        Feed::InverseTime(per_minute) if per_minute > 0.0 => 60.0 / per_minute,
        Feed::InverseTime(_) | Feed::Unknown => return None,
        Feed::PerMinute(_) | Feed::PerRevolution(_) => {
            let mean = |per_turn| Some(per_turn * leg.motion.mean_rpm()?);
            let feed = match leg.motion.feed {
                Feed::PerRevolution(per_turn) => mean(per_turn),
                _ => programmed_feed(leg),
            };
            let feed = feed.filter(|feed| *feed > 0.0)?;
            let way = if leg.length > 0.0 { leg.length } else { rotary_way(leg)? };
            way / feed * 60.0
        }
    };
    Some(axes.map_or(programmed, |time| programmed.max(time.seconds)))
}

/// Length of a block in which only rotary axes move, in degrees; `None` where the stances are not known.
fn rotary_way(leg: &Leg) -> Option<f64> {
    leg.start.as_ref()?;
    leg.end.as_ref().ok()?;
    let [a, b] = leg.rotary_change.map(deg);
    Some((a * a + b * b).sqrt())
}

/// Time the axes need.
struct AxesTime {
    seconds: f64,
    /// Every axis that moves has a declared speed.
    complete: bool,
}

/// Time of the slowest axis over its whole travel; `None` where the stances are not known.
fn axes_time(machine: &Machine, leg: &Leg) -> Option<AxesTime> {
    let (start, end) = (leg.start.as_ref()?, leg.end.as_ref().ok()?);
    let mut time = AxesTime {
        seconds: 0.0,
        complete: true,
    };
    for (joint, axis) in machine.axes.iter().enumerate() {
        let way = (end.joints[joint] - start.joints[joint]).abs();
        match axis.max_speed {
            _ if way == 0.0 => {}
            Some(speed) => time.seconds = time.seconds.max(way / speed),
            None => time.complete = false,
        }
    }
    Some(time)
}
