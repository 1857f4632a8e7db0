//! Comments of a line: where they are, and whether they end.
use super::problems;
use crate::Error;
use trunnion_syntax::TextRange;

/// The first error of the line's comments: the control checks them before anything else. `text` is the line without its end.
pub(crate) fn flaw(source: &[u8], text: TextRange) -> Option<Error> {
    let bytes = &source[text.as_usize()];
    // without one there can be no error
    memchr::memchr(b'(', bytes)?;
    let mut open = None;
    for (at, byte) in bytes.iter().enumerate() {
        let at = text.start + at as u32;
        match (byte, open) {
            (b'(', None) => open = Some(at),
            (b'(', Some(_)) => return Some(Error::new(&problems::NESTED_COMMENT, TextRange::new(at, at + 1))),
            (b')', Some(_)) => open = None,
            (b';', None) => return None,
            _ => {}
        }
    }
    open.map(|at| Error::new(&problems::UNCLOSED_COMMENT, TextRange::new(at, text.end)))
}

/// One past the comment that begins at `start` with `(` or `;`; comments inside it belong to it.
pub(super) fn end(source: &[u8], start: u32, end: u32) -> u32 {
    let bytes = &source[start as usize..end as usize];
    if bytes.first() == Some(&b';') {
        return end;
    }
    let mut depth = 0u32;
    for (at, byte) in bytes.iter().enumerate() {
        match byte {
            b'(' => depth += 1,
            b')' if depth == 1 => return start + at as u32 + 1,
            b')' => depth -= 1,
            _ => {}
        }
    }
    end
}
