//! A first look at a line that is skipped: most lines show by a few signs that they count for nothing.
//!
//! It settles only what the full look at a skipped line would settle in the same way (a test compares both).
use super::label::digits;
use super::oline::{Keyword, written};

/// Lines up to this length, including their line end, are examined here.
const LONGEST: usize = 253;

/// The class of a line by its first characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Look<'s> {
    /// It does not matter.
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
    /// The line after them is an O line with the wanted label.
    pub(super) counts: bool,
}

/// Skips the lines at the start of a text that do not matter by their first characters, `most` of them at most. What matters is an O line
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
fn blanks(text: &[u8]) -> usize {
    text.iter().take_while(|byte| matches!(**byte, b' ' | b'\t')).count()
}

/// How long the first line of a text is, including its line end, and whether there is a `(` in it.
#[inline]
fn length(text: &[u8]) -> (usize, bool) {
    let line = |end: Option<usize>| end.map_or(text.len(), |end| end + 1);
    match memchr::memchr2(b'\n', b'(', text) {
        Some(at) if text[at] == b'(' => (line(memchr::memchr(b'\n', text)), true),
        end => (line(end), false),
    }
}

/// Looks at the first line of a text; `bracket`: there is a `(` in it.
#[inline]
fn look(text: &[u8], bracket: bool) -> Look<'_> {
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
        end = digits(rest)?.1;
        end
    };
    at += blanks(&rest[at..]);
    let (keyword, length) = written(&rest[at..])?;
    // a line that ends here was cut off
    rest.get(at + length)?;
    (keyword != Keyword::Sub).then(|| Look::Label(&rest[usize::from(named)..end], keyword.is_global()))
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

    /// The result of the full look at a line: its label and whether it takes part in calls; `None` where something is wrong with it or
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
        let local = "if else elseif endif while endwhile do repeat endrepeat break continue";
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
        for word in ["sub", "iff", "whilewhile", "x"] {
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
