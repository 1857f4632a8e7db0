//! Edits of a text, the smallest unit in which a rewrite speaks.
use crate::TextRange;

/// Replace the bytes of `range` by `new_text`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextEdit {
    /// Bytes to replace.
    pub range: TextRange,
    /// What stands there afterwards.
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

#[cfg(test)]
mod tests {
    use super::{TextEdit, apply_edits};
    use crate::TextRange;

    fn edit(start: u32, end: u32, text: &str) -> TextEdit {
        TextEdit {
            range: TextRange::new(start, end),
            new_text: text.to_owned(),
        }
    }

    #[test]
    fn edits_are_put_in_from_left_to_right() {
        let edits = [edit(0, 1, "M"), edit(2, 2, " "), edit(3, 5, "")];
        assert_eq!(apply_edits(b"G1X12", &edits).as_deref(), Some(b"M1 X".as_slice()));
        assert_eq!(apply_edits(b"G1 X1", &[]).as_deref(), Some(b"G1 X1".as_slice()));
    }

    #[test]
    fn edits_that_do_not_fit_are_refused() {
        assert_eq!(apply_edits(b"G1 X1", &[edit(4, 9, "")]), None);
        assert_eq!(apply_edits(b"G1 X1", &[edit(3, 4, ""), edit(0, 1, "")]), None);
    }
}
