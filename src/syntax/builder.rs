//! What a lexer writes into: tokens, block starts and problems.
use crate::scan::Scan;
use crate::straight::Course;
use crate::{Format, LexOptions, SyntaxError, TokenKind, TokenTable, items, record};

/// This many tokens of the fast path are held back, and go to the table in one piece.
pub(crate) const HELD: usize = 512;

/// Tokens that are not in the table yet.
struct Held {
    kinds: [TokenKind; HELD],
    starts: [u32; HELD],
}

impl Default for Held {
    fn default() -> Self {
        Self {
            kinds: [TokenKind::Blank; HELD],
            starts: [0; HELD],
        }
    }
}

/// Tokens and blocks that are being built. A block is checked as soon as it is complete.
#[derive(Default)]
pub(crate) struct Builder {
    pub(crate) table: TokenTable,
    /// First token of each block.
    pub(crate) blocks: Vec<u32>,
    pub(crate) errors: Vec<SyntaxError>,
    /// First token of the current block.
    pub(crate) first: u32,
    /// Whether the current block must be read once by the grammar, for problems.
    pub(crate) course: Course,
    held: Held,
}

impl Builder {
    /// Room for this many tokens and blocks.
    pub(crate) fn with_room(tokens: usize, blocks: usize) -> Self {
        Self {
            table: TokenTable::with_room(tokens),
            blocks: Vec::with_capacity(blocks),
            ..Self::default()
        }
    }

    /// Adds a token that starts at byte `start`.
    #[inline]
    pub(crate) fn push(&mut self, kind: TokenKind, start: u32) {
        self.table.kinds.push(kind);
        self.table.starts.push(start);
    }

    /// Holds token `at` of those that [`Self::release`] adds. The place is below [`HELD`].
    #[inline]
    pub(crate) fn hold(&mut self, at: usize, kind: TokenKind, start: u32) {
        self.held.kinds[at] = kind;
        self.held.starts[at] = start;
    }

    /// Kind of token `at` of those that are held.
    #[inline]
    pub(crate) fn held(&self, at: usize) -> TokenKind {
        self.held.kinds[at]
    }

    /// Adds the first `count` tokens that are held.
    pub(crate) fn release(&mut self, count: usize) {
        self.table.kinds.extend_from_slice(&self.held.kinds[..count]);
        self.table.starts.extend(&self.held.starts[..count]);
    }

    /// Whether the current block has only blanks so far.
    pub(crate) fn block_is_empty(&self) -> bool {
        self.table.kinds[self.first as usize..]
            .iter()
            .all(|&kind| kind == TokenKind::Blank)
    }

    /// Ends the current block after the last token, which ends at byte `end`.
    #[inline]
    pub(crate) fn end_block(&mut self, source: &[u8], options: LexOptions, end: u32) {
        if !self.course.end() {
            self.check(source, options, end);
        }
        self.blocks.push(self.first);
        self.first = self.table.kinds.len() as u32;
    }

    /// Ends the last block, if it has any token, and the table.
    pub(crate) fn finish(&mut self, source: &[u8], options: LexOptions, end: u32) {
        if self.first as usize != self.table.kinds.len() {
            self.end_block(source, options, end);
        }
        self.table.end = end;
        self.sort_errors();
    }

    /// Sorts the problems by place; those of one place stay as they were found.
    pub(crate) fn sort_errors(&mut self) {
        self.errors.sort_by_key(|error| (error.range.start, error.range.end));
    }

    /// Reads the current block once with the grammar, for its problems. It ends at byte `end`.
    #[cold]
    pub(crate) fn check(&mut self, source: &[u8], options: LexOptions, end: u32) {
        self.table.end = end;
        let scan = Scan {
            source,
            table: &self.table,
            options,
            end: self.table.kinds.len() as u32,
        };
        match options.format {
            Format::Iso | Format::Osp => items::check(scan, self.first, &mut self.errors),
            Format::Apt => record::check(scan, self.first, &mut self.errors),
            // the lexer reports its problems; what words mean is not known here
            Format::Klartext => {}
        }
    }
}
