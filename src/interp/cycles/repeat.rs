//! Turning cycles of many cuts: G70 to G73 and G76 of systems A and B, G72 to G75 and G78 of system C.
//!
//! Sources: Fanuc Series 30i operator's manual, lathe system, multiple repetitive cycles; Adtech CNC4620 programming manual, sections 3.6.1
//! to 3.6.6 (the same cycles, with the order of their motions); Robur concise guide to Fanuc lathe cycles, G71 and G72. G70 runs along the
//! contour and returns to its start in rapid. G73 runs along the contour as often as R says, each time nearer to it, and goes to the start
//! of the next run in rapid. Of G71, G72 and G76 these sources agree on where they end, and not on the levels and lifts between: their path is unknown.
use super::contour::{Contour, shifted};
use super::hole::MOST_MOTIONS;
use crate::codes::Found;
use crate::run::{Interpreter, Report};
use crate::words::Words;
use crate::{FaultKind, Feed, MotionKind, Position, Refusal};
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
}

/// A cycle in the block in hand.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Repeated {
    pub(crate) action: Action,
}

impl Repeated {
    /// Whether X, Z and R of the cycle are lengths (R of G73 counts).
    pub(crate) fn has_coordinates(self) -> bool {
        matches!(
            self.action,
            Action::FacePeckCycle | Action::GroovePeckCycle | Action::ThreadRepeatCycle
        )
    }
}

impl Interpreter<'_> {
    /// Takes the cycle of a block; its coordinates are its own.
    pub(crate) fn take_repeated(&mut self, found: &Found<'_>) -> Repeated {
        self.memory.cycle.id.clone_from(&found.code.id);
        Repeated {
            action: found.code.action,
        }
    }

    /// Runs the cycle, or keeps what its first block says.
    pub(crate) fn repeated_cycle(&mut self, repeated: Repeated, words: &Words, report: &mut Report<'_>) {
        if self.memory.in_contour {
            let what = format!("{} inside the contour of a cycle", self.memory.cycle.id);
            report.fault(report.whole(), FaultKind::NotModelled { what });
            self.forget_linear();
            return;
        }
        match repeated.action {
            Action::FacePeckCycle | Action::GroovePeckCycle => self.peck_groove(repeated.action, words, report),
            Action::ThreadRepeatCycle => self.thread_repeat(words, report),
            Action::FinishCycle => self.along_contour(repeated.action, words, report),
            _ if !words.p.is_said() && !words.letter(b'Q').is_said() => self.keep_repeat(words),
            _ => self.along_contour(repeated.action, words, report),
        }
    }

    /// The first block of G71, G72, G73.
    fn keep_repeat(&mut self, words: &Words) {
        let length = |letter| self.length_word(words, letter).unwrap_or(0.0);
        let relief = [length(b'U'), length(b'W')];
        let runs = words.letter(b'R').number().map(|number| number.value);
        let kept = &mut self.memory.cycle.kept;
        kept.relief = Some(relief);
        kept.runs = runs
            .filter(|runs| runs.fract() == 0.0 && (1.0..=f64::from(MOST_RUNS)).contains(runs))
            .map(|runs| runs as u32);
    }

    fn along_contour(&mut self, action: Action, words: &Words, report: &mut Report<'_>) {
        let start = self.state.position;
        let Some(contour) = self.contour(words, report) else {
            self.nowhere(start, report);
            return;
        };
        if contour.follows {
            // behind its contour the control goes on; G70 goes on with the next block
            if action != Action::FinishCycle {
                self.memory.passed_over = Some((report.block.0, contour.last));
            }
        } else if action != Action::FinishCycle {
            let what = format!(
                "{}: where the program goes on when its contour does not follow it at once",
                self.memory.cycle.id
            );
            report.fault(report.whole(), FaultKind::NotModelled { what });
        }
        match action {
            Action::FinishCycle => self.finish_contour(contour, start, report),
            Action::PatternRepeatCycle => self.pattern_repeat(&contour, start, words, report),
            _ => {
                self.roughing_mistakes(action, &contour, words, report);
                self.feed_of(MotionKind::Linear, words, report);
                let what = format!(
                    "{}: levels and lifts of its cuts; it ends where it began",
                    self.memory.cycle.id
                );
                self.somehow_back(&what, start, report);
            }
        }
    }

    /// G70: along the contour with its own feeds, then back.
    fn finish_contour(&mut self, contour: Contour, start: Position, report: &Report<'_>) {
        for mut motion in contour.motions {
            motion.block = self.flow.main_block(report.block);
            self.state.position = motion.end;
            self.memory.out.push(motion);
        }
        self.rapid_straight(start, report);
        if contour.feed != self.state.feed {
            // whether F of the contour stays is not told
            self.state.feed = None;
            self.memory.feed_unread = true;
        }
    }

    /// G73: along the contour, each run nearer by the same step.
    fn pattern_repeat(&mut self, contour: &Contour, start: Position, words: &Words, report: &mut Report<'_>) {
        let allowance = self.allowance(words);
        let kept = self.memory.cycle.kept;
        let (Some([x, z]), Some(runs @ 2..)) = (kept.relief, kept.runs) else {
            let what = format!(
                "{} without two runs or more (R of its first block)",
                self.memory.cycle.id
            );
            return self.somehow_back(&what, start, report);
        };
        let feed = self.feed_of(MotionKind::Linear, words, report);
        for run in 0..runs {
            if self.is_full() {
                let what = format!(
                    "{}: more than {MOST_MOTIONS} motions in one block",
                    self.memory.cycle.id
                );
                return self.somehow_back(&what, start, report);
            }
            let left = 1.0 - f64::from(run) / f64::from(runs - 1);
            let by = [allowance[0] + x * left, allowance[1] + z * left];
            let mut from = start;
            from.values[X] += by[0];
            from.values[Z] += by[1];
            self.rapid_straight(from, report);
            for motion in &contour.motions {
                let mut motion = shifted(motion, by[0], by[1]);
                motion.block = self.flow.main_block(report.block);
                if motion.kind != MotionKind::Rapid {
                    motion.feed = feed;
                }
                self.state.position = motion.end;
                self.memory.out.push(motion);
            }
        }
        self.rapid_straight(start, report);
    }

    /// U (a diameter) and W of the block with P and Q: what is left for finishing, mm in X (radius) and Z.
    fn allowance(&self, words: &Words) -> [f64; 2] {
        let length = |letter| self.length_word(words, letter).unwrap_or(0.0);
        let diameter = self.memory.diameter.unwrap_or(self.dialect.quirks.diameter);
        [length(b'U') * if diameter { 0.5 } else { 1.0 }, length(b'W')]
    }

    /// What a control refuses: a first block that is no straight motion (Fanuc alarm PS0065).
    fn roughing_mistakes(&mut self, action: Action, contour: &Contour, words: &Words, report: &mut Report<'_>) {
        let straight = contour.motions.first().is_some_and(|motion| {
            let moves = |axis: usize| motion.start.get(axis) != motion.end.get(axis);
            let level = if action == Action::RoughFaceCycle { Z } else { X };
            matches!(motion.kind, MotionKind::Rapid | MotionKind::Linear) && moves(level)
        });
        if !straight {
            let message = format!(
                "the first block of the contour of {} must go to its first level by G0 or G1",
                self.memory.cycle.id
            );
            self.refuse(
                words,
                Refusal::CannedCycle,
                message,
                Some("contour-first-block"),
                report,
            );
        }
    }

    /// G76: many passes of a thread; the first of two blocks has no coordinates.
    fn thread_repeat(&mut self, words: &Words, report: &mut Report<'_>) {
        if words.axes.any() {
            let start = self.state.position;
            if words.feed.is_said() || self.state.feed.is_none() {
                self.lead(words, report);
            }
            let what = format!("{}: depths of its passes; it ends where it began", self.memory.cycle.id);
            self.somehow_back(&what, start, report);
        }
    }

    /// The way of a cycle is not known; it ends where it began.
    pub(super) fn somehow_back(&mut self, what: &str, start: Position, report: &mut Report<'_>) {
        report.fault(report.whole(), FaultKind::NotModelled { what: what.to_owned() });
        let orientation = self.held_orientation();
        let mut motion = self.new_motion(MotionKind::Unknown, start, start, orientation, Feed::Unknown, report);
        if self.state.frame_unknown {
            self.hide(&mut motion);
        }
        self.memory.out.push(motion);
    }

    /// Neither the way nor the end of a cycle is known.
    pub(super) fn nowhere(&mut self, start: Position, report: &Report<'_>) {
        self.forget_linear();
        let end = self.state.position;
        let orientation = self.held_orientation();
        let motion = self.new_motion(MotionKind::Unknown, start, end, orientation, Feed::Unknown, report);
        self.memory.out.push(motion);
    }

    pub(super) fn rapid_straight(&mut self, to: Position, report: &Report<'_>) {
        if self.state.position != to {
            self.goes(MotionKind::Rapid, to, Feed::Rapid, report);
        }
    }
}
