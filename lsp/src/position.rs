//! LSP positions and bytes: here and nowhere else.
use core::ops::Deref;
use tower_lsp::lsp_types::{Position, Range};
use trunnion_syntax::{TextRange, line_starts, line_starts_after};

/// How the client counts columns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Encoding {
    /// UTF-16 code units (the protocol's default).
    Utf16,
    /// Bytes.
    Utf8,
}

/// Byte offsets of the line starts of a text, and marks inside long lines: a line may be as long as the document and have a colour at each of its bytes.
#[derive(Debug, Default)]
pub(crate) struct Lines {
    starts: Vec<u32>,
    /// Byte offset of a character of a line, and how many UTF-16 code units of the line come before it.
    marks: Vec<(u32, u32)>,
}

/// Bytes of a line between two marks, up to a character more.
const STEP: usize = 128;

impl Lines {
    /// Of a text, which is UTF-8.
    pub(crate) fn new(text: &[u8]) -> Self {
        Self::with(line_starts(text), text)
    }

    /// Of a text with as many empty lines before it.
    pub(crate) fn after(lines: u32, text: &[u8]) -> Self {
        Self::with(line_starts_after(lines, text), text)
    }

    fn with(starts: Vec<u32>, text: &[u8]) -> Self {
        let ends = starts.iter().skip(1).map(|&end| end as usize).chain([text.len()]);
        let mut marks = Vec::new();
        for (&start, end) in starts.iter().zip(ends) {
            let (mut from, mut units) = (start as usize, 0);
            while end.saturating_sub(from) > STEP {
                let at = character(text, from + STEP);
                units += length(&text[from..at], Encoding::Utf16);
                marks.push((at as u32, units));
                from = at;
            }
        }
        Self { starts, marks }
    }

    /// Where to begin to count in the line that starts at `start`, for the first byte or unit beyond what `before` says: a byte, and how many units
    /// come before it.
    fn mark(&self, start: usize, encoding: Encoding, before: impl Fn(usize, u32) -> bool) -> (usize, u32) {
        let in_line = self.marks.partition_point(|&(at, _)| (at as usize) < start);
        let own = &self.marks[in_line..];
        let units = |&(at, units): &(u32, u32)| match encoding {
            Encoding::Utf16 => units,
            Encoding::Utf8 => at - start as u32,
        };
        let passed = own.partition_point(|mark| before(mark.0 as usize, units(mark)));
        let last = passed.checked_sub(1).map(|last| &own[last]);
        last.map_or((start, 0), |mark| (mark.0 as usize, units(mark)))
    }
}

impl Deref for Lines {
    type Target = [u32];

    fn deref(&self) -> &[u32] {
        &self.starts
    }
}

/// The text of a piece of a document, which is UTF-8. A piece of a line costs as much as it is long, the whole text too.
fn utf8(bytes: &[u8]) -> &str {
    core::str::from_utf8(bytes).unwrap_or_default()
}

/// The first byte of the character that a byte belongs to.
fn character(text: &[u8], mut at: usize) -> usize {
    // inside a character: 10xxxxxx
    while text.get(at).is_some_and(|byte| byte & 0xc0 == 0x80) {
        at -= 1;
    }
    at
}

/// How long a client finds a piece of a line.
fn length(piece: &[u8], encoding: Encoding) -> u32 {
    utf8(piece).chars().map(|c| units_of(c, encoding)).sum()
}

/// Byte offset of a position in a text, which is UTF-8; beyond the end of a line or text it is that end.
pub(crate) fn offset(text: &[u8], lines: &Lines, position: Position, encoding: Encoding) -> usize {
    let line = position.line as usize;
    let Some(&start) = lines.get(line) else {
        return text.len();
    };
    let start = start as usize;
    let mut end = lines.get(line + 1).map_or(text.len(), |&next| next as usize);
    while end > start && matches!(text[end - 1], b'\n' | b'\r') {
        end -= 1;
    }
    let (from, mut units) = lines.mark(start, encoding, |at, units| at <= end && units <= position.character);
    // the next mark is no farther, or the position is beyond the end
    let to = character(text, end.min(from + 2 * STEP));
    for (at, character) in utf8(&text[from..to]).char_indices() {
        if units >= position.character {
            return from + at;
        }
        units += units_of(character, encoding);
    }
    to
}

/// Position of a byte offset.
pub(crate) fn position(text: &[u8], lines: &Lines, offset: usize, encoding: Encoding) -> Position {
    let offset = character(text, offset.min(text.len()));
    let line = lines
        .partition_point(|&start| start as usize <= offset)
        .saturating_sub(1);
    let start = lines.get(line).copied().unwrap_or(0) as usize;
    let (from, before) = lines.mark(start, encoding, |at, _| at <= offset);
    Position {
        line: line as u32,
        character: before + length(&text[from..offset], encoding),
    }
}

/// LSP range of a range of bytes.
pub(crate) fn range(text: &[u8], lines: &Lines, bytes: TextRange, encoding: Encoding) -> Range {
    Range {
        start: position(text, lines, bytes.start as usize, encoding),
        end: position(text, lines, bytes.end as usize, encoding),
    }
}

fn units_of(character: char, encoding: Encoding) -> u32 {
    match encoding {
        Encoding::Utf16 => character.len_utf16() as u32,
        Encoding::Utf8 => character.len_utf8() as u32,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn utf16_columns_count_code_units() {
        let text = "(\u{1f527}\u{e4}) G1\r\nX2\rY3";
        let g = text.find('G').expect("there");
        let text = text.as_bytes();
        let starts = Lines::new(text);
        assert_eq!(starts[..], [0, 13, 16]);
        let at = position(text, &starts, g, Encoding::Utf16);
        assert_eq!((at.line, at.character), (0, 6), "the wrench counts two, the umlaut one");
        assert_eq!(offset(text, &starts, at, Encoding::Utf16), g);
        assert_eq!(position(text, &starts, g, Encoding::Utf8).character, g as u32);
        let past = Position { line: 0, character: 99 };
        assert_eq!(
            offset(text, &starts, past, Encoding::Utf16),
            11,
            "clamped before the line end"
        );
        assert_eq!(
            offset(text, &starts, Position { line: 9, character: 0 }, Encoding::Utf16),
            text.len()
        );
    }

    /// A long line between two short ones, with characters of one to four bytes.
    fn long_line() -> String {
        let piece = |i: usize| ["a", "\u{e4}", "\u{20ac}", "\u{1f600}"][i * i % 11 % 4];
        let long: String = (0..5000).map(piece).collect();
        format!("G0\n{long}\r\nX1\n")
    }

    #[test]
    fn places_in_a_long_line_are_those_that_counting_from_its_start_gives() {
        let text = long_line();
        let text = text.as_bytes();
        let lines = Lines::new(text);
        assert!(lines.marks.len() > 5, "{:?}", lines.marks);
        let plain = Lines {
            starts: lines.starts.clone(),
            marks: Vec::new(),
        };
        for encoding in [Encoding::Utf16, Encoding::Utf8] {
            for at in 0..=text.len() {
                let place = position(text, &lines, at, encoding);
                assert_eq!(place, position(text, &plain, at, encoding), "byte {at}");
                if !matches!(text.get(at), Some(b'\n')) {
                    assert_eq!(offset(text, &lines, place, encoding), character(text, at), "byte {at}");
                }
            }
            let past = Position::new(1, 90_000);
            assert_eq!(offset(text, &lines, past, encoding), text.len() - 5);
        }
    }

    #[test]
    fn no_place_of_a_long_line_is_far_from_a_mark() {
        let text = vec![b'x'; 100 * STEP];
        let lines = Lines::new(&text);
        let from = |offset: usize| lines.mark(0, Encoding::Utf16, |at, _| at <= offset).0;
        let farthest = (0..text.len()).map(|offset| offset - from(offset)).max();
        assert!(farthest.is_some_and(|bytes| bytes <= STEP), "{farthest:?}");
    }
}
