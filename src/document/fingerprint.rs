//! What recognises a finding in a later text of the same program: rule, level and the text of its block, not its line or block number.
use crate::weight;
use sha2::{Digest, Sha256};
use std::{collections::BTreeMap, fmt::Write};
use trunnion_check::{Diagnostic, Report, ValueKey};

/// A fingerprint for each finding of the list. Findings that look alike are numbered in the order of the file.
pub fn fingerprints(source: &[u8], report: &Report) -> Vec<String> {
    let mut alike = BTreeMap::<String, u32>::new();
    let mut marks = Vec::with_capacity(report.diagnostics.len());
    for d in &report.diagnostics {
        let mut mark = of(source, d);
        let count = alike.entry(mark.clone()).or_default();
        let _ = write!(mark, "/{count}");
        *count += 1;
        marks.push(mark);
    }
    marks
}

fn of(source: &[u8], d: &Diagnostic) -> String {
    let mut hash = Sha256::new();
    let mut add = |bytes: &[u8]| {
        hash.update((bytes.len() as u64).to_le_bytes());
        hash.update(bytes);
    };
    add(b"trunnion-fingerprint/1");
    add(d.rule.as_bytes());
    add(weight(d).as_bytes());
    add(&plain(line_at(source, d.range.start as usize)));
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

/// The line around a byte.
fn line_at(source: &[u8], at: usize) -> &[u8] {
    let at = at.min(source.len());
    let ends = |byte: &u8| matches!(byte, b'\n' | b'\r');
    let start = source[..at].iter().rposition(ends).map_or(0, |end| end + 1);
    let end = source[at..].iter().position(ends).map_or(source.len(), |end| at + end);
    &source[start..end]
}

/// A line without blanks and its block number, in capitals: what renumbering and layout do not change.
fn plain(line: &[u8]) -> Vec<u8> {
    let text: Vec<u8> = line
        .iter()
        .filter(|byte| !byte.is_ascii_whitespace())
        .map(u8::to_ascii_uppercase)
        .collect();
    let skip = usize::from(text.first() == Some(&b'/'));
    match text.get(skip..).and_then(|rest| rest.strip_prefix(b"N")) {
        Some(rest) => {
            let digits = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
            if digits == 0 {
                return text;
            }
            let mut out = text[..skip].to_vec();
            out.extend_from_slice(&rest[digits..]);
            out
        }
        None => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_blocks_and_blanks_do_not_count() {
        assert_eq!(plain(b"N10 g1 X5."), plain(b"N0200G1X5."));
        assert_eq!(plain(b"/N10 G1"), b"/G1");
        assert_eq!(plain(b"NX=5"), b"NX=5");
        assert_ne!(plain(b"G1 X5."), plain(b"G1 X6."));
        assert_eq!(line_at(b"a\nbc\rd", 3), b"bc");
        assert_eq!(line_at(b"a\nbc", 4), b"bc");
    }
}
