//! Signs of NUM controls (1020, 1040, 1060, Flexium), after the NUM 1020/1040/1060M programming manual: variables L0 to L959, external
//! parameters E with five digits, jumps G79 and calls G77 with block or program numbers inside the block, words of two letters that begin
//! with E, and messages `$0 TEXT`.
use super::text::{has, unnumbered, word};
use super::votes::Votes;

/// Signs in a line as it is written, in upper case.
pub(super) fn raw(line: &str, votes: &mut Votes) {
    // `$0=10` is a setting of grbl
    let message = unnumbered(line).strip_prefix('$').and_then(|rest| {
        let text = rest.strip_prefix(|c: char| c.is_ascii_digit())?;
        text.trim_start().chars().next()
    });
    if message.is_some_and(|first| first.is_ascii_alphabetic() || first == '+') {
        votes.add("num", 6, "a message `$0 ...`");
    }
}

/// Signs in a line without comments, in upper case.
pub(super) fn code(code: &str, votes: &mut Votes) {
    let text = unnumbered(code);
    if has(text, b'G', "79") && word(text, b'N') {
        votes.add("num", 10, "a jump G79 N");
    }
    if has(text, b'G', "77") && (word(text, b'N') || word(text, b'H')) {
        votes.add("num", 10, "a call G77 N or G77 H");
    }
    if ["P", "Q", "R"].iter().any(|axis| {
        let after = text.split_once(&format!("G16 {axis}")).map(|(_, rest)| rest);
        after.is_some_and(|rest| {
            rest.strip_prefix(['+', '-'])
                .is_some_and(|rest| !rest.starts_with(|c: char| c.is_ascii_digit()))
        })
    }) {
        votes.add("num", 12, "the axis of the tool G16 P, Q or R");
    }
    if parameter(text, b'E', 5..=5) {
        votes.add("num", 10, "an external parameter E");
    }
    if parameter(text, b'L', 1..=3) {
        votes.add("num", 10, "a variable L that is assigned");
    }
    let pairs = ["EA", "EB", "ES", "ER", "ET"];
    if text.starts_with('G') && pairs.iter().any(|pair| pair_with_number(text, pair)) {
        votes.add("num", 6, "a word of E and a letter");
    }
}

/// Whether a parameter with so many digits is assigned: `L1=5`, `E80000 = 5`.
fn parameter(text: &str, letter: u8, digits: core::ops::RangeInclusive<usize>) -> bool {
    text.match_indices('=').any(|(at, _)| {
        let name = text[..at].trim_end();
        let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
        let starts = stem.as_bytes().split_last();
        digits.contains(&(name.len() - stem.len()))
            && starts.is_some_and(|(last, before)| {
                *last == letter
                    && !before
                        .last()
                        .is_some_and(|byte| byte.is_ascii_alphabetic() || *byte == b'_')
            })
            && !text[at + 1..].starts_with('=')
    })
}

/// Whether a word of two letters stands with a number or a sign: `EB+2`, `ER5`.
fn pair_with_number(text: &str, pair: &str) -> bool {
    text.match_indices(pair).any(|(at, _)| {
        let before = text[..at].bytes().last();
        let after = text[at + pair.len()..].bytes().next();
        before.is_some_and(|byte| byte.is_ascii_digit() || matches!(byte, b' ' | b'.'))
            && after.is_some_and(|byte| byte.is_ascii_digit() || matches!(byte, b'+' | b'-' | b'.'))
    })
}
