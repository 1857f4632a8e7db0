//! A block's text without its comments, upper case, byte for byte at its place in the file.
use trunnion_syntax::{Block, TextRange};

/// One block to be read by lints.
pub(crate) struct Line<'p> {
    pub(crate) block: Block<'p>,
    /// Upper case, with comments as blanks. Byte `i` is at `start + i` in the file.
    pub(crate) text: Vec<u8>,
    start: u32,
}

impl<'p> Line<'p> {
    pub(crate) fn new(block: Block<'p>) -> Self {
        let range = block.range();
        let mut text = block.program().source()[range.as_usize()].to_ascii_uppercase();
        for comment in block.comments() {
            let from = comment.range.start.saturating_sub(range.start) as usize;
            let to = (comment.range.end.saturating_sub(range.start) as usize).min(text.len());
            if let Some(comment) = text.get_mut(from..to) {
                comment.fill(b' ');
            }
        }
        Self {
            block,
            text,
            start: range.start,
        }
    }

    /// Bytes `at..at + length` of the text as a range of the file.
    pub(crate) fn range(&self, at: usize, length: usize) -> TextRange {
        let start = self.start + at as u32;
        TextRange::new(start, start + length as u32)
    }

    /// Where `name` occurs as a function: directly before a bracket, not as the end of a longer name.
    pub(crate) fn functions(&self, name: &'static str) -> impl Iterator<Item = usize> + '_ {
        self.found(name).filter(move |&at| {
            let behind = self.text[at + name.len()..].iter().find(|byte| !byte.is_ascii_blank());
            let inside = at > 0 && (self.text[at - 1].is_ascii_alphabetic() || self.text[at - 1] == b'_');
            behind == Some(&b'[') && !inside
        })
    }

    /// All places of a text.
    pub(crate) fn found(&self, what: &'static str) -> impl Iterator<Item = usize> + '_ {
        memory_find(&self.text, what.as_bytes())
    }

    /// Whether there is an opening bracket: most blocks have none, and no expression.
    pub(crate) fn has_bracket(&self) -> bool {
        self.text.contains(&b'[')
    }
}

fn memory_find<'t>(text: &'t [u8], what: &'static [u8]) -> impl Iterator<Item = usize> + 't {
    (0..text.len()).filter(move |&at| text[at..].starts_with(what))
}

/// Blank or tab.
trait AsciiBlank {
    fn is_ascii_blank(&self) -> bool;
}

impl AsciiBlank for u8 {
    fn is_ascii_blank(&self) -> bool {
        matches!(self, b' ' | b'\t')
    }
}
