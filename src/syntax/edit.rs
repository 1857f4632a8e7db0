//! Edits of a text, the smallest unit of a rewrite.
use crate::TextRange;

/// Replace the bytes of `range` by `new_text`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextEdit {
    /// Bytes to replace.
    pub range: TextRange,
    /// The text afterwards.
    pub new_text: String,
}

/// The text after all `edits`, which must be sorted by start and must not overlap; `None` if they are not, or reach outside.
pub fn apply_edits(source: &[u8], edits: &[TextEdit]) -> Option<Vec<u8>> {
    let mut out = Vec::with_capacity(source.len());
    let mut at = 0usize;
    for edit in edits {
        let range = edit.range.as_usize();
        if range.start < at || range.end < range.start || range.end > source.len() {
            return None;
        }
        out.extend_from_slice(&source[at..range.start]);
        out.extend_from_slice(edit.new_text.as_bytes());
        at = range.end;
    }
    out.extend_from_slice(&source[at..]);
    Some(out)
}
