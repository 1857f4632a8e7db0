//! The text of a comment.
use crate::{Comment, TextRange};

/// Where a comment's text begins and ends, by its marks.
pub(crate) fn comment(source: &[u8], range: TextRange) -> Comment {
    let text = &source[range.as_usize()];
    let (open, close) = match text {
        [b'(', .., b')'] => (1, 1),
        [b'/', b'*', rest @ ..] => (2, if rest.ends_with(b"*/") { 2 } else { 0 }),
        [b'$', b'$', ..] => (2, 0),
        _ => (1, 0),
    };
    Comment {
        range,
        inner: TextRange::new(range.start + open, range.end - close),
    }
}
