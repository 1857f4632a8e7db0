//! Block numbers do not increase.
//!
//! # Why
//! People and controls use the numbers to find a block: a search for N30 stops at the first one. Numbers that
//! decrease or repeat are mostly harmless, but sometimes they show that a block was copied, moved or lost.
//!
//! # Example
//! ```gcode
//! N10 G0 X10
//! N30 X20
//! N20 X30
//! ;^^ block-number-order: N20 comes after N30
//! ```
//!
//! # Use instead
//! ```gcode
//! N10 G0 X10
//! N20 X20
//! N30 X30
//! ```
//!
//! # Guarantee
//! Sound; reported once per file, with the count of such blocks. Numbering starts again after a program number and
//! after `%`.
//!
//! # Sources
//! * ISO 6983-1:2009, sequence numbers.
use crate::prelude::*;

pub(super) const RULE: Body = Body::sound(Info, &[Wake::Program(check)]);

/// What begins a block, as far as its number goes.
enum Start {
    /// A number: its value in thousandths, and bytes.
    Number(u64, TextRange),
    /// A program begins.
    Program,
    Other,
}

fn check(overview: &Overview<'_>, out: &mut Reporter<'_>) {
    let program = overview.program;
    if !program.options().format.has_words() {
        return;
    }
    let mut last: Option<(u64, TextRange)> = None;
    for block in program.blocks() {
        // what most blocks begin with begins no number and no program
        if matches!(block.first_byte(), Some(b'G' | b'M' | b'X'..=b'Z')) {
            continue;
        }
        let range = block.range();
        match start(&program.source()[range.as_usize()], range.start) {
            Start::Number(value, range) => {
                if let Some((before, place)) = last
                    && value <= before
                {
                    let (this, that) = (out.text(range), out.text(place));
                    let message = if value == before {
                        format!("{this} is used twice in a row")
                    } else {
                        format!("{this} comes after {that}")
                    };
                    out.report(range, message)
                        .help("renumber the blocks if their numbers are used for searching")
                        .related(place, "the previous number is here")
                        .merge(Merge::once(0));
                }
                last = Some((value, range));
            }
            Start::Program => last = None,
            Start::Other => {}
        }
    }
}

/// Reads a block's first bytes only: most of a long program's time would go into its words.
fn start(text: &[u8], offset: u32) -> Start {
    let blanks = |at: usize| {
        at + text[at..]
            .iter()
            .take_while(|byte| matches!(byte, b' ' | b'\t'))
            .count()
    };
    let digits = |at: usize| text[at..].iter().take_while(|byte| byte.is_ascii_digit()).count();
    let mut at = blanks(0);
    if text.get(at) == Some(&b'/') {
        at += 1;
        at = blanks(at + digits(at));
    }
    match text.get(at) {
        Some(b'N' | b'n') => {}
        Some(b'O' | b'o' | b'%' | b':') => return Start::Program,
        _ => return Start::Other,
    }
    let begin = at;
    let mut number = blanks(at + 1);
    let count = digits(number);
    if !(1..=15).contains(&count) {
        return Start::Other;
    }
    let mut value = 0u64;
    for digit in &text[number..number + count] {
        value = value * 10 + u64::from(digit - b'0');
    }
    number += count;
    value *= 1000;
    if text.get(number) == Some(&b'.') {
        let part = digits(number + 1);
        for (digit, weight) in text[number + 1..number + 1 + part].iter().zip([100, 10, 1]) {
            value += u64::from(digit - b'0') * weight;
        }
        number += 1 + part;
    }
    Start::Number(value, TextRange::new(offset + begin as u32, offset + number as u32))
}

#[cfg(test)]
mod tests {
    use crate::fixture::assert_drawn;

    #[test]
    fn one_finding_counts_all_of_them() {
        let report = assert_drawn(
            "gcode",
            "N10 G0 X1\n/ N5 X2\n; ^^ block-number-order: N5 comes after N10\n;^ block-delete-unset: 1 block begins with /\nN5 X3\nn6.5 X4\nN 7 X5\nN6.9 X6\n",
        );
        let found = report
            .diagnostics
            .iter()
            .find(|found| found.rule == "block-number-order");
        assert_eq!(found.map(|found| found.count), Some(3));
    }

    #[test]
    fn numbers_start_anew_in_another_program() {
        assert_drawn("gcode fanuc-30i", "%\nO1\nN10 G0 X1.\nM30\nO2\nN10 X2.\nM99\n%\n");
    }
}
