//! Which faults were reported, so that a loop reports each of them once.
use crate::{Fault, FaultKind};
use std::collections::HashSet;
use std::mem::{Discriminant, discriminant};

/// What distinguishes one fault from another: file, block, first byte, kind.
type Key = (u16, u32, u32, Discriminant<FaultKind>);

/// Faults that were reported.
#[derive(Clone, Debug, Default)]
pub(crate) struct ReportedFaults(HashSet<Key>);

/// Faults kept: a program of noise must not fill the memory.
const KEPT: usize = 100_000;

impl ReportedFaults {
    /// What a clone copies, as entries of other lists: a fault is a few numbers. A program may have one in each block, and check-points
    /// that are as many blocks apart would be far from what an editor shows.
    pub(crate) fn copied(&self) -> usize {
        self.0.len() / 8
    }

    /// Whether the fault is new. `again`: its block has run before, so that facts of its text alone were reported then.
    pub(crate) fn is_new(&mut self, file: u16, fault: &Fault, again: bool) -> bool {
        if again && is_textual(&fault.kind) {
            return false;
        }
        let key = (file, fault.block.0, fault.range.start, discriminant(&fault.kind));
        if self.0.len() >= KEPT && !self.0.contains(&key) {
            return !again;
        }
        self.0.insert(key)
    }
}

/// Facts that depend on the text of a block alone: each run of it gives the same.
pub(crate) fn is_textual(kind: &FaultKind) -> bool {
    matches!(
        kind,
        FaultKind::UnknownCode { .. }
            | FaultKind::UnknownWord
            | FaultKind::GroupConflict { .. }
            | FaultKind::RepeatedWord
            | FaultKind::AmbiguousDecimal
    )
}
