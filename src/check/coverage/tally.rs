//! What is counted while a program runs.
use super::{Coverage, GivenUp};
use crate::visited::Visited;
use trunnion_dialect::Dialect;
use trunnion_interp::{Fault, FaultKind, Motion, MotionKind};
use trunnion_syntax::BlockId;

/// See the module.
pub(crate) struct Tally {
    /// Axes that place the tip, as bits of a position: on a lathe there may be no Y.
    tip: u16,
    /// Motions that move something.
    travels: u64,
    /// Motions with a known end.
    known: u64,
    given_up: Option<GivenUp>,
}

impl Tally {
    pub(crate) fn new(dialect: &Dialect) -> Self {
        Self {
            tip: if dialect.quirks.diameter { 0b101 } else { 0b111 },
            travels: 0,
            known: 0,
            given_up: None,
        }
    }

    /// A motion was run.
    #[inline]
    pub(crate) fn motion(&mut self, motion: &Motion) {
        self.travels += u64::from(!matches!(motion.kind, MotionKind::Dwell(_)));
        let is_known = motion.kind != MotionKind::Unknown && motion.end.known & self.tip == self.tip;
        self.known += u64::from(is_known);
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
            motions_known: self.known,
            travels: self.travels,
            given_up: self.given_up.take(),
            ran,
            last,
            ..Coverage::default()
        }
    }
}
