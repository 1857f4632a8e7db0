//! Where the lines of a text start, as editors count them.

/// Byte offsets of line starts. Lines end with `\n`, `\r\n` or a lone `\r`.
pub fn line_starts(text: &[u8]) -> Vec<u32> {
    line_starts_after(0, text)
}

/// The same of a text with this many empty lines before it, each a byte long: see [`crate::parse_after`].
pub fn line_starts_after(lines: u32, text: &[u8]) -> Vec<u32> {
    let mut starts: Vec<u32> = (0..=lines).collect();
    for at in memchr::memchr2_iter(b'\n', b'\r', text) {
        if text[at] == b'\n' || text.get(at + 1) != Some(&b'\n') {
            starts.push(lines + at as u32 + 1);
        }
    }
    starts
}

#[cfg(test)]
mod tests {
    use super::{line_starts, line_starts_after};

    #[test]
    fn lines_end_in_three_ways() {
        assert_eq!(line_starts(b"G0\r\nX1\rX2\n"), [0, 4, 7, 10]);
        assert_eq!(line_starts(b"\n\rX"), [0, 1, 2]);
        for lines in [0, 1, 7] {
            let text = b"X1\nX2\r\n\nX3";
            let whole = ["\n".repeat(lines as usize).as_bytes(), text].concat();
            assert_eq!(line_starts_after(lines, text), line_starts(&whole), "{lines}");
        }
    }
}
