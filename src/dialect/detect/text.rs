//! The text of a program in which signs are searched: lines, words, comments.

/// Lines, whatever ends them: LF, CR LF, or CR alone.
pub(super) fn lines(text: &str) -> impl Iterator<Item = &str> {
    let end = if text.contains('\n') { '\n' } else { '\r' };
    text.split(end).map(|line| line.trim_end_matches('\r'))
}

/// Words of a line: letter and number as written.
pub(super) fn words(code: &str) -> impl Iterator<Item = (u8, &str)> {
    // every line of every program passes here many times: bytes are enough, because an ASCII byte is no part of another character
    let letters = code.bytes().enumerate().filter(|(_, byte)| byte.is_ascii_uppercase());
    letters.map(|(at, letter)| (letter, number_after(code, at)))
}

/// The numbers of the words with a letter, as written.
fn numbers(code: &str, letter: u8) -> impl Iterator<Item = &str> {
    let places = code.bytes().enumerate().filter(move |(_, byte)| *byte == letter);
    places.map(|(at, _)| number_after(code, at))
}

/// The number behind the letter at a byte.
fn number_after(code: &str, at: usize) -> &str {
    let rest = code[at + 1..].trim_start();
    let end = rest
        .bytes()
        .position(|byte| !(byte.is_ascii_digit() || matches!(byte, b'.' | b'-' | b'+')))
        .unwrap_or(rest.len());
    &rest[..end]
}

/// Whether a line holds the code of a letter and number, leading zeros left out: `G50`, `M97`.
pub(super) fn has(code: &str, letter: u8, number: &str) -> bool {
    numbers(code, letter).any(|digits| digits.trim_start_matches('0') == number)
}

/// Whether a line holds a letter with a number.
pub(super) fn word(code: &str, letter: u8) -> bool {
    numbers(code, letter).any(|digits| !digits.is_empty())
}

/// Whether `word` occurs in `code` and is not part of a longer name. Words may be packed: `N10G710`.
pub(super) fn has_word(code: &str, word: &str) -> bool {
    code.match_indices(word).any(|(at, _)| {
        let (before, after) = (&code[..at], &code[at + word.len()..]);
        let ends = match word.bytes().last() {
            Some(b'0'..=b'9') => !after.starts_with(|c: char| c.is_ascii_digit() || c == '.'),
            Some(b'A'..=b'Z') => !after.starts_with(|c: char| c.is_ascii_alphanumeric() || c == '_'),
            _ => true,
        };
        ends && !before.ends_with(|c: char| c.is_ascii_alphabetic() || c == '_')
    })
}

/// Whether a word or variable is assigned with `=` (`R1=5`, `X=10`, `CR=3`).
pub(super) fn assigned(code: &str) -> bool {
    code.match_indices('=').any(|(at, _)| {
        let before = code[..at].trim_end();
        before.ends_with(|c: char| c.is_ascii_alphanumeric() || c == '_') && !code[at + 1..].starts_with('=')
    })
}

/// Whether the text ends with a name of two letters or more, whose arguments may follow (`CYCLE800`, `MSG`; not `G1`).
fn ends_with_name(text: &str) -> bool {
    let text = text.trim_end();
    let name = text
        .rsplit(|c: char| !c.is_ascii_alphanumeric() && c != '_')
        .next()
        .unwrap_or_default();
    name.bytes()
        .take(2)
        .filter(|&b| b.is_ascii_alphabetic() || b == b'_')
        .count()
        == 2
}

/// The line without `( ... )` comments and without `; ...`; arguments `NAME( ... )` stay.
pub(super) fn strip_comments(line: &str) -> String {
    let mut out = String::with_capacity(line.len());
    let mut in_comment = false;
    for c in line.chars() {
        match c {
            ')' if in_comment => in_comment = false,
            _ if in_comment => {}
            ';' => break,
            '(' if !ends_with_name(&out) => in_comment = true,
            _ => out.push(c),
        }
    }
    out
}

/// The line without the block number in front, with or without its N.
pub(super) fn unnumbered(line: &str) -> &str {
    let rest = line.strip_prefix('N').unwrap_or(line);
    let after = rest.trim_start_matches(|c: char| c.is_ascii_digit());
    if after.len() == rest.len() {
        line
    } else {
        after.trim_start()
    }
}

/// Whether a line consists of words alone: letters followed by numbers, comments left out.
pub(super) fn is_block(line: &str) -> bool {
    let code = line.split(['(', ';']).next().unwrap_or_default();
    let code = code.trim_start_matches('/').trim();
    // a block number whose digits are missing
    let code = code.strip_prefix("N ").map_or(code, str::trim_start);
    let mut letters = 0usize;
    let mut after_letter = false;
    for c in code.chars() {
        match c {
            'A'..='Z' if !after_letter => (letters, after_letter) = (letters + 1, true),
            '0'..='9' | '.' => after_letter = false,
            '+' | '-' | ' ' | '=' | '\t' => {}
            _ => return false,
        }
    }
    letters > 0 && !after_letter
}
