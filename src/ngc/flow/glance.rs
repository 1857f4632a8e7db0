//! A first look at a line that is skipped: most lines show by a few signs that they count for nothing.
//!
//! It settles only what the full look at a skipped line would settle in the same way (a test compares both).
use super::oline::Keyword;

/// Lines up to this length, their line end counted, are looked at here.
pub(super) const LONGEST: usize = 253;

/// What a line is at first sight.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Look<'s> {
    /// It counts for nothing.
    Nothing,
    /// An O line with this name or number and a keyword that takes part in structures, or (`true`) in calls and returns; no `sub`.
    Label(&'s [u8], bool),
    /// It must be read.
    Unclear,
}

/// Lines that were passed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Passed {
    pub(super) lines: usize,
    /// Their bytes.
    pub(super) length: usize,
    /// The line after them is an O line with the label that is looked for.
    pub(super) counts: bool,
}

/// Passes the lines at the start of a text that by their first signs count for nothing, `most` of them at most. What counts is an O line
/// labelled `wanted` that takes part in calls and returns (`global`), or one that takes part in structures.
pub(super) fn pass(text: &[u8], wanted: &[u8], global: bool, most: usize) -> Passed {
    let mut passed = Passed::default();
    let mut rest = text;
    while passed.lines < most && !rest.is_empty() {
        let (length, has_comment) = length(rest);
        if length > LONGEST {
            break;
        }
        match look(rest, has_comment) {
            Look::Nothing => {}
            Look::Label(name, is_global) => {
                passed.counts = is_global == global && wanted.eq_ignore_ascii_case(name);
                if passed.counts {
                    break;
                }
            }
            Look::Unclear => break,
        }
        passed.lines += 1;
        passed.length += length;
        rest = &rest[length..];
    }
    passed
}

/// How many blanks a text begins with.
#[inline]
pub(super) fn blanks(text: &[u8]) -> usize {
    if let Some(bytes) = text.first_chunk::<8>() {
        let word = u64::from_le_bytes(*bytes);
        let other = word ^ u64::from_le_bytes([b' '; 8]);
        let count = other.trailing_zeros() / 8;
        if count < 8 && (word >> (8 * count)) as u8 != b'\t' {
            return count as usize;
        }
    }
    text.iter().take_while(|byte| matches!(**byte, b' ' | b'\t')).count()
}

/// How long the first line of a text is, its line end counted, and whether there is a `(` in it.
#[inline]
pub(super) fn length(text: &[u8]) -> (usize, bool) {
    const ONES: u64 = u64::from_ne_bytes([1; 8]);
    const HIGH: u64 = u64::from_ne_bytes([0x80; 8]);
    // with these bits set, line end and bracket are the same sign, and so are `*` and a control code
    const APART: u64 = u64::from_ne_bytes([b'\n' ^ b'('; 8]);
    const BOTH: u64 = u64::from_ne_bytes([b'\n' | b'('; 8]);
    let mut at = 0;
    // lines are short: words of eight bytes are faster than a call
    'line: for bytes in text.as_chunks::<8>().0 {
        let word = u64::from_le_bytes(*bytes);
        let other = (word | APART) ^ BOTH;
        // where a byte is one of them, its highest bit is set; above the first one others may be, too
        let mut marks = other.wrapping_sub(ONES) & !other & HIGH;
        while marks != 0 {
            let place = marks.trailing_zeros() / 8;
            match (word >> (8 * place)) as u8 {
                b'\n' => return (at + place as usize + 1, false),
                b'(' => break 'line,
                _ => marks &= marks - 1,
            }
        }
        at += 8;
    }
    let rest = &text[at..];
    let end = memchr::memchr(b'\n', rest);
    let length = end.map_or(rest.len(), |end| end + 1);
    (at + length, memchr::memchr(b'(', &rest[..length]).is_some())
}

/// Looks at the first line of a text; `bracket`: there is a `(` in it.
#[inline]
pub(super) fn look(text: &[u8], bracket: bool) -> Look<'_> {
    let rest = &text[blanks(text)..];
    let Some(first) = rest.first() else {
        return Look::Nothing;
    };
    match first {
        b'\n' | b';' => Look::Nothing,
        b'o' | b'O' if !bracket => label(&rest[1..]).unwrap_or(Look::Unclear),
        b'n' | b'N' | b'o' | b'O' => Look::Unclear,
        b'm' | b'M' if may_call(&rest[1..]) => Look::Unclear,
        b'#' | b'a'..=b'z' | b'A'..=b'Z' if !bracket => Look::Nothing,
        _ => Look::Unclear,
    }
}

/// Whether `M98` may be there: the control reads such a line as a whole.
fn may_call(rest: &[u8]) -> bool {
    let first = rest.iter().find(|byte| !matches!(byte, b' ' | b'\t'));
    matches!(first, Some(b'9' | b'0' | b'[' | b'+'))
}

/// What follows the O: digits without a leading zero, or `<name>`, and a keyword without blanks inside.
#[inline]
fn label(rest: &[u8]) -> Option<Look<'_>> {
    let named = rest.first() == Some(&b'<');
    let mut end = usize::from(named);
    let mut at = if named {
        while rest
            .get(end)
            .is_some_and(|byte| byte.is_ascii_alphanumeric() || *byte == b'_')
        {
            end += 1;
        }
        if rest.get(end) != Some(&b'>') {
            return None;
        }
        end + 1
    } else {
        while rest.get(end).is_some_and(u8::is_ascii_digit) {
            end += 1;
        }
        if !(1..=9).contains(&end) || (rest[0] == b'0' && end > 1) {
            return None;
        }
        end
    };
    while matches!(rest.get(at), Some(b' ' | b'\t')) {
        at += 1;
    }
    let letters = keyword(rest.get(at..)?);
    at += letters.len;
    let global = is_global(letters.word)?;
    // a line that ends here was cut off
    rest.get(at)?;
    Some(Look::Label(&rest[usize::from(named)..end], global))
}

/// The letters that a text begins with.
struct Letters {
    /// In lower case, the first one lowest; 0 where they are more than eight.
    word: u64,
    len: usize,
}

/// The word that a text begins with.
#[inline]
fn keyword(text: &[u8]) -> Letters {
    let Some(bytes) = text.first_chunk::<8>() else {
        let mut word = [0; 8];
        let len = text.iter().take_while(|byte| byte.is_ascii_alphabetic()).count();
        for (to, byte) in word.iter_mut().zip(&text[..len]) {
            *to = byte | 0x20;
        }
        let word = u64::from_le_bytes(word);
        return Letters { word, len };
    };
    let of = |byte: u8| u64::from_le_bytes([byte; 8]);
    let lower = u64::from_le_bytes(*bytes) | of(0x20);
    // the highest bit of each byte: not ASCII, from `a` on, after `z`
    let plain = lower & of(0x7f);
    let letter = (plain + of(0x80 - b'a')) & !(plain + of(0x80 - b'z' - 1)) & !lower;
    let others = !letter & of(0x80);
    let len = others.trailing_zeros() as usize / 8;
    if len == 8 {
        // longer words are for the full look
        let longer = text.get(8).is_some_and(u8::is_ascii_alphabetic);
        let word = if longer { 0 } else { lower };
        return Letters { word, len };
    }
    let word = lower & ((1 << (8 * len)) - 1);
    Letters { word, len }
}

/// The keyword that a text begins with, where it needs no value and a letter after it would belong to it; how many letters it has.
#[inline]
pub(super) fn plain_keyword(text: &[u8]) -> Option<(Keyword, usize)> {
    let letters = keyword(text);
    let found = PLAIN.iter().find(|(word, _)| *word == letters.word)?.1;
    // `else if` is one word
    let alone = found != Keyword::Else || !matches!(text.get(letters.len), Some(b' ' | b'\t' | b'\r'));
    alone.then_some((found, letters.len))
}

/// A word of up to eight letters as one number, the first one lowest.
const fn of(word: &[u8]) -> u64 {
    let mut letters = 0;
    let mut at = 0;
    while at < word.len() {
        letters |= (word[at] as u64) << (8 * at);
        at += 1;
    }
    letters
}

/// Keywords that need no value.
const PLAIN: [(u64, Keyword); 10] = [
    (of(b"endwhile"), Keyword::EndWhile),
    (of(b"endif"), Keyword::EndIf),
    (of(b"else"), Keyword::Else),
    (of(b"call"), Keyword::Call),
    (of(b"sub"), Keyword::Sub),
    (of(b"endsub"), Keyword::EndSub),
    (of(b"return"), Keyword::Return),
    (of(b"do"), Keyword::Do),
    (of(b"break"), Keyword::Break),
    (of(b"continue"), Keyword::Continue),
];

/// Whether a keyword, its letters as one number, takes part in calls and returns (true) or in structures; `None` for `sub`, and for a word
/// that is none of them.
#[inline]
fn is_global(letters: u64) -> Option<bool> {
    const GLOBAL: [u64; 3] = [of(b"endsub"), of(b"call"), of(b"return")];
    const LOCAL: [u64; 10] = [
        of(b"if"),
        of(b"else"),
        of(b"endif"),
        of(b"while"),
        of(b"endwhile"),
        of(b"elseif"),
        of(b"do"),
        of(b"repeat"),
        of(b"break"),
        of(b"continue"),
    ];
    if LOCAL.contains(&letters) {
        Some(false)
    } else {
        GLOBAL.contains(&letters).then_some(true)
    }
}

#[cfg(test)]
mod tests {
    use super::{Look, look};
    use crate::flow::fetch;
    use crate::flow::label::Label;
    use crate::flow::oline::{self, Keyword, OLine};
    use proptest::prelude::*;
    use trunnion_formula::Pool;
    use trunnion_syntax::TextRange;

    /// What the full look makes of a line: its label and whether it takes part in calls; `None` where something is wrong with it or
    /// it begins a subprogram.
    #[expect(
        clippy::option_option,
        reason = "wrong, counting for nothing, and counting are three answers"
    )]
    fn full(line: &[u8]) -> Option<Option<(String, bool)>> {
        let text = fetch::trimmed(line, TextRange::new(0, line.len() as u32));
        let head = fetch::head(line, text);
        if fetch::text_flaw(line, text).is_some() || head.delete {
            return None;
        }
        if head.first != Some(b'o') {
            return (head.first != Some(b'%')).then_some(None);
        }
        let mut cursor = head.cursor;
        let mut read = OLine::default();
        oline::read(&mut cursor, &mut Pool::default(), &mut read);
        let name = match &read.label {
            Label::Number(number) => number.to_string(),
            Label::Text(name) => name.to_string(),
            Label::Computed(_) => return None,
        };
        let global = matches!(read.keyword, Keyword::EndSub | Keyword::Call | Keyword::Return);
        let sub = matches!(read.keyword, Keyword::Sub | Keyword::Bare);
        (!sub).then_some(Some((name, global)))
    }

    #[test]
    fn keywords_are_known_at_first_sight() {
        let local = "if else elseif endif while endwhile do repeat break continue";
        let global = "endsub call return";
        for (words, is_global) in [(local, false), (global, true)] {
            for word in words.split(' ') {
                for text in [
                    format!(" o12 {word}\n"),
                    format!("O12{}[1]\nG1 X2\n", word.to_uppercase()),
                ] {
                    assert_eq!(look(text.as_bytes(), false), Look::Label(b"12", is_global), "{text:?}");
                }
            }
        }
        for word in ["sub", "endrepeat", "iff", "whilewhile", "x"] {
            assert_eq!(
                look(format!("o1 {word}\nG1\n").as_bytes(), false),
                Look::Unclear,
                "{word}"
            );
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn a_line_is_as_long_as_it_is(text in "[a-z \\n(\u{29}\u{8}\u{b}\u{a9}*]{0,40}") {
            let text = text.as_bytes();
            let length = text.iter().position(|byte| *byte == b'\n').map_or(text.len(), |end| end + 1);
            prop_assert_eq!(super::length(text), (length, text[..length].contains(&b'(')));
        }

        #[test]
        fn what_is_seen_at_first_sight_is_so(
            line in "[ \\t]{0,2}[oO]?(1|12|007|0|<a_1>|<A b>|#1|<a)?[ ]{0,2}(if|else|else if|endif|while|endwhile|call|endsub|sub|end sub|return|do|G1 X1|#2=3|N5|%|/)?( ?\\[1\\]| ?[(;]c[)]?|x| 2)?\r?\n",
            behind in "[a-z(0-9]{0,9}"
        ) {
            let expected = full(line.as_bytes());
            let followed = format!("{line}{behind}");
            match look(followed.as_bytes(), line.contains('(')) {
                Look::Unclear => {}
                Look::Nothing => prop_assert_eq!(expected, Some(None), "{:?}", line),
                Look::Label(name, global) => {
                    let name = String::from_utf8_lossy(name).to_ascii_lowercase();
                    prop_assert_eq!(expected, Some(Some((name, global))), "{:?}", line);
                }
            }
        }
    }
}
