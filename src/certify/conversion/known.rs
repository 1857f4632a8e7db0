//! Where the known positions of a program are: which of its rapids to unknown ones may be left out depends on them.
use super::reading::Posed;
use std::collections::BTreeMap;
use trunnion_interp::MotionKind;

/// Motions whose end is known, and that are no dwells.
pub struct Known {
    /// The first of each tool.
    first: BTreeMap<Option<u32>, usize>,
    /// The next one from each motion on, itself included.
    next: Vec<Option<usize>>,
}

impl Known {
    /// Those of all motions of a program, in their order. One pass: it is asked at each of them.
    pub fn of(motions: &[Posed]) -> Self {
        let (mut first, mut next, mut last) = (BTreeMap::new(), vec![None; motions.len()], None);
        for (index, posed) in motions.iter().enumerate().rev() {
            if posed.end.is_ok() && !matches!(posed.motion.kind, MotionKind::Dwell(_)) {
                first.insert(posed.motion.tool, index);
                last = Some(index);
            }
            next[index] = last;
        }
        Self { first, next }
    }

    /// Whether no motion before this one ends at a known position with the tool.
    pub fn none_before(&self, index: usize, tool: Option<u32>) -> bool {
        self.first.get(&tool).is_none_or(|&first| first >= index)
    }

    /// The next motion to a known position: this one, or one after it.
    pub fn next_from(&self, index: usize) -> Option<usize> {
        self.next.get(index).copied().flatten()
    }
}
