//! The texts of INI files, tool tables and parameter files.
use std::fmt::Write;

use super::{Ini, Parameters, ToolEntry, ToolTable};

/// A line of a setup file without meaning.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct BadLine {
    /// From 1.
    pub line: usize,
    /// What is wrong.
    pub message: String,
}

/// Lines without a byte order mark and line ends.
fn lines(bytes: &[u8]) -> impl Iterator<Item = (usize, String)> {
    let text = String::from_utf8_lossy(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)).into_owned();
    let lines: Vec<String> = text.lines().map(str::to_owned).collect();
    lines.into_iter().enumerate().map(|(place, line)| (place + 1, line))
}

impl Ini {
    /// Reads `[SECTION]` and `KEY = value`; `#` and `;` begin a comment at the start of a line. The first of equal keys is used.
    pub fn parse(bytes: &[u8]) -> Self {
        let mut values = std::collections::BTreeMap::new();
        let mut section = String::new();
        for (_, line) in lines(bytes) {
            let line = line.trim();
            if line.is_empty() || line.starts_with(['#', ';']) {
                continue;
            }
            if let Some(rest) = line.strip_prefix('[') {
                rest.split(']').next().unwrap_or("").trim().clone_into(&mut section);
            } else if let Some((key, value)) = line.split_once('=') {
                values
                    .entry((section.clone(), key.trim().to_owned()))
                    .or_insert_with(|| value.trim().to_owned());
            }
        }
        Self { values }
    }
}

impl ToolTable {
    /// Reads lines of words: T number, P pocket, X Y Z A B C U V W offsets, D diameter, I and J angles, Q orientation; `;` begins a
    /// comment. Lines that are not rows are reported with the rows. Each P takes a row, including a second P of one line and those of a line
    /// that is not a row (as in `rs274`): tools after it move down. A row without P is that of the spindle at the start of a run, and takes no other;
    /// a tool that is there and in a later row has the later values in both (observed).
    pub fn parse(bytes: &[u8]) -> (Self, Vec<BadLine>) {
        let mut rows = Vec::new();
        let mut spindle: Option<ToolEntry> = None;
        let mut bad = Vec::new();
        for (line, text) in lines(bytes) {
            let words = text.split(';').next().unwrap_or("").trim();
            if words.is_empty() {
                continue;
            }
            let pockets = pockets(words);
            match row(words) {
                Ok(entry) if pockets == 0 => spindle = Some(ToolEntry { pocket: -1, ..entry }),
                Ok(entry) => {
                    if let Some(spindle) = spindle.as_mut().filter(|there| there.number == entry.number) {
                        *spindle = entry;
                    }
                    rows.extend((1..pockets).map(|_| ToolEntry::NOBODY));
                    rows.push(entry);
                }
                Err(message) => {
                    rows.extend((0..pockets).map(|_| ToolEntry::NOBODY));
                    bad.push(BadLine { line, message });
                }
            }
        }
        (Self { rows, spindle }, bad)
    }
    /// The table `rs274` takes when none is given.
    pub fn sample() -> Self {
        let row = |number, pocket, z, diameter| ToolEntry {
            number,
            pocket,
            offset: [0.0, 0.0, z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            diameter,
            ..ToolEntry::default()
        };
        Self {
            rows: vec![
                row(1, 1, 0.511, 0.125),
                row(2, 2, 0.1, 0.0625),
                row(3, 3, 1.273, 0.201),
                row(99_999, 123, 0.1, 0.0),
            ],
            spindle: None,
        }
    }
}

/// How many P words with a number a line has, regardless of its other contents.
fn pockets(words: &str) -> usize {
    let is_pocket = |word: &&str| {
        let number = word
            .strip_prefix(['P', 'p'])
            .map(|text| text.strip_prefix(['+', '-']).unwrap_or(text));
        number.is_some_and(|number| number.starts_with(|sign: char| sign.is_ascii_digit()))
    };
    words.split_whitespace().filter(is_pocket).count()
}

/// One row of a tool table.
fn row(words: &str) -> Result<ToolEntry, String> {
    let mut entry = ToolEntry::default();
    let mut numbered = false;
    for word in words.split_whitespace() {
        let letter = word.as_bytes()[0].to_ascii_uppercase();
        let number = word.get(1..).unwrap_or("");
        let value: f64 = number
            .parse()
            .map_err(|_| format!("`{word}` is not a word: expected a letter and a number"))?;
        match letter {
            b'T' => {
                entry.number = value as i32;
                numbered = true;
            }
            b'P' => entry.pocket = value as i32,
            b'D' => entry.diameter = value,
            b'I' => entry.front_angle = value,
            b'J' => entry.back_angle = value,
            b'Q' => entry.orientation = value as i32,
            _ => match b"XYZABCUVW".iter().position(|&axis| axis == letter) {
                Some(axis) => entry.offset[axis] = value,
                None => return Err(format!("`{word}`: a tool table has no column with this letter")),
            },
        }
    }
    if numbered {
        Ok(entry)
    } else {
        Err("a row of a tool table needs T".to_owned())
    }
}

impl Parameters {
    /// Reads lines of a number and a value, ascending.
    ///
    /// # Errors
    /// The first invalid line, or one whose number is out of order or range.
    pub fn parse(bytes: &[u8]) -> Result<Self, BadLine> {
        let mut values: Vec<(u32, f64)> = Vec::new();
        for (line, text) in lines(bytes) {
            if text.trim().is_empty() {
                continue;
            }
            let bad = |message: &str| BadLine {
                line,
                message: message.to_owned(),
            };
            let mut words = text.split_whitespace();
            let index = words.next().and_then(|word| word.parse::<u32>().ok());
            let value = words.next().and_then(|word| word.parse::<f64>().ok());
            // rs274 skips lines that are not pairs
            let (Some(index), Some(value)) = (index, value) else {
                continue;
            };
            if !(1..=LAST).contains(&index) {
                return Err(bad("Parameter number out of range"));
            }
            if values.last().is_some_and(|&(last, _)| last >= index) {
                return Err(bad("Parameter file out of order"));
            }
            values.push((index, value));
        }
        Ok(Self {
            values,
            globals: Vec::new(),
        })
    }
    /// The text of a parameter file.
    pub fn text(&self) -> String {
        self.text_with(0)
    }
    /// The same with more decimals than the six that the control writes.
    pub fn text_with(&self, more: usize) -> String {
        self.values.iter().fold(String::new(), |mut text, (index, value)| {
            // writing to a string does not fail
            let _ = writeln!(text, "{index}\t{value:.*}", 6 + more);
            text
        })
    }
}

/// Highest number that a parameter file may hold.
const LAST: u32 = 5602;
