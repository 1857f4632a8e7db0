//! A pass over a part of a program: what it needs to continue, and what it leaves to the whole.
use super::Pass;
use crate::assumed::Assumed;
use crate::trail::Trail;
use crate::view::InForce;
use crate::{Diagnostic, Report};
use trunnion_interp::{ChainId, Fault, FaultKind, LengthOf, Refusal};
use trunnion_machine::{Follower, Memory};

/// What a pass remembers of the blocks before.
#[derive(Clone, Debug)]
pub(crate) struct PassMemory {
    follower: Option<Memory>,
    in_force: Option<InForce>,
    last_cut: Option<u32>,
    last_length: Option<LengthOf>,
    posture: i8,
    trail: Trail,
    motions: u64,
    assumed: Assumed,
}

/// An axis limit that only an assumption breaks is unknown.
pub(super) fn weigh(assumed: &Assumed, follower: Option<&Follower<'_>>, found: &mut [Diagnostic]) {
    let turns = follower.is_some_and(|follower| !follower.machine().rotary.is_empty());
    assumed.weigh(found, turns);
}

impl PassMemory {
    /// What the machine does.
    pub(crate) fn follower(&self) -> Option<&Memory> {
        self.follower.as_ref()
    }
}

impl<'a> Pass<'a> {
    /// What it needs to continue from here.
    pub(crate) fn memory(&self) -> PassMemory {
        PassMemory {
            follower: self.follower.as_ref().map(Follower::memory),
            in_force: self.in_force,
            last_cut: self.last_cut,
            last_length: self.last_length,
            posture: self.posture,
            trail: self.trail,
            motions: self.summary.motions,
            assumed: self.assumed.clone(),
        }
    }

    /// Only a part of the program is checked, from its beginning or from where `memory` was taken. The time is not planned.
    pub(crate) fn only_part(&mut self, memory: Option<&PassMemory>) {
        (self.part, self.pace) = (Some(false), None);
        self.reporter.only_part(memory.is_some());
        let Some(memory) = memory else { return };
        if let (Some(follower), Some(kept)) = (&mut self.follower, &memory.follower) {
            let machine: &'a trunnion_machine::Machine = follower.machine();
            *follower = Follower::resume(machine, kept);
        }
        (self.in_force, self.last_cut, self.last_length) = (memory.in_force, memory.last_cut, memory.last_length);
        (self.posture, self.trail) = (memory.posture, memory.trail);
        self.summary.motions = memory.motions;
        self.assumed = memory.assumed.clone();
    }

    /// Whether only the rest of the program decides how it goes on.
    pub(crate) fn has_left_part(&self) -> bool {
        self.part == Some(true)
    }

    /// Whether a fault of a part says nothing of the whole: what is missing here may be behind it. Then the part ends.
    pub(super) fn leaves_part(&mut self, fault: &Fault) -> bool {
        let Some(left) = &mut self.part else { return false };
        let decides = match &fault.kind {
            FaultKind::EndlessLoop { .. }
            | FaultKind::MissingSubprogram { .. }
            | FaultKind::NotDecided { .. }
            | FaultKind::ProgramAlarm { .. }
            | FaultKind::MissingProgramEnd => true,
            FaultKind::Rejected { refusal, .. } => matches!(
                refusal,
                Refusal::Label | Refusal::Subprogram | Refusal::Structure | Refusal::CannedCycle | Refusal::ProgramEnd
            ),
            _ => false,
        };
        *left |= decides;
        decides
    }

    /// What a part was found to be: findings of places alone. What looks at the program as a whole is not asked.
    pub(crate) fn finish_part(mut self) -> Report {
        if let Some(follower) = &self.follower {
            self.reporter.word_worst(follower.machine(), &self.legs.rules);
        }
        let mut diagnostics = self.reporter.finish(&|_: ChainId| Vec::new());
        weigh(&self.assumed, self.follower.as_ref(), &mut diagnostics);
        self.summary.count(&diagnostics);
        Report {
            diagnostics,
            summary: self.summary,
            ..Report::default()
        }
    }
}
