//! Which blocks of the main program have run, and which faults were told, so that a loop tells each of them once.
use crate::{Fault, FaultKind};
use std::collections::HashSet;
use std::mem::{Discriminant, discriminant};

/// A set of blocks.
#[derive(Clone, Debug, Default)]
pub(crate) struct Ran {
    bits: Vec<u64>,
    /// First block of the stretch that runs now, which is not in `bits` yet.
    pub(crate) from: u32,
}

impl Ran {
    /// The stretch up to `end` (not included) has run; another begins at `next`.
    pub(crate) fn jump(&mut self, end: u32, next: u32) {
        self.add(self.from, end);
        self.from = next;
    }

    fn add(&mut self, from: u32, end: u32) {
        if from >= end {
            return;
        }
        let (first, last) = (from / 64, (end - 1) / 64);
        if self.bits.len() <= last as usize {
            self.bits.resize(last as usize + 1, 0);
        }
        for word in first..=last {
            let low = if word == first { from % 64 } else { 0 };
            let high = if word == last { (end - 1) % 64 } else { 63 };
            self.bits[word as usize] |= (u64::MAX << low) & (u64::MAX >> (63 - high));
        }
    }

    /// Whether a block has run before the stretch that runs now.
    pub(crate) fn has(&self, block: u32) -> bool {
        let bits = self.bits.get(block as usize / 64).copied().unwrap_or(0);
        bits & (1 << (block % 64)) != 0
    }
}

/// What tells one fault from another: file, block, first byte, kind.
type Key = (u16, u32, u32, Discriminant<FaultKind>);

/// Faults that were told.
#[derive(Clone, Debug, Default)]
pub(crate) struct Told(HashSet<Key>);

/// Faults kept: a program of noise fills no memory.
const KEPT: usize = 100_000;

impl Told {
    /// Whether the fault is new. `again`: its block has run before, so that what its text alone says was told then.
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

/// Facts that hang on the text of a block alone: each run of it gives the same.
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
