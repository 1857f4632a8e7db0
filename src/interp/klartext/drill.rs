//! Calls of cycles, and the motions of hole cycles.
//!
//! A hole: in rapid to Q203+Q200, the work to Q203+Q201, back to Q203+Q204, or to Q203+Q200 where that is higher. Q201=0 does nothing. Where
//! the rapid back into a hole ends is not taken from a source: `[control] peck_clearance` declares it. Rigid tapping (207, 209): the spindle is
//! in position control, interpolated with the tool axis (HEIDENHAIN Technical Manual MANUALplus 620, p. 1028).
use super::Klartext;
use super::hole::{Cycle, CycleFeed, Hole};
use super::values::Value;
use super::words::{Parameter, Words};
use crate::core::Report;
use crate::{Feed, MotionKind, Refusal};
use trunnion_syntax::TextRange;

/// Steps of one hole.
pub(super) const MOST: usize = 10_000;
/// Levels that differ by less are one, mm.
pub(super) const SAME_LEVEL: f64 = 1e-9;

/// Levels along the tool axis, mm, and feeds of a hole.
struct At {
    clear: f64,
    bottom: f64,
    back: f64,
    feed: Feed,
    out: Option<Feed>,
}

impl Klartext<'_> {
    /// CYCL CALL, CYCL CALL POS, CYCL CALL PAT.
    pub(crate) fn call_cycle(&mut self, words: &mut Words<'_>, report: &mut Report<'_>) {
        if words.takes_word("PAT") {
            return self.call_pattern(words, report);
        }
        let positioned = words.takes_word("POS");
        let found = self.path_words(words, report);
        self.codes_before(&found, report);
        if positioned {
            self.call_at(&found, report);
        } else {
            self.run_cycle(report);
        }
        self.codes_after(&found);
    }

    /// The cycle was defined in a program whose BEGIN PGM says another unit.
    pub(super) fn cycle_has_other_unit(&self) -> bool {
        let is_there = !matches!(self.memory.cycle, Cycle::None);
        is_there && self.memory.cycle_unit != self.core.state.coordinates.unit_mm()
    }

    /// Runs the cycle that is defined where the tool is.
    pub(crate) fn run_cycle(&mut self, report: &mut Report<'_>) {
        self.flush(report);
        let over = self.cycle_motions.over(self.core.setup.limits.blocks);
        if let Some(why) = over.filter(|_| !matches!(self.memory.cycle, Cycle::None)) {
            self.not_modelled_once(&why, report);
            return self.work_unknown(report);
        }
        if self.cycle_has_other_unit() {
            let what = "a cycle that a program in another unit defines: in which unit its values count";
            self.not_modelled_once(what, report);
            return self.work_unknown(report);
        }
        match self.memory.cycle.clone() {
            Cycle::None => Self::rejected(Refusal::CannedCycle, "no cycle is defined before its call", report),
            Cycle::Hole(hole) => self.drill(&hole, report),
            Cycle::Old(_) if self.scales_cycles(report) => self.work_unknown(report),
            Cycle::Old(old) => self.run_old_cycle(&old, report),
            Cycle::Other(number) => {
                self.not_modelled_once(&format!("cycle {number}: its path"), report);
                self.work_unknown(report);
            }
        }
    }

    /// A cycle whose path is not followed: the tool is above where it was called.
    pub(super) fn work_unknown(&mut self, report: &mut Report<'_>) {
        let start = self.core.state.position;
        let along = self.axes()[2];
        self.core.forget_linear();
        let mut end = start;
        end.forget(along);
        self.core.state.position = end;
        let orientation = self.core.held_orientation();
        let motion = self
            .core
            .motion_in_frame(MotionKind::Unknown, [start, end], orientation, Feed::Unknown, report);
        self.memory.heading = None;
        self.emit(&motion, report);
    }

    pub(super) fn cycle_feed(&mut self, feed: CycleFeed, report: &mut Report<'_>) -> Feed {
        let unit = self.core.state.feed.unit_mm();
        let value = match feed {
            CycleFeed::Value(Some(value)) if value > 0.0 => Some(value * unit),
            CycleFeed::Auto if self.memory.tool_feed.is_some() || self.memory.tool_feed_unread => self.memory.tool_feed,
            CycleFeed::Rapid => return Feed::Rapid,
            CycleFeed::Value(Some(_)) | CycleFeed::Missing | CycleFeed::Auto => {
                let kind = crate::FaultKind::MissingFeed {
                    inverse_time: false,
                    zero: feed != CycleFeed::Auto,
                };
                report.fault(TextRange::default(), kind);
                return Feed::Unknown;
            }
            CycleFeed::Value(None) | CycleFeed::Unknown => None,
        };
        value.map_or(Feed::Unknown, Feed::PerMinute)
    }

    pub(super) fn drill(&mut self, hole: &Hole, report: &mut Report<'_>) {
        if self.scales_cycles(report) {
            return self.work_unknown(report);
        }
        if let Some(parameter) = self.changed_since(hole) {
            self.memory.unfollowed = true;
            self.not_modelled_once(
                &format!(
                    "cycle {}: {parameter} has changed since CYCL DEF, and whether the cycle reads it at its call is in no source: define the cycle again",
                    hole.cycle
                ),
                report,
            );
            return self.work_unknown(report);
        }
        self.drill_as_defined(hole, report);
    }

    /// The feed of the way out of a hole; `None`: in rapid.
    fn way_out(&mut self, hole: &Hole, feed: Feed, report: &mut Report<'_>) -> Option<Feed> {
        match hole.cycle {
            201 | 202 => match hole.back_feed {
                CycleFeed::Missing | CycleFeed::Value(Some(0.0)) => Some(feed),
                other => Some(self.cycle_feed(other, report)),
            },
            // Q208 = 0 is Q206; 205 goes back in rapid where it is left out
            203 | 205 => match hole.back_feed {
                CycleFeed::Missing if hole.cycle == 205 => None,
                CycleFeed::Missing | CycleFeed::Value(Some(0.0)) => Some(feed),
                other => Some(self.cycle_feed(other, report)),
            },
            206 | 207 | 209 => Some(feed),
            _ => None,
        }
    }

    fn drill_as_defined(&mut self, hole: &Hole, report: &mut Report<'_>) {
        let unit = self.core.state.coordinates.unit_mm();
        let (Some(clear), Some(depth), Some(surface)) = (hole.clear, hole.depth, hole.surface) else {
            self.not_modelled_once(
                &format!("cycle {}: Q200, Q201 or Q203 is not known", hole.cycle),
                report,
            );
            return self.work_unknown(report);
        };
        if depth == 0.0 {
            return;
        }
        if clear < 0.0 {
            let message = format!(
                "cycle {}: Q200 is negative, so that the tool goes below the surface in rapid: it is a distance, 0 or more",
                hole.cycle
            );
            Self::rejected(Refusal::CannedCycle, message, report);
            return self.work_unknown(report);
        }
        if self.unclear_steps(hole, report) {
            return self.work_unknown(report);
        }
        if depth > 0.0 {
            let what = format!(
                "cycle {}: a positive depth (Q201), which a machine parameter refuses or runs towards the spindle",
                hole.cycle
            );
            self.not_modelled_once(&what, report);
            return self.work_unknown(report);
        }
        if matches!(hole.cycle, 207 | 209) && hole.pitch == Some(0.0) {
            let message = format!("cycle {} without a pitch: Q239 is 0", hole.cycle);
            Self::rejected(Refusal::CannedCycle, message, report);
        }
        let second = hole.second.unwrap_or(clear).max(clear);
        let feed = match hole.pitch.filter(|_| matches!(hole.cycle, 207 | 209)) {
            // the spindle leads
            Some(pitch) => match self.core.state.spindle.rpm() {
                Some(rpm) if rpm > 0.0 && pitch != 0.0 => Feed::PerMinute(pitch.abs() * unit * rpm),
                _ => Feed::Unknown,
            },
            None => self.cycle_feed(hole.feed, report),
        };
        let out = self.way_out(hole, feed, report);
        let at = At {
            clear: (surface + clear) * unit,
            bottom: (surface + depth) * unit,
            back: (surface + second) * unit,
            feed,
            out,
        };
        let by_tip = hole.is_by_tip();
        let rigid = matches!(hole.cycle, 207 | 209);
        self.level(MotionKind::Rapid, Some(at.clear), Feed::Rapid, report);
        if rigid {
            self.core.state.spindle.turn(Some(true));
        }
        self.work(hole, &at, by_tip, depth * unit, report);
        match at.out {
            Some(feed) => {
                let odd = hole.cycle == 202 && hole.direction.is_none_or(|direction| direction != 0.0);
                if odd {
                    self.not_modelled_once("cycle 202: how it gets off the wall (Q214)", report);
                }
                let kind = if odd { MotionKind::Unknown } else { linear(feed) };
                self.level(kind, Some(at.clear), feed, report);
            }
            None => self.level(MotionKind::Rapid, Some(at.clear), Feed::Rapid, report),
        }
        self.level(MotionKind::Rapid, Some(at.back), Feed::Rapid, report);
        if rigid {
            // whether it turns afterwards is not taken from a source
            self.core.state.spindle.lose();
        }
    }

    /// Q202 of a cycle that drills in steps, and Q204: what is missing or negative is reported.
    fn unclear_steps(&mut self, hole: &Hole, report: &mut Report<'_>) -> bool {
        let steps = matches!(hole.cycle, 200 | 203 | 205);
        let needed = [(202, hole.peck, steps), (204, hole.second, true)];
        for (number, value, _) in needed.iter().filter(|needed| needed.2) {
            match value {
                None => self.not_modelled_once(&format!("cycle {}: Q{number} is not known", hole.cycle), report),
                Some(value) if *value < 0.0 => {
                    let message = format!(
                        "cycle {}: Q{number} is negative: it is a distance, 0 or more",
                        hole.cycle
                    );
                    Self::rejected(Refusal::CannedCycle, message, report);
                }
                Some(_) => continue,
            }
            return true;
        }
        false
    }

    /// A parameter of the definition that has another value by now.
    fn changed_since(&self, hole: &Hole) -> Option<Parameter> {
        let parameters = &self.memory.parameters;
        let changed = |given: &&(Parameter, Value)| parameters.get(given.0) != given.1;
        hole.given.iter().find(changed).map(|given| given.0)
    }

    /// Whether the motions of a hole say all about it: nothing else of its definition counts.
    pub(super) fn is_followed(&self, hole: &Hole) -> bool {
        let unit = self.core.state.coordinates.unit_mm();
        let (Some(depth), Some(_), Some(_), Some(_)) = (hole.depth, hole.clear, hole.surface, hole.second) else {
            return false;
        };
        if hole.peck.is_none() && matches!(hole.cycle, 200 | 203 | 205) {
            return false;
        }
        let single = hole.is_single(depth * unit, unit);
        hole.is_by_tip()
            && match hole.cycle {
                200 => single || self.core.setup.control.peck_clearance_mm.is_some(),
                203 | 205 => single,
                201 | 206 | 207 | 240 => true,
                _ => false,
            }
    }

    /// From the clearance to the bottom.
    fn work(&mut self, hole: &Hole, at: &At, by_tip: bool, depth: f64, report: &mut Report<'_>) {
        let unit = self.core.state.coordinates.unit_mm();
        let peck = hole.peck.map(|peck| peck * unit).filter(|peck| *peck > 0.0);
        let single = hole.is_single(depth, unit);
        if !by_tip {
            self.not_modelled_once(
                &format!("cycle {}: the depth depends on the tool's tip", hole.cycle),
                report,
            );
            return self.level(MotionKind::Unknown, None, Feed::Unknown, report);
        }
        let straight = match hole.cycle {
            200 | 203 => {
                if !single && peck.is_some() {
                    return self.pecks(hole, at, peck.unwrap_or_default(), report);
                }
                true
            }
            205 => single,
            209 => hole
                .chip_depth
                .is_none_or(|step| step == 0.0 || step * unit >= depth.abs()),
            208 | 241 => false,
            _ => true,
        };
        if straight {
            self.level(linear(at.feed), Some(at.bottom), at.feed, report);
        } else {
            // the depth is known, the way is not
            self.not_modelled_once(&format!("cycle {}: the way to its depth", hole.cycle), report);
            self.level(MotionKind::Unknown, Some(at.bottom), Feed::Unknown, report);
        }
        self.stay(hole.stay, report);
    }

    /// Steps: to break chips with a short way back, or out of the hole.
    fn pecks(&mut self, hole: &Hole, at: &At, peck: f64, report: &mut Report<'_>) {
        let unit = self.core.state.coordinates.unit_mm();
        let universal = hole.cycle == 203;
        let mm = |value: Option<f64>| value.unwrap_or(0.0) * unit;
        let breaks = if universal { hole.breaks.unwrap_or(0.0) } else { 0.0 };
        let (shrink, least) = if universal {
            (mm(hole.shrink), mm(hole.least_peck))
        } else {
            (0.0, 0.0)
        };
        let near = self.core.setup.control.peck_clearance_mm;
        let mut step = peck;
        let mut broken = 0.0;
        // the first step begins at the surface
        let mut depth = mm(hole.surface) - step;
        for _ in 0..MOST {
            if depth <= at.bottom + SAME_LEVEL {
                self.level(linear(at.feed), Some(at.bottom), at.feed, report);
                return self.stay(hole.stay, report);
            }
            self.level(linear(at.feed), Some(depth), at.feed, report);
            if broken < breaks {
                broken += 1.0;
                let back = hole.chip.map(|chip| depth + chip * unit);
                self.level(MotionKind::Rapid, back, Feed::Rapid, report);
            } else {
                broken = 0.0;
                // Q208 is the feed out of the hole
                let out = at.out.unwrap_or(Feed::Rapid);
                self.level(linear(out), Some(at.clear), out, report);
                self.stay(hole.stay_above, report);
                if near.is_none() {
                    let what = "where the rapid back into the hole ends (declare [control] peck_clearance)";
                    self.not_modelled_once(&format!("cycle {}: {what}", hole.cycle), report);
                }
                self.level(MotionKind::Rapid, near.map(|near| depth + near), Feed::Rapid, report);
            }
            if shrink > 0.0 {
                step = (step - shrink).max(least);
            }
            if step <= 0.0 {
                break;
            }
            depth -= step;
        }
        self.not_modelled_once(
            &format!("cycle {}: more than 10000 steps, or steps of nothing", hole.cycle),
            report,
        );
        self.level(MotionKind::Unknown, Some(at.bottom), Feed::Unknown, report);
    }

    pub(super) fn stay(&mut self, seconds: Option<f64>, report: &mut Report<'_>) {
        if let Some(seconds) = seconds.filter(|seconds| *seconds > 0.0) {
            self.dwell(Some(seconds), report);
        }
    }

    /// A motion along the tool axis to a level in the coordinates of the words; `None`: it is not known.
    pub(super) fn level(&mut self, kind: MotionKind, level: Option<f64>, feed: Feed, report: &mut Report<'_>) {
        let along = self.axes()[2];
        let start = self.core.state.position;
        let mut end = self.memory.frames.programmed(&start);
        let before = end.get(along);
        match level {
            Some(level) if before.is_some_and(|before| (before - level).abs() <= SAME_LEVEL) => return,
            Some(level) => end.set(along, level),
            None => end.forget(along),
        }
        end = self.memory.frames.arrive(end);
        self.core.state.position = end;
        let orientation = self.core.held_orientation();
        let feed = match kind {
            MotionKind::Rapid => Feed::Rapid,
            MotionKind::Unknown => Feed::Unknown,
            _ => feed,
        };
        let motion = self.core.motion_in_frame(kind, [start, end], orientation, feed, report);
        self.memory.heading = None;
        self.cycle_motions.add();
        self.emit(&motion, report);
    }
}

pub(super) fn linear(feed: Feed) -> MotionKind {
    if feed == Feed::Rapid {
        MotionKind::Rapid
    } else {
        MotionKind::Linear
    }
}
