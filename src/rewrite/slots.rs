//! The coordinate numbers of a block: where they are written, and edits that give them new values.
use crate::style::NumberStyle;
use std::borrow::Cow;
use trunnion_syntax::{Address, AptArg, Block, Program, TextEdit, TextRange, Value};

/// Which numbers of a block a rewrite handles: X, Y, Z, and then two rotary words or three components of the tool vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Scheme {
    /// ISO words X, Y, Z and these rotary letters; 0 for one that the machine lacks.
    Rotaries([u8; 2]),
    /// ISO words X, Y, Z and A3= B3= C3=.
    IndexedVector,
    /// ISO words X, Y, Z and I, J, K.
    LetterVector,
    /// The six numbers of APT GOTO.
    Goto,
}

/// One coordinate as written.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Slot<'p> {
    /// Bytes of the number.
    pub number: TextRange,
    /// Bytes of the whole word.
    pub word: TextRange,
    /// The number's text.
    pub text: Cow<'p, str>,
    /// Its value.
    pub value: f64,
}

/// Coordinates of a block, in the order of the scheme (at most six).
pub(crate) type Slots<'p> = [Option<Slot<'p>>; 6];

impl Scheme {
    /// The scheme of a block whose tool axis is programmed as a vector.
    pub(crate) fn of_vector(program: &Program, block: &Block<'_>) -> Self {
        if !program.options().format.has_words() {
            return Self::Goto;
        }
        let indexed = block
            .words()
            .any(|word| matches!(word.address, Address::Indexed(b'A' | b'B' | b'C', 3)));
        if indexed {
            Self::IndexedVector
        } else {
            Self::LetterVector
        }
    }

    /// Position of a word's address in the scheme.
    fn index(self, address: Address) -> Option<usize> {
        let vector = match (self, address) {
            (_, Address::Letter(letter @ b'X'..=b'Z')) => return Some(usize::from(letter - b'X')),
            (Self::Rotaries(rotaries), Address::Letter(letter)) => {
                return rotaries.iter().position(|&rotary| rotary == letter).map(|at| 3 + at);
            }
            (Self::IndexedVector, Address::Indexed(letter, 3)) => letter.checked_sub(b'A'),
            (Self::LetterVector, Address::Letter(letter)) => letter.checked_sub(b'I'),
            _ => None,
        };
        vector.filter(|&i| i < 3).map(|i| 3 + usize::from(i))
    }

    /// The axis letter of a coordinate; `None` for components of a vector.
    pub(crate) fn letter(self, index: usize) -> Option<u8> {
        match (self, index) {
            (Self::Goto, _) => None,
            (_, 0..=2) => Some(b"XYZ"[index]),
            (Self::Rotaries(letters), 3..=4) => Some(letters[index - 3]),
            _ => None,
        }
    }

    /// The word's name, for messages.
    pub(crate) fn name(self, index: usize) -> String {
        match (self, index) {
            (_, 0..=2) => char::from(b"XYZ"[index]).to_string(),
            (Self::Rotaries(letters), _) => char::from(letters[(index - 3).min(1)]).to_string(),
            (Self::IndexedVector, _) => format!("{}3", char::from(b"ABC"[(index - 3).min(2)])),
            _ => char::from(b"IJK"[(index - 3).min(2)]).to_string(),
        }
    }
}

/// The coordinates of a block. `Err`: one is not a plain number, or is given twice.
pub(crate) fn slots<'p>(program: &'p Program, block: &Block<'_>, scheme: Scheme) -> Result<Slots<'p>, String> {
    let mut slots = Slots::default();
    if scheme == Scheme::Goto {
        let Some(record) = block.record().filter(|record| record.is("GOTO")) else {
            return Err("the motion is not a GOTO record".into());
        };
        for (i, arg) in record.args().enumerate().take(6) {
            let AptArg::Number(value, range) = arg else {
                return Err("GOTO has an argument that is not a number".into());
            };
            slots[i] = Some(Slot {
                number: range,
                word: range,
                text: program.text(range),
                value: value.to_f64(),
            });
        }
        return Ok(slots);
    }
    for word in block.words() {
        let Some(i) = scheme.index(word.address) else { continue };
        let Value::Number(value) = word.value else {
            return Err(format!(
                "{} is not a plain number but {}",
                scheme.name(i),
                program.text(word.range)
            ));
        };
        let slot = Slot {
            number: word.value_range,
            word: word.range,
            text: program.text(word.value_range),
            value: value.to_f64(),
        };
        if slots[i].replace(slot).is_some() {
            return Err(format!("{} is written twice", scheme.name(i)));
        }
    }
    Ok(slots)
}

/// How a program writes each coordinate of a scheme.
pub(crate) type Styles = [Option<NumberStyle>; 6];

/// Learns how the program writes each coordinate of a scheme.
pub(crate) fn styles(program: &Program, scheme: Scheme) -> Styles {
    let mut texts: [Vec<TextRange>; 6] = Default::default();
    for block in program.blocks() {
        if scheme == Scheme::Goto {
            let Some(record) = block.record().filter(|record| record.is("GOTO")) else {
                continue;
            };
            for (i, arg) in record.args().enumerate().take(6) {
                if let AptArg::Number(_, range) = arg {
                    texts[i].push(range);
                }
            }
        } else {
            for word in block.words() {
                if let (Some(i), Value::Number(_)) = (scheme.index(word.address), word.value) {
                    texts[i].push(word.value_range);
                }
            }
        }
    }
    texts.map(|ranges| {
        let texts = ranges
            .into_iter()
            .map(|range| core::str::from_utf8(&program.source()[range.as_usize()]).unwrap_or(""));
        NumberStyle::learn(texts)
    })
}

/// An edit that inserts the word of an axis (letter, and its number as text) into an ISO block, in the order X Y Z A B C among the
/// axis words that are there. `None` if there is none.
pub(crate) fn insert_word(program: &Program, block: &Block<'_>, letter: u8, number: &str) -> Option<TextEdit> {
    let order = |letter: u8| b"XYZABC".iter().position(|&axis| axis == letter);
    let mine = order(letter)?;
    let (mut before, mut after) = (None, None);
    for word in block.words() {
        let Address::Letter(other) = word.address else { continue };
        match order(other) {
            Some(place) if place < mine => before = Some(word.range),
            Some(_) if after.is_none() => after = Some(word.range),
            _ => {}
        }
    }
    let name = char::from(letter);
    let (at, new_text) = match (before, after) {
        (Some(range), _) => (
            range.end,
            format!("{}{name}{number}", blank_before(program, range.start)),
        ),
        (None, Some(range)) => (
            range.start,
            format!("{name}{number}{}", blank_before(program, range.start)),
        ),
        (None, None) => return None,
    };
    Some(TextEdit {
        range: TextRange::new(at, at),
        new_text,
    })
}

/// One blank where the word at `start` has one before it; at the start of a line, where axis words of the program have one.
fn blank_before(program: &Program, start: u32) -> &'static str {
    let source = program.source();
    let before = (start as usize).checked_sub(1).and_then(|at| source.get(at));
    let separated = || {
        source
            .windows(2)
            .any(|pair| pair[0] == b' ' && b"XYZABC".contains(&pair[1]))
    };
    match before {
        Some(b' ' | b'\t') => " ",
        None | Some(b'\n' | b'\r') if separated() => " ",
        _ => "",
    }
}

/// Numbers with at least the digits that every control has: 0.001 mm or 0.0001 in, and 0.001 deg. Tool vectors as they are.
pub(crate) fn finer(styles: Styles, scheme: Scheme, unit_mm: f64) -> Styles {
    let mut styles = styles;
    let lengths = if unit_mm > 1.0 { 4 } else { 3 };
    for (index, style) in styles.iter_mut().enumerate() {
        let least = match (index, scheme) {
            (0..=2, _) => lengths,
            (_, Scheme::Rotaries(_)) => 3,
            _ => 0,
        };
        *style = style.map(|style| style.with_decimals(least));
    }
    styles
}
