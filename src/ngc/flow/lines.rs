//! Lines that ran: which ones, and what was found out about those that ran more than once.
use super::Memo;
use std::collections::VecDeque;

/// Lines of one page.
const PAGE: u32 = 128;
/// So many pages are kept per file, those that began last.
const KEPT: usize = 64;

type Page = [Option<Kept>; PAGE as usize];

/// What is kept of a line.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Kept {
    /// Where its read form is, if it is not gone.
    pub(super) slot: u32,
    pub(super) memo: Memo,
}

/// What is remembered of one file's lines.
#[derive(Debug, Default)]
pub(crate) struct Lines {
    /// A bit per line that ran.
    ran: Vec<u64>,
    /// Lines from here on never ran.
    frontier: u32,
    /// Lines from here on were never skipped.
    glanced: u32,
    pages: Vec<Option<Box<Page>>>,
    /// Pages that are there, in the order in which they began.
    order: VecDeque<u32>,
}

/// A copy finds out again: check-points must not copy what can be computed again.
impl Clone for Lines {
    fn clone(&self) -> Self {
        Self {
            ran: self.ran.clone(),
            frontier: self.frontier,
            glanced: self.glanced,
            pages: Vec::new(),
            order: VecDeque::new(),
        }
    }
}

impl Lines {
    /// Whether a line ran before; it is noted that it does now.
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
    /// Whether a line that is skipped was skipped or run before; it is noted that it was looked at.
    pub(crate) fn glance(&mut self, line: u32) -> bool {
        let before = line < self.glanced;
        self.glanced = self.glanced.max(line + 1);
        before
    }
    /// What is kept of a line.
    #[inline]
    pub(crate) fn kept(&mut self, line: u32) -> Option<&mut Kept> {
        let page = self.pages.get_mut((line / PAGE) as usize)?.as_mut()?;
        page[(line % PAGE) as usize].as_mut()
    }
    /// Keeps what was found out about a line.
    #[inline]
    pub(crate) fn keep(&mut self, line: u32, kept: Kept) {
        let page = (line / PAGE) as usize;
        if page >= self.pages.len() {
            self.pages.resize_with(page + 1, || None);
        }
        if self.pages[page].is_none() {
            self.pages[page] = Some(self.begin_page(page as u32));
        }
        if let Some(page) = &mut self.pages[page] {
            page[(line % PAGE) as usize] = Some(kept);
        }
    }
    /// An empty page: where there are enough the oldest one is forgotten.
    fn begin_page(&mut self, page: u32) -> Box<Page> {
        self.order.push_back(page);
        let oldest = if self.order.len() > KEPT {
            self.order.pop_front()
        } else {
            None
        };
        let Some(mut old) = oldest.and_then(|oldest| self.pages[oldest as usize].take()) else {
            return Box::new([const { None }; PAGE as usize]);
        };
        old.fill(None);
        old
    }
}
