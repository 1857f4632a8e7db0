//! Drilling cycles that are called with their numbers between parentheses (Sinumerik CYCLE81 to CYCLE89), at the present position or, after
//! MCALL, after every motion.
//!
//! Order of the numbers and of the motions: Sinumerik 840D sl Programming Manual, Cycles (drilling cycles). All begin with RTP, RFP, SDIS,
//! DP, DPR: level of the retraction, level of the surface, clearance above it, depth as a coordinate, depth below the surface; if both
//! depths are given the last one is used.
use super::hole::Plan;
use super::modes::Modes;
use crate::arc::plane_axes;
use crate::codes::{BlockCodes, Found, not_modelled};
use crate::core::Report;
use crate::iso::Iso;
use crate::words::Words;
use crate::{Argument, Effect, FaultKind, Feed, Motion, MotionKind, Refusal};
use std::sync::Arc;
use trunnion_dialect::Plane;
use trunnion_syntax::TextRange;

/// One number of a call.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Given {
    /// Left out.
    Nothing,
    /// A number.
    Number(f64),
    /// Something that is not evaluated.
    Unread,
}

impl Given {
    /// The number; 0 where it is left out.
    pub(super) fn or_zero(self) -> Option<f64> {
        match self {
            Self::Nothing => Some(0.0),
            Self::Number(number) => Some(number),
            Self::Unread => None,
        }
    }
}

/// What a cycle does in the hole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sort {
    /// CYCLE81, CYCLE82: down, dwell, rapid out.
    Drill,
    /// CYCLE83: in steps.
    Deep,
    /// CYCLE84: rigid tap.
    Tap,
    /// CYCLE840: tap with a compensating chuck.
    FloatingTap,
    /// CYCLE85: feed of its own in and out.
    Ream,
    /// CYCLE86: oriented, lifted off, out.
    Bore,
    /// CYCLE87, CYCLE88: stop at the bottom, out after the start button.
    BoreStop,
    /// CYCLE89: feed in and out.
    BoreFeed,
}

/// The cycles, and how many of their numbers are known here.
const CYCLES: [(&str, Sort, usize); 10] = [
    ("CYCLE81", Sort::Drill, 6),
    ("CYCLE82", Sort::Drill, 6),
    ("CYCLE83", Sort::Deep, 17),
    ("CYCLE84", Sort::Tap, 18),
    ("CYCLE840", Sort::FloatingTap, 12),
    ("CYCLE85", Sort::Ream, 8),
    ("CYCLE86", Sort::Bore, 11),
    ("CYCLE87", Sort::BoreStop, 6),
    ("CYCLE88", Sort::BoreStop, 7),
    ("CYCLE89", Sort::BoreFeed, 6),
];

/// A cycle with its numbers.
#[derive(Clone, Debug)]
pub(crate) struct HoleCall {
    pub(super) id: &'static str,
    pub(super) sort: Sort,
    numbers: Vec<Given>,
    /// It has numbers that have no meaning here.
    further: bool,
    /// The modes at the end that newer posts write.
    pub(super) modes: Modes,
    /// The call as it is compared where its motions are not known.
    pub(crate) said: Argument,
}

impl HoleCall {
    /// The call of a cycle; `None`: none of those that are known.
    pub(crate) fn new(id: &str, numbers: Vec<Given>, said: Argument) -> Option<Self> {
        let (id, sort, known) = *CYCLES.iter().find(|(name, ..)| *name == id)?;
        let modes = Modes::of(id, &numbers);
        let known = known + if modes == Modes::None { 0 } else { Modes::COUNT };
        let rest = numbers.get(known..).unwrap_or_default();
        let further = rest.iter().any(|given| given.or_zero() != Some(0.0));
        Some(Self {
            id,
            sort,
            numbers,
            further,
            modes,
            said,
        })
    }
    /// Where _AXN is.
    fn axis_place(&self) -> usize {
        if self.sort == Sort::FloatingTap { 11 } else { 12 }
    }
    pub(super) fn number(&self, place: usize) -> Given {
        self.numbers.get(place).copied().unwrap_or(Given::Nothing)
    }
}

impl Iso<'_> {
    /// A cycle with its numbers in the block, or after the block's motion under MCALL, which is then emitted before it.
    pub(crate) fn called_cycle(
        &mut self,
        codes: &[Found<'_>],
        words: &Words,
        block: &BlockCodes,
        motion: &mut Option<Motion>,
        report: &mut Report<'_>,
    ) {
        if let Some(found) = block.hole_call.and_then(|at| codes.get(at)) {
            if !block.modal_call && self.modal_call_unclear(found, report) {
                return;
            }
            let text = report.program.text(found.range);
            let numbers = self.call_numbers(&text);
            if !block.modal_call && self.hole_row(found, &numbers, words, report) {
                return;
            }
            let said = crate::written::hole_call_argument(&found.code.id, &crate::written::resolved(self, &text));
            let call = HoleCall::new(&found.code.id, numbers, said).filter(|_| !words.axes.any());
            let Some(call) = call else {
                not_modelled(found, report);
                self.core.forget_position();
                return;
            };
            if block.modal_call {
                self.memory.cycle.call = Some(Arc::new(call));
            } else {
                self.run_call(&call, words, report);
            }
            return;
        }
        if motion.is_none() && self.core.dialect.quirks.declares_names() {
            let acts = self.memory.cycle.call.is_some() || self.memory.own.modal.is_some();
            if acts && self.acts_without_motion(codes, words) {
                self.memory.own.acts_again = true;
                if let Some(call) = self.memory.cycle.call.clone() {
                    self.memory.own.acts_again = false;
                    self.run_call(&call, words, report);
                }
                return;
            }
        }
        let moved = motion
            .as_ref()
            .filter(|motion| !matches!(motion.kind, MotionKind::Dwell(_)));
        if let (Some(call), Some(moved)) = (self.memory.cycle.call.clone(), moved) {
            self.memory.out.push(*moved);
            *motion = None;
            self.run_call(&call, words, report);
        }
    }

    /// The text in the parentheses of a call.
    fn call_numbers(&self, text: &str) -> Vec<Given> {
        let Some(inside) = text
            .split_once('(')
            .map(|(_, rest)| rest.trim_end().trim_end_matches(')'))
        else {
            return Vec::new();
        };
        if inside.contains(['"', '(']) {
            // nested commas are not distinguished
            return vec![Given::Unread; 5];
        }
        inside
            .split(',')
            .map(|one| match (one.trim(), one.trim().parse::<f64>()) {
                ("", _) => Given::Nothing,
                (_, Ok(number)) if number.abs() <= crate::reader::LARGEST => Given::Number(number),
                (one, _) => self.memory.own.value(one).map_or(Given::Unread, Given::Number),
            })
            .collect()
    }

    /// The cycle is not worked out: the linear axes move on an unknown way to an unknown place.
    fn call_is_lost(&mut self, kind: FaultKind, report: &mut Report<'_>) {
        report.fault(TextRange::default(), kind);
        let mut motion = self.unknown_motion(&Words::default(), report);
        motion.end.known &= !crate::core::LINEAR;
        self.core.forget_linear();
        self.memory.out.push(motion);
    }

    /// Runs a cycle at the present position.
    pub(super) fn run_call(&mut self, call: &HoleCall, words: &Words, report: &mut Report<'_>) {
        if self.is_full() {
            let what = format!("{}: {}", call.id, self.full());
            return self.call_is_lost(FaultKind::NotModelled { what }, report);
        }
        let axis = plane_axes(self.core.state.coordinates.plane())[2];
        let other_axis = match call.sort {
            // _AXN 3 is the third geometry axis, as 0 is: Z
            Sort::Deep | Sort::Tap | Sort::FloatingTap => !match call.number(call.axis_place()).or_zero() {
                Some(axis) => axis == 0.0 || axis == 3.0 && self.core.state.coordinates.plane() == Plane::Xy,
                None => false,
            },
            _ => false,
        } || axis == 0 && self.program_sets_diameters();
        let other_mode = match call.modes {
            Modes::None => false,
            Modes::Depth { plane, .. } => plane.is_some_and(|plane| plane != self.core.state.coordinates.plane()),
            Modes::Other => true,
        };
        let why = if call.further || other_axis || other_mode {
            Some("with numbers that select other meanings")
        } else if call.levels().is_none() {
            Some("without known levels that make a hole")
        } else {
            None
        };
        if call.makes_no_hole() && !call.further && !other_axis && !other_mode {
            return;
        }
        let Some([retract, begin, bottom]) = call.levels().filter(|_| why.is_none()) else {
            let wrong = call
                .wrong_level()
                .filter(|_| !call.further && !other_axis && !other_mode);
            let kind = match wrong {
                Some((message, alarm)) => FaultKind::Rejected {
                    refusal: Refusal::CannedCycle,
                    message,
                    alarm: alarm.map(str::to_owned),
                },
                None => FaultKind::NotModelled {
                    what: format!("{} {}", call.id, why.unwrap_or_default()),
                },
            };
            return self.call_is_lost(kind, report);
        };
        let unit = self.core.state.coordinates.unit_mm();
        let feed = self.call_feed(call, words, report);
        let plan = Plan {
            axis,
            r: Some(begin * unit),
            bottom: bottom * unit,
            initial: None,
            back: Some(retract * unit),
            feed,
        };
        self.call_spindle(call);
        self.down(&plan, MotionKind::Rapid, plan.r, report);
        self.in_hole(call, &plan, report);
        if matches!(call.sort, Sort::Tap | Sort::FloatingTap) {
            // direction after the cycle: 3, 4, otherwise the spindle is off
            let after = call.number(if call.sort == Sort::Tap { 6 } else { 7 }).or_zero();
            match after {
                Some(code) => self.core.state.spindle.switch(code == 3.0 || code == 4.0),
                None => self.core.state.spindle.lose(),
            }
            let to = after.map(|code| match code {
                3.0 => "M3",
                4.0 => "M4",
                _ => "M5",
            });
            self.spindle_after_call(to, report);
            // at which speed it turns after the speed of the tap, no source says
            if call.sort == Sort::Tap && self.core.effects.wanted() {
                let block = self.core.main_block(report.block);
                self.core.effects.add(block, Effect::left("speed"));
            }
        }
        match call.sort {
            Sort::Bore => self.spindle_after_call(Some("M5"), report),
            // M5 and M0 at the bottom: what the operator does there is not in the program
            Sort::BoreStop => self.spindle_after_call(None, report),
            _ => {}
        }
    }

    /// What the spindle does after a cycle that switches it; `None`: not known.
    fn spindle_after_call(&mut self, to: Option<&'static str>, report: &Report<'_>) {
        if self.core.effects.wanted() {
            let block = self.core.main_block(report.block);
            self.core.effects.add(
                block,
                match to {
                    Some(code) => Effect::set("spindle", [Argument::code(code)]),
                    None => Effect::left("spindle"),
                },
            );
        }
    }

    fn in_hole(&mut self, call: &HoleCall, plan: &Plan, report: &mut Report<'_>) {
        if call.sort == Sort::Deep && call.modes == Modes::None && self.deep_steps(call, plan, report) {
            self.down(plan, MotionKind::Rapid, plan.back, report);
            return;
        }
        let steps = match call.sort {
            Sort::Deep => true,
            Sort::Tap => call.number(15).or_zero() != Some(0.0),
            _ => false,
        };
        if steps {
            let full = self.is_full().then(|| format!(" ({})", self.full()));
            let what = format!("{}: the steps in the hole{}", call.id, full.unwrap_or_default());
            report.fault(TextRange::default(), FaultKind::NotModelled { what });
            self.down(plan, MotionKind::Unknown, Some(plan.bottom), report);
        } else {
            self.down(plan, MotionKind::Linear, Some(plan.bottom), report);
        }
        if call.id != "CYCLE87" {
            self.wait_at_bottom(
                call.number(if steps && call.sort == Sort::Deep { 8 } else { 5 }),
                report,
            );
        }
        match call.sort {
            Sort::Drill | Sort::Deep => {}
            Sort::Tap => self.out_of_thread(call, plan, report),
            Sort::FloatingTap | Sort::BoreFeed => self.down(plan, MotionKind::Linear, plan.r, report),
            Sort::Ream => {
                let out = Plan {
                    feed: self.own_feed(call.number(7)),
                    ..*plan
                };
                self.down(&out, MotionKind::Linear, plan.r, report);
            }
            Sort::Bore => {
                self.core.state.spindle.turn(Some(false));
                self.lift_off(call, 1.0, report);
                self.down(plan, MotionKind::Rapid, plan.back, report);
                self.lift_off(call, -1.0, report);
                return;
            }
            Sort::BoreStop => self.core.state.spindle.turn(Some(false)),
        }
        self.down(plan, MotionKind::Rapid, plan.back, report);
        if call.sort == Sort::BoreStop {
            // it stood at the bottom, and nothing in the program starts it again
            self.core.state.spindle.turn(Some(true));
            self.core.state.spindle.leave_to_machine();
        }
    }

    /// CYCLE86: RPA, RPO and RPAP off the wall (1), and RPA and RPO back over the hole (-1).
    fn lift_off(&mut self, call: &HoleCall, sign: f64, report: &mut Report<'_>) {
        let axes = plane_axes(self.core.state.coordinates.plane());
        let position = self.core.state.position;
        let before = self.memory.frames.programmed(&position);
        let mut place = before;
        for (number, axis) in [(7, axes[0]), (8, axes[1]), (9, axes[2])] {
            if number == 9 && sign < 0.0 {
                continue;
            }
            match (call.number(number).or_zero(), place.get(axis)) {
                (Some(by), Some(at)) => place.set(axis, at + sign * by * self.core.state.coordinates.unit_mm()),
                _ => place.forget(axis),
            }
        }
        if place != before {
            self.goes(MotionKind::Rapid, place, Feed::Rapid, report);
        }
    }

    /// DTB: seconds; turns of the spindle where it is negative.
    pub(super) fn wait_at_bottom(&mut self, given: Given, report: &Report<'_>) {
        let seconds = match given {
            Given::Nothing => return,
            Given::Number(seconds) if seconds >= 0.0 => Some(seconds),
            Given::Number(turns) => self.core.state.spindle.rpm().map(|rpm| -turns / rpm * 60.0),
            Given::Unread => None,
        };
        if seconds != Some(0.0) {
            self.pause(seconds, report);
        }
    }
}
