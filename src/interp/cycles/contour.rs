//! The contour of a turning cycle: the blocks between two sequence numbers, run on a copy of the interpreter.
use crate::Sink;
use crate::core::Report;
use crate::iso::Iso;
use crate::words::{WordValue, Words};
use crate::{Fault, FaultKind, ModalState, Motion, MotionKind, Refusal};
use trunnion_flow::{Key, Search};
use trunnion_syntax::{BlockId, Item, Program};

/// Motions of a contour, or of a cut along it.
const MOST_MOTIONS: usize = 100_000;

/// A contour as its blocks define it, from where the cycle begins.
pub(super) struct Contour {
    pub(super) motions: Vec<Motion>,
    /// Its first and last block, and whether it begins directly after the cycle's own block.
    pub(super) first: u32,
    pub(super) last: u32,
    pub(super) follows: bool,
    /// The F active after it.
    pub(super) feed: Option<f64>,
    /// Cutter compensation is on somewhere in it.
    pub(super) compensated: bool,
}

#[derive(Default)]
struct Collected {
    motions: Vec<Motion>,
    faults: Vec<Fault>,
    compensated: bool,
    /// The program ends inside.
    ended: bool,
    feed: Option<f64>,
}

impl Sink for Collected {
    fn motion(&mut self, motion: &Motion, state: &ModalState) {
        self.compensated |= state.compensation != 0;
        if self.motions.len() <= MOST_MOTIONS {
            self.motions.push(*motion);
        }
    }
    fn fault(&mut self, fault: Fault) {
        self.faults.push(fault);
    }
}

impl Iso<'_> {
    /// Reads the contour that P and Q of the cycle name. Faults of its blocks are reported once. `None`: it is unknown, and that is reported.
    pub(super) fn contour(&mut self, words: &Words, report: &mut Report<'_>) -> Option<Contour> {
        let program = report.program;
        let (first, last) = self.contour_blocks(program, words, report)?;
        let here = report.block.0;
        let follows = is_next(program, here, first);
        let mut found = self.run_blocks(program, first, last);
        self.cycle_motions.add_in_vain(u64::from(last - first));
        if !self.memory.contours_reported.contains(&first) {
            self.memory.contours_reported.push(first);
            for fault in std::mem::take(&mut found.faults) {
                (report.faults)(fault);
            }
        }
        let ends = self.memory.frames.active || self.memory.frames.tilt.is_some() || self.core.state.zero.is_lost();
        let known = |motion: &Motion| {
            let path = matches!(motion.kind, MotionKind::Rapid | MotionKind::Linear | MotionKind::Arc(_));
            let place = |axis| motion.start.get(axis).is_some() && motion.end.get(axis).is_some();
            path && place(0) && place(2) && !motion.machine_coordinates
        };
        // dwells stay
        found
            .motions
            .retain(|motion| !matches!(motion.kind, MotionKind::Dwell(_)));
        let why = if found.ended {
            "the program ends inside it"
        } else if found.motions.is_empty() || found.motions.len() > MOST_MOTIONS {
            "it has no motions, or more than 100000"
        } else if ends {
            "its coordinates are rotated, scaled or unknown"
        } else if !found.motions.iter().all(known) {
            "some of its points are unknown"
        } else {
            return Some(Contour {
                motions: found.motions,
                first,
                last,
                follows,
                feed: found.feed,
                compensated: found.compensated,
            });
        };
        if follows {
            self.memory.passed_over = Some((here, last));
        }
        let what = format!("contour of {}: {why}", self.memory.cycle.id);
        report.fault(report.whole(), FaultKind::NotModelled { what });
        None
    }

    /// Runs blocks on a copy of the interpreter.
    fn run_blocks(&self, program: &Program, first: u32, last: u32) -> Collected {
        let mut ghost = self.clone();
        ghost.flow.follows = false;
        ghost.memory.passed_over = None;
        ghost.memory.in_contour = true;
        ghost.memory.out.clear();
        ghost.memory.corners = crate::corner::Corners::default();
        let mut found = Collected::default();
        for block in first..=last {
            ghost.step_iso(&program.block(BlockId(block)), &mut found);
            if ghost.core.state.ended {
                break;
            }
        }
        found.ended = ghost.core.state.ended;
        found.feed = ghost.core.state.feed.value();
        ghost.put_out_rest(&program.block(BlockId(last)), &mut found);
        found
    }

    /// First and last block of the contour.
    fn contour_blocks(&mut self, program: &Program, words: &Words, report: &mut Report<'_>) -> Option<(u32, u32)> {
        let number = |said: WordValue| said.index();
        let numbers = (number(words.p), number(words.letter(b'Q')));
        let (Some(first), Some(last)) = numbers else {
            let message = format!(
                "{} without P and Q, the first and last block of its contour",
                self.memory.cycle.id
            );
            self.refuse(words, Refusal::CannedCycle, message, None, report);
            return None;
        };
        let here = report.block.0;
        let index = self.sequence_numbers(program);
        let section = index.section(here);
        let label = |number, from| index.label(&Key::Number(number), from, section, Search::ForwardThenStart);
        let from = label(first, here);
        let to = from.and_then(|from| label(last, from));
        let missing = match (from, to) {
            (Some(from), Some(to)) if to > from => return Some((from, to)),
            (Some(from), _) if first == last => return Some((from, from)),
            (None, _) => first,
            _ => last,
        };
        let message = format!("contour of {}: block N{missing} does not exist", self.memory.cycle.id);
        self.refuse(words, Refusal::Label, message, Some("contour-missing"), report);
        None
    }
}

/// Whether only comments are between two blocks.
fn is_next(program: &Program, from: u32, to: u32) -> bool {
    let says = |block: u32| {
        let block = program.block(BlockId(block));
        block.items().any(|item| !matches!(item, Item::Comment(_)))
    };
    from < to && !(from + 1..to).any(says)
}

/// A motion moved by a shift of X and Z, mm.
pub(super) fn shifted(motion: &Motion, x: f64, z: f64) -> Motion {
    let mut motion = *motion;
    for place in [&mut motion.start, &mut motion.end] {
        place.values[0] += x;
        place.values[2] += z;
    }
    if let MotionKind::Arc(Some(arc)) = &mut motion.kind {
        for point in [&mut arc.start, &mut arc.end, &mut arc.centre] {
            point.x += x;
            point.z += z;
        }
    }
    motion
}
