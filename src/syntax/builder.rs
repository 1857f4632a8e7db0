//! What a lexer writes into: tokens, block starts and problems.
use crate::scan::Scan;
use crate::{Format, LexOptions, SyntaxError, TokenKind, TokenTable, items, record, straight};

/// Tokens and blocks as they grow. A block is checked as soon as it is complete.
#[derive(Default)]
pub(crate) struct Builder {
    pub(crate) table: TokenTable,
    /// First token of each block.
    pub(crate) blocks: Vec<u32>,
    pub(crate) errors: Vec<SyntaxError>,
    /// First token of the block at work.
    pub(crate) first: u32,
    /// Whether the block at work must be read once by the grammar, for problems.
    pub(crate) odd: bool,
    /// Whether it holds more than words, comments and blanks, all of it cut the fast way.
    pub(crate) formula: bool,
}

impl Builder {
    /// Room for so many tokens and blocks.
    pub(crate) fn with_room(tokens: usize, blocks: usize) -> Self {
        let mut out = Self::default();
        out.table.kinds.reserve(tokens);
        out.table.starts.reserve(tokens);
        out.blocks.reserve(blocks);
        out
    }

    /// Adds a token that starts at byte `start`.
    #[inline]
    pub(crate) fn push(&mut self, kind: TokenKind, start: u32) {
        self.table.kinds.push(kind);
        self.table.starts.push(start);
    }

    /// Whether the block at work has nothing but blanks so far.
    pub(crate) fn block_is_empty(&self) -> bool {
        self.table.kinds[self.first as usize..]
            .iter()
            .all(|&kind| kind == TokenKind::Blank)
    }

    /// Ends the block at work behind the last token, which ends at byte `end`.
    #[inline]
    pub(crate) fn end_block(&mut self, source: &[u8], options: LexOptions, end: u32) {
        self.blocks.push(self.first);
        if self.odd || self.formula {
            self.check(source, options, end);
        }
        self.first = self.table.kinds.len() as u32;
    }

    /// Ends the last block, if it has any token, and the table.
    pub(crate) fn finish(&mut self, source: &[u8], options: LexOptions, end: u32) {
        if self.first as usize != self.table.kinds.len() {
            self.end_block(source, options, end);
        }
        self.table.end = end;
        self.errors.sort_by_key(|error| (error.range.start, error.range.end));
    }

    /// Reads the block once with the grammar, for its problems, unless a look at its kinds of tokens shows that it has none.
    fn check(&mut self, source: &[u8], options: LexOptions, end: u32) {
        self.formula = false;
        let odd = core::mem::take(&mut self.odd);
        self.table.end = end;
        let scan = Scan {
            source,
            table: &self.table,
            options,
            end: self.table.kinds.len() as u32,
        };
        if !odd && straight::is_sound(scan, self.first) {
            return;
        }
        match options.format {
            Format::Iso => items::check(scan, self.first, &mut self.errors),
            Format::Apt => record::check(scan, self.first, &mut self.errors),
        }
    }
}
