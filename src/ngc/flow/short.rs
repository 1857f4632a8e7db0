//! O lines as most of them are written, in one pass over their bytes: `o12 endif`, `o<name> call [1] [2.5]`, `o3 sub (a comment)`.
//!
//! It accepts only what [`oline::read`] would read in the same way without a flaw (a test compares both), and only lines that are read to run
//! once: what runs again is found by its text.
use super::fetch::LONGEST;
use super::glance;
use super::label::{Label, digits};
use super::labels::Place;
use super::oline::{ARGUMENTS, Keyword, OLine};
use super::{Compiled, Kind, Memo};
use crate::Engine;
use trunnion_formula::{Name, literal_in_brackets};
use trunnion_syntax::TextRange;

/// How a line begins.
struct Head {
    /// Where the label is a name; else it is this number.
    name: Option<Name>,
    number: u32,
    keyword: Keyword,
    /// Where O, the end of the label, the keyword and its end are.
    at: [usize; 4],
}

impl Engine {
    /// The line at a place in its read form, if it is an O line of this sort.
    #[inline]
    pub(super) fn short_o_line(&mut self, place: Place) -> Option<Box<Compiled>> {
        let source = self.files[place.file().0 as usize].bytes();
        let text = source.get(place.offset as usize..)?;
        let start = glance::blanks(text);
        if !matches!(text.get(start), Some(b'o' | b'O')) {
            return None;
        }
        let text = &text[..text.len().min(LONGEST as usize)];
        let head = head(text, start)?;
        let mut compiled = self.flow.texts.nowhere();
        let old = compiled.o.take().or_else(|| compiled.spare.take());
        let mut line = old.unwrap_or_default();
        for value in line.values.drain(..) {
            compiled.line.pool.take_back(value);
        }
        let end = rest(text, &head, place.offset, &mut line);
        compiled.o = Some(line);
        let Some(end) = end else {
            self.flow.texts.put_back(compiled);
            return None;
        };
        compiled.place = place;
        compiled.next = place.further(1, place.offset + end as u32);
        compiled.kind = Kind::Label;
        compiled.only_sets = false;
        compiled.cut = None;
        compiled.flaw = None;
        compiled.memo = Memo::default();
        if let Some(line) = &mut compiled.o {
            complete(line, head, place.offset);
        }
        Some(compiled)
    }
}

/// Label and keyword of the O line whose O is at `start`.
#[inline]
fn head(text: &[u8], start: usize) -> Option<Head> {
    let behind = &text[start + 1..];
    let (name, number, length) = if behind.first() == Some(&b'<') {
        let (name, length) = Name::before(&behind[1..], b'>')?;
        (Some(name), 0, length + 2)
    } else {
        let (number, length) = digits(behind)?;
        (None, number, length)
    };
    let label_end = start + 1 + length;
    let word = label_end + glance::blanks(&text[label_end..]);
    let (keyword, length) = glance::plain_keyword(&text[word..])?;
    Some(Head {
        name,
        number,
        keyword,
        at: [start, label_end, word, word + length],
    })
}

/// Arguments of a call into `line`, then a comment and the line end: where the line ends. `offset`: where the text is in the file.
#[inline]
fn rest(text: &[u8], head: &Head, offset: u32, line: &mut OLine) -> Option<usize> {
    let mut at = head.at[3];
    at += glance::blanks(&text[at..]);
    if head.keyword == Keyword::Call {
        while text.get(at) == Some(&b'[') {
            let (value, length) = literal_in_brackets(&text[at..], offset + at as u32)?;
            if line.values.len() == ARGUMENTS {
                return None;
            }
            line.values.push(value);
            at += length;
            at += glance::blanks(&text[at..]);
        }
    }
    if text.get(at) == Some(&b'(') {
        let plain = |byte: &u8| !matches!(byte, b'(' | b')' | b'\n' | 0);
        at += 1;
        at += text[at..].iter().position(|byte| !plain(byte))?;
        if text[at] != b')' {
            return None;
        }
        at += 1;
        at += glance::blanks(&text[at..]);
    }
    at += usize::from(text.get(at) == Some(&b'\r'));
    (text.get(at) == Some(&b'\n')).then_some(at + 1)
}

/// What is left to emit of a line that has its values; `offset`: where the text is in the file.
#[inline]
fn complete(line: &mut OLine, head: Head, offset: u32) {
    let [start, label_end, word, end] = head.at.map(|at| offset + at as u32);
    line.keyword = head.keyword;
    line.label = match head.name {
        Some(name) => Label::Text(name),
        None => Label::Number(head.number),
    };
    line.label_range = TextRange::new(start, label_end);
    line.keyword_range = TextRange::new(word, end);
    line.rest = TextRange::new(word, word);
    (line.flaw, line.tail) = (None, None);
    line.errors.clear();
}

#[cfg(test)]
mod tests {
    use super::{OLine, complete, head, rest};
    use crate::flow::{fetch, glance, oline};
    use proptest::prelude::*;
    use trunnion_formula::Pool;
    use trunnion_syntax::TextRange;

    /// Whether this path accepts the line; then it is what the general path reads.
    fn same(text: &str) -> bool {
        let there = format!("G1 X1\n{text}");
        let bytes = there.as_bytes();
        let from = &bytes[6..];
        let start = glance::blanks(from);
        if !matches!(from.get(start), Some(b'o' | b'O')) {
            return false;
        }
        let Some(head) = head(from, start) else { return false };
        let mut short = OLine::default();
        let Some(end) = rest(from, &head, 6, &mut short) else {
            return false;
        };
        complete(&mut short, head, 6);
        let line = TextRange::new(6, 6 + end as u32);
        let text = fetch::trimmed(bytes, line);
        assert_eq!(fetch::text_flaw(bytes, text), None);
        let mut general = OLine::default();
        let mut cursor = fetch::head(bytes, text).cursor;
        oline::read(&mut cursor, &mut Pool::default(), &mut general);
        assert_eq!(general.errors, []);
        // whether a formula is a number that was written, or one in brackets, makes no difference to a call
        let values = |line: &OLine| {
            let values = line.values.iter();
            values
                .map(|value| (value.range(), value.number().map(f64::to_bits)))
                .collect::<Vec<_>>()
        };
        assert_eq!(values(&short), values(&general), "{there:?}");
        let others = |line: &OLine| {
            format!(
                "{:?} {:?} {:?} {:?} {:?} {:?} {:?}",
                line.keyword, line.label, line.label_range, line.keyword_range, line.rest, line.flaw, line.tail
            )
        };
        assert_eq!(others(&short), others(&general), "{there:?}");
        assert_eq!(bytes[6 + end - 1], b'\n');
        assert!(!bytes[6..6 + end - 1].contains(&b'\n'));
        true
    }

    #[test]
    fn what_most_o_lines_are_is_short() {
        for text in [
            "o100 sub (pocket 1)\n",
            "  O<Name_1> CALL [1] [-2] [.5][0.25]\r\n",
            "o1 endwhile\n",
            "o12 return \n",
            "o0 else\n",
            "o7 call\n",
            "o<a> endsub ( o )\n",
        ] {
            let signed = text.contains("[-");
            assert_eq!(same(text), !signed, "{text:?}");
        }
        for text in [
            "o01 sub\n",
            "o1 else if [1]\n",
            "o1 if [1]\n",
            "o1 sub",
            "o1 call [1+1]\n",
            "o1 sub (a (b)\n",
            "o1 sub (a\n",
            "o1 call [1] (a) [2]\n",
            "o1 endsub [1]\n",
            "o1 end sub\n",
            "o1 sub ; a\n",
            "o1 sub x\n",
            "o1\n",
        ] {
            assert!(!same(text), "{text:?}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(3000))]

        #[test]
        fn both_ways_read_the_same(
            text in "[ \\t]{0,9}[oO](1|12|007|0|123456789|1234567890|<a_1>|<A b>|<>|<a|#1)[ ]{0,2}(if|else|else if|endif|while|endwhile|call|CALL|endsub|sub|end sub|return|do|repeat|break|continue)?([ ]?\\[(1|1.5|-2|.5|5.|.|1 2|#1|1e3|12345678901234567|0.)\\]){0,3}( ?[(;]c[)]?| x| 2|\\[1\\]|\u{0})?[ ]?\r?\n?[a-z]{0,9}"
        ) {
            same(&text);
        }
    }
}
