//! Slips of the pen: the letter O where a zero belongs, a keyword of LinuxCNC without its O-word.
use trunnion_dialect::Dialect;
use trunnion_syntax::{Format, Program, TextRange};

/// A word with the letter O in its number, and what was meant.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Slip {
    /// The word.
    pub(crate) range: TextRange,
    /// It with zeros.
    pub(crate) meant: String,
}

/// How far from a byte its word, and the keyword of its line, are looked for: no control takes longer blocks, and each finding of a line of
/// megabytes looks.
const FAR: usize = 512;

/// The word at a byte of a program's code, if it has a letter O in its number and is a word with zeros instead: `X5O.`, `GO`.
pub(crate) fn letter_o(program: &Program, at: u32) -> Option<Slip> {
    let source = program.source();
    let at = at as usize;
    let is_part = |byte: &u8| byte.is_ascii_alphanumeric() || matches!(byte, b'.' | b'+' | b'-' | b'_');
    let before = source
        .get(..at)?
        .iter()
        .rev()
        .take(FAR)
        .take_while(|byte| is_part(byte));
    let before = before.count();
    let after = source[at..].iter().take(FAR).take_while(|byte| is_part(byte)).count();
    if before == FAR || after == FAR {
        return None;
    }
    let end = at + after;
    let mut start = at - before;
    if let Some(slip) = assigned(source, start, end) {
        return Some(slip);
    }
    while start < end {
        let in_number = |byte: &&u8| byte.is_ascii_digit() || matches!(byte, b'.' | b'+' | b'-' | b'O' | b'o');
        let stop = start + 1 + source[start + 1..end].iter().take_while(in_number).count();
        if (start..stop.max(start + 1)).contains(&at) {
            return word(source, start, stop);
        }
        start = stop;
    }
    None
}

/// A number behind `=` with a letter O in it: `F=200O`, with its address.
fn assigned(source: &[u8], start: usize, end: usize) -> Option<Slip> {
    let number = &source[start..end];
    let in_number = |byte: &u8| byte.is_ascii_digit() || matches!(byte, b'.' | b'O' | b'o');
    let unsigned = number
        .strip_prefix(b"-")
        .or_else(|| number.strip_prefix(b"+"))
        .unwrap_or(number);
    let is_slip = matches!(unsigned, [b'0'..=b'9' | b'.', ..])
        && unsigned.iter().all(in_number)
        && unsigned.iter().any(|byte| byte.eq_ignore_ascii_case(&b'O'))
        && unsigned.iter().any(u8::is_ascii_digit)
        && unsigned.split(|byte| *byte == b'.').count() <= 2
        && !goes_on(&source[end..]);
    let before = source[..start]
        .trim_ascii_end()
        .strip_suffix(b"=")
        .filter(|_| is_slip)?;
    let named =
        |byte: &&u8| byte.is_ascii_alphanumeric() || matches!(byte, b'_' | b'#' | b'$' | b'<' | b'>' | b'[' | b']');
    let before = before.trim_ascii_end();
    let name = before.iter().rev().take(FAR).take_while(named).count();
    let from = before.len() - name;
    let address = core::str::from_utf8(&source[from..start]).ok()?;
    let digits = core::str::from_utf8(number).ok()?.replace(['O', 'o'], "0");
    (name > 0).then(|| Slip {
        range: TextRange::new(from as u32, end as u32),
        meant: format!("{address}{digits}"),
    })
}

fn word(source: &[u8], start: usize, end: usize) -> Option<Slip> {
    let (letter, number) = source[start..end].split_first()?;
    let is_slip = letter.is_ascii_alphabetic()
        && !letter.eq_ignore_ascii_case(&b'O')
        && number.iter().any(|byte| byte.eq_ignore_ascii_case(&b'O'))
        && !goes_on(&source[end..])
        && !matches!(
            start.checked_sub(1).map(|before| source[before]),
            Some(b'A'..=b'Z' | b'a'..=b'z' | b'_' | b'$' | b'<')
        );
    if !is_slip {
        return None;
    }
    let text = core::str::from_utf8(&source[start..end]).ok()?;
    let meant = format!("{}{}", char::from(*letter), text[1..].replace(['O', 'o'], "0"));
    let digits = meant[1..].strip_prefix(['+', '-']).unwrap_or(&meant[1..]);
    let is_number = digits.bytes().all(|byte| byte.is_ascii_digit() || byte == b'.')
        && digits.bytes().filter(|byte| *byte == b'.').count() <= 1;
    is_number.then(|| Slip {
        range: TextRange::new(start as u32, end as u32),
        meant,
    })
}

/// Whether what was taken for a word goes on as a name, or calls something.
fn goes_on(rest: &[u8]) -> bool {
    match rest {
        [b'A'..=b'Z' | b'a'..=b'z', next, ..] => !matches!(next, b'0'..=b'9' | b'+' | b'-' | b'.' | b'#' | b'['),
        [first, ..] => first.is_ascii_alphabetic() || matches!(first, b'_' | b'(' | b'[' | b'=' | b':' | b'<'),
        [] => false,
    }
}

/// An APT record in which an argument is the letter O, or has it among its digits, with zeros in its place.
pub(crate) fn record_with_zeros(record: &str, dialect: &Dialect) -> Option<String> {
    let (major, arguments) = record.split_once('/').filter(|_| dialect.lex.format == Format::Apt)?;
    let is_number = |text: &str| {
        let digits = text.trim().trim_start_matches(['+', '-']);
        digits.contains(['O', 'o'])
            && digits
                .bytes()
                .all(|byte| byte.is_ascii_digit() || b".oO".contains(&byte))
    };
    let fixed = |text: &str| {
        if is_number(text) {
            text.replace(['O', 'o'], "0")
        } else {
            text.to_owned()
        }
    };
    let fixed: Vec<String> = arguments.split(',').map(fixed).collect();
    let meant = format!("{major}/{}", fixed.join(","));
    (meant != record).then_some(meant)
}

/// Words of LinuxCNC that follow an O-word.
const KEYWORDS: &[&str] = &[
    "if",
    "elseif",
    "else",
    "endif",
    "while",
    "endwhile",
    "do",
    "repeat",
    "endrepeat",
    "break",
    "continue",
    "sub",
    "endsub",
    "return",
    "call",
];

/// The keyword that a line begins with, where LinuxCNC wants an O-word before it; and where it is. `at`: a byte of the line.
pub(crate) fn bare_keyword(program: &Program, at: u32) -> Option<(&'static str, TextRange)> {
    let source = program.source();
    let before = source.get(..at as usize)?;
    let near = before.len().saturating_sub(FAR);
    let mut start = match memchr::memrchr(b'\n', &before[near..]) {
        Some(end) => near + end + 1,
        None if near > 0 => return None,
        None => 0,
    };
    start += source[start..]
        .iter()
        .take(FAR)
        .take_while(|byte| matches!(byte, b' ' | b'\t'))
        .count();
    let is_letter = |byte: &&u8| byte.is_ascii_alphabetic();
    let end = start + source[start..].iter().take(FAR).take_while(is_letter).count();
    let word = source.get(start..end)?;
    let goes_on =
        matches!(source.get(end), Some(byte) if byte.is_ascii_digit() || matches!(byte, b'.' | b'+' | b'-' | b'#'));
    let keyword = KEYWORDS
        .iter()
        .find(|known| word.eq_ignore_ascii_case(known.as_bytes()));
    Some((keyword.filter(|_| !goes_on)?, TextRange::new(start as u32, end as u32)))
}

#[cfg(test)]
mod tests {
    use super::{bare_keyword, letter_o, record_with_zeros};

    #[test]
    fn codes_and_records_with_a_letter_o_offer_the_digit() {
        let text = "G71 G0 X1\nGO X10\n;^ not-modelled: `GO` is no code of sinumerik-840d, and no program GO.SPF or .MPF was found; did you mean `G0`?\nM30\n";
        crate::fixture::assert_drawn("gcode sinumerik-840d", text);
        let apt = trunnion_dialect::builtin("apt").expect("built in");
        for (record, wanted) in [
            ("GOTO/1,2,O", Some("GOTO/1,2,0")),
            ("GOTO/1.O, -2O,3", Some("GOTO/1.0, -20,3")),
            ("LOADTL/ON", None),
            ("GOTO/1,2,3", None),
            ("COOLNT/OFF", None),
        ] {
            assert_eq!(record_with_zeros(record, apt).as_deref(), wanted, "{record}");
        }
    }

    #[test]
    fn a_keyword_without_its_o_word() {
        let dialect = trunnion_dialect::builtin("linuxcnc").expect("built in");
        for (text, at, wanted) in [
            ("  if [#1 LT 0]\n", 3, Some("if")),
            ("G0 X1\n\tENDIF\n", 8, Some("endif")),
            ("while [#1 LT 3]", 10, Some("while")),
            ("o100 if [#1 LT 3]", 5, None),
            ("I5 F3", 1, None),
            ("do5", 0, None),
            (format!("if [{}]", "1".repeat(400)).as_str(), 300, Some("if")),
            (format!("if [{}]", "1".repeat(900)).as_str(), 800, None),
            ("", 0, None),
        ] {
            let program = trunnion_syntax::parse(text.as_bytes().to_vec(), dialect.lex);
            assert_eq!(bare_keyword(&program, at).map(|found| found.0), wanted, "{text}");
        }
    }

    #[test]
    fn a_word_with_a_letter_o_is_found_at_each_of_its_bytes() {
        for (text, at, wanted) in [
            ("G1 F=200O Y1", 8, Some("F=2000")),
            ("G1 F=200O Y1", 5, Some("F=2000")),
            ("R1 = -1O.5\nM30", 6, Some("R1 = -10.5")),
            ("#<_a>=1o", 6, Some("#<_a>=10")),
            ("F=2O0O.O.", 4, None),
            ("F=2O(3)", 3, None),
            ("F=O5", 2, None),
            ("2O", 1, None),
            ("G1 X5O. F100", 3, Some("X50.")),
            ("G1 X5O. F100", 6, Some("X50.")),
            ("G1X5O.Y3.", 5, Some("X50.")),
            ("GO X0", 0, Some("G0")),
            ("GO X0", 1, Some("G0")),
            ("G1 X1 F1OO", 9, Some("F100")),
            ("M3O", 2, Some("M30")),
            ("X-O.5", 1, Some("X-0.5")),
            ("GOTO 5", 0, None),
            ("O100", 0, None),
            ("X5 Y3", 0, None),
            ("X1.O.2", 3, None),
            ("N10 DO=5", 4, None),
            ("FOO(1)", 0, None),
            (format!("G1 {}X5O.", "Y1".repeat(200)).as_str(), 405, Some("X50.")),
            // no further than the longest block
            (format!("G1 {}X5O.", "Y1".repeat(400)).as_str(), 805, None),
            ("GO", 5, None),
        ] {
            let dialect = trunnion_dialect::builtin("iso-6983").expect("built in");
            let program = trunnion_syntax::parse(text.as_bytes().to_vec(), dialect.lex);
            let found = letter_o(&program, at).map(|slip| slip.meant);
            assert_eq!(found.as_deref(), wanted, "{text} {at}");
        }
    }
}
