//! What recognises a finding in a later text of the same program: rule, level and the text of its block, not its line or block number.
use crate::weight;
use sha2::{Digest, Sha256};
use std::{borrow::Cow, collections::BTreeMap, fmt::Write};
use trunnion_check::{Diagnostic, Report, ValueKey};

/// A fingerprint for each finding of the list. Findings that look alike are numbered in the order of the file.
pub fn fingerprints(source: &[u8], report: &Report) -> Vec<String> {
    let mut alike = BTreeMap::<String, u32>::new();
    let mut lines = Lines::new(source);
    let mut marks = Vec::with_capacity(report.diagnostics.len());
    for d in &report.diagnostics {
        let mut mark = of(&lines.at(d.range.start as usize), d);
        let count = alike.entry(mark.clone()).or_default();
        let _ = write!(mark, "/{count}");
        *count += 1;
        marks.push(mark);
    }
    marks
}

/// `line`: what stands for its line.
fn of(line: &[u8], d: &Diagnostic) -> String {
    let mut hash = Sha256::new();
    let mut add = |bytes: &[u8]| {
        hash.update((bytes.len() as u64).to_le_bytes());
        hash.update(bytes);
    };
    add(b"trunnion-fingerprint/1");
    add(d.rule.as_bytes());
    add(weight(d).as_bytes());
    add(line);
    // two axes in one block are two findings
    for (key, value) in &d.values {
        if let ValueKey::Text(text) = value {
            add(key.as_bytes());
            add(text.as_bytes());
        }
    }
    let mut led: Vec<&str> = d.also.iter().map(|led| led.rule).collect();
    led.sort_unstable();
    led.dedup();
    for rule in led {
        add(rule.as_bytes());
    }
    let mut text = String::with_capacity(34);
    for byte in &hash.finalize()[..16] {
        let _ = write!(text, "{byte:02x}");
    }
    text
}

/// A longer line is read once for all findings in it, bytes, and its digest stands for it: thousands of findings may lie in one line of megabytes.
const LONG: usize = 1 << 16;

/// What stands for the lines of a text.
struct Lines<'s> {
    source: &'s [u8],
    /// Long lines that were read: where they start, where they end, and their digests.
    long: BTreeMap<usize, (usize, Vec<u8>)>,
    /// Bytes read so far.
    read: usize,
}

impl<'s> Lines<'s> {
    fn new(source: &'s [u8]) -> Self {
        Self {
            source,
            long: BTreeMap::new(),
            read: 0,
        }
    }

    /// The line around a byte as [`plain`] shows it; of a long line a digest of that.
    fn at(&mut self, at: usize) -> Cow<'_, [u8]> {
        let before = self.long.range(..=at).next_back();
        if let Some(start) = before.filter(|(_, (end, _))| at <= *end).map(|(start, _)| *start) {
            return Cow::Borrowed(&self.long[&start].1);
        }
        let (start, line) = line_at(self.source, at);
        self.read += line.len();
        let text = plain(line);
        if line.len() <= LONG {
            return Cow::Owned(text);
        }
        let digest = Sha256::digest(&text).to_vec();
        let (_, digest) = self.long.entry(start).or_insert((start + line.len(), digest));
        Cow::Borrowed(digest)
    }
}

/// The line around a byte, and where it starts.
fn line_at(source: &[u8], at: usize) -> (usize, &[u8]) {
    let at = at.min(source.len());
    let ends = |byte: &u8| matches!(byte, b'\n' | b'\r');
    let start = source[..at].iter().rposition(ends).map_or(0, |end| end + 1);
    let end = source[at..].iter().position(ends).map_or(source.len(), |end| at + end);
    (start, &source[start..end])
}

/// A line without blanks and its block number, in capitals: what renumbering and layout do not change.
fn plain(line: &[u8]) -> Vec<u8> {
    let text: Vec<u8> = line
        .iter()
        .filter(|byte| !byte.is_ascii_whitespace())
        .map(u8::to_ascii_uppercase)
        .collect();
    let skip = usize::from(text.first() == Some(&b'/'));
    let (skipped, rest) = text.split_at(skip);
    // `N10`, or the bare number of Klartext
    let rest = rest.strip_prefix(b"N").unwrap_or(rest);
    let digits = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
    if digits == 0 || digits == rest.len() {
        return text;
    }
    [skipped, &rest[digits..]].concat()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_blocks_and_blanks_do_not_count() {
        assert_eq!(plain(b"N10 g1 X5."), plain(b"N0200G1X5."));
        assert_eq!(plain(b"/N10 G1"), b"/G1");
        assert_eq!(plain(b"NX=5"), b"NX=5");
        assert_eq!(plain(b"12 L X+5"), plain(b"13 L  X+5"));
        assert_eq!(plain(b"N10"), b"N10");
        assert_ne!(plain(b"G1 X5."), plain(b"G1 X6."));
        assert_eq!(line_at(b"a\nbc\rd", 3), (2, &b"bc"[..]));
        assert_eq!(line_at(b"a\nbc", 4), (2, &b"bc"[..]));
    }

    #[test]
    fn a_long_line_is_read_once_whatever_is_found_in_it() {
        let long = "G1 X1. ".repeat(LONG / 4);
        let source = format!("X1\n{long}\nX2\n{}", long.replace('1', "2"));
        let mut lines = Lines::new(source.as_bytes());
        let own = |at: usize, lines: &mut Lines<'_>| lines.at(at).into_owned();
        let first = own(3, &mut lines);
        for at in (3..3 + long.len()).step_by(97) {
            assert_eq!(own(at, &mut lines), first);
        }
        assert_eq!(lines.read, long.len());
        assert_eq!(own(1, &mut lines), b"X1");
        assert_eq!(own(4 + long.len(), &mut lines), b"X2");
        assert_ne!(own(source.len(), &mut lines), first);
        // blanks still do not count
        let apart = long.replace(' ', "  ");
        assert_eq!(Lines::new(apart.as_bytes()).at(9).into_owned(), first);
    }
}
