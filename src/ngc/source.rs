//! A program's bytes and where its lines begin.
use memchr::memchr_iter;
use std::sync::Arc;
use trunnion_syntax::TextRange;

/// Which file of a run: 0 is the main program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct FileId(pub u32);

impl FileId {
    /// The program that was started.
    pub const MAIN: Self = Self(0);
}

/// A program's bytes and where its lines begin.
#[derive(Debug)]
pub struct Source {
    /// As people are shown it; empty for the main program.
    pub path: String,
    bytes: Arc<[u8]>,
    /// Offset of each line, and the length of the file at the end.
    starts: Vec<u32>,
}

impl Source {
    /// Finds the lines. A file is at most 4 GiB long; what lies behind is cut off by the callers, who refuse such files.
    pub fn new(path: String, bytes: Arc<[u8]>) -> Self {
        let mut starts = vec![0];
        starts.extend(memchr_iter(b'\n', &bytes).map(|at| at as u32 + 1));
        if starts.last() != Some(&(bytes.len() as u32)) {
            starts.push(bytes.len() as u32);
        }
        Self { path, bytes, starts }
    }
    /// All bytes.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }
    /// How many lines.
    pub fn line_count(&self) -> u32 {
        self.starts.len() as u32 - 1
    }
    /// Bytes of a line (from 0) with its line end; `None` behind the last.
    pub fn line(&self, line: u32) -> Option<TextRange> {
        let start = *self.starts.get(line as usize)?;
        let end = *self.starts.get(line as usize + 1)?;
        Some(TextRange::new(start, end))
    }
    /// The line (from 0) in which a byte lies.
    pub fn line_of(&self, offset: u32) -> u32 {
        (self.starts.partition_point(|&start| start <= offset) as u32).saturating_sub(1)
    }
}
