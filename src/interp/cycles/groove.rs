//! Pecking on a lathe: G74 along Z and G75 along X (G76 and G77 of system C).
//!
//! Steps of Q (Z) or P (X) with a lift after each, back in rapid to where the cut began, aside by P or Q, again until the end is
//! reached; the end is back at the start. P and Q are radii in least increments, without sign. Sources: Fanuc Series 30i operator's manual,
//! lathe system; Adtech CNC4620 programming manual, sections 3.6.5 and 3.6.6. Whether the first cut is relieved at its bottom (R of the second block) is
//! described differently, so that is unknown.
use crate::core::Report;
use crate::iso::Iso;
use crate::words::{WordValue, Words};
use crate::{FaultKind, Feed, MotionKind, Position, Refusal};
use trunnion_dialect::Action;

const X: usize = 0;
const Z: usize = 2;
/// Steps and cuts of one cycle.
const MOST: f64 = 10_000.0;

/// Where a cycle pecks to and how far it goes aside.
struct Grooves {
    start: Position,
    /// The axis of the cut, and the one aside.
    axes: [usize; 2],
    /// Ends of both, mm.
    ends: [f64; 2],
    /// Steps of both; the axis aside may have none.
    steps: [f64; 2],
    lift: Option<f64>,
    feed: Feed,
}

/// How a block writes its steps.
struct GrooveWords {
    in_one: bool,
    /// Of the cut, and aside.
    letters: [u8; 2],
    /// mm.
    steps: [Option<f64>; 2],
    relief: WordValue,
}

impl Iso<'_> {
    /// G74 and G75: the first of two blocks says the lift, the second the rest.
    pub(super) fn peck_groove(&mut self, action: Action, words: &Words, report: &mut Report<'_>) {
        if !words.axes.any() {
            if words.radius.is_given() {
                self.memory.cycle.kept.lift = self.length_word(words, b'R').map(f64::abs);
            }
            return;
        }
        let start = self.core.state.position;
        let mut end = start;
        self.targets(&words.axes, false, &mut end);
        let axes = if action == Action::FacePeckCycle {
            [Z, X]
        } else {
            [X, Z]
        };
        let named = |axis: usize| (words.axes.given | words.axes.unread) & (1 << axis) != 0;
        let GrooveWords {
            in_one,
            letters,
            steps,
            relief,
        } = self.groove_words(action, words);
        let unread = in_one && (0..2).any(|place| steps[place].is_none() && words.letter(letters[place]).is_given());
        if !named(axes[0]) || !unread && steps[0].is_none_or(|step| step == 0.0) && words.letter(letters[0]).is_given()
        {
            let message = format!(
                "{} without the end of its cut, or with a step of 0",
                self.memory.cycle.id
            );
            self.refuse(words, Refusal::CannedCycle, message, None, report);
            // steps of 0 never reach the end
            return self.nowhere(start, report);
        }
        let feed = self.feed_of(MotionKind::Linear, words, report);
        let known = axes
            .iter()
            .all(|&axis| start.get(axis).is_some() && end.get(axis).is_some());
        let relieved = relief.is_given() && relief.number().is_none_or(|number| number.value != 0.0);
        let control = self.core.setup.control.chip_break_retract_mm;
        let lift = if in_one { control } else { self.memory.cycle.kept.lift };
        let way = |place: usize| (end.values[axes[place]] - start.values[axes[place]]).abs();
        let count = |place: usize| way(place) / steps[place].filter(|step| *step > 0.0).unwrap_or(f64::MAX);
        let why = if unread {
            Some("with a step (I, K) without a decimal point")
        } else if self.memory.frames.active || self.core.state.zero.is_lost() || !known {
            Some("from or to an unknown position")
        } else if relieved {
            Some("with a relief at the bottom (R, in one block D)")
        } else if in_one && lift.is_none() && count(0) > 1.0 + 1e-9 {
            Some(
                "in the format in one block: how far the tool goes back after each step (declare [control] chip_break_retract: Haas setting 22)",
            )
        } else if way(1) > 0.0 && steps[1].is_none_or(|step| step == 0.0) {
            Some("with a sideways move and no step for it")
        } else if count(0).max(1.0) * (count(1) + 1.0) > MOST {
            Some("with more than 10000 steps")
        } else {
            None
        };
        if let Some(why) = why {
            let what = format!("{} {why}", self.memory.cycle.id);
            if known {
                return self.unknown_path_to_start(&what, start, report);
            }
            report.fault(report.whole(), FaultKind::NotModelled { what });
            return self.nowhere(start, report);
        }
        let grooves = Grooves {
            start,
            axes,
            ends: axes.map(|axis| end.values[axis]),
            steps: [steps[0].unwrap_or(f64::MAX), steps[1].unwrap_or(0.0)],
            lift,
            feed,
        };
        self.grooves(&grooves, report);
    }

    /// Two blocks: P and Q, a radius and a length; in one block (Haas; Fanuc Series 10/11 format) I is the step of X as a radius, K that
    /// of Z, D the relief.
    fn groove_words(&self, action: Action, words: &Words) -> GrooveWords {
        let in_one = [b'I', b'K', b'D'].iter().any(|&letter| words.letter(letter).is_given());
        let mut letters = if in_one { [b'I', b'K'] } else { [b'P', b'Q'] };
        if action == Action::FacePeckCycle {
            letters.reverse();
        }
        let step = |letter| {
            if in_one {
                self.one_block_length(words, letter).map(f64::abs)
            } else {
                self.increment_word(words, letter)
            }
        };
        GrooveWords {
            in_one,
            letters,
            steps: letters.map(step),
            relief: if in_one { words.letter(b'D') } else { words.radius },
        }
    }

    fn grooves(&mut self, grooves: &Grooves, report: &Report<'_>) {
        let [cut, aside] = grooves.axes;
        let mut place = grooves.start;
        loop {
            self.pecks(grooves, report);
            place.set(cut, grooves.start.values[cut]);
            self.rapid_straight(place, report);
            let left = grooves.ends[1] - place.values[aside];
            if left.abs() <= 1e-9 {
                break;
            }
            let next = if left.abs() <= grooves.steps[1] + 1e-9 {
                grooves.ends[1]
            } else {
                place.values[aside] + left.signum() * grooves.steps[1]
            };
            place.set(aside, next);
            self.rapid_straight(place, report);
        }
        self.rapid_straight(grooves.start, report);
    }

    /// From the present position down to the end, in steps.
    fn pecks(&mut self, grooves: &Grooves, report: &Report<'_>) {
        let axis = grooves.axes[0];
        let from = self.core.state.position.values[axis];
        let way = grooves.ends[0] - from;
        let mut done = 0.0;
        let to = |interpreter: &mut Self, kind, value: Option<f64>| {
            let mut place = interpreter.core.state.position;
            match value {
                Some(value) => place.set(axis, value),
                None => place.forget(axis),
            }
            let feed = if kind == MotionKind::Rapid {
                Feed::Rapid
            } else {
                grooves.feed
            };
            interpreter.goes(kind, place, feed, report);
        };
        loop {
            done += grooves.steps[0];
            if done >= way.abs() - 1e-9 {
                to(self, MotionKind::Linear, Some(grooves.ends[0]));
                return;
            }
            let depth = from + way.signum() * done;
            to(self, MotionKind::Linear, Some(depth));
            let lifted = grooves.lift.map(|lift| depth - way.signum() * lift);
            to(self, MotionKind::Rapid, lifted);
        }
    }

    /// P or Q of these cycles, mm: least increments (0.001 mm, 0.0001 inch) where it has no decimal point.
    pub(super) fn increment_word(&self, words: &Words, letter: u8) -> Option<f64> {
        let number = words.letter(letter).number()?;
        let unit = self.core.state.coordinates.unit_mm();
        let least = if unit == 1.0 { 0.001 } else { 0.0001 };
        Some((number.value * if number.has_point { unit } else { least * unit }).abs())
    }
}
