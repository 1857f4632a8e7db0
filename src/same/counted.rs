//! How many motions a run has yielded, so that nobody runs it again to count them.
use crate::input::Input;
use crate::item::{Item, Step};
use crate::steps::Steps;

/// How many motions were yielded, and for how many of them the function held.
pub(crate) struct Counted {
    holds: fn(&Step, &Input<'_>) -> bool,
    count: [u64; 2],
}

impl Counted {
    pub(crate) fn take(&mut self, item: &Item, input: &Input<'_>) {
        if let Item::Motion(step) = item {
            self.count[0] += 1;
            self.count[1] += u64::from((self.holds)(step, input));
        }
    }
}

impl Steps<'_> {
    /// Counts the motions that [`Iterator::next`] yields, and those for which a function holds, for [`Steps::counted`].
    pub fn count_motions(&mut self, holds: fn(&Step, &Input<'_>) -> bool) {
        let count = [0; 2];
        self.counted = Some(Counted { holds, count });
    }

    /// See [`Steps::count_motions`].
    pub fn counted(&self) -> [u64; 2] {
        self.counted.as_ref().map_or([0; 2], |counted| counted.count)
    }
}
