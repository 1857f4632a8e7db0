//! Turning cycles of many cuts: G70 to G73 and G76 of systems A and B, G72 to G75 and G78 of system C.
//!
//! Sources: Fanuc Series 30i operator's manual, lathe system, multiple repetitive cycles; Adtech CNC4620 programming manual, sections 3.6.1
//! to 3.6.6 (the same cycles, with the order of their motions). G70 runs along the contour and returns to its start in rapid. G73 runs along
//! the contour as often as R gives, each time nearer to it, and goes to the start of the next run in rapid. G71 and G72: `rough.rs`; G74 and
//! G75: `groove.rs`; G76: `thread.rs`.
use super::contour::{Contour, shifted};
use super::rough::Roughing;
use super::thread::Thread;
use crate::codes::Found;
use crate::core::Report;
use crate::iso::Iso;
use crate::words::Words;
use crate::{FaultKind, Feed, Motion, MotionKind, Position};
use trunnion_dialect::Action;

const X: usize = 0;
const Z: usize = 2;
/// Runs of G73.
const MOST_RUNS: u32 = 10_000;

/// What the first block of a cycle in two blocks keeps for the second, mm.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Kept {
    /// G73: distance of the first run from the last, X as a radius, and Z.
    relief: Option<[f64; 2]>,
    /// G73: number of runs.
    runs: Option<u32>,
    /// G74, G75: how far the tool goes back after each step.
    pub(super) lift: Option<f64>,
    /// G71, G72.
    pub(super) roughing: Roughing,
    /// G76.
    pub(super) thread: Thread,
}

impl Kept {
    /// All of it, NaN where it is not given; empty where nothing is.
    pub(super) fn numbers(&self) -> Vec<f64> {
        let [x, z] = self.relief.map_or([None; 2], |relief| relief.map(Some));
        let own = [x, z, self.runs.map(f64::from), self.lift];
        let all = own
            .into_iter()
            .chain(self.roughing.numbers())
            .chain(self.thread.numbers());
        if all.clone().all(|value| value.is_none()) {
            return Vec::new();
        }
        all.map(|value| value.unwrap_or(f64::NAN)).collect()
    }
}

/// A cycle in the current block.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Repeated {
    pub(crate) action: Action,
}

impl Repeated {
    /// Whether all of X, Z, U, W and R in a block of the cycle are lengths (R of the first block of G73 counts).
    pub(crate) fn has_coordinates(self, words: &Words) -> bool {
        match self.action {
            Action::PatternRepeatCycle => words.p.is_given(),
            Action::FinishCycle => false,
            _ => true,
        }
    }
}

impl Iso<'_> {
    /// Takes the cycle of a block; its coordinates are its own.
    pub(crate) fn take_repeated(&mut self, found: &Found<'_>) -> Repeated {
        self.memory.cycle.id.clone_from(&found.code.id);
        Repeated {
            action: found.code.action,
        }
    }

    /// Runs the cycle, or keeps the data of its first block.
    pub(crate) fn repeated_cycle(&mut self, repeated: Repeated, words: &Words, report: &mut Report<'_>) {
        if self.memory.in_contour {
            let what = format!("{} inside the contour of a cycle", self.memory.cycle.id);
            report.fault(report.whole(), FaultKind::NotModelled { what });
            self.core.forget_linear();
            return;
        }
        // the first of two blocks makes no motion
        let runs = words.axes.any() || words.p.is_given();
        if runs && self.is_full() {
            let what = format!("{}: {}", self.memory.cycle.id, self.full());
            return self.unknown_path_to_start(&what, self.core.state.position, report);
        }
        match repeated.action {
            Action::FacePeckCycle | Action::GroovePeckCycle => self.peck_groove(repeated.action, words, report),
            Action::ThreadRepeatCycle => self.thread_repeat(words, report),
            Action::FinishCycle => self.along_contour(repeated.action, words, report),
            _ if !words.p.is_given() && !words.letter(b'Q').is_given() => self.keep_repeat(repeated.action, words),
            _ => self.along_contour(repeated.action, words, report),
        }
    }

    /// The first block of G71, G72, G73.
    fn keep_repeat(&mut self, action: Action, words: &Words) {
        if action != Action::PatternRepeatCycle {
            return self.keep_roughing(action, words);
        }
        let relief = self.lengths(words);
        let runs = words.letter(b'R').number().map(|number| number.value);
        let kept = &mut self.memory.cycle.kept;
        kept.relief = relief;
        kept.runs = runs
            .filter(|runs| runs.fract() == 0.0 && (1.0..=f64::from(MOST_RUNS)).contains(runs))
            .map(|runs| runs as u32);
    }

    fn along_contour(&mut self, action: Action, words: &Words, report: &mut Report<'_>) {
        let start = self.core.state.position;
        let Some(contour) = self.contour(words, report) else {
            self.nowhere(start, report);
            return;
        };
        if contour.follows {
            // after its contour the control continues; G70 continues with the next block
            if action != Action::FinishCycle {
                self.memory.passed_over = Some((report.block.0, contour.last));
            }
        } else if action != Action::FinishCycle {
            let what = format!(
                "{}: where the program continues if its contour does not follow it directly",
                self.memory.cycle.id
            );
            report.fault(report.whole(), FaultKind::NotModelled { what });
        }
        match action {
            Action::FinishCycle => self.finish_contour(contour, start, report),
            Action::PatternRepeatCycle => self.pattern_repeat(&contour, start, words, report),
            _ => self.rough(action, &contour, start, words, report),
        }
    }

    /// G70: along the contour with its own feeds, then back.
    fn finish_contour(&mut self, contour: Contour, start: Position, report: &Report<'_>) {
        for mut motion in contour.motions {
            motion.block = self.core.main_block(report.block);
            self.core.state.position = motion.end;
            self.memory.out.push(motion);
        }
        self.rapid_straight(start, report);
        if contour.feed != self.core.state.feed.value() {
            // the sources do not say whether F of the contour stays
            self.core.state.feed.set(None);
            self.core.feed_unread = true;
        }
    }

    /// G73: along the contour, each run nearer by the same step.
    fn pattern_repeat(&mut self, contour: &Contour, start: Position, words: &Words, report: &mut Report<'_>) {
        let kept = self.memory.cycle.kept;
        let in_one = words.letter(b'D').is_given();
        let (relief, runs) = if in_one {
            self.pattern_in_one(words)
        } else {
            (kept.relief, kept.runs)
        };
        let (Some([x, z]), Some(runs @ 2..)) = (relief, runs) else {
            let what = format!(
                "{} without {}",
                self.memory.cycle.id,
                if in_one {
                    "known I and K and at least two passes (D)"
                } else {
                    "U, W and at least two passes (R of its first block)"
                }
            );
            return self.unknown_path_to_start(&what, start, report);
        };
        let Some(allowance) = self.allowance(words) else {
            let what = format!("{} with an unknown allowance", self.memory.cycle.id);
            return self.unknown_path_to_start(&what, start, report);
        };
        let feed = self.feed_of(MotionKind::Linear, words, report);
        for run in 0..runs {
            if self.is_full() {
                let what = format!("{}: {}", self.memory.cycle.id, self.full());
                return self.unknown_path_to_start(&what, start, report);
            }
            let left = 1.0 - f64::from(run) / f64::from(runs - 1);
            let by = [allowance[0] + x * left, allowance[1] + z * left];
            let mut from = start;
            from.values[X] += by[0];
            from.values[Z] += by[1];
            self.rapid_straight(from, report);
            self.along(&contour.motions, by, feed, report);
        }
        self.rapid_straight(start, report);
    }

    /// G73 in one block (Haas; Fanuc Series 10/11 format): I and K the distance of the first run from the last, D the number of runs.
    fn pattern_in_one(&self, words: &Words) -> (Option<[f64; 2]>, Option<u32>) {
        let length = |letter| match self.length_word(words, letter) {
            None if words.letter(letter).is_given() => None,
            length => Some(length.unwrap_or(0.0)),
        };
        let relief = length(b'I').zip(length(b'K')).map(|(x, z)| [x, z]);
        let runs = words.letter(b'D').index().filter(|runs| (1..=MOST_RUNS).contains(runs));
        (relief, runs)
    }

    /// Along a contour that is moved by X and Z, mm: F, S and M of its blocks are ignored, those of the cycle apply.
    pub(super) fn along(&mut self, motions: &[Motion], by: [f64; 2], feed: Feed, report: &Report<'_>) {
        for motion in motions {
            let mut motion = shifted(motion, by[0], by[1]);
            motion.block = self.core.main_block(report.block);
            self.core.spindle_of(&mut motion);
            if motion.kind != MotionKind::Rapid {
                motion.feed = feed;
            }
            self.core.state.position = motion.end;
            self.memory.out.push(motion);
        }
    }

    /// U (a diameter) and W of the block with P and Q: what is left for finishing, mm in X (radius) and Z; `None`: unknown.
    pub(super) fn allowance(&self, words: &Words) -> Option<[f64; 2]> {
        let diameter = self.distances_are_diameters();
        let [x, z] = self.lengths(words)?;
        Some([x * if diameter { 0.5 } else { 1.0 }, z])
    }

    /// U and W, mm; 0 where they are not programmed, `None` where one of them is unknown.
    fn lengths(&self, words: &Words) -> Option<[f64; 2]> {
        let length = |letter| match self.length_word(words, letter) {
            None if words.letter(letter).is_given() => None,
            length => Some(length.unwrap_or(0.0)),
        };
        Some([length(b'U')?, length(b'W')?])
    }

    /// The path of a cycle is unknown; it ends where it began.
    pub(super) fn unknown_path_to_start(&mut self, what: &str, start: Position, report: &mut Report<'_>) {
        report.fault(report.whole(), FaultKind::NotModelled { what: what.to_owned() });
        let orientation = self.core.held_orientation();
        // a cycle that stops half way has already moved the tool
        let from = std::mem::replace(&mut self.core.state.position, start);
        let motion = self
            .core
            .motion_in_frame(MotionKind::Unknown, [from, start], orientation, Feed::Unknown, report);
        self.memory.out.push(motion);
    }

    /// Both the path and the end of a cycle are unknown.
    pub(super) fn nowhere(&mut self, start: Position, report: &Report<'_>) {
        self.core.forget_linear();
        let end = self.core.state.position;
        let orientation = self.core.held_orientation();
        let motion = self
            .core
            .new_motion(MotionKind::Unknown, start, end, orientation, Feed::Unknown, report);
        self.memory.out.push(motion);
    }

    pub(super) fn rapid_straight(&mut self, to: Position, report: &Report<'_>) {
        if self.core.state.position != to {
            self.goes(MotionKind::Rapid, to, Feed::Rapid, report);
        }
    }
}
