//! A first look at a line that is skipped: most lines show by a few signs that they count for nothing.
//!
//! It settles only what the full look at a skipped line would settle in the same way (a test compares both).

use super::oline::{self, Keyword};

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

/// Looks at one line; `bracket`: there is a `(` in it.
#[inline]
pub(super) fn look(line: &[u8], bracket: bool) -> Look<'_> {
    let Some(start) = line.iter().position(|byte| !matches!(byte, b' ' | b'\t')) else {
        return Look::Nothing;
    };
    let rest = &line[start..];
    match rest[0] {
        b'\n' | b';' => Look::Nothing,
        b'o' | b'O' if !bracket => label(&rest[1..]).unwrap_or(Look::Unclear),
        b'n' | b'N' | b'o' | b'O' => Look::Unclear,
        b'm' | b'M' if may_call(&rest[1..]) => Look::Unclear,
        b'#' | b'a'..=b'z' | b'A'..=b'Z' if !bracket => Look::Nothing,
        _ => Look::Unclear,
    }
}

/// Whether `M98` may stand there: the control reads such a line as a whole.
fn may_call(rest: &[u8]) -> bool {
    let first = rest.iter().find(|byte| !matches!(byte, b' ' | b'\t'));
    matches!(first, Some(b'9' | b'0' | b'[' | b'+'))
}

/// What stands behind the O: digits without a zero in front, or `<name>`, and a keyword without blanks inside.
fn label(rest: &[u8]) -> Option<Look<'_>> {
    let (name, behind) = if rest.first() == Some(&b'<') {
        let end = rest
            .iter()
            .skip(1)
            .position(|byte| !(byte.is_ascii_alphanumeric() || *byte == b'_'))?;
        (rest.get(end + 1) == Some(&b'>')).then_some((&rest[1..=end], &rest[end + 2..]))?
    } else {
        let end = rest.iter().position(|byte| !byte.is_ascii_digit())?;
        let plain = (1..=9).contains(&end) && (rest[0] != b'0' || end == 1);
        plain.then_some(rest.split_at(end))?
    };
    let blanks = behind.iter().position(|byte| !matches!(byte, b' ' | b'\t'))?;
    let word = &behind[blanks..];
    let end = word.iter().position(|byte| !byte.is_ascii_alphabetic())?;
    let global = match oline::keyword_of(&word[..end])? {
        Keyword::Sub => return None,
        keyword => matches!(keyword, Keyword::EndSub | Keyword::Call | Keyword::Return),
    };
    Some(Look::Label(name, global))
}

#[cfg(test)]
mod tests {
    use super::{Look, look};
    use crate::flow::fetch;
    use crate::flow::oline::{self, Keyword, Label, OLine};
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
        let Label::Text(name) = &read.label else { return None };
        let global = matches!(read.keyword, Keyword::EndSub | Keyword::Call | Keyword::Return);
        let sub = matches!(read.keyword, Keyword::Sub | Keyword::Bare);
        (!sub).then(|| Some((name.to_string(), global)))
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(2000))]

        #[test]
        fn what_is_seen_at_first_sight_is_so(
            line in "[ \\t]{0,2}[oO]?(1|12|007|0|<a_1>|<A b>|#1|<a)?[ ]{0,2}(if|else|else if|endif|while|endwhile|call|endsub|sub|end sub|return|do|G1 X1|#2=3|N5|%|/)?( ?\\[1\\]| ?[(;]c[)]?|x| 2)?\r?\n"
        ) {
            let expected = full(line.as_bytes());
            match look(line.as_bytes(), line.contains('(')) {
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
