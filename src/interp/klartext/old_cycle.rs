//! Cycles of older controls, whose values stand in lines of their own: pecking 1, pocket 4, circular pocket 5; others by number only.
//!
//! The lines are in the order of the manuals. Their texts depend on the language of the dialogue and are not read: the value is the last
//! number of a line. The cycle begins where the tool is, the set-up clearance above the workpiece, and ends there.
//!
//! Pecking: at feed to a peck, in rapid to the start and back to the distance t before the last peck, and so on; a dwell at the bottom. t is
//! 0.6 mm up to a depth of 30 mm, above that a 50th of the depth, at most 7 mm. The sign of the depth is the direction. Sources: TNC 360 p. 8-4,
//! TNC 370 p. 8-6, TNC 407 (280 580) DIN/ISO p. 8-4. Pockets: where they end, not their path (TNC 360 p. 8-12, DIN/ISO p. 8-13; TNC 426/430 p. 264).
use super::Klartext;
use super::drill::{MOST, linear};
use super::hole::{Cycle, CycleFeed};
use super::values::Value;
use super::words::{Said, Words};
use crate::Argument;
use crate::core::Report;
use crate::{Feed, MotionKind};

/// Lines of a cycle.
const LINES: usize = 8;

/// A cycle as its lines define it, in the program's unit.
#[derive(Clone, Debug, Default)]
pub(crate) struct OldCycle {
    number: u32,
    /// The last number of each line; the first line has none.
    values: [Value; LINES],
    feed: CycleFeed,
}

impl OldCycle {
    /// Its number and its known values.
    pub(super) fn arguments(&self) -> Vec<Argument> {
        let values = (1..).zip(&self.values);
        let values = values.filter_map(|(line, value)| Some(Argument::number(format!("cycle {line}"), (*value)?)));
        core::iter::once(Argument::number("cycle", f64::from(self.number)))
            .chain(values)
            .collect()
    }
}

impl Klartext<'_> {
    /// `CYCL DEF 1.0` begins a definition, `1.1` and so on continue it.
    pub(crate) fn old_cycle_line(&mut self, number: u32, line: u32, words: &mut Words<'_>, report: &mut Report<'_>) {
        if line == 0 {
            let old = OldCycle {
                number,
                ..OldCycle::default()
            };
            self.memory.cycle = Cycle::Old(Box::new(old));
            return;
        }
        let (mut value, mut feed) = (None, None);
        for word in words.by_ref() {
            match (word.name(), word.value) {
                (b"FMAX", _) => feed = Some(CycleFeed::Rapid),
                (b"FAUTO", _) => feed = Some(CycleFeed::Auto),
                (b"F", Said::Nothing) => feed = Some(CycleFeed::Unknown),
                (b"F", said) => feed = Some(CycleFeed::Value(self.said(said, report))),
                (_, Said::Number(number)) => value = Some(number),
                (_, said @ Said::Parameter(..)) => value = self.said(said, report),
                _ => {}
            }
        }
        match &mut self.memory.cycle {
            Cycle::Old(old) if old.number == number => {
                if let Some(place) = old.values.get_mut(line as usize) {
                    *place = value;
                }
                if let Some(feed) = feed {
                    old.feed = feed;
                }
            }
            // its beginning is missing, which was reported
            _ => self.memory.cycle = Cycle::Other(number),
        }
    }

    pub(crate) fn run_old_cycle(&mut self, old: &OldCycle, report: &mut Report<'_>) {
        match old.number {
            1 => self.peck(old, report),
            4 | 5 => {
                self.not_modelled_once(&format!("cycle {}: its path", old.number), report);
                self.work_and_return(report);
            }
            12 => {
                Self::not_modelled("cycle 12: the program that it calls", report);
                self.call_is_not_followed();
            }
            number => {
                self.not_modelled_once(&format!("cycle {number}: its path"), report);
                self.work_unknown(report);
            }
        }
    }

    fn peck(&mut self, old: &OldCycle, report: &mut Report<'_>) {
        let along = self.axes()[2];
        let start = self.memory.frames.programmed(&self.core.state.position).get(along);
        let [_, clear, depth, peck, stay, ..] = old.values;
        let (Some(start), Some(clear), Some(depth), Some(peck)) = (start, clear, depth, peck) else {
            let what = "cycle 1: its clearance, depth or peck, or the height at which it begins";
            self.not_modelled_once(what, report);
            return self.work_and_return(report);
        };
        if depth == 0.0 || peck == 0.0 {
            self.not_modelled_once("cycle 1 with a depth or peck of 0", report);
            return self.work_and_return(report);
        }
        let unit = self.core.state.coordinates.unit_mm();
        let [clear, total, peck] = [clear, depth, peck].map(|length| length.abs() * unit);
        let near = if total <= 30.0 { 0.6 } else { (total / 50.0).min(7.0) };
        let at = |deep: f64| start + depth.signum() * (clear + deep);
        let feed = self.cycle_feed(old.feed, report);
        let mut deep = 0.0;
        for _ in 0..MOST {
            deep = f64::min(deep + peck, total);
            self.level(linear(feed), Some(at(deep)), feed, report);
            if deep >= total {
                self.stay(stay, report);
                return self.level(MotionKind::Rapid, Some(start), Feed::Rapid, report);
            }
            self.level(MotionKind::Rapid, Some(start), Feed::Rapid, report);
            let back = at((deep - near).max(-clear));
            self.level(MotionKind::Rapid, Some(back), Feed::Rapid, report);
        }
        self.not_modelled_once("cycle 1: more than 10000 pecks", report);
        self.work_and_return(report);
    }

    /// A cycle whose path is not followed, and that ends where it begins.
    fn work_and_return(&mut self, report: &mut Report<'_>) {
        let place = self.core.state.position;
        let orientation = self.core.held_orientation();
        let motion = self
            .core
            .motion_in_frame(MotionKind::Unknown, [place; 2], orientation, Feed::Unknown, report);
        self.memory.heading = None;
        self.emit(&motion, report);
    }
}
