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
    /// The one before each motion.
    previous: Vec<Option<usize>>,
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
        let mut previous = vec![None; motions.len()];
        for index in 1..motions.len() {
            let is_known = next[index - 1] == Some(index - 1);
            previous[index] = if is_known { Some(index - 1) } else { previous[index - 1] };
        }
        Self { first, next, previous }
    }

    /// Whether no motion before this one ends at a known position with the tool.
    pub fn none_before(&self, index: usize, tool: Option<u32>) -> bool {
        self.first.get(&tool).is_none_or(|&first| first >= index)
    }

    /// Whether a rapid to an unknown position may be left out: before all known positions of its tool, or after the last one.
    pub fn is_outside(&self, motions: &[Posed], index: usize) -> bool {
        let posed = &motions[index];
        let tool = posed.motion.tool;
        let rapid = matches!(posed.motion.kind, MotionKind::Rapid | MotionKind::Unknown);
        let next = self.next_from(index).map(|next| &motions[next]);
        rapid && (self.none_before(index, tool) || next.is_none_or(|next| next.motion.tool != tool))
    }

    /// Whether the last known position before a motion was reached by a cut of the same tool: without the motion the tool would stay there.
    pub fn leaves_a_cut(&self, motions: &[Posed], index: usize) -> bool {
        let before = self.previous[index].map(|before| &motions[before].motion);
        before.is_some_and(|before| before.is_feed() && before.tool == motions[index].motion.tool)
    }

    /// The next motion to a known position: this one, or one after it.
    pub fn next_from(&self, index: usize) -> Option<usize> {
        self.next.get(index).copied().flatten()
    }
}
