//! How far a run is in its text, for a line on a terminal.
use std::sync::{
    Arc,
    atomic::{AtomicU32, AtomicU64, Ordering::Relaxed},
};

/// A shorter text needs no share: it is run in a moment.
const LEAST_BLOCKS: usize = 4096;
/// Where a run is becomes known at every so many blocks of the text.
const EVERY: u32 = 256;

/// Where the run of a long text is. Runs write it and take nothing from it, so all values are equal. Without [`Progress::watched`] nothing is kept.
#[derive(Clone, Debug, Default)]
pub struct Progress(Option<Arc<Place>>);

#[derive(Debug, Default)]
struct Place {
    /// The block in the upper half, the number of blocks in the lower one. 0 between two runs.
    at: AtomicU64,
    ended: AtomicU32,
}

impl PartialEq for Progress {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Progress {
    /// One that can be asked while a run goes on.
    pub fn watched() -> Self {
        Self(Some(Arc::default()))
    }

    /// Other work begins: its runs are counted from 1.
    pub fn begin(&self) {
        if let Some(place) = &self.0 {
            place.at.store(0, Relaxed);
            place.ended.store(0, Relaxed);
        }
    }

    /// A run did this block of so many.
    #[inline]
    pub fn reach(&self, block: u32, blocks: usize) {
        if let Some(place) = &self.0
            && block.is_multiple_of(EVERY)
            && blocks >= LEAST_BLOCKS
        {
            place.at.store(u64::from(block) << 32 | blocks as u64, Relaxed);
        }
    }

    /// A run is at its end.
    pub fn end(&self) {
        if let Some(place) = &self.0
            && place.at.swap(0, Relaxed) != 0
        {
            place.ended.fetch_add(1, Relaxed);
        }
    }

    /// The share of the text in percent, rounded down, and the number of the run, counted from 1. None between two runs.
    pub fn share(&self) -> Option<(u32, u32)> {
        let place = self.0.as_ref()?;
        let at = place.at.load(Relaxed);
        let (block, blocks) = (at >> 32, at & u64::from(u32::MAX));
        let share = (block * 100).checked_div(blocks)?;
        Some((share as u32, place.ended.load(Relaxed) + 1))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_run_has_a_share_until_its_end() {
        let progress = Progress::watched();
        let seen = progress.clone();
        assert_eq!(seen.share(), None);
        progress.reach(37 * 1024, 102_400);
        assert_eq!(seen.share(), Some((37, 1)));
        // between two of the blocks that are written down
        progress.reach(40 * 1024 + 1, 102_400);
        assert_eq!(seen.share(), Some((37, 1)));
        progress.end();
        assert_eq!(seen.share(), None);
        progress.end();
        progress.reach(1024, 102_400);
        assert_eq!(seen.share(), Some((1, 2)), "an end without a share is not counted");
        progress.begin();
        assert_eq!(seen.share(), None);
        progress.reach(1024, 102_400);
        assert_eq!(seen.share(), Some((1, 1)));
    }

    #[test]
    fn a_short_text_has_none() {
        let progress = Progress::watched();
        progress.reach(256, LEAST_BLOCKS - 1);
        assert_eq!(progress.share(), None);
        Progress::default().reach(256, LEAST_BLOCKS);
        assert_eq!(Progress::default().share(), None);
    }
}
