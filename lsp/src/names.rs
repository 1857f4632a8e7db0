//! The value of a variable and the target of an O-word, for the hover.
use std::fmt::Write;
use trunnion_check::BlockInfo;
use trunnion_syntax::{Block, Program, TextRange};

/// Lines of one O-word that are shown.
const SHOWN: usize = 8;

/// The hover text for the variable or O-word at byte `at` of a block, and its bytes.
pub(crate) fn at(program: &Program, block: &Block<'_>, at: u32, info: &BlockInfo) -> Option<(String, TextRange)> {
    variable(program, block, at, info).or_else(|| o_word(program, block, at))
}

/// `#1` or `#<name>` at the cursor with its value.
fn variable(program: &Program, block: &Block<'_>, at: u32, info: &BlockInfo) -> Option<(String, TextRange)> {
    let range = block.range();
    let bytes = program.bytes(range);
    let starts = (0..bytes.len()).filter(|&start| bytes[start] == b'#');
    let mut spans = starts.filter_map(|start| Some((start, start + 1 + length(&bytes[start + 1..])?)));
    let cursor = at.checked_sub(range.start)? as usize;
    let (start, end) = spans.find(|(start, end)| (*start..=*end).contains(&cursor))?;
    let word = TextRange::new(range.start + start as u32, range.start + end as u32);
    let name = program.text(word).into_owned();
    let [before, after] = info.variables.value(&name);
    let mut text = format!("**{name}** {} before this block", worth(before));
    if worth(before) != worth(after) {
        let _ = write!(text, ", {} after it", worth(after));
    }
    Some((text, word))
}

/// How many bytes after `#` belong to the variable; `None` where its number is computed.
fn length(behind: &[u8]) -> Option<usize> {
    let count = |is: fn(&u8) -> bool| behind.iter().take_while(|byte| is(byte)).count();
    match behind.first()? {
        b'<' => behind.iter().position(|byte| *byte == b'>').map(|end| end + 1),
        b'_' => Some(count(|byte| byte.is_ascii_alphanumeric() || *byte == b'_')),
        b'0'..=b'9' => Some(count(u8::is_ascii_digit)),
        _ => None,
    }
}

fn worth(value: Option<f64>) -> String {
    match value {
        None => "has no value".to_owned(),
        Some(value) if value.is_nan() => "has an unknown value".to_owned(),
        Some(value) => {
            let digits = format!("{value:.6}");
            let digits = digits.trim_end_matches('0').trim_end_matches('.');
            format!("= {}", if digits == "-0" { "0" } else { digits })
        }
    }
}

/// The O-word at the beginning of a block: its name in lower case without blanks, its bytes, and the keyword after it.
fn label(program: &Program, block: &Block<'_>) -> Option<(String, TextRange, String)> {
    let range = block.range();
    let text = program.bytes(range);
    let from = text.iter().position(|byte| !byte.is_ascii_whitespace())?;
    if !text[from].eq_ignore_ascii_case(&b'o') {
        return None;
    }
    let behind = &text[from + 1..];
    let length = match behind.first()? {
        b'<' => behind.iter().position(|byte| *byte == b'>')? + 1,
        b'0'..=b'9' => behind.iter().take_while(|byte| byte.is_ascii_digit()).count(),
        _ => return None,
    };
    let end = from + 1 + length;
    let keyword = text[end..].trim_ascii_start();
    let letters = keyword.iter().take_while(|byte| byte.is_ascii_alphabetic()).count();
    let name: String = String::from_utf8_lossy(&text[from..end])
        .split_whitespace()
        .collect::<String>()
        .to_ascii_lowercase();
    let keyword = String::from_utf8_lossy(&keyword[..letters]).to_ascii_lowercase();
    let word = TextRange::new(range.start + from as u32, range.start + end as u32);
    (!keyword.is_empty()).then_some((name, word, keyword))
}

/// The O-word at the cursor with the lines that contain it.
fn o_word(program: &Program, block: &Block<'_>, at: u32) -> Option<(String, TextRange)> {
    let (name, word, _) = label(program, block).filter(|(_, word, _)| word.touches(at))?;
    let mut lines = Vec::new();
    for (index, other) in program.blocks().enumerate() {
        if let Some((_, _, keyword)) = label(program, &other).filter(|(known, ..)| *known == name) {
            lines.push((index + 1, keyword));
        }
    }
    let written = program.text(word);
    let mut text = match lines.iter().find(|(_, keyword)| keyword == "sub") {
        Some((line, _)) => format!("**{written}** subprogram, starts on line {line}"),
        None if lines.iter().any(|(_, keyword)| keyword == "call") => {
            format!("**{written}** is not defined in this file")
        }
        None => format!("**{written}**"),
    };
    for (line, keyword) in lines.iter().take(SHOWN) {
        let _ = write!(text, "\n* line {line}: {keyword}");
    }
    if lines.len() > SHOWN {
        let _ = write!(text, "\n* and {} more", lines.len() - SHOWN);
    }
    Some((text, word))
}
