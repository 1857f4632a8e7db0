//! Which lines ran, and where skips from those that ran more than once ended.
use super::labels::Place;
use foldhash::HashMap;

/// Where a skip ended, and the generation of labels for which that holds.
pub(super) type Skip = Option<(u64, Place)>;

/// What is remembered about the lines of one file.
#[derive(Debug, Default)]
pub(crate) struct Lines {
    /// A bit per line that ran.
    ran: Vec<u64>,
    /// Lines from here on never ran.
    frontier: u32,
    /// Lines from here on were never skipped.
    glanced: u32,
    /// Of lines that run repeatedly: where the skip that they began ended.
    skips: HashMap<u32, Skip>,
}

/// A copy starts empty: check-points must not copy what can be computed again.
impl Clone for Lines {
    fn clone(&self) -> Self {
        Self {
            ran: self.ran.clone(),
            frontier: self.frontier,
            glanced: self.glanced,
            skips: HashMap::default(),
        }
    }
}

impl Lines {
    /// Whether a line ran before; records that it runs now.
    #[inline]
    pub(crate) fn run(&mut self, line: u32) -> bool {
        let word = (line / 64) as usize;
        let bit = 1 << (line % 64);
        if line >= self.frontier {
            self.frontier = line + 1;
            if word >= self.ran.len() {
                self.ran.resize(word + 1, 0);
            }
        } else if self.ran[word] & bit != 0 {
            return true;
        }
        self.ran[word] |= bit;
        false
    }
    /// Whether no line from this one on ever ran.
    #[inline]
    pub(crate) fn is_new(&self, line: u32) -> bool {
        line >= self.frontier
    }
    /// Whether a line ran.
    pub(crate) fn has_run(&self, line: u32) -> bool {
        self.ran
            .get((line / 64) as usize)
            .is_some_and(|word| word & (1 << (line % 64)) != 0)
    }
    /// Whether the 64 lines from one on, whose number 64 divides, all ran.
    pub(crate) fn all_ran(&self, line: u32) -> bool {
        self.ran.get((line / 64) as usize) == Some(&u64::MAX)
    }
    /// Lines from here on were never skipped.
    pub(crate) fn glanced(&self) -> u32 {
        self.glanced
    }
    /// Whether a line that is skipped was skipped or run before; records that it was examined.
    pub(crate) fn glance(&mut self, line: u32) -> bool {
        let before = line < self.glanced;
        self.glanced = self.glanced.max(line + 1);
        before
    }
    /// Where the skip from a line ended, if that is known.
    pub(super) fn skip(&self, line: u32) -> Skip {
        self.skips.get(&line).copied().flatten()
    }
    /// Records that a line runs repeatedly, and where its skip ended.
    pub(super) fn keep(&mut self, line: u32, skip: Skip) {
        self.skips.insert(line, skip);
    }
    /// Records where the skip from a line ended, if the line runs repeatedly.
    pub(super) fn skipped(&mut self, line: u32, skip: Skip) {
        if let Some(kept) = self.skips.get_mut(&line) {
            *kept = skip;
        }
    }
}
