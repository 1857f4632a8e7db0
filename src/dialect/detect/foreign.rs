//! Files that are not NC programs at all: pictures, binaries, prose, source code.
use super::others::klartext;
use super::text::{is_block, lines, strip_comments};
use super::votes::Votes;

/// Bytes that are searched for control characters.
const HEAD: usize = 4096;

/// First bytes of file formats that people confuse with programs, and what they are.
const FORMATS: &[(&[u8], &str)] = &[
    (b"\x89PNG", "a PNG picture"),
    (b"\xFF\xD8\xFF", "a JPEG picture"),
    (b"GIF8", "a GIF picture"),
    (b"\x7FELF", "an ELF binary"),
    (b"%PDF-", "a PDF document"),
    (b"PK\x03\x04", "a ZIP archive"),
    (b"\x1F\x8B", "a gzip archive"),
    (b"7z\xBC\xAF", "a 7z archive"),
    (b"Rar!", "a RAR archive"),
    (b"\xD0\xCF\x11\xE0", "an old Office document"),
    (b"SQLite format 3", "a database"),
    (b"\xCA\xFE\xBA\xBE", "a binary"),
    (b"{\\rtf", "an RTF document"),
];

/// What a file is by its bytes, if it is not text. Leading and trailing NUL bytes are those of paper tape, and UTF-16 is text.
pub(crate) fn binary(source: &[u8]) -> Option<&'static str> {
    if let Some((_, what)) = FORMATS.iter().find(|(magic, _)| source.starts_with(magic)) {
        return Some(what);
    }
    let leader = source.iter().take_while(|byte| **byte == 0).count();
    let trailer = source[leader..].iter().rev().take_while(|byte| **byte == 0).count();
    let text = &source[leader..source.len() - trailer];
    let head = &text[..text.len().min(HEAD)];
    let low = head.iter().filter(|byte| is_control(**byte)).count();
    let wide = head.as_chunks::<2>().0;
    let is_utf16 =
        |at: usize| !wide.is_empty() && wide.iter().filter(|pair| pair[at] == 0).count() * 10 > wide.len() * 9;
    let marked = source.starts_with(&[0xFF, 0xFE]) || source.starts_with(&[0xFE, 0xFF]);
    if marked || is_utf16(0) || is_utf16(1) {
        return None;
    }
    (low * 50 > head.len()).then_some("binary data")
}

/// Control characters that no program has: tabs, line ends, form feeds, the tape's DC1 to DC4, EOT, SUB and NUL may be in one.
fn is_control(byte: u8) -> bool {
    byte < 0x20
        && !matches!(
            byte,
            b'\t' | b'\n' | b'\r' | 0x0B | 0x0C | 0x11..=0x14 | 0x04 | 0x1A | 0x1B
        )
}

/// What a text is, if hardly anything in it is a block: judged by its first lines.
pub(super) fn prose(text: &str, signs: u32) -> Option<&'static str> {
    if let Some(what) = by_beginning(text) {
        return Some(what);
    }
    let count = Count::of(text);
    // a text about programs contains words of programs
    if count.reads_like_prose() {
        return Some(PROSE);
    }
    if signs >= 10 || !count.has_few_blocks() {
        return None;
    }
    // a few lines of an unknown kind prove nothing
    (count.words >= 3 || count.blocks == 0).then_some(if count.has_braces() { DATA } else { PROSE })
}

/// What kind of text it is, if it is plainly no program although a dialect is declared. Lines that are just not blocks may be statements of that
/// dialect.
pub(super) fn plainly_none(text: &str) -> Option<&'static str> {
    let by_lines = || {
        let count = Count::of(text);
        if count.reads_like_prose() {
            Some(PROSE)
        } else {
            (count.words >= 3 && count.has_few_blocks() && count.has_braces()).then_some(DATA)
        }
    };
    by_beginning(text).or_else(by_lines)
}

const PROSE: &str = "text that is not a program";
const DATA: &str = "data or source code";

/// What a text is by its first characters.
fn by_beginning(text: &str) -> Option<&'static str> {
    let start = text.trim_start_matches(['\u{feff}', ' ', '\t', '\r', '\n']);
    let known = [
        ("<?XML", "an XML document"),
        ("<!DOCTYPE", "an HTML document"),
        ("<HTML", "an HTML document"),
        ("<SVG", "a picture (SVG)"),
        ("#!/", "a script"),
        ("#INCLUDE", "source code"),
        ("#IFNDEF", "source code"),
        ("#PRAGMA", "source code"),
        ("-----BEGIN", "a key or certificate"),
        ("SOLID ", "an STL model"),
        ("ISO-10303-21", "a STEP model"),
    ];
    known
        .into_iter()
        .find_map(|(begin, what)| start.starts_with(begin).then_some(what))
}

/// Lines of a text by their kind.
#[derive(Default)]
struct Count {
    /// Blocks and statements.
    blocks: u32,
    /// All others.
    words: u32,
    sentences: u32,
    /// Lines of data or source code.
    braces: u32,
}

impl Count {
    /// Counts the first lines.
    fn of(text: &str) -> Self {
        const LOOKED_AT: usize = 400;
        let mut count = Self::default();
        for line in lines(text).map(str::trim).take(LOOKED_AT) {
            let code = strip_comments(line);
            let code = code.trim();
            if code.is_empty() || line == "%" || line.starts_with("$$") || line.starts_with("/*") {
                continue;
            }
            if is_block(code) || is_statement(code) || is_klartext(line) || is_text_of_apt(code) {
                count.blocks += 1;
            } else {
                count.words += 1;
                count.sentences += u32::from(is_sentence(code));
                count.braces += u32::from(code.ends_with(['{', '}']) || code.starts_with(['{', '}', '<', '"']));
            }
        }
        count
    }
    fn reads_like_prose(&self) -> bool {
        self.sentences >= 3 && self.sentences > self.blocks + (self.words - self.sentences) / 2
    }
    fn has_few_blocks(&self) -> bool {
        self.words > 0 && self.blocks * 4 <= self.words
    }
    fn has_braces(&self) -> bool {
        self.braces * 3 > self.words
    }
}

/// Whether a line reads like prose: four plain words or more, and little else.
fn is_sentence(code: &str) -> bool {
    let (mut plain, mut all) = (0usize, 0usize);
    for token in code.split_whitespace() {
        all += 1;
        let token = token.trim_matches(|c: char| c.is_ascii_punctuation());
        plain += usize::from(token.len() >= 2 && token.chars().all(|c| c.is_alphabetic() || matches!(c, '\'' | '-')));
    }
    plain >= 4 && plain * 10 >= all * 6
}

/// Whether a line has a sign of Klartext.
fn is_klartext(line: &str) -> bool {
    let mut votes = Votes::default();
    klartext(line, &mut votes);
    votes.weight(&["heidenhain-klartext"]) > 0
}

/// Whether a line is one of an APT program that holds a text for people.
fn is_text_of_apt(code: &str) -> bool {
    let word = code.split(['/', ' ']).next().unwrap_or_default();
    ["PARTNO", "PPRINT", "REMARK", "TITLES"].contains(&word)
}

/// Whether a line is a statement of a macro: a variable is assigned, or a condition in brackets is tested.
fn is_statement(code: &str) -> bool {
    let mut chars = code.chars();
    let variable = chars.next() == Some('#') && matches!(chars.next(), Some('0'..='9' | '<' | '['));
    let word = code.starts_with(|c: char| c.is_ascii_uppercase())
        && code
            .chars()
            .nth(1)
            .is_some_and(|c| c.is_ascii_digit() || matches!(c, '#' | '[' | '-' | '+' | '.'))
        && !code.contains(". ");
    let decides = ["IF[", "IF [", "WHILE[", "WHILE [", "GOTO", "END1", "END2", "O<"]
        .iter()
        .any(|start| code.starts_with(start));
    variable || word || decides
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_that_are_no_text() {
        assert_eq!(binary(b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR"), Some("a PNG picture"));
        assert_eq!(binary(b"\x7FELF\x02\x01\x01"), Some("an ELF binary"));
        assert_eq!(binary(&[1, 2, 3, 5, 6, 7, 0, 9, 8]), Some("binary data"));
        for text in [
            &b"G0 X1\r\nM30\r\n"[..],
            b"\0\0\0%\nO1\nG0 X1\n%\0\0",
            b"\x12%\nG0\x14",
            b"",
            b"\0\0",
            "G0 X1 (Fr\u{e4}sen)\n".as_bytes(),
            b"\xFF\xFEG\x000\x00",
            b"G\x000\x00 \x00X\x001\x00",
        ] {
            assert_eq!(binary(text), None, "{text:?}");
        }
    }

    #[test]
    fn a_text_about_programs_is_none() {
        let text = "The program begins with TRAORI and needs G43.4 on other controls.\nAfter it the tip is led along the path.\n\
                    M428 does the same on the machines of that maker.\nWrite G0 before the first motion and nothing else.\n";
        assert_eq!(
            prose(&text.to_ascii_uppercase(), 30),
            Some("text that is not a program")
        );
        let program = "PROGRAM FOR THE SMALL PART OF JOB 12\nG21\nG0 X1\nG1 Z-1 F100\nM30\n";
        assert_eq!(prose(program, 0), None);
    }

    /// Klartext and texts in APT are made of words, and are no prose.
    #[test]
    fn programs_of_many_words() {
        let klartext = "0 BEGIN PGM DECKEL MM\n1 TOOL CALL 5 Z S1000 F500\n2 PLANE RESET TURN FMAX\n3 CYCL CALL PAT FMAX\n\
                        4 PLANE RESET TURN FMAX\n5 M30\n6 END PGM DECKEL MM\n";
        let apt = "PARTNO/DECKEL\nPPRINT THIS LINE IS WRITTEN BY THE SYSTEM\nPPRINT FOR ALL THAT READ IT\n\
                   PPRINT AND FOR THE MACHINE TOO\nUNITS/MM\nGOTO/0,0,100\nFINI\n";
        for text in [klartext, apt] {
            assert_eq!((prose(text, 0), plainly_none(text)), (None, None), "{text}");
        }
    }

    #[test]
    fn texts_that_are_no_programs() {
        let is = |text: &str| prose(&text.to_ascii_uppercase(), 0);
        assert_eq!(is("<?xml version=\"1.0\"?>\n<a/>\n"), Some("an XML document"));
        assert_eq!(is("#include <stdio.h>\nint main() {\n}\n"), Some("source code"));
        assert_eq!(
            is("Dear colleague,\nplease look at the program of last week.\nIt runs G1 too fast.\n"),
            Some("text that is not a program")
        );
        assert_eq!(is("{\n  \"a\": 1,\n  \"b\": [1, 2]\n}\n"), Some("data or source code"));
        for program in [
            "%\nO1000\nG0 X1\nM30\n",
            "#1=5\nWHILE[#1LT9]DO1\nEND1\n",
            "(only a comment)\n",
            "",
            "G0 X#1 Y[2+3]\nG1 Z-1\n",
            "T1 M6 (drill)\nX1\n",
        ] {
            assert_eq!(is(program), None, "{program}");
        }
    }
}
