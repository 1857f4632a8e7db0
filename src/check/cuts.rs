//! Feed motions while the spindle does not turn, put together: one cause is one stretch of the program.
use crate::caller::{Part, starts_spindle};
use crate::pass::ask;
use crate::sink::{Active, Reporter};
use crate::view::InForce;
use crate::wake::Wake;
use std::collections::BTreeMap;
use trunnion_interp::{ChainId, Motion, MotionKind};
use trunnion_syntax::{Address, BlockId, Program, Value, Word};

/// Why the tool does not turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Still {
    /// The program switched the spindle off.
    Off,
    /// It turned before a tool change, a program stop or a tap that may have stopped it, and was not started after it.
    Left,
    /// It is on, with S0.
    NoSpeed,
    /// It is on, and the program has given no S.
    SpeedUnsaid,
    /// Nothing in the program starts a spindle.
    NeverStarted,
    /// The program starts one, after these feed motions.
    StartedLater,
}

/// Whether a spindle turned at any time of the run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Started {
    /// The program started it.
    Yes,
    /// Something that is not modelled may have started it: a builder's code, a program that is missing. Feed motions before that had none.
    Perhaps,
    /// Nothing started it.
    No,
}

impl Started {
    /// From what is in effect at the end.
    pub(crate) fn of(by_program: bool, unread: bool) -> Self {
        match (by_program, unread) {
            (true, _) => Self::Yes,
            (false, true) => Self::Perhaps,
            (false, false) => Self::No,
        }
    }
}

/// Feed motions in a row for which the same holds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct StillCuts {
    pub(crate) why: Still,
    /// The block of the first.
    pub(crate) first: BlockId,
    /// The block of the last.
    pub(crate) last: BlockId,
    /// The calls that led to the first.
    pub(crate) chain: ChainId,
    /// How many.
    pub(crate) count: u32,
    /// S was above zero in other feed motions with the same tool: it may be the power of a laser.
    pub(crate) other_speed: bool,
    /// The same tool probes, or is measured, without a cut with the spindle on between.
    pub(crate) probes: bool,
    tool: Option<u32>,
    /// See [`Cuts::rest`].
    rest: u32,
}

/// Collects them while a program runs.
#[derive(Default)]
pub(crate) struct Cuts {
    /// Why the last feed motion was one of them, where its stretch begins, and the tool there.
    open: Option<(Still, BlockId, Option<u32>)>,
    found: BTreeMap<(BlockId, Still), StillCuts>,
    /// Feed motions before any code of the spindle.
    quiet: Option<StillCuts>,
    /// Tools of which a feed motion had S above zero.
    with_speed: Vec<Option<u32>>,
    /// Counts the feed motions with a turning spindle: between two of them the spindle rests, or turns for nothing.
    rest: u32,
    /// Motions with an unknown end while the spindle is off, which may be those of a probe: the rest, the tool, the block.
    touches: Vec<(u32, Option<u32>, BlockId)>,
}

/// So many touches are kept; findings after them are judged without.
const TOUCHES: usize = 1024;

impl Cuts {
    /// Takes a motion; `allowed` says whether a comment allows the finding in its block.
    #[inline]
    pub(crate) fn add(&mut self, motion: &Motion, in_force: &InForce, allowed: impl FnOnce() -> bool) {
        if !motion.is_feed() || motion.machine_coordinates {
            if motion.kind == MotionKind::Unknown && motion.spindle_on == Some(false) {
                self.touched(motion);
            }
            return;
        }
        let why = match motion.spindle_on {
            Some(true) if motion.spindle_rpm == Some(0.0) => Still::NoSpeed,
            Some(true) if !in_force.speed_programmed && !in_force.spindle_unread => Still::SpeedUnsaid,
            Some(true) => {
                self.open = None;
                self.rest = self.rest.wrapping_add(1);
                if motion.spindle_rpm.is_some_and(|rpm| rpm > 0.0) && self.with_speed.last() != Some(&motion.tool) {
                    self.turned_with(motion.tool);
                }
                return;
            }
            Some(false) => Still::Off,
            None if in_force.spindle_left => Still::Left,
            None if in_force.spindle_unread || in_force.spindle_started => {
                self.open = None;
                return;
            }
            None => Still::NeverStarted,
        };
        self.count(why, motion, allowed);
    }

    #[cold]
    fn touched(&mut self, motion: &Motion) {
        let touch = (self.rest, motion.tool, motion.block);
        if self.touches.len() < TOUCHES && self.touches.last() != Some(&touch) {
            self.touches.push(touch);
        }
    }

    fn turned_with(&mut self, tool: Option<u32>) {
        if !self.with_speed.contains(&tool) {
            self.with_speed.push(tool);
        }
    }

    fn count(&mut self, why: Still, motion: &Motion, allowed: impl FnOnce() -> bool) {
        let new = StillCuts {
            why,
            first: motion.block,
            last: motion.block,
            chain: motion.chain,
            count: 0,
            other_speed: false,
            probes: false,
            tool: motion.tool,
            rest: self.rest,
        };
        let cuts = if why == Still::NeverStarted {
            self.open = None;
            self.quiet.get_or_insert(new)
        } else {
            if why != Still::SpeedUnsaid && allowed() {
                return;
            }
            // of a tool that probes the stretch is judged apart
            let same = |tool| self.touches.is_empty() || tool == motion.tool;
            let (first, tool) = match self.open {
                Some((open, first, tool)) if open == why && same(tool) => (first, tool),
                _ => (motion.block, motion.tool),
            };
            self.open = Some((why, first, tool));
            self.found.entry((first, why)).or_insert(new)
        };
        cuts.last = motion.block;
        cuts.count = cuts.count.saturating_add(1);
    }

    /// All stretches, those before the first code of the spindle first. Only of a main program it is said that nothing starts the spindle, or gives S: the
    /// caller of a subprogram may have done so, as may what comes before a part of a program.
    /// A subprogram that probes and starts no spindle moves a probe, or a tool that it measures.
    fn finish(&self, program: &Program, part: Part, started: Started) -> Vec<StillCuts> {
        let touches: Vec<_> = self
            .touches
            .iter()
            .filter(|touch| is_probing(program, touch.2))
            .collect();
        if started != Started::No || part == Part::Called {
            let may_turn = |cuts: &StillCuts| StillCuts {
                other_speed: self.with_speed.contains(&cuts.tool),
                probes: touches
                    .iter()
                    .any(|(rest, tool, _)| (*rest, *tool) == (cuts.rest, cuts.tool)),
                ..*cuts
            };
            let told = |cuts: &&StillCuts| part == Part::Main || cuts.why != Still::SpeedUnsaid;
            let measures = |cuts: &StillCuts| {
                let here = part == Part::Called && cuts.why == Still::Off && cuts.probes;
                here && !starts_spindle(program)
            };
            let before = self
                .quiet
                .iter()
                .filter(|_| started != Started::No && part == Part::Main);
            let found = self.found.values().filter(told).map(may_turn);
            let before = before.map(|cuts| StillCuts {
                why: if started == Started::Yes {
                    Still::StartedLater
                } else {
                    cuts.why
                },
                ..*cuts
            });
            return before.chain(found.filter(|cuts| !measures(cuts))).collect();
        }
        let quiet = self.quiet.iter().filter(|_| part == Part::Main);
        let whole = quiet.chain(self.found.values()).copied().reduce(|mut whole, cuts| {
            if cuts.first < whole.first {
                (whole.first, whole.chain) = (cuts.first, cuts.chain);
            }
            whole.last = whole.last.max(cuts.last);
            whole.count = whole.count.saturating_add(cuts.count);
            whole
        });
        let never = |cuts| StillCuts {
            why: Still::NeverStarted,
            ..cuts
        };
        whole.map(never).into_iter().collect()
    }
}

/// Whether a block has a code that probes: G38.2 to G38.5, or G31, which ends at a signal.
fn is_probing(program: &Program, block: BlockId) -> bool {
    let code = |word: Word| match word.value {
        Value::Number(number) if word.address == Address::Letter(b'G') => {
            let tenths = (number.to_f64() * 10.0).round();
            (382.0..=385.0).contains(&tenths) || tenths == 310.0
        }
        _ => false,
    };
    program.block(block).words().any(code)
}

/// Asks the rules about each stretch.
pub(crate) fn report_still(cuts: &Cuts, rules: &[Active], reporter: &mut Reporter<'_>, started: Started) {
    for still in cuts.finish(reporter.program(), reporter.part(), started) {
        reporter.origin(false, still.chain);
        ask(rules, reporter, (Some(still.first), 0), |wake, out| {
            if let Wake::Still(rule) = wake {
                rule(&still, out);
            }
        });
    }
}
