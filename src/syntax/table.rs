//! The token table: kinds and starts side by side, two and a quarter bytes a token.
use crate::TokenKind;
use crate::starts::Starts;
use core::ops::Range;

/// A half-open range of bytes in the source.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Default)]
pub struct TextRange {
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
}

impl TextRange {
    /// The range `start..end`.
    pub fn new(start: u32, end: u32) -> Self {
        Self { start, end }
    }
    /// As indices into the source.
    pub fn as_usize(self) -> Range<usize> {
        self.start as usize..self.end as usize
    }
    /// The smallest range that holds both.
    pub fn cover(self, other: Self) -> Self {
        Self {
            start: self.start.min(other.start),
            end: self.end.max(other.end),
        }
    }
    /// The range this many bytes later; wrapping, so that 2^32 less moves back.
    #[inline]
    #[must_use]
    pub fn shifted(self, by: u32) -> Self {
        Self {
            start: self.start.wrapping_add(by),
            end: self.end.wrapping_add(by),
        }
    }
    /// Whether `offset` is inside, including the end.
    pub fn touches(self, offset: u32) -> bool {
        self.start <= offset && offset <= self.end
    }
}

/// Index of a token.
pub type TokenId = u32;

/// Kinds and start offsets of all tokens of a source; token `i` ends where token `i + 1` starts.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct TokenTable {
    pub(crate) kinds: Vec<TokenKind>,
    pub(crate) starts: Starts,
    pub(crate) end: u32,
}

impl TokenTable {
    /// Room for so many tokens.
    pub(crate) fn with_room(tokens: usize) -> Self {
        let mut out = Self::default();
        out.kinds.reserve(tokens);
        out.starts.reserve(tokens);
        out
    }
    /// Number of tokens.
    pub fn len(&self) -> usize {
        self.kinds.len()
    }
    /// Whether there is no token.
    pub fn is_empty(&self) -> bool {
        self.kinds.is_empty()
    }
    /// Kind of token `id`.
    pub fn kind(&self, id: TokenId) -> TokenKind {
        self.kinds[id as usize]
    }
    /// Bytes of token `id`.
    #[inline]
    pub fn range(&self, id: TokenId) -> TextRange {
        let next = id as usize + 1;
        let end = if next < self.kinds.len() {
            self.starts.get(next)
        } else {
            self.end
        };
        TextRange::new(self.start(id), end)
    }
    /// First byte of token `id`.
    #[inline]
    pub(crate) fn start(&self, id: TokenId) -> u32 {
        self.starts.get(id as usize)
    }
    /// Memory that the tokens take, bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&*self.kinds) + self.starts.bytes()
    }
}
