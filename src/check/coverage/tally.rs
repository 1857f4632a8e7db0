//! What is counted while a program runs.
use super::{Coverage, GivenUp};
use crate::place::names_axis;
use crate::visited::Visited;
use trunnion_dialect::Dialect;
use trunnion_interp::{ChainId, Fault, FaultKind, Motion, MotionKind};
use trunnion_syntax::{BlockId, Program};

/// Motions by what is known of their ends.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Ends {
    /// Axes that place the tip, as bits of a position: on a lathe there may be no Y.
    tip: u16,
    /// How many motions end where these of X, Y and Z are known, as bits.
    by_axes: [u64; 8],
    /// Some motions are in another file.
    elsewhere: bool,
}

impl Ends {
    fn add(&mut self, motion: &Motion) {
        if motion.kind != MotionKind::Unknown {
            self.by_axes[usize::from(motion.end.known & 0b111)] += 1;
        }
        self.elsewhere |= motion.chain != ChainId::MAIN;
    }

    /// Motions with a known end. An axis that the program never names, and that is known nowhere, stays where it is: a program for a laser, a
    /// wire or a lathe moves in two axes.
    pub(super) fn known(&self, program: &Program) -> u64 {
        let known = |tip: u16| -> u64 {
            let ends = (0u16..).zip(self.by_axes);
            ends.filter(|(axes, _)| axes & tip == tip).map(|(_, count)| count).sum()
        };
        if self.elsewhere || !program.options().format.has_words() {
            return known(self.tip);
        }
        let named = |axis: usize| {
            let letters = [b"XYZ"[axis], b"UVW"[axis]];
            let names = |letter| program.blocks().any(|block| names_axis(program, block.id(), letter));
            letters.into_iter().any(names)
        };
        let mut stays = (0..3).filter(|axis| known(1 << axis) == 0 && !named(*axis));
        match (stays.next(), stays.next()) {
            (Some(axis), None) if self.tip == 0b111 => known(0b111 & !(1 << axis)),
            _ => known(self.tip),
        }
    }
}

/// See the module.
pub(crate) struct Tally {
    ends: Ends,
    /// Motions that move something.
    travels: u64,
    given_up: Option<GivenUp>,
}

impl Tally {
    pub(crate) fn new(dialect: &Dialect) -> Self {
        Self {
            ends: Ends {
                tip: if dialect.quirks.diameter { 0b101 } else { 0b111 },
                ..Ends::default()
            },
            travels: 0,
            given_up: None,
        }
    }

    /// A motion was run.
    #[inline]
    pub(crate) fn motion(&mut self, motion: &Motion) {
        self.travels += u64::from(!matches!(motion.kind, MotionKind::Dwell(_)));
        self.ends.add(motion);
    }

    /// A fault may say where the run was stopped.
    pub(crate) fn fault(&mut self, fault: &Fault) {
        let reason = match &fault.kind {
            FaultKind::NotDecided { .. } => "not-decided",
            FaultKind::EndlessLoop { .. } => "endless-loop",
            FaultKind::ProgramAlarm { .. } => "program-alarm",
            _ => return,
        };
        let block = fault.block;
        self.given_up.get_or_insert(GivenUp { block, reason });
    }

    /// What was covered, before [`Coverage::complete`] works out what was not.
    pub(crate) fn coverage(&mut self, motions: u64, ran: Visited, last: Option<BlockId>) -> Coverage {
        Coverage {
            motions,
            ends: std::mem::take(&mut self.ends),
            travels: self.travels,
            given_up: self.given_up.take(),
            ran,
            last,
            ..Coverage::default()
        }
    }
}
