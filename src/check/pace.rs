//! How the machine runs the program: its time, and the places where it slows down, crawls, swings or cuts a corner.
mod seen;

use crate::pass::ask;
use crate::sink::{Active, Reporter};
use crate::view::LegView;
use crate::wake::Wake;
use seen::{Pending, Seen};
use trunnion_dialect::Dialect;
use trunnion_geometry::Vec3;
use trunnion_interp::{ChainId, Feed, Placed};
use trunnion_machine::{BlockPath, Machine, leads_tip};
use trunnion_planner::{Modes, Planner, Timed};
use trunnion_servo::Corner;
use trunnion_syntax::{BlockId, Program};

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
    /// An axis that moves in a cut declares no acceleration: `joint`.
    NoAcceleration,
    /// The servo loops of some linear axes are declared, but not alike: corners are not judged.
    UnlikeLoops,
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

/// A corner may be cut by this much where the machine file does not say otherwise, mm.
pub(crate) const CORNER: f64 = 0.02;

/// The planner inside a check.
pub(crate) struct Pace<'m> {
    machine: &'m Machine,
    planner: Planner<'m>,
    seen: Seen<'m>,
    /// Linear axes whose servo loops are declared alike: joints, gain, feed forward.
    loops: Option<([usize; 3], f64, f64)>,
    /// Corners wait for loops that are declared alike: said at the first one.
    unlike: bool,
    modes: Modes,
    linuxcnc: bool,
    motions: u32,
    tool: Option<u32>,
    before: Option<Tangent>,
    /// Axes of which it was said that their acceleration is not declared: bits by joint.
    bare: u32,
}

/// Direction of the linear axes at the end of a motion.
#[derive(Clone, Copy)]
struct Tangent {
    motion: u32,
    direction: Vec3,
    feed: f64,
}

impl<'m> Pace<'m> {
    pub(crate) fn new(machine: &'m Machine, dialect: &Dialect) -> Self {
        Self {
            machine,
            planner: Planner::new(machine, dialect.advice.rotary_feed),
            seen: Seen::new(machine),
            loops: loops(machine),
            unlike: loops(machine).is_none() && speaks_of_loops(machine),
            modes: Modes::new(dialect),
            linuxcnc: dialect.quirks.rs274(),
            motions: 0,
            tool: None,
            before: None,
            bare: 0,
        }
    }

    /// Whether effects of this program may change times.
    pub(crate) fn wants_effects(&self, program: &Program) -> bool {
        let codes: &[&[u8]] = if self.linuxcnc {
            &[b"61", b"64"]
        } else {
            &[b"60", b"61", b"9", b"09"]
        };
        !self.machine.control.planning.m_times.is_empty() || has_code(program.source(), codes)
    }

    /// What the program does apart from its motions.
    pub(crate) fn effect(&mut self, placed: &Placed) {
        if let Some(seconds) = self.modes.take(&placed.effect, self.machine) {
            self.wait(seconds);
        }
    }

    /// The machine stands still.
    fn wait(&mut self, seconds: f64) {
        self.planner.end(self.modes.last());
        let seen = &mut self.seen;
        self.planner.finish(&mut |timed| seen.take(&timed));
        seen.low += seconds;
        seen.high += seconds;
    }

    /// The next leg.
    pub(crate) fn add(&mut self, view: &LegView<'_>) {
        let leg = view.leg;
        if leg.motion.tool.is_some() && leg.motion.tool != self.tool {
            self.tool = leg.motion.tool;
            if let Some(seconds) = self.machine.control.planning.tool_change_time {
                self.wait(seconds);
            }
        }
        self.undeclared(view);
        self.corner(view);
        if view.rotary_turns() {
            self.seen.turning.push_back(self.motions);
        }
        if let Some(feed) = tip_feed(view) {
            let timed = Timed::at(leg.motion.block, leg.motion.chain, self.motions);
            self.seen.place(&timed, PaceKind::Mode, (feed[1], feed[0]), 0);
        }
        let control = self.modes.advance();
        let seen = &mut self.seen;
        self.planner.leg(leg, control, &mut |timed| seen.take(&timed));
        self.motions += 1;
    }

    /// Remembers axes of a cut whose acceleration is not declared, each once.
    fn undeclared(&mut self, view: &LegView<'_>) {
        let leg = view.leg;
        if !leg.motion.is_feed() || leg.motion.spindle_on != Some(true) {
            return;
        }
        let Some((start, end)) = view.stances() else { return };
        for (joint, axis) in self.machine.axes.iter().enumerate().take(32) {
            let bit = 1_u32 << joint;
            let moves = (end.joints[joint] - start.joints[joint]).abs() > 1e-9;
            if moves && axis.max_acceleration.is_none() && self.bare & bit == 0 {
                self.bare |= bit;
                let timed = Timed::at(leg.motion.block, leg.motion.chain, self.motions);
                self.seen
                    .place(&timed, PaceKind::NoAcceleration, (0.0, 0.0), joint as u8);
            }
        }
    }

    /// The end of the program: its lowest and highest time, s.
    pub(crate) fn finish(&mut self) -> Option<[f64; 2]> {
        self.planner.end(self.modes.last());
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
        let leg = view.leg;
        if self.unlike && leg.motion.is_feed() && leg.motion.spindle_on == Some(true) {
            self.unlike = false;
            let timed = Timed::at(leg.motion.block, leg.motion.chain, self.motions);
            self.seen.place(&timed, PaceKind::UnlikeLoops, (0.0, 0.0), 0);
        }
        let Some((joints, ..)) = self.loops else { return };
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

/// Whether a linear axis declares its servo loop.
pub(crate) fn speaks_of_loops(machine: &Machine) -> bool {
    let joints = machine.linear.iter().take(3);
    joints.clone().count() == 3
        && joints
            .into_iter()
            .any(|&joint| machine.axes[joint].extra.position_gain.is_some())
}

/// Whether a text contains a G code with one of these numbers: not followed by a digit.
fn has_code(text: &[u8], numbers: &[&[u8]]) -> bool {
    memchr::memchr2_iter(b'G', b'g', text).any(|at| {
        let behind = &text[at + 1..];
        let ends = |rest: &[u8]| !rest.first().is_some_and(u8::is_ascii_digit);
        numbers
            .iter()
            .any(|number| behind.strip_prefix(*number).is_some_and(ends))
    })
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
