//! Expressions of Okuma's user task.
//!
//! Square brackets group and hold the arguments of functions; blanks end names (NC-PB/gEdit, syntax-okuma.md, from the OSP-P200L and P300 manuals).
//! `* /` bind tighter than `+ -`, these tighter than EQ NE GT GE LT LE, and equal ones bind from left to right. What no source states has no value
//! that is known (NaN): AND, OR and EOR beside each other or beside a comparison without brackets between them, and of other numbers than 0 and 1;
//! MOD and FIX of negative numbers, ROUND of a half, FUP below zero, ATAN, ATAN2, DROUND, DFIX, DFUP, BIN, BCD; comparisons of numbers that differ by less
//! than one part in 1e9.
use crate::code::{Binary, Comparison, Formula};
use crate::infix::{Reader, Rules, operator_word, read};
use crate::{FormulaError, FormulaErrorKind as Kind};
use trunnion_syntax::TextRange;

mod operands;

/// Reads the expression that begins at the start of `range`, as far as it extends: the formula, and one past its last byte. Variables are
/// queried by name in lower case, with their index where they have one; elements of several dimensions and functions without a known value by
/// the name with `[`.
///
/// # Errors
/// The text is no expression.
pub fn osp(source: &[u8], range: TextRange) -> Result<(Formula, u32), FormulaError> {
    read::<Osp>(source, range)
}

/// The operators that bind weaker than sums inside one pair of brackets.
#[derive(Clone, Copy, Default, PartialEq)]
enum Weak {
    #[default]
    None,
    Comparison,
    Logical(Binary),
    /// Several whose order no source states.
    Several,
}

const COMPARES: u8 = 5;
const JOINS: u8 = 3;

#[derive(Default)]
struct Osp {
    /// Inside the innermost bracket.
    weak: Weak,
    /// Inside the brackets around it, the outermost first.
    around: Vec<Weak>,
}

impl Rules for Osp {
    const GROUP: [u8; 2] = *b"[]";

    /// Blanks, and the line end and `$` of a block that continues.
    fn blanks(reader: &mut Reader<'_, Self>) {
        while let Some(byte) = reader.peek() {
            let continues = byte == b'$' && matches!(reader.before(), Some(b'\n' | b'\r'));
            if !byte.is_ascii_whitespace() && !continues {
                return;
            }
            reader.skip(1);
        }
    }

    fn operand(reader: &mut Reader<'_, Self>, first: u8) -> Result<bool, Kind> {
        match first {
            b'#' => operands::hexadecimal(reader).map(|()| true),
            b'a'..=b'z' | b'A'..=b'Z' => operands::name(reader),
            _ => Err(Kind::MissingValue),
        }
    }

    fn number(reader: &mut Reader<'_, Self>) -> Result<(), Kind> {
        operands::number(reader)
    }

    fn binary(reader: &Reader<'_, Self>) -> Option<(Binary, u8, usize)> {
        match reader.peek()? {
            b'+' => return Some((Binary::Add, 9, 1)),
            b'-' => return Some((Binary::Subtract, 9, 1)),
            b'*' => return Some((Binary::Multiply, 10, 1)),
            b'/' => return Some((Binary::Divide, 10, 1)),
            _ => {}
        }
        operator_word(operands::word(reader.rest()), &WORDS)
    }

    fn open(&mut self) {
        self.around.push(std::mem::take(&mut self.weak));
    }

    fn close(&mut self) {
        self.weak = self.around.pop().unwrap_or_default();
    }

    fn joined(&mut self, binary: Binary, rank: u8) {
        let new = match rank {
            COMPARES => Weak::Comparison,
            JOINS => Weak::Logical(binary),
            _ => return,
        };
        self.weak = match (self.weak, new) {
            (Weak::None, new) => new,
            (Weak::Logical(old), Weak::Logical(new)) if old == new => self.weak,
            _ => Weak::Several,
        };
    }

    fn settled(&self) -> bool {
        self.weak != Weak::Several
    }
}

const WORDS: [(&[u8], Binary, u8); 9] = [
    (b"EQ", Binary::Compared(Comparison::Equal), COMPARES),
    (b"NE", Binary::Compared(Comparison::NotEqual), COMPARES),
    (b"GT", Binary::Compared(Comparison::Greater), COMPARES),
    (b"GE", Binary::Compared(Comparison::GreaterOrEqual), COMPARES),
    (b"LT", Binary::Compared(Comparison::Less), COMPARES),
    (b"LE", Binary::Compared(Comparison::LessOrEqual), COMPARES),
    (b"AND", Binary::TruthAnd, JOINS),
    (b"OR", Binary::TruthOr, JOINS),
    (b"EOR", Binary::TruthXor, JOINS),
];

#[cfg(test)]
mod tests;
