//! Byte offsets to lines and columns.

/// Line starts of a text: byte offsets to lines and columns and back.
#[derive(Clone, Debug)]
pub struct LineIndex {
    /// Byte offset of the start of each line (lines end with `\n`, `\r\n` or a lone `\r`).
    pub starts: Vec<u32>,
    /// Inside lines longer than [`STEP`]: byte offset of a character, and how many characters of its line come before it. A line may be as
    /// long as the file, and a file may have a finding at each of its bytes.
    marks: Vec<(u32, u32)>,
}

/// Bytes of a line between two marks, up to a character more.
const STEP: usize = 1024;

impl LineIndex {
    /// Line starts of `source`. The first is 0; a text that ends with a line end has an empty last line.
    pub fn new(source: &[u8]) -> Self {
        let (mut starts, mut marks, mut start) = (vec![0], Vec::new(), 0);
        for at in memchr::memchr2_iter(b'\n', b'\r', source) {
            if source[at] == b'\n' || source.get(at + 1) != Some(&b'\n') {
                mark(source, start, at + 1, &mut marks);
                start = at + 1;
                starts.push(start as u32);
            }
        }
        mark(source, start, source.len(), &mut marks);
        Self { starts, marks }
    }

    /// Line and column of a byte, both from 1; the column counts Unicode characters (invalid bytes count one each).
    /// An offset inside a character gives that character's column; one beyond the text gives its end.
    pub fn line_column(&self, source: &[u8], offset: u32) -> (u32, u32) {
        let offset = (offset as usize).min(source.len());
        let line = self.starts.partition_point(|&start| start as usize <= offset).max(1);
        let start = (self.starts.get(line - 1).copied().unwrap_or(0) as usize).min(offset);
        let (from, before) = self.mark(start, offset);
        (
            line as u32,
            1 + before + characters(&source[from..offset], &source[offset..]),
        )
    }

    /// The last mark of the line between its start and `offset`; the start itself where there is none.
    fn mark(&self, start: usize, offset: usize) -> (usize, u32) {
        let after = self.marks.partition_point(|&(at, _)| at as usize <= offset);
        match after.checked_sub(1).map(|last| self.marks[last]) {
            Some((at, count)) if at as usize >= start => (at as usize, count),
            _ => (start, 0),
        }
    }

    /// The byte offset of a line and column as [`Self::line_column`] counts them; `None` where the text has no such line.
    /// A column beyond the line's end gives the line's end.
    pub fn offset(&self, source: &[u8], line: u32, column: u32) -> Option<u32> {
        let index = (line as usize).checked_sub(1)?;
        let start = *self.starts.get(index)? as usize;
        let end = self.starts.get(index + 1).map_or(source.len(), |&next| next as usize);
        let mut text = source.get(start..end)?;
        if index + 1 < self.starts.len() {
            let ending = if text.ends_with(b"\r\n") { 2 } else { 1 };
            text = &text[..text.len() - ending];
        }
        let mut at = 0;
        for _ in 1..column.max(1) {
            if at >= text.len() {
                break;
            }
            at += character(&text[at..]);
        }
        Some((start + at) as u32)
    }
}

/// Adds the marks of the line from `start` to `end`.
fn mark(source: &[u8], start: usize, end: usize, marks: &mut Vec<(u32, u32)>) {
    let (mut from, mut count) = (start, 0);
    while end - from > STEP {
        let mut at = from + STEP;
        // not inside a character: the mark moves back to its first byte
        let back = (1..=3).find(|&back| source.get(at - back..).is_some_and(|text| character(text) > back));
        at -= back.unwrap_or(0);
        count += characters(&source[from..at], &[]);
        marks.push((at as u32, count));
        from = at;
    }
}

/// Length in bytes of the character at the start of `bytes`: 1 for an invalid byte. `bytes` must not be empty.
pub(crate) fn character(bytes: &[u8]) -> usize {
    let length = match bytes[0] {
        0xC2..=0xDF => 2,
        0xE0..=0xEF => 3,
        0xF0..=0xF4 => 4,
        _ => return 1,
    };
    match bytes.get(..length) {
        Some(text) if core::str::from_utf8(text).is_ok() => length,
        _ => 1,
    }
}

/// How many characters start before the end of `before`, where `after` may complete the last one (which then is not counted).
fn characters(before: &[u8], after: &[u8]) -> u32 {
    if before.is_ascii() {
        return before.len() as u32;
    }
    let (mut at, mut count) = (0, 0);
    while at < before.len() {
        let length = character(&before[at..]);
        if length == 1 && before[at] >= 0xC2 && before.len() - at < 4 && completes(&before[at..], after) {
            break;
        }
        at += length;
        count += 1;
    }
    count
}

/// Whether `head` is the beginning of a character that `tail` finishes.
fn completes(head: &[u8], tail: &[u8]) -> bool {
    let mut joined = [0u8; 7];
    let tail = &tail[..tail.len().min(3)];
    let length = head.len() + tail.len();
    joined[..head.len()].copy_from_slice(head);
    joined[head.len()..length].copy_from_slice(tail);
    character(&joined[..length]) > head.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Lines of every length around the marks, with characters of one to four bytes and bytes that are none.
    fn long_lines() -> Vec<u8> {
        let mut text = Vec::new();
        for i in 0..4000_usize {
            let piece: &[u8] = [
                &b"a"[..],
                "\u{e4}".as_bytes(),
                "\u{20ac}".as_bytes(),
                "\u{1f600}".as_bytes(),
                b"\xe4",
                b"\xf0\x9f",
            ][i * i % 6];
            text.extend_from_slice(piece);
            if i % 1500 == 1499 {
                text.extend_from_slice(b"\r\n");
            }
        }
        text
    }

    #[test]
    fn columns_of_long_lines_are_those_that_counting_from_the_start_gives() {
        let text = long_lines();
        let index = LineIndex::new(&text);
        assert!(index.marks.len() > 4, "{:?}", index.marks);
        let plain = LineIndex {
            starts: index.starts.clone(),
            marks: Vec::new(),
        };
        for offset in 0..=text.len() as u32 {
            assert_eq!(
                index.line_column(&text, offset),
                plain.line_column(&text, offset),
                "byte {offset}"
            );
        }
    }

    #[test]
    fn no_place_of_a_long_line_is_far_from_a_mark() {
        let text = vec![b'x'; 100 * STEP];
        let index = LineIndex::new(&text);
        let farthest = (0..text.len()).map(|offset| offset - index.mark(0, offset).0).max();
        assert!(farthest.is_some_and(|bytes| bytes <= STEP), "{farthest:?}");
    }
}
