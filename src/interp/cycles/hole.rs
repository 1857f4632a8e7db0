//! Drilling, tapping and boring cycles: to the hole, rapid to R, down to Z as the cycle says, and back.
use super::data::Stored;
use crate::arc::plane_axes;
use crate::core::Report;
use crate::iso::Iso;
use crate::words::{WordValue, Words};
use crate::{FaultKind, Feed, MotionKind, Position, Refusal};
use trunnion_dialect::Action;

/// Holes of one block.
const MOST_REPEATS: u32 = 10_000;

/// One hole with its numbers, all as coordinates of the words.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plan {
    pub(super) axis: usize,
    pub(super) r: Option<f64>,
    pub(super) bottom: f64,
    pub(super) initial: Option<f64>,
    pub(super) back: Option<f64>,
    pub(super) feed: Feed,
}

impl Iso<'_> {
    /// Runs the cycle in effect at the places that the block says.
    pub(crate) fn hole_cycle(&mut self, words: &Words, report: &mut Report<'_>) {
        let across = plane_axes(self.core.state.coordinates.plane())[2];
        let declared = self.drilling_axis();
        let axis = declared.unwrap_or(across);
        self.store_hole(words, axis);
        if declared.is_none() {
            self.core.state.position.forget(across);
            let why = "a drilling cycle in another plane than G17: which axis drills, Z or that across the plane \
                       (declare [control] drilling_axis as parameter FXY says)";
            self.lost(words, 2, why, report);
            return;
        }
        if self.core.state.compensation != 0 {
            self.lost(
                words,
                axis,
                "a drilling cycle while cutter radius compensation is on (G41, G42)",
                report,
            );
            return;
        }
        if self.tip_is_led_aslant() {
            self.lost(
                words,
                axis,
                "a drilling cycle under tool centre point control with the tool not along Z: whether it drills along Z or along the tool",
                report,
            );
            return;
        }
        if let Some(why) = self.scaled_steps(axis) {
            return self.lost(words, axis, why, report);
        }
        let repeats = match words.letter(self.memory.cycle.repeats) {
            // L of a call repeats the call
            _ if words.flow && words.p.is_given() => Some(1),
            WordValue::Nothing => Some(1),
            said => said.index().filter(|&count| count <= MOST_REPEATS),
        };
        let Some(repeats) = repeats else {
            self.lost(
                words,
                axis,
                "a number of repeats that is unknown or above 10000",
                report,
            );
            return;
        };
        if repeats == 0 {
            // data only; the sources do not say whether the tool moves to the coordinates
            if (words.axes.given | words.axes.unread) & !(1 << axis) != 0 {
                self.lost(words, axis, "coordinates in a cycle with zero repeats", report);
            }
            return;
        }
        let Some(plan) = self.plan(words, axis, report) else {
            self.lost(words, axis, "", report);
            return;
        };
        let mut places = words.axes;
        places.given &= !(1 << axis);
        places.unread &= !(1 << axis);
        for _ in 0..repeats {
            if self.is_full() {
                return self.too_many(words, axis, report);
            }
            let position = self.core.state.position;
            let mut place = self.memory.frames.programmed(&position);
            let before = place;
            let others = Words {
                axes: places,
                ..Words::default()
            };
            self.place(&others, &mut place);
            if place != before || places.unread != 0 || place.known & places.given != places.given {
                self.goes(MotionKind::Rapid, place, Feed::Rapid, report);
                self.has_moved(places.given | places.unread);
            }
            self.hole(&plan, report);
        }
    }

    /// Numbers of the hole; says what is missing.
    fn plan(&mut self, words: &Words, axis: usize, report: &mut Report<'_>) -> Option<Plan> {
        let hole = self.memory.cycle.hole;
        let missing = match (hole.r, hole.bottom) {
            (Stored::Nothing, _) => Some("R, the level where the feed starts"),
            (_, Stored::Nothing) => Some("the depth of the hole"),
            _ => None,
        };
        if matches!(hole.r, Stored::Nothing) && self.core.dialect.quirks.cycle_level_optional {
            let what = format!("{} without R: the level where its feed starts", self.memory.cycle.id);
            report.fault(words.first.unwrap_or_default(), FaultKind::NotModelled { what });
            return None;
        }
        if let Some(missing) = missing {
            let message = format!(
                "{} without {missing}: program it in the block of the cycle",
                self.memory.cycle.id
            );
            self.refuse(words, Refusal::CannedCycle, message, None, report);
            return None;
        }
        let r = hole.r.from(hole.initial);
        let Some(bottom) = hole.bottom.from(r) else {
            let letter = char::from(crate::AXIS_LETTERS[axis]);
            let what = format!(
                "{}: its levels refer to {letter}, whose position is unknown here",
                self.memory.cycle.id
            );
            report.fault(words.first.unwrap_or_default(), FaultKind::NotModelled { what });
            return None;
        };
        if r.is_some_and(|r| r < bottom) && self.drills_down(axis) {
            self.upside_down(words, report);
            return None;
        }
        let feed = self.feed_of(MotionKind::Linear, words, report);
        let always_initial = self.core.state.motion == Some(Action::BackBoreCycle);
        let back = if self.core.dialect.quirks.cycle_return_unknown {
            self.level_of_return(words, r, report)
        } else if self.memory.cycle.to_r && !always_initial {
            r
        } else {
            hole.initial
        };
        let steps = matches!(self.core.state.motion, Some(Action::PeckCycle | Action::ChipBreakCycle));
        if steps && self.asks_depths(words, report) {
            return None;
        }
        if steps && hole.q.is_none_or(|q| q == 0.0) && hole.ijk[0].is_none() {
            let message = format!("{} without Q, the depth of each step", self.memory.cycle.id);
            self.refuse(words, Refusal::CannedCycle, message, Some("peck-missing"), report);
            return None;
        }
        self.asks_pecks(words, report);
        Some(Plan {
            axis,
            r,
            bottom,
            initial: hole.initial,
            back,
            feed,
        })
    }

    /// A mistake for which the control refuses the block.
    pub(crate) fn refuse(
        &self,
        words: &Words,
        refusal: Refusal,
        message: String,
        alarm: Option<&str>,
        report: &mut Report<'_>,
    ) {
        let alarm = alarm.and_then(|mistake| self.core.dialect.alarm(mistake));
        let kind = FaultKind::Rejected {
            refusal,
            message,
            alarm: alarm.map(|alarm| alarm.number.clone()),
        };
        report.fault(words.first.unwrap_or_default(), kind);
    }

    /// The block's places are not known after it.
    pub(super) fn lost(&mut self, words: &Words, axis: usize, why: &str, report: &mut Report<'_>) {
        if !why.is_empty() {
            let what = format!("{}: {why}", self.memory.cycle.id);
            report.fault(words.first.unwrap_or_default(), FaultKind::NotModelled { what });
        }
        let mut motion = self.unknown_motion(words, report);
        self.core.state.position.forget(axis);
        motion.end.forget(axis);
        self.memory.out.push(motion);
    }

    /// A motion of the drilling axis alone; an unknown target is forgotten.
    pub(super) fn down(&mut self, plan: &Plan, kind: MotionKind, to: Option<f64>, report: &Report<'_>) {
        let position = self.core.state.position;
        let here = self.memory.frames.programmed(&position);
        let mut place = here;
        match to {
            Some(to) => place.set(plan.axis, to),
            None => place.forget(plan.axis),
        }
        if place != here || to.is_none() {
            let feed = match kind {
                MotionKind::Rapid => Feed::Rapid,
                MotionKind::Unknown => Feed::Unknown,
                _ => plan.feed,
            };
            self.goes(kind, place, feed, report);
            self.has_moved(1 << plan.axis);
        }
    }

    fn wait(&mut self, seconds: Option<f64>, report: &Report<'_>) {
        if seconds.is_some_and(|seconds| seconds > 0.0) {
            self.pause(seconds, report);
        }
    }

    /// A dwell; `None`: of unknown length.
    pub(super) fn pause(&mut self, seconds: Option<f64>, report: &Report<'_>) {
        let position = self.core.state.position;
        let kind = MotionKind::Dwell(seconds);
        let motion = self.core.motion_in_frame(
            kind,
            [position, position],
            self.core.held_orientation(),
            Feed::Unknown,
            report,
        );
        self.memory.out.push(motion);
    }

    /// One hole, from the present position above it.
    fn hole(&mut self, plan: &Plan, report: &mut Report<'_>) {
        let dwell = self.memory.cycle.dwell();
        let feed_out = |interpreter: &mut Self, plan: &Plan, report: &Report<'_>| {
            interpreter.down(plan, MotionKind::Linear, plan.r, report);
            interpreter.down(plan, MotionKind::Rapid, plan.back, report);
        };
        let Some(action) = self.core.state.motion else { return };
        if action == Action::BackBoreCycle {
            self.back_bore(plan, report);
            return;
        }
        self.down(plan, MotionKind::Rapid, plan.r, report);
        let tapped = self.tap_begins(action, report);
        match action {
            Action::PeckCycle | Action::ChipBreakCycle => self.steps(plan, action, report),
            _ => self.down(plan, MotionKind::Linear, Some(plan.bottom), report),
        }
        match action {
            Action::DrillDwellCycle | Action::PeckCycle | Action::ChipBreakCycle => {
                self.wait(dwell, report);
                self.down(plan, MotionKind::Rapid, plan.back, report);
            }
            Action::TapCycle | Action::TapLeftCycle => {
                self.wait(dwell, report);
                let mut out = *plan;
                if let (Feed::PerMinute(feed), Some(times)) = (plan.feed, self.memory.cycle.hole.times) {
                    out.feed = Feed::PerMinute(feed * times);
                }
                feed_out(self, &out, report);
            }
            Action::BoreCycle => {
                self.wait(dwell, report);
                feed_out(self, plan, report);
            }
            Action::BoreStopCycle => self.with_spindle_off(|interpreter| {
                interpreter.down(plan, MotionKind::Rapid, plan.back, report);
            }),
            Action::BoreManualCycle => {
                self.wait(dwell, report);
                let what = format!("{}: the manual retract out of the hole", self.memory.cycle.id);
                report.fault(report.whole(), FaultKind::NotModelled { what });
                self.with_spindle_off(|interpreter| interpreter.down(plan, MotionKind::Unknown, plan.r, report));
                self.down(plan, MotionKind::Rapid, plan.back, report);
            }
            Action::FineBoreCycle => {
                self.wait(dwell, report);
                let aside = self.aside(plan, report);
                self.with_spindle_off(|interpreter| {
                    interpreter.shift(plan, aside, 1.0, report);
                    interpreter.down(plan, MotionKind::Rapid, plan.back, report);
                    interpreter.shift(plan, aside, -1.0, report);
                });
            }
            _ => self.down(plan, MotionKind::Rapid, plan.back, report),
        }
        if let Some(before) = tapped {
            self.tap_ends(before, report);
        }
    }

    fn with_spindle_off(&mut self, run: impl FnOnce(&mut Self)) {
        let before = self.core.state.spindle;
        self.core.state.spindle.turn(Some(false));
        run(self);
        self.core.state.spindle = before;
    }

    /// How far the tool moves off the wall, along both axes across the hole; `None`: a parameter of the control decides the direction, and
    /// it is not declared, or turned by a frame.
    fn aside(&self, plan: &Plan, report: &mut Report<'_>) -> Option<[f64; 2]> {
        let hole = &self.memory.cycle.hole;
        if let [i, j, _] = hole.ijk
            && (i.is_some() || j.is_some())
        {
            return Some([i.unwrap_or(0.0), j.unwrap_or(0.0)]);
        }
        let [a, b] = plan.across();
        let declared = self
            .core
            .setup
            .control
            .bore_shift
            .filter(|_| !self.memory.frames.active);
        if let Some(((axis, sense), q)) = declared
            .filter(|(axis, _)| [a, b].contains(axis))
            .zip(hole.q.map(f64::abs))
        {
            return Some([a, b].map(|other| if other == axis { sense * q } else { 0.0 }));
        }
        let what = format!(
            "{}: the direction in which Q moves the tool off the wall (declare [control] bore_shift)",
            self.memory.cycle.id
        );
        report.fault(report.whole(), FaultKind::NotModelled { what });
        None
    }

    /// Moves the tool off the wall (1) or back (-1).
    fn shift(&mut self, plan: &Plan, aside: Option<[f64; 2]>, sign: f64, report: &Report<'_>) {
        let [a, b] = plan.across();
        let position = self.core.state.position;
        let mut place = self.memory.frames.programmed(&position);
        let kept = self.memory.cycle.hole_place;
        match aside {
            Some(by) => {
                for (axis, by) in [(a, by[0]), (b, by[1])] {
                    if let Some(value) = place.get(axis) {
                        place.set(axis, value + sign * by);
                    }
                }
            }
            None if sign > 0.0 => {
                self.memory.cycle.hole_place = [place.get(a), place.get(b)];
                place.forget(a);
                place.forget(b);
            }
            None => {
                for (axis, value) in [(a, kept[0]), (b, kept[1])] {
                    if let Some(value) = value {
                        place.set(axis, value);
                    }
                }
            }
        }
        self.goes(MotionKind::Rapid, place, Feed::Rapid, report);
    }

    /// G87: shifted and stopped to R below, back to the axis of the hole, feed up, shifted and stopped to the initial level.
    fn back_bore(&mut self, plan: &Plan, report: &mut Report<'_>) {
        let aside = self.aside(plan, report);
        let dwell = self.memory.cycle.dwell();
        self.with_spindle_off(|interpreter| {
            interpreter.shift(plan, aside, 1.0, report);
            interpreter.down(plan, MotionKind::Rapid, plan.r, report);
            interpreter.shift(plan, aside, -1.0, report);
        });
        self.down(plan, MotionKind::Linear, Some(plan.bottom), report);
        self.wait(dwell, report);
        self.with_spindle_off(|interpreter| {
            interpreter.shift(plan, aside, 1.0, report);
            interpreter.down(plan, MotionKind::Rapid, plan.initial, report);
            interpreter.shift(plan, aside, -1.0, report);
        });
    }

    /// The target of coordinates, polar ones too, as words.
    pub(crate) fn place(&mut self, words: &Words, place: &mut Position) {
        self.targets(&words.axes, false, place);
        if self.memory.frames.active {
            if let Some(mut polar) = self.memory.frames.polar {
                polar.place(words, &self.core.state, place);
                self.memory.frames.polar = Some(polar);
            }
            self.after_turn(words, place);
        }
    }
}
