//! A program's bytes and where its lines begin.
use memchr::{memchr, memchr_iter};
use std::sync::Arc;
use trunnion_syntax::TextRange;

/// Which file of a run: 0 is the main program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct FileId(pub u32);

impl FileId {
    /// The program that was started.
    pub const MAIN: Self = Self(0);
}

/// This many lines share one entry of the index: a file of nothing but line ends must not cost four times its size in memory.
pub(crate) const STRIDE: u32 = 64;

/// This many bytes are scanned together while the index is built.
const BLOCK: usize = 512;

/// Shared bytes.
#[derive(Debug)]
enum Bytes {
    Slice(Arc<[u8]>),
    Vector(Arc<Vec<u8>>),
}

impl Bytes {
    #[inline]
    fn get(&self) -> &[u8] {
        match self {
            Self::Slice(bytes) => bytes,
            Self::Vector(bytes) => bytes,
        }
    }
}

/// A program's bytes and where its lines begin.
#[derive(Debug)]
pub struct Source {
    /// As people are shown it; empty for the main program.
    pub path: String,
    bytes: Bytes,
    /// Offset of every 64th line.
    starts: Vec<u32>,
    lines: u32,
}

impl Source {
    /// Finds the lines. A file is at most 4 GiB long; the callers refuse longer files.
    pub fn new(path: String, bytes: Arc<[u8]>) -> Self {
        Self::of(path, Bytes::Slice(bytes))
    }
    /// The same for bytes in a vector, which are not copied.
    pub fn shared(path: String, bytes: Arc<Vec<u8>>) -> Self {
        Self::of(path, Bytes::Vector(bytes))
    }
    fn of(path: String, held: Bytes) -> Self {
        let bytes = held.get();
        let mut starts = vec![0];
        let mut lines = 0u32;
        for (block, from) in bytes.chunks(BLOCK).zip((0..).step_by(BLOCK)) {
            let count = memchr_iter(b'\n', block).count() as u32;
            // most blocks begin no entry of the index: counting is much faster than finding each line end
            if lines % STRIDE + count >= STRIDE {
                let ends = memchr_iter(b'\n', block).zip(lines + 1..);
                let entries = ends.filter(|(_, line)| line % STRIDE == 0);
                starts.extend(entries.map(|(at, _)| (from + at) as u32 + 1));
            }
            lines += count;
        }
        // a last line without line end counts as a line
        lines += u32::from(bytes.last().is_some_and(|byte| *byte != b'\n'));
        Self {
            path,
            bytes: held,
            starts,
            lines,
        }
    }
    /// All bytes.
    #[inline]
    pub fn bytes(&self) -> &[u8] {
        self.bytes.get()
    }
    /// How many lines.
    pub fn line_count(&self) -> u32 {
        self.lines
    }
    /// Bytes of a line (from 0) with its line end; `None` after the last.
    pub fn line(&self, line: u32) -> Option<TextRange> {
        if line >= self.lines {
            return None;
        }
        let mut start = self.starts[(line / STRIDE) as usize];
        for _ in 0..line % STRIDE {
            start = self.line_at(start).end;
        }
        Some(self.line_at(start))
    }
    /// Bytes of the line that begins at an offset, with its line end; empty at the end of the file.
    #[inline]
    pub fn line_at(&self, start: u32) -> TextRange {
        let rest = &self.bytes()[start as usize..];
        let length = memchr(b'\n', rest).map_or(rest.len(), |at| at + 1);
        TextRange::new(start, start + length as u32)
    }
    /// The line (from 0) that contains a byte.
    pub fn line_of(&self, offset: u32) -> u32 {
        let block = self.starts.partition_point(|&start| start <= offset).saturating_sub(1);
        let from = self.starts[block] as usize;
        let to = (offset as usize).min(self.bytes().len());
        let line = block as u32 * STRIDE + memchr_iter(b'\n', &self.bytes()[from..to.max(from)]).count() as u32;
        line.min(self.lines.saturating_sub(1))
    }
}

#[cfg(test)]
mod tests {
    use super::Source;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn lines_are_where_they_are(lengths in proptest::collection::vec(0usize..40, 0..400), closed: bool) {
            let mut text: String = lengths.iter().map(|length| "x".repeat(*length) + "\n").collect();
            if !closed {
                text.push('y');
            }
            let source = Source::new(String::new(), text.as_bytes().into());
            let lines: Vec<&str> = text.split_inclusive('\n').collect();
            prop_assert_eq!(source.line_count() as usize, lines.len());
            let mut offset = 0;
            for (number, line) in (0..).zip(&lines) {
                let range = source.line(number).expect("it is there");
                prop_assert_eq!(range.as_usize(), offset..offset + line.len());
                prop_assert_eq!(source.line_of(offset as u32), number);
                offset += line.len();
            }
            prop_assert_eq!(source.line(lines.len() as u32), None);
        }
    }
}
