//! A piece of text belongs to no word, record or comment.
//!
//! # Why
//! A control stops at such a place, skips it, or reads something other than what was intended. What is written
//! there cannot be checked.
//!
//! # Example
//! ```gcode
//! N10 G1 X F500
//! ;      ^ syntax-error: `X` has no value
//! N20 G1 X10 ?
//! ;          ^ syntax-error: `?` does not belong to any word
//! ```
//!
//! # Use instead
//! ```gcode
//! N10 G1 X0 F500
//! N20 G1 X10
//! ```
//!
//! # Guarantee
//! Sound: every byte of the file belongs to a word, a record, a comment or a blank, or is reported here, by
//! `bad-number`, by `decimal-comma` or by `unclosed-comment`.
//!
//! # Sources
//! * NISTIR 6556 (2000), section 3.3 on the format of a line.
//! * ISO 6983-1:2009, the format of a block.
use crate::prelude::*;
use trunnion_syntax::{Program, TokenId, TokenKind};

pub(super) const RULE: Body = Body::sound(
    Error,
    &[
        Wake::Text(check),
        Wake::Refused(Refusal::Syntax, plain),
        Wake::Unreadable(report_utf16),
    ],
);

fn check(error: &SyntaxError, out: &mut Reporter<'_>) {
    if matches!(
        error.kind,
        SyntaxErrorKind::WordWithoutValue | SyntaxErrorKind::NumberWithoutLetter
    ) && out.is_slip(error.range)
    {
        return;
    }
    if out.dialect().quirks.dollar_commands && is_command(out.program(), error.range) {
        return;
    }
    let text = out.text(error.range);
    if error.kind == SyntaxErrorKind::UnbalancedBracket && text == "[" {
        let before = word_after_bracket(out.program(), error.range);
        let message = match &before {
            Some(word) => format!("missing `]` before `{word}`"),
            None => "missing `]`: this `[` is not closed".to_owned(),
        };
        out.report(error.range, message).help("close the bracket");
        return;
    }
    let (message, help) = match error.kind {
        SyntaxErrorKind::NestedComment => (
            "a comment starts inside another comment".to_owned(),
            "close the first comment before it, or remove the inner opening mark",
        ),
        SyntaxErrorKind::UnexpectedCharacter => (
            format!("`{text}` does not belong to any word"),
            "remove it, or put it into a comment",
        ),
        SyntaxErrorKind::WordWithoutValue => (
            format!("`{text}` has no value"),
            "write its value, or remove the letter",
        ),
        SyntaxErrorKind::NumberWithoutLetter => (
            format!("the number `{text}` has no letter"),
            "write the letter it belongs to",
        ),
        SyntaxErrorKind::MissingValue => (format!("nothing follows `{text}`"), "write the missing value"),
        SyntaxErrorKind::UnbalancedBracket => {
            (format!("`{text}` has no matching bracket"), "close or open the bracket")
        }
        SyntaxErrorKind::UnclosedText => (
            "a quoted text is not closed at the end of its line".to_owned(),
            "write the closing quote",
        ),
        SyntaxErrorKind::DanglingContinuation => (
            "`$` continues the statement, but the file ends here".to_owned(),
            "remove the `$`, or write the rest of the statement",
        ),
        SyntaxErrorKind::BadRecord => (
            format!("`{text}` is not allowed at this place in an APT statement"),
            "a statement is a major word, then `/`, then arguments separated by commas",
        ),
        SyntaxErrorKind::TooLarge => (
            "the file is larger than 4 GiB: it was read only up to here".to_owned(),
            "split the program",
        ),
        SyntaxErrorKind::UnclosedComment
        | SyntaxErrorKind::BadNumber
        | SyntaxErrorKind::DecimalComma
        | SyntaxErrorKind::BlankInNumber => return,
    };
    if error.kind == SyntaxErrorKind::WordWithoutValue && text.trim().eq_ignore_ascii_case("N") {
        // a program without one number usually has many without
        out.report(error.range, "`N` has no number")
            .help("write the block number, or remove the N; the rest of the block is read")
            .merge(Merge::once(hash("N")));
        return;
    }
    out.report(error.range, message).help(help);
}

/// Whether a place is in a line for grbl itself: a command or setting (`$$`), which the run follows, or `?` alone, which asks for a report
/// (grbl 1.1 documentation, commands).
fn is_command(program: &Program, range: TextRange) -> bool {
    let Some(block) = program.block_at(range.start) else {
        return false;
    };
    // a line may hold as many mistakes as bytes: its first tokens decide, and a run of blanks is one token
    let tokens = program.block(block).tokens();
    let table = program.tokens();
    let mut said = tokens.filter(|id| table.kind(*id) != TokenKind::Blank);
    let begins = |id: Option<TokenId>, with: &[u8]| {
        let first = id.and_then(|id| program.bytes(table.range(id)).first());
        first.is_some_and(|byte| with.contains(byte))
    };
    let first = said.next();
    if begins(first, b"$") {
        return true;
    }
    let alone = first.is_some_and(|id| program.bytes(table.range(id)) == b"?");
    alone && said.next().is_none_or(|id| begins(Some(id), b"(;\r\n"))
}

/// A bracket is closed within so many bytes, or the word before which it should have been is not named.
const NEAR: usize = 200;

/// The word after an open bracket, before which it should have been closed: it begins with a letter after a value.
fn word_after_bracket(program: &Program, bracket: TextRange) -> Option<String> {
    let rest = program.source().get(bracket.end as usize..)?;
    // there may be as many brackets as bytes
    let line = &rest[..rest.len().min(NEAR)];
    let line = line.split(|byte| matches!(byte, b'\r' | b'\n' | b'(' | b';')).next()?;
    let text = match core::str::from_utf8(line) {
        Ok(text) => text,
        Err(error) => core::str::from_utf8(&line[..error.valid_up_to()]).ok()?,
    };
    text.split_ascii_whitespace()
        .skip(1)
        .find(|word| {
            let mut bytes = word.bytes();
            let letter = bytes.next().is_some_and(|byte| byte.is_ascii_alphabetic());
            letter
                && bytes
                    .next()
                    .is_some_and(|byte| byte.is_ascii_digit() || matches!(byte, b'.' | b'-' | b'+'))
        })
        .map(|word| word.chars().take(40).collect())
}

/// Reports that a file is UTF-16, instead of a problem for each of its bytes.
fn report_utf16(out: &mut Reporter<'_>) {
    out.report(TextRange::new(0, 2), "this file is UTF-16; save it as UTF-8 or ASCII")
        .note("controls read one byte per character; nothing was checked");
}

#[cfg(test)]
mod tests {
    use crate::fixture::{Fixture, assert_drawn};
    use crate::unreadable::is_utf16;

    #[test]
    fn commands_of_grbl_are_no_mistakes() {
        for line in ["$$", "$$ ; settings", "$I", "?", "? (state)"] {
            assert_drawn("gcode grbl", &format!("{line}\nG21 G90\nG0 X0\nM2\n"));
        }
        assert_drawn(
            "gcode grbl",
            "G0 X1 ?\n;     ^ syntax-error: `?` does not belong to any word\nM2\n",
        );
    }

    #[test]
    fn utf_16_is_one_finding() {
        let mut text = String::from("\0");
        text.extend("G0 X1 Y2\r\nM30\r\n".chars().flat_map(|c| [c, '\0']));
        for text in [text[1..].to_owned(), text] {
            let report = Fixture::parse("gcode mill-3axis", &text).check().unwrap();
            let found: Vec<_> = report
                .diagnostics
                .iter()
                .map(|d| (d.rule, d.message.as_str()))
                .collect();
            if text.len() % 2 == 0 {
                assert_eq!(
                    found,
                    [("syntax-error", "this file is UTF-16; save it as UTF-8 or ASCII")]
                );
            }
        }
        assert!(is_utf16(b"\xFF\xFEG\x000\0") && is_utf16(b"\xFE\xFF\0G\x000") && is_utf16(b"\0G\x000\0 "));
        for text in [&b""[..], b"\0\0\0\0", b"G0", b"G\0", b"G0 X1\n\0\0"] {
            assert!(!is_utf16(text), "{text:?}");
        }
    }

    #[test]
    fn block_numbers_that_are_missing_are_one_finding() {
        let report = Fixture::parse("gcode mill-3axis", "N G21\nN10 G0 X0 Y0 Z0\nN G1 X5 F100\nN\nM30\n")
            .check()
            .unwrap();
        let found: Vec<_> = report
            .diagnostics
            .iter()
            .map(|d| (d.message.as_str(), d.count))
            .collect();
        assert_eq!(found, [("`N` has no number", 3)]);
        assert_eq!(report.summary.motions, 2, "the blocks are read");
    }

    #[test]
    fn a_long_piece_of_text_is_not_quoted_in_full() {
        let text = format!("G0 X{}.1.2\n", "1".repeat(5000));
        let report = Fixture::parse("gcode mill-3axis", &text).check().unwrap();
        let found = report.diagnostics.iter().find(|d| d.rule == "bad-number").unwrap();
        assert_eq!(found.message, format!("`{}...` is not a number", "1".repeat(40)));
        assert!(report.diagnostics.iter().all(|d| d.message.len() < 200));
    }

    #[test]
    fn the_number_of_a_spindle_is_a_word_of_linuxcnc_alone() {
        let found = |dialect: &str| {
            let text = "G21 G90 G94\nM3 $0 S1000\nG0 X0 Y0 Z5\nG1 Z-1 F100\nM5 $0\nM2\n";
            let report = Fixture::parse(&format!("gcode {dialect}"), text).check().unwrap();
            let errors = report
                .diagnostics
                .iter()
                .filter(|d| d.severity == crate::Severity::Error);
            errors.map(|d| d.rule).collect::<Vec<_>>()
        };
        assert_eq!(found("linuxcnc"), [""; 0]);
        assert_eq!(found("fanuc-30i"), ["unknown-word", "unknown-word"]);
    }
}
