//! Rapid motions one after the other, each alone in a plain block: what `reroute-rapid` may replace.
use trunnion_check::{Assume, Settings};
use trunnion_interp::{ChainId, Fault, ModalState, Motion, MotionKind, Orientation, Sink, Swivel, Tool, run};
use trunnion_machine::{AxisKind, Follower, Leg, Machine, TravelLevel};
use trunnion_syntax::{Address, Block, BlockId, Item, Program, Value};

/// One rapid motion.
#[derive(Clone, Debug)]
pub(crate) struct Rapid {
    /// Its block.
    pub block: BlockId,
    /// What the machine does.
    pub leg: Leg,
    /// What is declared about the tool in use.
    pub tool: Option<Tool>,
    /// mm per programmed length unit.
    pub unit_mm: f64,
    /// Nothing undeclared matters.
    pub declared: bool,
    /// Why its block cannot be edited; `None`: it can.
    pub fixed: Option<&'static str>,
}

/// Rapid motions one after the other that may be replaced together.
#[derive(Clone, Debug)]
pub(crate) struct Run {
    /// At least one.
    pub rapids: Vec<Rapid>,
    /// The highest level at which the rapids since the last cut go across the tool.
    pub level: Option<TravelLevel>,
}

struct Collector<'p, 'm> {
    program: &'p Program,
    machine: &'m Machine,
    follower: Follower<'m>,
    assume: Assume,
    /// Runs so far; the last one may go on.
    runs: Vec<Run>,
    level: Option<TravelLevel>,
    open: bool,
    last: Option<BlockId>,
}

impl Sink for Collector<'_, '_> {
    fn motion(&mut self, motion: &Motion, state: &ModalState) {
        let leg = self.follower.follow(motion);
        let block = motion.block;
        let twice = self.last == Some(block);
        let rapid = motion.kind == MotionKind::Rapid && motion.chain == ChainId::MAIN;
        let empty_between = self.last.is_none_or(|last| self.is_empty_between(last, block));
        self.last = Some(block);
        if !rapid {
            self.open = false;
            self.level = self.level.filter(|_| matches!(motion.kind, MotionKind::Dwell(_)));
            return;
        }
        self.level = TravelLevel::extended(self.level, self.machine, &leg);
        let left = self.assume.leaves(motion.undeclared);
        let fixed = if twice {
            Some("one block makes more than one motion")
        } else {
            self.why_fixed(motion, state, &leg)
        };
        let rapid = Rapid {
            block,
            tool: state.tool.data(),
            unit_mm: state.coordinates.unit_mm(),
            declared: left.zero.trailing_zeros() >= 3 && !left.length,
            leg,
            fixed,
        };
        let joins = self.open && empty_between && rapid.fixed.is_none();
        let same = |first: &Rapid| {
            let (a, b) = (&first.leg.motion, &rapid.leg.motion);
            first.fixed.is_none()
                && first.leg.start.is_some()
                && first.tool == rapid.tool
                && a.zero.iter().zip(&b.zero).all(|(a, b)| a.to_bits() == b.to_bits())
                && a.tool_length_mm.to_bits() == b.tool_length_mm.to_bits()
                && a.tcp == b.tcp
        };
        match self
            .runs
            .last_mut()
            .filter(|run| joins && run.rapids.first().is_some_and(same))
        {
            Some(run) => {
                run.rapids.push(rapid);
                run.level = self.level;
            }
            None => self.runs.push(Run {
                rapids: vec![rapid],
                level: self.level,
            }),
        }
        self.open = true;
    }
    fn fault(&mut self, _: Fault) {}
    fn reads_faults(&self) -> bool {
        false
    }
}

impl Collector<'_, '_> {
    /// Whether the blocks between two have nothing but comments.
    fn is_empty_between(&self, last: BlockId, block: BlockId) -> bool {
        (last.0 + 1..block.0).all(|id| {
            let mut items = self.program.block(BlockId(id)).items();
            items.all(|item| matches!(item, Item::Comment(_)))
        })
    }

    fn why_fixed(&self, motion: &Motion, state: &ModalState, leg: &Leg) -> Option<&'static str> {
        if state.coordinates.incremental() {
            return Some("its words are incremental (G91)");
        }
        if motion.machine_coordinates {
            return Some("its words are machine coordinates");
        }
        if motion.tilt.normal.is_some() || motion.tilt.swivel != Swivel::No {
            return Some("its words are in a tilted plane");
        }
        if matches!(motion.orientation, Orientation::Vector(..)) {
            return Some("tool vectors are programmed");
        }
        let (Some(start), Ok(end)) = (&leg.start, &leg.end) else {
            return Some("the machine's position is unknown");
        };
        let turns = |(joint, axis): (usize, &trunnion_machine::Axis)| {
            axis.kind == AxisKind::Rotary && start.joints[joint] != end.joints[joint]
        };
        if self.machine.axes.iter().enumerate().any(turns) {
            return Some("a rotary axis turns in it");
        }
        (!is_plain(&self.program.block(motion.block))).then_some("its block has more than the words of a rapid motion")
    }
}

/// Whether a block has nothing but a number, G0, and X Y Z with plain numbers, each once.
fn is_plain(block: &Block<'_>) -> bool {
    let mut seen: Vec<u8> = Vec::new();
    block.items().all(|item| match item {
        Item::Comment(_) => true,
        Item::Word(word) => match (word.address, word.value) {
            (Address::Letter(b'N'), Value::Number(_)) => true,
            (Address::Letter(b'G'), Value::Number(number)) => number.to_f64() == 0.0,
            (Address::Letter(letter @ b'X'..=b'Z'), Value::Number(_)) => {
                let first = !seen.contains(&letter);
                seen.push(letter);
                first
            }
            _ => false,
        },
        _ => false,
    })
}

/// The runs of a program; each begins and ends where something else happens, or where a block cannot be edited.
pub(crate) fn rapid_runs(program: &Program, settings: &Settings<'_>, machine: &Machine) -> Result<Vec<Run>, String> {
    if !settings.dialect.lex.format.has_words() {
        return Err("rapid motions of APT are not rewritten: its post-processor writes them".into());
    }
    let mut collector = Collector {
        program,
        machine,
        follower: Follower::new(machine),
        assume: settings.assume,
        runs: Vec::new(),
        level: None,
        open: false,
        last: None,
    };
    run(program, settings.dialect, &settings.setup, &mut collector);
    Ok(collector.runs)
}
