//! How the machine runs the program: its time, and the places where it slows down, crawls, swings or cuts a corner.
use crate::pass::ask;
use crate::sink::{Active, Reporter};
use crate::view::LegView;
use crate::wake::Wake;
use std::collections::VecDeque;
use trunnion_dialect::Dialect;
use trunnion_geometry::Vec3;
use trunnion_interp::{ChainId, Feed};
use trunnion_machine::{BlockPath, Machine, leads_tip};
use trunnion_planner::{PathControl, Planner, Timed};
use trunnion_servo::{Corner, Profile, closed_form};
use trunnion_syntax::BlockId;

/// What a place is about; each is one rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PaceKind {
    /// A bend takes more acceleration at F than an axis has: `value` the feed that it allows, `joint` the axis.
    Bend,
    /// The feed swings: `value` the lowest feed.
    Swing,
    /// The tool crawls in the cut: `value` seconds.
    Crawl,
    /// Blocks shorter than the control's time for one: `value` the feed that it allows.
    Short,
    /// The servo loops cut a corner: `value` mm.
    Corner,
    /// F is not the speed of the tip: `value` the speed of the tip.
    Mode,
}

/// A place: one block or several one after the other.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub(crate) kind: PaceKind,
    pub(crate) block: BlockId,
    pub(crate) chain: ChainId,
    pub(crate) last: BlockId,
    pub(crate) count: u32,
    /// The worst value, see [`PaceKind`].
    pub(crate) value: f64,
    /// F there, mm/min (deg/min where `turns_only`); at a corner the speed.
    pub(crate) feed: f64,
    pub(crate) turns_only: bool,
    /// Joint of the axis, where there is one.
    pub(crate) joint: u8,
    last_motion: u32,
}

impl Place {
    /// Unit of F, and the keys of F and of another feed.
    pub(crate) fn unit(&self) -> (&'static str, [&'static str; 2]) {
        if self.turns_only {
            ("deg/min", ["feed_deg_min", "value_deg_min"])
        } else {
            ("mm/min", ["feed_mm_min", "value_mm_min"])
        }
    }
}

/// The most places of a kind that are kept apart; later ones count as part of the last.
const MOST: usize = 1000;
/// Share of F below which a bend or a swing matters.
const MATTERS: f64 = 0.7;
/// Two dips within this path are a swing, mm.
const WINDOW: f64 = 2.0;
/// The tool crawls when it is below 5 % of F for this long, s.
const CRAWLS: f64 = 0.05;
/// A corner may be cut by this much where the machine file does not say otherwise, mm.
pub(crate) const CORNER: f64 = 0.02;

/// The planner inside a check.
pub(crate) struct Pace<'m> {
    machine: &'m Machine,
    planner: Planner<'m>,
    seen: Seen<'m>,
    /// Linear axes whose servo loops are declared alike: joints, gain, feed forward.
    loops: Option<([usize; 3], f64, f64)>,
    motions: u32,
    tool: Option<u32>,
    before: Option<Tangent>,
}

/// Direction of the linear axes at the end of a motion.
#[derive(Clone, Copy)]
struct Tangent {
    motion: u32,
    direction: Vec3,
    feed: f64,
}

/// A corner whose speed is not planned yet.
#[derive(Clone, Copy)]
struct Pending {
    /// The motion after it.
    motion: u32,
    corner: Corner,
    feeds: [f64; 2],
    acceleration: f64,
}

/// What came out of the planner.
struct Seen<'m> {
    machine: &'m Machine,
    low: f64,
    high: f64,
    known: bool,
    places: Vec<Place>,
    corners: VecDeque<Pending>,
    /// Motions in which rotary axes turn, whose time is not known yet.
    turning: VecDeque<u32>,
    /// Planned speed at the end of the last motion, mm/s.
    leaves: f64,
    swing: Swing,
}

/// The feed along the path in feed, as a run of dips.
#[derive(Default)]
struct Swing {
    way: f64,
    /// Highest since the last dip, lowest in it, and whether it is in one.
    high: f64,
    low: f64,
    falling: bool,
    dip: Option<f64>,
}

impl Swing {
    /// The next feed after some way, both mm; the lowest feed of two dips that lie within the window.
    fn next(&mut self, way: f64, feed: f64) -> Option<f64> {
        self.way += way;
        if self.falling {
            self.low = self.low.min(feed);
            if feed * MATTERS <= self.low {
                return None;
            }
            let found = self.dip.is_some_and(|dip| self.way - dip <= WINDOW).then_some(self.low);
            (self.dip, self.falling, self.high) = (Some(self.way), false, feed);
            return found;
        }
        self.high = self.high.max(feed);
        if feed < self.high * MATTERS {
            (self.falling, self.low) = (true, feed);
        }
        None
    }
}

impl<'m> Pace<'m> {
    pub(crate) fn new(machine: &'m Machine, dialect: &Dialect) -> Self {
        Self {
            machine,
            planner: Planner::new(machine, dialect.advice.rotary_feed),
            seen: Seen {
                machine,
                low: 0.0,
                high: 0.0,
                known: true,
                places: Vec::new(),
                corners: VecDeque::new(),
                turning: VecDeque::new(),
                leaves: 0.0,
                swing: Swing::default(),
            },
            loops: loops(machine),
            motions: 0,
            tool: None,
            before: None,
        }
    }

    /// The next leg.
    pub(crate) fn add(&mut self, view: &LegView<'_>) {
        let leg = view.leg;
        if leg.motion.tool.is_some() && leg.motion.tool != self.tool {
            self.tool = leg.motion.tool;
            if let Some(seconds) = self.machine.control.planning.tool_change_time {
                self.seen.low += seconds;
                self.seen.high += seconds;
            }
        }
        self.corner(view);
        if view.rotary_turns() {
            self.seen.turning.push_back(self.motions);
        }
        if let Some(feed) = tip_feed(view) {
            let timed = Timed::at(leg.motion.block, leg.motion.chain, self.motions);
            self.seen.place(&timed, PaceKind::Mode, (feed[1], feed[0]), 0);
        }
        let seen = &mut self.seen;
        self.planner
            .leg(leg, PathControl::ByMachine, &mut |timed| seen.take(&timed));
        self.motions += 1;
    }

    /// The end of the program: its lowest and highest time, s.
    pub(crate) fn finish(&mut self) -> Option<[f64; 2]> {
        let seen = &mut self.seen;
        self.planner.finish(&mut |timed| seen.take(&timed));
        let Seen { low, high, known, .. } = seen;
        (*known && low.is_finite() && high.is_finite()).then_some([low.min(*high), *high])
    }

    /// Asks the rules about each place, in the order of the run.
    pub(crate) fn report(&self, rules: &[Active], reporter: &mut Reporter<'_>) {
        for place in &self.seen.places {
            reporter.origin(false, place.chain);
            ask(rules, reporter, (Some(place.block), 0), |wake, out| {
                if let Wake::Pace(kind, rule) = wake
                    && kind == place.kind
                {
                    rule(place, self.machine, out);
                }
            });
        }
    }

    /// Remembers the corner at the start of a feed motion, where the servo loops are declared.
    fn corner(&mut self, view: &LegView<'_>) {
        let Some((joints, ..)) = self.loops else { return };
        let leg = view.leg;
        let feed = match leg.motion.feed {
            Feed::PerMinute(feed) if leg.motion.is_feed() && leg.motion.spindle_on == Some(true) => feed / 60.0,
            _ => {
                self.before = None;
                return;
            }
        };
        let Some(path) = BlockPath::new(self.machine, leg).filter(|_| feed > 0.0 && !view.rotary_turns()) else {
            self.before = None;
            return;
        };
        let [start, end] = [0.0, 1.0].map(|t| {
            let rates = path.rates(t);
            Vec3::from(joints.map(|joint| rates[joint]))
        });
        if let Some(before) = self.before.filter(|before| before.motion + 1 == self.motions)
            && let Some(corner) = Corner::new(&before.direction, &start)
            && corner.turn() > 1e-3
        {
            let slowest = |direction: &Vec3| {
                let axes = joints.iter().zip(direction.iter());
                let each = axes.filter(|(_, share)| share.abs() > 1e-9);
                each.filter_map(|(&joint, share)| Some(self.machine.axes[joint].max_acceleration? / share.abs()))
                    .fold(f64::INFINITY, f64::min)
            };
            let acceleration = slowest(&corner.before).min(slowest(&corner.after));
            if acceleration.is_finite() {
                let feeds = [before.feed, feed];
                self.seen.corners.push_back(Pending {
                    motion: self.motions,
                    corner,
                    feeds,
                    acceleration,
                });
            }
        }
        self.before = Some(Tangent {
            motion: self.motions,
            direction: end,
            feed,
        });
    }
}

impl Seen<'_> {
    fn take(&mut self, timed: &Timed) {
        match timed.seconds {
            [Some(low), Some(high)] => {
                self.low += low;
                self.high += high;
            }
            _ => self.known = false,
        }
        let turns = self.turning.front() == Some(&timed.motion);
        if turns {
            self.turning.pop_front();
        }
        self.corner(timed);
        self.leaves = timed.leaves.unwrap_or(0.0) / 60.0;
        let Some(feed) = timed.feed.filter(|_| timed.engaged && timed.seconds[1].is_some()) else {
            self.swing = Swing::default();
            return;
        };
        if let Some((bend, joint)) = timed.bend_feed {
            self.place(timed, PaceKind::Bend, (bend, feed), joint);
        }
        if let Some(most) = timed.block_time_feed {
            self.place(timed, PaceKind::Short, (most, feed), 0);
        }
        if timed.crawls > CRAWLS {
            self.place(timed, PaceKind::Crawl, (timed.crawls, feed), 0);
        }
        if turns {
            self.swing = Swing::default();
        } else if let (Some(reached), Some(leaves), false) = (timed.reached, timed.leaves, timed.turns_only) {
            let half = 0.5 * timed.length;
            let first = self.swing.next(half, reached);
            if let Some(low) = self.swing.next(half, leaves).or(first) {
                self.place(timed, PaceKind::Swing, (low, feed), 0);
            }
        }
    }

    /// A corner whose speed is known now.
    fn corner(&mut self, timed: &Timed) {
        while let Some(pending) = self
            .corners
            .front()
            .copied()
            .filter(|pending| pending.motion <= timed.motion)
        {
            self.corners.pop_front();
            let Some((_, kv, forward)) = loops(self.machine).filter(|_| pending.motion == timed.motion) else {
                continue;
            };
            let profile = Profile {
                feeds: pending.feeds,
                acceleration: pending.acceleration,
                corner_speed: self.leaves,
            };
            let error = closed_form(&pending.corner, &profile, kv, forward);
            let tolerance = self.machine.control.planning.corner_tolerance.unwrap_or(CORNER);
            if error > tolerance {
                self.place(timed, PaceKind::Corner, (error, self.leaves * 60.0), 0);
            }
        }
    }

    /// Adds a place, or extends the last one of its kind.
    fn place(&mut self, timed: &Timed, kind: PaceKind, (value, feed): (f64, f64), joint: u8) {
        let full = self.places.len() >= MOST;
        let last = self.places.iter_mut().rev().take(8).find(|place| place.kind == kind);
        if let Some(place) = last
            && (full || place.last_motion + 1 == timed.motion && place.joint == joint)
        {
            let worse = match kind {
                PaceKind::Crawl | PaceKind::Corner => value > place.value,
                // the tip is fastest against F
                PaceKind::Mode => value * place.feed > place.value * feed,
                PaceKind::Bend | PaceKind::Swing | PaceKind::Short => value < place.value,
            };
            if worse {
                (place.value, place.feed) = (value, feed);
            }
            (place.last, place.last_motion, place.count) = (timed.block, timed.motion, place.count + 1);
            return;
        }
        if full {
            return;
        }
        self.places.push(Place {
            kind,
            block: timed.block,
            chain: timed.chain,
            last: timed.block,
            count: 1,
            value,
            feed,
            turns_only: timed.turns_only,
            joint,
            last_motion: timed.motion,
        });
    }
}

/// The first three linear axes with the same position gain and feed forward; `None` where they are not declared so.
fn loops(machine: &Machine) -> Option<([usize; 3], f64, f64)> {
    let joints: [usize; 3] = machine.linear.get(..3)?.try_into().ok()?;
    let of = |joint: usize| {
        let extra = &machine.axes[joint].extra;
        Some((extra.position_gain?, extra.feed_forward.unwrap_or(0.0)))
    };
    let (kv, forward) = of(joints[0])?;
    joints
        .iter()
        .all(|&joint| of(joint) == Some((kv, forward)))
        .then_some((joints, kv, forward))
}

/// F and the mean speed of the tip, mm/min, where linear and rotary axes move together, F is a speed along X Y Z and the tip's is clearly another one.
fn tip_feed(view: &LegView<'_>) -> Option<[f64; 2]> {
    let leg = view.leg;
    let Feed::PerMinute(feed) = leg.motion.feed else {
        return None;
    };
    if leg.motion.spindle_on != Some(true)
        || !leg.motion.is_feed()
        || leads_tip(&leg.motion)
        || leg.length <= 0.0
        || !view.rotary_turns()
        || view.lever_is_undeclared()
    {
        return None;
    }
    let (start, end) = view.stances()?;
    let share = start.tip_distance_to(end) / leg.length;
    // the chord is the least that the tip travels
    (share > 1.25).then_some([feed, feed * share])
}
