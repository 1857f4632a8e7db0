//! A parsed program: source, tokens, blocks and problems.
use crate::builder::Builder;
use crate::scan::Scan;
use crate::{
    Block, Format, LexOptions, SyntaxError, SyntaxErrorKind, TextRange, TokenId, TokenTable, apt, iso, klartext,
};
use core::ops::Range;
use std::borrow::Cow;
use std::sync::Arc;

/// Index of a block; one block per line (APT: per statement, which may span lines by `$`).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Default)]
pub struct BlockId(pub u32);

/// A parsed program. Owns its source; blocks and words are views into it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Program {
    pub(crate) source: Arc<Vec<u8>>,
    pub(crate) options: LexOptions,
    pub(crate) tokens: TokenTable,
    /// First token of each block.
    pub(crate) blocks: Vec<u32>,
    pub(crate) errors: Vec<SyntaxError>,
}

/// Parses any bytes. Total: problems are in [`Program::errors`].
pub fn parse(source: Vec<u8>, options: LexOptions) -> Program {
    parse_up_to(source, options, u32::MAX)
}

/// Parses the first `limit` bytes: offsets must fit their type.
fn parse_up_to(source: Vec<u8>, options: LexOptions, limit: u32) -> Program {
    let length = source.len().min(limit as usize);
    let mut out = room(&source[..length], options);
    lex(&source[..length], options, true, &mut out);
    if length < source.len() {
        let range = TextRange::new(limit.saturating_sub(1), limit);
        out.errors.push(SyntaxError {
            kind: SyntaxErrorKind::TooLarge,
            range,
        });
    }
    Program::of(source, options, out)
}

/// This many bytes of a longer file are used to estimate how much room its tokens need.
const SAMPLE: usize = 1 << 14;

/// Tables with room for the tokens of `source`, as many per byte as in a piece from its middle: growing them would copy them, and
/// fresh memory costs more than lexing.
pub(crate) fn room(source: &[u8], options: LexOptions) -> Builder {
    if source.len() < 4 * SAMPLE {
        return Builder::with_room(source.len() / 4 + 16, source.len() / 32 + 16);
    }
    let middle = source.len() / 2;
    let start = memchr::memchr(b'\n', &source[middle..middle + SAMPLE]).map_or(middle, |at| middle + at + 1);
    let mut sample = Builder::with_room(SAMPLE, SAMPLE / 8);
    lex(&source[start..start + SAMPLE], options, false, &mut sample);
    // an eighth more, so that a little denser parts fit, too
    let scaled = |count: usize| (count + 1) * (source.len() / SAMPLE + 1) / 8 * 9;
    Builder::with_room(scaled(sample.table.kinds.len()), scaled(sample.blocks.len()))
}

/// Lexes `source` with the lexer of its format.
pub(crate) fn lex(source: &[u8], options: LexOptions, at_start: bool, out: &mut Builder) {
    match options.format {
        Format::Iso | Format::Osp => iso::lex(source, options, at_start, out),
        Format::Apt => apt::lex(source, options, at_start, out),
        Format::Klartext => klartext::lex(source, options, at_start, out),
    }
}

impl Program {
    /// A text with its tokens.
    pub(crate) fn of(source: Vec<u8>, options: LexOptions, lexed: Builder) -> Self {
        Self {
            source: Arc::new(source),
            options,
            tokens: lexed.table,
            blocks: lexed.blocks,
            errors: lexed.errors,
        }
    }
    /// The bytes as on disk.
    pub fn source(&self) -> &[u8] {
        &self.source
    }
    /// The same, shared without a copy.
    pub fn shared_source(&self) -> Arc<Vec<u8>> {
        Arc::clone(&self.source)
    }
    /// How it was lexed.
    pub fn options(&self) -> LexOptions {
        self.options
    }
    /// All tokens.
    pub fn tokens(&self) -> &TokenTable {
        &self.tokens
    }
    /// Problems of the text, sorted by place.
    pub fn errors(&self) -> &[SyntaxError] {
        &self.errors
    }
    /// Number of blocks (lines, empty ones included; a line end at the end of the file opens no further one; APT: statements).
    pub fn block_count(&self) -> usize {
        self.blocks.len()
    }
    /// View of one block. Its number must be below [`Self::block_count`].
    pub fn block(&self, id: BlockId) -> Block<'_> {
        Block { program: self, id }
    }
    /// All blocks in order.
    pub fn blocks(&self) -> impl Iterator<Item = Block<'_>> {
        (0..self.blocks.len() as u32).map(|i| self.block(BlockId(i)))
    }
    /// The block that holds the byte `offset`, its line end included; the end of the text belongs to the last block.
    /// `None` beyond it, and in an empty program.
    pub fn block_at(&self, offset: u32) -> Option<BlockId> {
        if offset > self.tokens.end {
            return None;
        }
        let behind = self.blocks.partition_point(|&first| self.tokens.start(first) <= offset);
        behind.checked_sub(1).map(|index| BlockId(index as u32))
    }
    /// [`Self::block_at`], where the byte is likely to be in a known block: then nothing is searched.
    pub fn block_near(&self, offset: u32, near: BlockId) -> Option<BlockId> {
        let first = self.blocks.get(near.0 as usize);
        let next = self.blocks.get(near.0 as usize + 1);
        match (first, next) {
            (Some(&first), Some(&next)) if self.tokens.start(first) <= offset && offset < self.tokens.start(next) => {
                Some(near)
            }
            _ => self.block_at(offset),
        }
    }
    /// The text of a range, where it is UTF-8; else with replacement characters.
    pub fn text(&self, range: TextRange) -> Cow<'_, str> {
        String::from_utf8_lossy(self.bytes(range))
    }
    /// The bytes of a range; of the part inside the file where it reaches outside.
    pub fn bytes(&self, range: TextRange) -> &[u8] {
        let end = (range.end as usize).min(self.source.len());
        &self.source[(range.start as usize).min(end)..end]
    }
    /// The tokens of a block.
    #[inline]
    pub(crate) fn block_tokens(&self, id: BlockId) -> Range<TokenId> {
        let end = self
            .blocks
            .get(id.0 as usize + 1)
            .copied()
            .unwrap_or(self.tokens.kinds.len() as u32);
        self.blocks[id.0 as usize]..end
    }
    /// A view of the tokens before `end`.
    #[inline]
    pub(crate) fn scan(&self, end: TokenId) -> Scan<'_> {
        Scan {
            source: &self.source,
            table: &self.tokens,
            options: self.options,
            end,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::parse_up_to;
    use crate::{LexOptions, SyntaxErrorKind, TextRange};

    #[test]
    fn a_file_that_is_too_large_is_parsed_as_far_as_offsets_reach() {
        let program = parse_up_to(b"G1 X1\nG1 X23456\n".to_vec(), LexOptions::default(), 12);
        assert_eq!(program.block_count(), 2);
        assert_eq!(program.tokens().range(program.tokens().len() as u32 - 1).end, 12);
        assert_eq!(program.errors().len(), 1);
        assert_eq!(program.errors()[0].kind, SyntaxErrorKind::TooLarge);
        assert_eq!(program.errors()[0].range, TextRange::new(11, 12));
    }
}
