//! A cursor over the bytes of one line that skips blanks, tabs and carriage returns.
use trunnion_syntax::TextRange;

/// Reads a piece of a program byte by byte, skips blanks (tabs and carriage returns, too), gives letters in lower case, and knows where it is.
///
/// RS274/NGC and Macro B give blanks no meaning anywhere outside comments: `X 1 2` is `X12`, `s q r t [4]` is a function.
/// A cursor is small and can be copied: a copy is a mark one can go back to.
#[derive(Clone, Copy, Debug)]
pub struct Cursor<'s> {
    source: &'s [u8],
    /// Offset of the next byte that is not a blank, or `end`.
    at: u32,
    /// One past the last byte that was read.
    behind: u32,
    end: u32,
}

/// Whether `byte` has no meaning to either grammar.
pub(crate) fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | b'\r')
}

impl<'s> Cursor<'s> {
    /// A cursor over `range` of the file `source`; parts of the range beyond the file do not exist.
    pub fn new(source: &'s [u8], range: TextRange) -> Self {
        let length = u32::try_from(source.len()).unwrap_or(u32::MAX);
        let end = range.end.min(length);
        let start = range.start.min(end);
        let mut cursor = Self {
            source,
            at: start,
            behind: start,
            end,
        };
        cursor.skip();
        cursor
    }

    fn skip(&mut self) {
        let rest = &self.source[self.at as usize..self.end as usize];
        let blanks = rest.iter().position(|&byte| !is_blank(byte)).unwrap_or(rest.len());
        self.at += blanks as u32;
    }

    /// The next byte that is not a blank, letters in lower case; `None` at the end.
    #[inline]
    pub fn peek(&self) -> Option<u8> {
        self.rest().first().map(u8::to_ascii_lowercase)
    }

    /// The byte after [`Self::peek`], by the same rules.
    pub fn peek_second(&self) -> Option<u8> {
        let mut next = *self;
        next.bump();
        next.peek()
    }

    /// Takes the next byte, as [`Self::peek`] gives it.
    #[inline]
    pub fn bump(&mut self) -> Option<u8> {
        let byte = self.peek()?;
        self.at += 1;
        self.behind = self.at;
        if self.rest().first().copied().is_some_and(is_blank) {
            self.skip();
        }
        Some(byte)
    }

    /// Takes the next byte if it is `byte` (in lower case).
    pub fn eat(&mut self, byte: u8) -> bool {
        let there = self.peek() == Some(byte);
        if there {
            self.bump();
        }
        there
    }

    /// Offset in the file of the next byte that is not a blank, or the end of the range.
    pub fn at(&self) -> u32 {
        self.at
    }

    /// One past the last byte that was taken (blanks after it not counted).
    pub fn behind(&self) -> u32 {
        self.behind
    }

    /// The range from `start` to the last byte that was taken.
    pub fn since(&self, start: u32) -> TextRange {
        TextRange::new(start, self.behind.max(start))
    }

    /// The next byte alone, or an empty range at the end.
    pub fn here(&self) -> TextRange {
        TextRange::new(self.at, (self.at + 1).min(self.end))
    }

    /// The rest that is not read yet, as it is in the file.
    #[inline]
    pub fn rest(&self) -> &'s [u8] {
        &self.source[self.at as usize..self.end as usize]
    }

    /// Whether nothing but blanks is left.
    pub fn is_at_end(&self) -> bool {
        self.at >= self.end
    }

    /// Advances to the byte at `offset` of the file, at most to the end of the range; never back.
    #[inline]
    pub fn skip_to(&mut self, offset: u32) {
        if offset > self.at {
            self.at = offset.min(self.end);
            self.behind = self.at;
            if self.rest().first().copied().is_some_and(is_blank) {
                self.skip();
            }
        }
    }
}
