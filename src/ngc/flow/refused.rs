//! The words of a refused line: the control would have stopped there, so their effect is unknown.
use super::{Compiled, Kind};
use crate::Block;

/// See the module.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Refused {
    /// Axes with words, bit i for axis i of X Y Z A B C U V W. Polar words move X and Y.
    pub axes: u16,
    /// M3, M4 or M5, or an M code whose number is unknown.
    pub spindle: bool,
}

impl Refused {
    /// Takes in a word: its letter in upper case and its value where that is known.
    fn word(&mut self, letter: u8, value: Option<f64>) {
        match letter {
            b'@' | b'^' => self.axes |= 0b11,
            b'M' => self.spindle |= value.is_none_or(|value| (3.0..=5.0).contains(&value)),
            _ => {
                let axis = b"XYZABCUVW".iter().position(|axis| *axis == letter);
                self.axes |= axis.map_or(0, |axis| 1 << axis);
            }
        }
    }

    /// Of a line that was read into a block at once.
    pub(super) fn of_block(block: &Block) -> Self {
        let mut refused = Self::default();
        for letter in b"XYZABCUVW".iter().filter(|letter| block.has(**letter)) {
            refused.word(*letter, None);
        }
        refused.spindle = (3..=5).contains(&block.m[7]);
        refused
    }

    /// Of a line in its read form, whose text (up to a NUL) is `text`. Where something is wrong with the text, words are not distinguished
    /// from the rest, so each letter outside comments is taken as one.
    pub(super) fn of_line(compiled: &Compiled, text: &[u8]) -> Self {
        let mut refused = Self::default();
        if matches!(compiled.kind, Kind::Label | Kind::Percent) {
            return refused;
        }
        if compiled.kind != Kind::Blank && compiled.flaw.is_none() && compiled.line.errors.is_empty() {
            for word in &compiled.line.words {
                refused.word(word.letter, word.value.number());
            }
            return refused;
        }
        let mut comment = false;
        for byte in text {
            match byte {
                b';' if !comment => break,
                b'(' => comment = true,
                b')' => comment = false,
                letter if !comment => refused.word(letter.to_ascii_uppercase(), None),
                _ => {}
            }
        }
        refused
    }
}
