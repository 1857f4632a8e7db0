//! A parsed program: source, tokens, blocks and problems.
use crate::{Block, LexOptions, SyntaxError, TextRange, TokenTable};

/// Index of a block; one block per line (APT: per statement, which may span lines by `$`).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Default)]
pub struct BlockId(pub u32);

/// A parsed program. Owns its source; blocks and words are views into it.
#[derive(Clone, Debug)]
pub struct Program {
    pub(crate) source: Vec<u8>,
    pub(crate) options: LexOptions,
    pub(crate) tokens: TokenTable,
    /// First token of each block.
    pub(crate) blocks: Vec<u32>,
    pub(crate) errors: Vec<SyntaxError>,
}

/// Parses any bytes. Total: problems are in [`Program::errors`].
pub fn parse(source: Vec<u8>, options: LexOptions) -> Program {
    let _ = (source, options);
    todo!()
}

impl Program {
    /// The bytes as they lie on disk.
    pub fn source(&self) -> &[u8] {
        &self.source
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
    /// Number of blocks (lines, empty ones included; APT: statements).
    pub fn block_count(&self) -> usize {
        self.blocks.len()
    }
    /// View of one block.
    pub fn block(&self, id: BlockId) -> Block<'_> {
        Block { program: self, id }
    }
    /// All blocks in order.
    pub fn blocks(&self) -> impl Iterator<Item = Block<'_>> {
        (0..self.blocks.len() as u32).map(|i| self.block(BlockId(i)))
    }
    /// The block that holds the byte `offset`.
    pub fn block_at(&self, offset: u32) -> Option<BlockId> {
        let _ = offset;
        todo!()
    }
    /// The text of a range, where it is UTF-8; else with replacement characters.
    pub fn text(&self, range: TextRange) -> std::borrow::Cow<'_, str> {
        String::from_utf8_lossy(&self.source[range.as_usize()])
    }
}

/// Line starts of a text: byte offsets to lines and columns and back.
#[derive(Clone, Debug)]
pub struct LineIndex {
    /// Byte offset of the start of each line (lines end with `\n`, `\r\n` or a lone `\r`).
    pub starts: Vec<u32>,
}

impl LineIndex {
    /// Line starts of `source`.
    pub fn new(source: &[u8]) -> Self {
        let _ = source;
        todo!()
    }
    /// Line and column of a byte, both from 1; the column counts Unicode characters (invalid bytes count one each).
    pub fn line_column(&self, source: &[u8], offset: u32) -> (u32, u32) {
        let _ = (source, offset);
        todo!()
    }
}
