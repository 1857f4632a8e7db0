//! Where the known positions of a program are.
use std::collections::BTreeMap;
use trunnion_certify::conversion::Posed;
use trunnion_interp::MotionKind;

/// Motions whose end is known.
pub(crate) struct Known {
    /// The first of each tool.
    pub(crate) first: BTreeMap<Option<u32>, usize>,
    /// The next one from each motion on, itself included.
    pub(crate) next: Vec<Option<usize>>,
}

impl Known {
    pub(crate) fn of(motions: &[Posed]) -> Self {
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
}
