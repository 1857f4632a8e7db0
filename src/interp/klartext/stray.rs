//! Text in a block that no statement has: the control refuses the block, so that what it does is not known.
//!
//! Words of paths are judged where they are read ([`super::path_words`]). Titles of cycles, names of programs and formulas may contain anything
//! but control characters.
use super::words::{Said, Word, Words};

/// Signs that no statement but a formula, a name or a title has.
const FOREIGN: &[u8] = b"[]{}()<>?!^@$&|\\`'*/#%=";

/// First words that have no value.
const PLAIN: [&str; 18] = [
    "L", "LN", "CR", "CT", "LP", "CP", "CTP", "CC", "APPR", "DEP", "TOOL", "CYCL", "CYCLE", "PLANE", "FUNCTION",
    "BEGIN", "SEL", "TRANS",
];

/// Words of TOOL CALL and TOOL DEF: those that [`super::tool`] reads, and the letters of further tool axes.
const OF_TOOLS: [&str; 16] = [
    "X", "Y", "Z", "U", "V", "W", "S", "VC", "F", "FU", "FZ", "DL", "DR", "DR2", "L", "R",
];

/// The bytes of the first part of a block that does not belong to its statement.
pub(super) fn stray(text: &[u8]) -> Option<(usize, usize)> {
    let is_control = |byte: &u8| *byte < b' ' && !matches!(byte, b'\t' | b'\r' | b'\n') || *byte == 0x7f;
    if let Some(at) = text.iter().position(is_control) {
        return Some((at, at + 1));
    }
    let mut words = Words::new(text);
    let first = words.next()?;
    if first.value != Said::Nothing && PLAIN.iter().any(|name| first.is(name)) {
        return Some((first.start, first.end));
    }
    match first.name() {
        b"TOOL" => of_tool(words),
        b"CYCL" | b"CYCLE" => of_cycle(words),
        b"LBL" => of_label(&first, words),
        b"PLANE" => foreign(words.text, words.at),
        _ => None,
    }
}

/// The first foreign sign that is not in a text.
fn foreign(text: &[u8], from: usize) -> Option<(usize, usize)> {
    let mut quoted = false;
    for (at, byte) in text.iter().enumerate().skip(from) {
        quoted ^= *byte == b'"';
        if !quoted && FOREIGN.contains(byte) {
            return Some((at, at + 1));
        }
    }
    None
}

fn of_tool(mut words: Words<'_>) -> Option<(usize, usize)> {
    let kind = words.next()?;
    if kind.value == Said::Nothing {
        // the tool's number or name stands behind a blank, or is left out
        let mut ahead = words.clone();
        if ahead.next().is_some_and(|word| word.name().is_empty()) {
            words = ahead;
        }
    }
    words
        .find(|word| !OF_TOOLS.iter().any(|name| word.is(name)))
        .map(|word| (word.start, word.end))
}

/// Nothing follows the number or the name of a label.
fn of_label(first: &Word<'_>, mut words: Words<'_>) -> Option<(usize, usize)> {
    if first.value == Said::Nothing {
        words.next();
    }
    words.next().map(|word| (word.start, word.end))
}

/// `CYCL DEF 200 DRILLING Q200=2 Q201=-20`, `CYCL DEF 7.1 X+5`.
fn of_cycle(mut words: Words<'_>) -> Option<(usize, usize)> {
    let kind = words.next()?;
    if !kind.is("DEF") {
        return None;
    }
    let start = kind.start + kind.name().len();
    let blanks = words.text[start..]
        .iter()
        .take_while(|byte| byte.is_ascii_whitespace())
        .count();
    let first = start + blanks;
    let number = words.text[first..]
        .iter()
        .take_while(|byte| byte.is_ascii_digit() || **byte == b'.')
        .count();
    let after = first + number;
    // without a number it is refused where it is read
    if words.text[first..].iter().any(u8::is_ascii_digit) {
        let next = words.text.get(after);
        if number == 0 || next.is_some_and(|byte| !byte.is_ascii_whitespace() && !byte.is_ascii_alphabetic()) {
            return Some((after, after + 1));
        }
    }
    words.at = after;
    of_list(words)
}

/// Once a parameter has its value only others follow: `Q200=2 Q206=FMAX Q203=+Q1`.
fn of_list(mut words: Words<'_>) -> Option<(usize, usize)> {
    let mut begun = false;
    while let Some(word) = words.next() {
        let parameter = word.name().is_empty() && matches!(word.value, Said::Parameter(..));
        if parameter && words.takes(b'=') {
            begun = true;
            // `+MAX` are two words
            if words.next().is_some_and(|word| matches!(word.value, Said::Sign(_))) {
                words.next();
            }
        } else if begun && !word.is("~") {
            return Some((word.start, word.end));
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::stray;

    #[test]
    fn what_a_statement_does_not_have_is_found() {
        for text in [
            "TOOL CALL 1 Z S2000 F100 DL+0.1 DR-0.2 DR2+0,1",
            "TOOL CALL \"MILL 5\" Z S2000",
            "TOOL CALL Z S500",
            "TOOL CALL QS5 Z S500",
            "TOOL DEF 5 L+10 R+5",
            "CYCL DEF 10.0 DREHUNG / ROTATION",
            "CYCL DEF 7.1 #5",
            "CYCL DEF 200 BOHREN Q200=2 Q206=FMAX Q203=+Q1 Q208=+MAX",
            "CYCL DEF 200 BOHREN~\n Q200=2~\n Q201=-20",
            "LBL 1",
            "LBL \"A?\"",
            "CALL PGM TNC:\\DIR\\A.H",
            "QS1 = \"A\" || QS2",
            "L X+5 R0 FMAX",
            "PLANE SPATIAL SPA+0 SPB+5 SPC+0 STAY",
        ] {
            assert_eq!(stray(text.as_bytes()), None, "{text}");
        }
        for (text, at) in [
            ("TOOL CALL 1 Z [1]S2000", 14),
            ("TOOL CALL 1 Z S2000 7", 20),
            ("TOOL CALL 1 Z S2000 FOO", 20),
            ("TOOL CALL 1_ Z", 11),
            ("TOOL 7 CALL 1 Z", 0),
            ("CYCL DEF 200 A Q200=2 1=2 Q201=-20", 22),
            ("CYCL DEF 200 A Q200=2 Q7 Q201=-20", 22),
            ("CYCL DEF FOO 7.0 DATUM", 9),
            ("CYCL DEF 7].0 DATUM", 10),
            ("CYCL DEF )7.0 DATUM", 9),
            ("LBL 1_", 5),
            ("LBL \"A\" 5", 8),
            ("L 5 X+7", 0),
            ("L X+7 \u{1}Y+5", 6),
            ("PLANE SPATIAL SPA+0 @SPB+5 SPC+0 STAY", 20),
        ] {
            assert_eq!(stray(text.as_bytes()).map(|found| found.0), Some(at), "{text}");
        }
    }
}
