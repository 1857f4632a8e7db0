//! What comes out of the planner, put together to places.
use super::{CORNER, PaceKind, Place, loops};
use std::collections::VecDeque;
use trunnion_machine::Machine;
use trunnion_planner::Timed;
use trunnion_servo::{Corner, Profile, closed_form_with_ramps};

/// The most places of a kind that are kept apart; later ones count as part of the last.
const MOST: usize = 1000;
/// Share of F below which a bend or a swing matters.
const MATTERS: f64 = 0.7;
/// Two dips within this path are a swing, mm.
const WINDOW: f64 = 2.0;
/// The tool crawls when it is below 5 % of F for this long, s.
const CRAWLS: f64 = 0.05;
/// A corner whose speed is not planned yet.
#[derive(Clone, Copy)]
pub(super) struct Pending {
    /// The motion after it.
    pub(super) motion: u32,
    pub(super) corner: Corner,
    pub(super) feeds: [f64; 2],
    pub(super) acceleration: f64,
}

/// What came out of the planner.
pub(super) struct Seen<'m> {
    pub(super) machine: &'m Machine,
    pub(super) low: f64,
    pub(super) high: f64,
    pub(super) known: bool,
    pub(super) places: Vec<Place>,
    pub(super) corners: VecDeque<Pending>,
    /// Motions in which rotary axes turn, whose time is not known yet.
    pub(super) turning: VecDeque<u32>,
    /// Planned speed at the end of the last motion, mm/s.
    pub(super) leaves: f64,
    pub(super) swing: Swing,
    /// For how long the tool crawls without a break, s, and F of the block in which it does so longest; `None` before the first block of a cut.
    pub(super) crawl: Option<Crawling>,
}

/// A crawl that may go on.
#[derive(Clone, Copy)]
pub(super) struct Crawling {
    seconds: f64,
    /// The longest part of it in one block, s, and F there.
    part: f64,
    feed: f64,
}

impl Crawling {
    /// It goes on in a block.
    fn goes_on(before: Option<Self>, part: f64, feed: f64) -> Self {
        let own = Self {
            seconds: part,
            part,
            feed,
        };
        before.map_or(own, |before| Self {
            seconds: before.seconds + part,
            ..if part > before.part { own } else { before }
        })
    }
}

/// The share of F along the path in feed, as a run of dips.
#[derive(Default)]
pub(super) struct Swing {
    way: f64,
    /// Highest since the last dip, lowest in it and where, and whether it is in one.
    pub(super) high: f64,
    pub(super) low: f64,
    at: f64,
    falling: bool,
    dip: Option<f64>,
}

impl Swing {
    /// The next share of F after some way, mm; the lowest one of two dips that lie within the window.
    fn next(&mut self, way: f64, share: f64) -> Option<f64> {
        self.way += way;
        if self.falling {
            if share <= self.low {
                (self.low, self.at) = (share, self.way);
            }
            if share * MATTERS <= self.low {
                return None;
            }
            let found = self.dip.is_some_and(|dip| self.at - dip <= WINDOW).then_some(self.low);
            (self.dip, self.falling, self.high) = (Some(self.at), false, share);
            return found;
        }
        self.high = self.high.max(share);
        if share < self.high * MATTERS {
            (self.falling, self.low, self.at) = (true, share, self.way);
        }
        None
    }
}

impl<'m> Seen<'m> {
    pub(super) fn new(machine: &'m Machine) -> Self {
        Self {
            machine,
            low: 0.0,
            high: 0.0,
            known: true,
            places: Vec::new(),
            corners: VecDeque::new(),
            turning: VecDeque::new(),
            leaves: 0.0,
            swing: Swing::default(),
            crawl: None,
        }
    }
}

impl Seen<'_> {
    pub(super) fn take(&mut self, timed: &Timed) {
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
            (self.swing, self.crawl) = (Swing::default(), None);
            return;
        };
        if let Some((bend, joint)) = timed.bend_feed {
            self.place(timed, PaceKind::Bend, (bend, feed), joint);
        }
        if let Some(most) = timed.block_time_feed {
            self.place(timed, PaceKind::Short, (most, feed), 0);
        }
        // from block to block without a break: it leaves one slowly and enters the next one so
        let crawl = timed.crawl;
        // the start of a cut is none
        let part = if self.crawl.is_none() && crawl.faster {
            0.0
        } else {
            crawl.enters
        };
        let enters = Crawling::goes_on(self.crawl, part, feed);
        let inside = Crawling::goes_on(None, crawl.inside, feed);
        let longest = if inside.seconds > enters.seconds {
            inside
        } else {
            enters
        };
        if longest.seconds > CRAWLS {
            self.place(timed, PaceKind::Crawl, (longest.seconds, longest.feed), 0);
        }
        let leaves = Crawling::goes_on(None, crawl.leaves, feed);
        self.crawl = Some(if crawl.faster { leaves } else { enters });
        if turns {
            self.swing = Swing::default();
        } else if let (Some(reached), Some(leaves), false) = (timed.reached, timed.leaves, timed.turns_only) {
            let half = 0.5 * timed.length;
            let first = self.swing.next(half, reached / feed);
            if let Some(low) = self.swing.next(half, leaves / feed).or(first) {
                self.place(timed, PaceKind::Swing, (low * feed, feed), 0);
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
            let error = closed_form_with_ramps(&pending.corner, &profile, kv, forward);
            let tolerance = self.machine.control.planning.corner_tolerance.unwrap_or(CORNER);
            if error > tolerance {
                self.place(timed, PaceKind::Corner, (error, self.leaves * 60.0), 0);
            }
        }
    }

    /// Adds a place, or extends the last one of its kind.
    pub(super) fn place(&mut self, timed: &Timed, kind: PaceKind, (value, feed): (f64, f64), joint: u8) {
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
                PaceKind::NoAcceleration | PaceKind::UnlikeLoops => false,
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
