//! Byte offsets to lines and columns.

/// Line starts of a text: byte offsets to lines and columns and back.
#[derive(Clone, Debug)]
pub struct LineIndex {
    /// Byte offset of the start of each line (lines end with `\n`, `\r\n` or a lone `\r`).
    pub starts: Vec<u32>,
}

impl LineIndex {
    /// Line starts of `source`. The first is 0; a text that ends with a line end has an empty last line.
    pub fn new(source: &[u8]) -> Self {
        let mut starts = vec![0];
        for at in memchr::memchr2_iter(b'\n', b'\r', source) {
            if source[at] == b'\n' || source.get(at + 1) != Some(&b'\n') {
                starts.push(at as u32 + 1);
            }
        }
        Self { starts }
    }

    /// Line and column of a byte, both from 1; the column counts Unicode characters (invalid bytes count one each).
    /// An offset inside a character gives that character's column; one beyond the text gives its end.
    pub fn line_column(&self, source: &[u8], offset: u32) -> (u32, u32) {
        let offset = (offset as usize).min(source.len());
        let line = self.starts.partition_point(|&start| start as usize <= offset).max(1);
        let start = (self.starts.get(line - 1).copied().unwrap_or(0) as usize).min(offset);
        (line as u32, 1 + characters(&source[start..offset], &source[offset..]))
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
