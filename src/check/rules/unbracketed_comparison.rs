//! AND, OR or XOR joins two comparisons that have no brackets.
//!
//! # Why
//! On a Sinumerik comparisons bind less tightly than AND, OR and XOR: `R1>5 AND R2<3` is `(R1 > (5 AND R2)) < 3`, which is
//! true whatever the two variables hold. The control accepts it without an alarm. In Custom Macro B, too, EQ, NE, GT, LT, GE and LE bind less tightly.
//!
//! # Example
//! ```gcode sinumerik-840d
//! N10 R1=6 R2=2
//! N20 IF R1>5 AND R2<3 GOTOF AWAY
//! ;           ^^^ unbracketed-comparison: AND binds before the comparisons on both sides of it
//! N30 AWAY: M30
//! ```
//!
//! # Use instead
//! ```gcode sinumerik-840d
//! N10 R1=6 R2=2
//! N20 IF (R1>5) AND (R2<3) GOTOF AWAY
//! N30 AWAY: M30
//! ```
//!
//! # Guarantee
//! Sound: the rule reports every such operator in the text, also in blocks that do not run.
//!
//! # Sources
//! * Sinumerik 6FC5398-2EP40-0BA0 (12/2019): the priority of operators, p. 444.
//! * Fanuc B-63944EN: custom macro, priority of operations.
use crate::prelude::*;
use trunnion_dialect::Language;

pub(super) const RULE: Body = Body::sound(Warning, &[Wake::Program(check)]);

fn check(overview: &Overview<'_>, out: &mut Reporter<'_>) {
    let program = overview.program;
    let quirks = &overview.settings.dialect.quirks;
    let names = quirks.macro_b();
    if quirks.language != Language::Sinumerik && !names {
        return;
    }
    let source = program.source();
    // most programs compare nothing
    let signs = || memchr::memchr2(b'<', b'>', source).is_some() || memchr::memmem::find(source, b"==").is_some();
    if !names && !signs() || names && memchr::memchr(b'#', source).is_none() {
        return;
    }
    for block in program.blocks() {
        let range = block.range();
        for (from, to) in between_comparisons(&source[range.as_usize()], names) {
            let range = TextRange::new(range.start + from as u32, range.start + to as u32);
            let word = out.text(range).to_ascii_uppercase();
            out.report(
                range,
                format!("{word} binds before the comparisons on both sides of it"),
            )
            .help("put each comparison in brackets");
        }
    }
}

/// EQ, NE, GT, LT, GE, LE, and no longer name.
fn compares(text: &[u8]) -> bool {
    let Some(name) = text.get(..2) else { return false };
    [b"EQ", b"NE", b"GT", b"LT", b"GE", b"LE"]
        .iter()
        .any(|known| name.eq_ignore_ascii_case(*known))
        && !text.get(2).is_some_and(u8::is_ascii_alphabetic)
}

/// What the open bracket has so far.
#[derive(Clone, Copy, Default)]
struct Level {
    compared: bool,
    /// The operator after a comparison.
    word: Option<(usize, usize)>,
}

/// The operators between two comparisons of one bracket; bytes of the text.
/// `names`: the comparisons are names (EQ), and words may follow each other without a blank (`#1EQ1AND#2EQ2`).
fn between_comparisons(text: &[u8], names: bool) -> Vec<(usize, usize)> {
    let mut found = Vec::new();
    let (mut outer, mut here) = (Vec::new(), Level::default());
    let is_name =
        |byte: u8| byte.is_ascii_alphabetic() || !names && (byte.is_ascii_digit() || matches!(byte, b'_' | b'$'));
    let mut at = 0;
    while let Some(&byte) = text.get(at) {
        let next = text.get(at + 1).copied();
        let length = match (byte, next) {
            (b';', _) => break,
            (b'(', _) if names => memchr::memchr(b')', &text[at..]).map_or(text.len() - at, |end| end + 1),
            (b'"', _) => memchr::memchr(b'"', &text[at + 1..]).map_or(text.len() - at, |end| end + 2),
            (b'(' | b'[', _) => {
                outer.push(std::mem::take(&mut here));
                1
            }
            (b')' | b']', _) => {
                here = outer.pop().unwrap_or_default();
                1
            }
            _ if names && compares(&text[at..]) => {
                found.extend(here.word.take());
                here.compared = true;
                2
            }
            (b'<', Some(b'<')) => 2,
            (b'<' | b'>', _) | (b'=', Some(b'=')) => {
                found.extend(here.word.take());
                here.compared = true;
                1 + usize::from(matches!(next, Some(b'=' | b'>')))
            }
            (b',' | b'=', _) => {
                here = Level::default();
                1
            }
            _ if is_name(byte) => {
                let length = text[at..].iter().take_while(|byte| is_name(**byte)).count();
                let name = text[at..at + length].to_ascii_uppercase();
                match name.as_slice() {
                    b"AND" | b"OR" | b"XOR" if here.compared => here.word = Some((at, at + length)),
                    b"IF" | b"WHILE" | b"UNTIL" => here = Level::default(),
                    name if name.starts_with(b"GOTO") => here = Level::default(),
                    _ => {}
                }
                length
            }
            _ => 1,
        };
        at += length;
    }
    found
}

#[cfg(test)]
mod tests {
    use super::between_comparisons;

    #[test]
    fn names_of_comparisons_need_no_blanks() {
        for (text, words) in [
            ("IF[#1EQ1AND#2EQ2]GOTO10", vec!["AND"]),
            ("IF [[#1 EQ 1] AND [#2 EQ 2]] GOTO 10", vec![]),
            ("WHILE[#1LT5OR#2GT1]DO1", vec!["OR"]),
            ("#3=#1AND#2", vec![]),
            ("(A EQ B AND C EQ D)", vec![]),
            ("IF[#1EQ#2AND3]GOTO1", vec![]),
        ] {
            let found = between_comparisons(text.as_bytes(), true);
            let found: Vec<&str> = found.iter().map(|(from, to)| &text[*from..*to]).collect();
            assert_eq!(found, words, "{text}");
        }
    }

    #[test]
    fn only_operators_between_comparisons_of_one_bracket_are_found() {
        for (text, words) in [
            ("IF R1>5 AND R2<3 GOTOF A", vec!["AND"]),
            ("WHILE (R1==5 or R2<>3)", vec!["or"]),
            ("IF A>=1 XOR B<=2 AND C==3", vec!["XOR", "AND"]),
            ("IF (R1>5) AND (R2<3)", vec![]),
            ("IF R1>5 AND R2", vec![]),
            ("R1=R2 AND R3 R4=R5>1", vec![]),
            ("IF R1>5 GOTOF A IF R2 AND R3<1 GOTOF B", vec![]),
            ("MSG(\"1>2 AND 3<4\")", vec![]),
            ("MSG(\"A\"<<R1 AND R2<<\"B\")", vec![]),
            ("IF R1>5 ; AND R2<3", vec![]),
            ("IF R1>5 AND R[R2<3]>1", vec!["AND"]),
            ("\"", vec![]),
        ] {
            let found = between_comparisons(text.as_bytes(), false);
            let found: Vec<&str> = found.iter().map(|(from, to)| &text[*from..*to]).collect();
            assert_eq!(found, words, "{text}");
        }
    }
}
