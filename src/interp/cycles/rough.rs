//! Roughing on a lathe, type I in two blocks: G71 with cuts along Z, G72 with cuts along X (G73 and G74 of system C).
//!
//! From the start point in rapid by the finishing allowance; in by the depth of cut as the first block of the contour says (G0 or G1); along the
//! axis at the feed up to the contour, which is moved by the allowance; off at 45 degrees by the escape; back in rapid to the start line; in by
//! depth and escape; and where the first point of the contour is reached or would be passed, in to that point and along the whole contour, then
//! back to the start point in rapid. Depth and escape stay until they are programmed again (parameters 5132 and 5133), for both cycles.
//! In one block (Haas; Fanuc Series 10/11 format) D is the depth, and the control has set the escape.
//!
//! Sources: Robur concise guide to Fanuc lathe cycles, page 48; GSK988T user manual, G71, page 69 (the same cycle, with the order of its motions);
//! Rockwell 9/Series lathe manual, page 24-9. Fanuc's own (Series 30i operator's manual, lathe system, stock removal in turning and facing) was
//! not available. They differ in whether the tool leaves its cuts at the feed or in rapid, and do not describe cuts that miss the contour, run along a part of it, or are
//! shorter than the escape: there the path is unknown, and what follows is known again.
use super::contour::Contour;
use super::levels::{Frame, Path};
use crate::core::Report;
use crate::iso::Iso;
use crate::words::Words;
use crate::{FaultKind, Feed, Motion, MotionKind, Position, Refusal, RoughingEscape};
use trunnion_dialect::{Action, Plane};
use trunnion_syntax::{Address, BlockId, Value};

const X: usize = 0;
const Z: usize = 2;
/// Cuts of one cycle.
const MOST: f64 = 10_000.0;
/// How far positions may be off, mm.
const OFF: f64 = 1e-6;

/// What the first block of G71 and G72 keeps, mm; `None`: not programmed, or unknown.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Roughing {
    depth: Option<f64>,
    escape: Option<f64>,
}

impl Roughing {
    pub(super) fn numbers(&self) -> [Option<f64>; 2] {
        [self.depth, self.escape]
    }
}

/// A cycle that can be computed.
struct Plan {
    frame: Frame,
    path: Path,
    /// Where the cuts begin: the start point moved by the allowance.
    begin: Position,
    allowance: [f64; 2],
    depth: f64,
    escape: f64,
    /// Depth of the contour's first point.
    full: f64,
    /// How the tool goes in.
    infeed: MotionKind,
    feed: Feed,
}

impl Iso<'_> {
    /// The first block: U or W the depth of cut, R the escape, both radii.
    pub(super) fn keep_roughing(&mut self, action: Action, words: &Words) {
        let depth = if action == Action::RoughFaceCycle { b'W' } else { b'U' };
        for (letter, escape) in [(depth, false), (b'R', true)] {
            if words.letter(letter).is_given() {
                let value = self.length_word(words, letter);
                let roughing = &mut self.memory.cycle.kept.roughing;
                if escape {
                    roughing.escape = value.filter(|value| *value >= 0.0);
                } else {
                    roughing.depth = value.filter(|value| *value > 0.0);
                }
            }
        }
    }

    /// The second block.
    pub(super) fn rough(
        &mut self,
        action: Action,
        contour: &Contour,
        start: Position,
        words: &Words,
        report: &mut Report<'_>,
    ) {
        self.roughing_mistakes(action, contour, words, report);
        let feed = self.feed_of(MotionKind::Linear, words, report);
        match self.plan_roughing(action, contour, start, feed, words, report) {
            Ok(plan) => self.cuts(&plan, contour, start, report),
            Err(why) => {
                let what = format!(
                    "cuts of {}: {why}; the cycle is taken to end where it started",
                    self.memory.cycle.id
                );
                self.unknown_path_to_start(&what, start, report);
            }
        }
    }

    /// What a control refuses: a first block that is not a straight motion (Fanuc alarm PS0065).
    fn roughing_mistakes(&mut self, action: Action, contour: &Contour, words: &Words, report: &mut Report<'_>) {
        let straight = contour.motions.first().is_some_and(|motion| {
            let moves = |axis: usize| motion.start.get(axis) != motion.end.get(axis);
            let level = if action == Action::RoughFaceCycle { Z } else { X };
            matches!(motion.kind, MotionKind::Rapid | MotionKind::Linear) && moves(level)
        });
        if !straight {
            let message = format!(
                "the first block of the contour of {} must move to its first level with G0 or G1",
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

    /// The cycle, or why it cannot be computed.
    fn plan_roughing(
        &self,
        action: Action,
        contour: &Contour,
        start: Position,
        feed: Feed,
        words: &Words,
        report: &Report<'_>,
    ) -> Result<Plan, &'static str> {
        let axes = if action == Action::RoughFaceCycle {
            [Z, X]
        } else {
            [X, Z]
        };
        let (depth, escape) = self.roughing_data(words)?;
        let allowance = self.allowance(words).ok_or("its finishing allowance is unknown")?;
        if self.core.state.coordinates.plane() != Plane::Zx {
            return Err("a plane other than that of X and Z");
        }
        let motions = self.outline(contour, axes, start, report)?;
        let (first, rest) = motions.split_first().ok_or("its contour has no motions")?;
        let last = rest.last().ok_or("its contour is only one block")?;
        let ways = [
            first.end.values[axes[0]] - start.values[axes[0]],
            last.end.values[axes[1]] - first.end.values[axes[1]],
        ];
        if ways.iter().any(|way| way.abs() < OFF) || (first.end.values[axes[1]] - start.values[axes[1]]).abs() > OFF {
            return Err("its contour does not start along one axis and continue along the other");
        }
        let signs = ways.map(f64::signum);
        let moved = axes.map(|axis| allowance[usize::from(axis == Z)]);
        if (0..2).any(|i| moved[i] * signs[i] > 0.0) {
            return Err("its finishing allowance extends beyond the contour");
        }
        let full = ways[0].abs();
        if full / depth > MOST {
            return Err("more than 10000 cuts");
        }
        // depths and positions along the contour are the same before and after its move
        let frame = Frame {
            axes,
            signs,
            origin: axes.map(|axis| start.values[axis]),
        };
        let path = Path::new(rest, frame)?;
        let mut begin = start;
        begin.values[X] += allowance[0];
        begin.values[Z] += allowance[1];
        Ok(Plan {
            frame: Frame {
                origin: axes.map(|axis| begin.values[axis]),
                ..frame
            },
            path,
            begin,
            allowance,
            depth,
            escape,
            full,
            infeed: first.kind,
            feed,
        })
    }

    /// Depth of cut and escape, mm: of the block before, or in one block D and what the control has set.
    fn roughing_data(&self, words: &Words) -> Result<(f64, f64), &'static str> {
        let set = self.core.setup.control.roughing_retract_mm;
        let kept = self.memory.cycle.kept.roughing;
        if words.letter(b'R').is_given() {
            return Err("R in the block with P and Q");
        }
        if [b'I', b'K'].iter().any(|&letter| words.letter(letter).is_given()) {
            return Err("with an allowance for a cut before the last (I, K)");
        }
        if words.letter(b'D').is_given() {
            let depth = self.one_block_length(words, b'D').filter(|depth| *depth > 0.0);
            let depth =
                depth.ok_or("the format in one block: its depth of cut (D) is not above 0, or has no decimal point")?;
            let escape = set.ok_or(
                "the format in one block: declare [control] roughing_retract (Haas setting 73, parameter 5133)",
            )?;
            return Ok((depth, escape));
        }
        let depth = kept.depth;
        let depth =
            depth.ok_or("without a depth of cut above 0 in its first block (parameter 5132, Haas setting 72)")?;
        let escape = kept.escape.or(set);
        let escape = escape.ok_or("without an escape in its first block (parameter 5133)")?;
        Ok((depth, escape))
    }

    /// The motions of a contour for which type I can be computed.
    fn outline(
        &self,
        contour: &Contour,
        axes: [usize; 2],
        start: Position,
        report: &Report<'_>,
    ) -> Result<Vec<Motion>, &'static str> {
        if contour.compensated || self.core.state.compensation != 0 {
            return Err("tool nose radius compensation");
        }
        says_type_one(contour.first, axes, report)?;
        let stays = |place: &Position| {
            (0..place.values.len()).all(|axis| axes.contains(&axis) || place.get(axis) == start.get(axis))
        };
        if !contour
            .motions
            .iter()
            .all(|motion| stays(&motion.start) && stays(&motion.end))
        {
            return Err("its contour moves other axes");
        }
        let motions = &contour.motions;
        let same = |motion: &Motion| {
            (motion.tool, motion.zero, motion.tool_length_mm)
                == (
                    self.core.state.tool.number(),
                    self.core.state.zero.values(),
                    self.core.state.length.mm().unwrap_or(0.0),
                )
        };
        if !motions.iter().all(same) {
            return Err("its contour changes the tool or the work offset");
        }
        if !motions
            .first()
            .is_some_and(|first| matches!(first.kind, MotionKind::Rapid | MotionKind::Linear))
        {
            return Err("its first block is not a straight motion");
        }
        if motions.iter().skip(1).any(|motion| motion.kind == MotionKind::Rapid) {
            return Err("a rapid motion inside its contour");
        }
        Ok(motions.clone())
    }

    fn cuts(&mut self, plan: &Plan, contour: &Contour, start: Position, report: &mut Report<'_>) {
        let lift = match self.core.setup.control.roughing_escape {
            Some(RoughingEscape::Feed) => MotionKind::Linear,
            Some(RoughingEscape::Rapid) => MotionKind::Rapid,
            None => MotionKind::Unknown,
        };
        self.rapid_straight(plan.begin, report);
        let (mut missed, mut lifted, mut lost) = (false, false, false);
        let mut cut = 1.0;
        while cut * plan.depth < plan.full - 1e-4 {
            if self.is_full() {
                let what = format!("{}: {}", self.memory.cycle.id, self.full());
                return self.unknown_path_to_start(&what, start, report);
            }
            let depth = cut * plan.depth;
            cut += 1.0;
            let Some(along) = plan
                .path
                .meet(depth)
                .filter(|along| *along > (plan.escape - 1e-9).max(OFF))
            else {
                (missed, lost) = (true, true);
                continue;
            };
            let infeed = if lost { MotionKind::Unknown } else { plan.infeed };
            lost = false;
            self.cut_to(plan, infeed, depth, 0.0, report);
            self.cut_to(plan, MotionKind::Linear, depth, along, report);
            if plan.escape > 0.0 {
                lifted = true;
                self.cut_to(plan, lift, depth - plan.escape, along - plan.escape, report);
            }
            self.cut_to(plan, MotionKind::Rapid, depth - plan.escape, 0.0, report);
        }
        let infeed = if lost { MotionKind::Unknown } else { plan.infeed };
        self.cut_to(plan, infeed, plan.full, 0.0, report);
        self.along(&contour.motions[1..], plan.allowance, plan.feed, report);
        self.rapid_straight(start, report);
        if missed {
            let why = "cuts that miss its contour, run along part of it, or are shorter than the escape";
            self.report_not_modelled(why, report);
        }
        if lifted && lift == MotionKind::Unknown {
            let why = "whether the tool leaves its cuts at feed or in rapid (declare [control] roughing_escape)";
            self.report_not_modelled(why, report);
        }
    }

    /// A motion in the plane of the cuts.
    fn cut_to(&mut self, plan: &Plan, kind: MotionKind, depth: f64, along: f64, report: &Report<'_>) {
        let mut place = self.core.state.position;
        let coordinates = plan.frame.coordinates(depth, along);
        for (axis, value) in plan.frame.axes.into_iter().zip(coordinates) {
            place.set(axis, value);
        }
        let feed = match kind {
            MotionKind::Rapid => Feed::Rapid,
            MotionKind::Unknown => Feed::Unknown,
            _ => plan.feed,
        };
        self.goes(kind, place, feed, report);
    }

    /// Reports what is unknown about a cycle.
    pub(super) fn report_not_modelled(&self, why: &str, report: &mut Report<'_>) {
        let what = format!("{}: {why}", self.memory.cycle.id);
        report.fault(report.whole(), FaultKind::NotModelled { what });
    }
}

/// Type I: the first block of the contour has G0 or G1 and one axis.
fn says_type_one(first: u32, axes: [usize; 2], report: &Report<'_>) -> Result<(), &'static str> {
    let (mut straight, mut infeed, mut both) = (false, false, false);
    let letters = |axis: usize| if axis == X { [b'X', b'U'] } else { [b'Z', b'W'] };
    for word in report.program.block(BlockId(first)).words() {
        match (word.address, word.value) {
            (Address::Letter(b'G'), Value::Number(code)) => straight |= matches!(code.to_f64(), 0.0 | 1.0),
            (Address::Letter(letter), _) => {
                infeed |= letters(axes[0]).contains(&letter);
                both |= letters(axes[1]).contains(&letter);
            }
            _ => {}
        }
    }
    match (straight && infeed, both) {
        (_, true) => Err("the first block of its contour names both axes (type II)"),
        (false, _) => Err("the first block of its contour does not say G0 or G1 with its level"),
        _ => Ok(()),
    }
}
