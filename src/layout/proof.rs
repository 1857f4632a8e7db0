//! The proof that two texts make the same motions: both are run side by side, and after each block that holds something every
//! motion, every fault and the whole modal state are compared. Nothing of it knows how the second text was made.
use crate::alike::{same_motion, same_state};
use crate::blanks::is_empty;
use std::collections::VecDeque;
use trunnion_dialect::Dialect;
use trunnion_interp::{Fault, FaultKind, Interpreter, ModalState, Motion, Setup, Sink};
use trunnion_syntax::{BlockId, Program};

/// Blocks that a proof runs beyond those that the program has, so that loops are followed and do not take forever. The proof counts
/// them, not the interpreters: empty blocks of one side would make its interpreter stop before the other one.
const MOST_REPEATED: u64 = 1_000_000;

/// How far faults must agree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Faults {
    /// Kind and numbers; texts without blanks and case.
    Whole,
    /// Kind alone: their texts name block numbers, and those have changed.
    Kinds,
}

/// Where two texts part.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// Block of the text before.
    pub block: BlockId,
    /// What differs there.
    pub what: &'static str,
}

/// The first difference between two runs; `None` where there is none.
pub(crate) fn first_difference(
    before: &Program,
    after: &Program,
    dialect: &Dialect,
    setup: &Setup,
    faults: Faults,
) -> Option<Difference> {
    let mut setup = setup.clone();
    let most = setup.limits.blocks.min(MOST_REPEATED) + before.block_count() as u64;
    setup.limits.blocks = most.saturating_mul(2);
    let (mut a, mut b) = (Run::new(before, dialect, &setup), Run::new(after, dialect, &setup));
    let mut reached = BlockId(0);
    loop {
        if a.blocks.max(b.blocks) >= most {
            return None;
        }
        let (left, right) = (a.advance(), b.advance());
        reached = left.unwrap_or(reached);
        let at = |what| Some(Difference { block: reached, what });
        if let Some(what) = a.events.differ(&mut b.events, faults) {
            return at(what);
        }
        match (left, right) {
            (None, None) => {
                let rest = !a.events.queue.is_empty() || !b.events.queue.is_empty();
                return if rest {
                    at("one of both says more at its end")
                } else {
                    None
                };
            }
            (Some(x), Some(y)) if a.events.ordinal(x) == b.events.ordinal(y) => {}
            _ => return at("the order in which blocks run"),
        }
        if !same_state(a.interpreter.state(), b.interpreter.state()) {
            // what the end of the text brings comes with the last block, or with an empty one behind it
            let more = a.advance().is_some() || b.advance().is_some();
            if more || !same_state(a.interpreter.state(), b.interpreter.state()) {
                return at("what is in force after the block");
            }
        }
    }
}

/// One side of the comparison.
struct Run<'a> {
    program: &'a Program,
    interpreter: Interpreter<'a>,
    events: Events,
    /// Blocks that it has run, empty ones too.
    blocks: u64,
}

impl<'a> Run<'a> {
    fn new(program: &'a Program, dialect: &'a Dialect, setup: &Setup) -> Self {
        let mut count = 0;
        let ordinals = program.blocks().map(|block| {
            let own = count;
            count += u32::from(!is_empty(&block));
            own
        });
        Self {
            program,
            interpreter: Interpreter::new(dialect, setup),
            events: Events {
                ordinals: ordinals.collect(),
                queue: VecDeque::new(),
                refused: None,
                first_alone: !dialect.quirks.rs274(),
            },
            blocks: 0,
        }
    }

    /// Runs on to the end of the next block that holds something; `None` at the end.
    fn advance(&mut self) -> Option<BlockId> {
        loop {
            let block = self.interpreter.advance(self.program, &mut self.events)?;
            self.blocks += 1;
            if !is_empty(&self.program.block(block)) {
                return Some(block);
            }
        }
    }
}

/// What a run has said and the other one has not yet been asked for.
struct Events {
    /// How many blocks that hold something stand before each block.
    ordinals: Vec<u32>,
    queue: VecDeque<Event>,
    /// The block whose first mistake was told last.
    refused: Option<u32>,
    /// Of a line only the first mistake counts, see [`Events::fault`]. LinuxCNC's reader goes on without a look at blanks.
    first_alone: bool,
}

enum Event {
    Motion(Box<Motion>),
    Fault(u32, FaultKind),
}

impl Events {
    fn ordinal(&self, block: BlockId) -> u32 {
        self.ordinals.get(block.0 as usize).copied().unwrap_or(u32::MAX)
    }

    /// Compares and forgets what both have said.
    fn differ(&mut self, other: &mut Self, faults: Faults) -> Option<&'static str> {
        while !self.queue.is_empty() && !other.queue.is_empty() {
            match (self.queue.pop_front()?, other.queue.pop_front()?) {
                (Event::Motion(a), Event::Motion(b)) if same_motion(&a, &b) => {}
                (Event::Motion(_), Event::Motion(_)) => return Some("a motion"),
                (Event::Fault(x, a), Event::Fault(y, b)) if x == y && same_fault(&a, &b, faults) => {}
                (Event::Fault(..), Event::Fault(..)) => return Some("a fault"),
                _ => return Some("the number of motions and faults"),
            }
        }
        None
    }
}

impl Sink for Events {
    fn motion(&mut self, motion: &Motion, _state: &ModalState) {
        let mut motion = Box::new(*motion);
        motion.block = BlockId(self.ordinal(motion.block));
        self.queue.push_back(Event::Motion(motion));
    }
    fn fault(&mut self, fault: Fault) {
        let ordinal = self.ordinal(fault.block);
        if self.first_alone && is_refusal(&fault.kind) {
            // behind the first mistake of a line, what else is found depends on its blanks: there reading goes on at what looks like
            // a word. The control stops at the first.
            let told = self
                .queue
                .iter()
                .any(|event| matches!(event, Event::Fault(other, kind) if *other == ordinal && is_refusal(kind)));
            if told || self.refused == Some(ordinal) {
                return;
            }
            self.refused = Some(ordinal);
        }
        self.queue.push_back(Event::Fault(ordinal, fault.kind));
    }
}

/// Whether a control stops at the fault.
fn is_refusal(kind: &FaultKind) -> bool {
    matches!(
        kind,
        FaultKind::Rejected { .. }
            | FaultKind::UnknownCode { .. }
            | FaultKind::UnknownWord
            | FaultKind::RepeatedWord
            | FaultKind::GroupConflict { .. }
    )
}

/// Whether two faults are the same but for places and the spelling of texts that they quote.
fn same_fault(a: &FaultKind, b: &FaultKind, faults: Faults) -> bool {
    if a == b {
        return true;
    }
    if std::mem::discriminant(a) != std::mem::discriminant(b) {
        return false;
    }
    match (a, b) {
        // the sentence may quote the text and name lines
        (
            FaultKind::Rejected { refusal, alarm, .. },
            FaultKind::Rejected {
                refusal: other,
                alarm: number,
                ..
            },
        ) => refusal == other && (alarm == number || quotes(alarm.as_ref()) && quotes(number.as_ref())),
        // the control's sentence names lines
        (
            FaultKind::MissingSubprogram {
                name: a, searched: x, ..
            },
            FaultKind::MissingSubprogram {
                name: b, searched: y, ..
            },
        ) => x == y && (faults == Faults::Kinds || folded(a) == folded(b)),
        // how many blocks ran depends on empty ones
        (FaultKind::EndlessLoop { proved: a, .. }, FaultKind::EndlessLoop { proved: b, .. }) => a == b,
        (FaultKind::GroupConflict { group, .. }, FaultKind::GroupConflict { group: other, .. }) => group == other,
        // texts as written
        (FaultKind::NotModelled { what: a }, FaultKind::NotModelled { what: b })
        | (FaultKind::NotDecided { what: a }, FaultKind::NotDecided { what: b })
        | (FaultKind::WorkOffsetUnset { name: a }, FaultKind::WorkOffsetUnset { name: b })
        | (FaultKind::ToolLengthUnset { tool: a }, FaultKind::ToolLengthUnset { tool: b })
        | (FaultKind::ProgramAlarm { message: a }, FaultKind::ProgramAlarm { message: b }) => {
            faults == Faults::Kinds || folded(a) == folded(b)
        }
        _ => faults == Faults::Kinds,
    }
}

/// LinuxCNC's messages may quote the text and name lines, too.
fn quotes(alarm: Option<&String>) -> bool {
    alarm.is_some_and(|alarm| alarm.starts_with("LinuxCNC: "))
}

/// A text without blanks and case.
fn folded(text: &str) -> String {
    text.chars()
        .filter(|c| !c.is_whitespace())
        .map(|c| c.to_ascii_uppercase())
        .collect()
}
