//! Expressions of a Sinumerik 840D sl. Other than in RS274/NGC and Macro B blanks end names, round brackets group, and an expression needs
//! no brackets around it.
//!
//! Priority (Sinumerik 840D sl Programming Manual, Job Planning, arithmetic operations: priority of the operations), highest first, equal
//! ones from left to right: NOT, B_NOT; `* / DIV MOD`; `+ -`; B_AND; B_XOR; B_OR; AND; XOR; OR; `<<`; `== <> > < >= <=`. So
//! `R1>5 AND R2<3` compares R1 with `5 AND R2` and the outcome with 3.
//!
//! What is not documented has no value that is known (NaN): comparisons of numbers that differ by less than one part in 1e9 (the control
//! compares REAL with a relative tolerance), TRUNC that near to a whole number, ROUNDUP of a negative fraction, DIV, MOD and bits of
//! fractions, BOUND with its limits exchanged. ROUND of a negative half is away from zero in nc-gcode-interpreter (CEAD).
use crate::code::{Binary, Comparison, Formula};
use crate::infix::{Reader, Rules, operator_word, read};
use crate::{FormulaError, FormulaErrorKind as Kind};
use trunnion_syntax::TextRange;

mod operands;
mod values;

pub(crate) use values::{binary, bound, unary};

/// Reads the expression that begins at the start of `range`, as far as it extends: the formula, and one past its last byte. Variables are
/// queried by number (`R5`) or by name in lower case; elements of fields of one dimension by name and index, others by the name with `[`, unknown
/// functions with `(`, texts as `"`.
///
/// # Errors
/// The text is no expression.
pub fn sinumerik(source: &[u8], range: TextRange) -> Result<(Formula, u32), FormulaError> {
    read::<Sinumerik>(source, range)
}

#[derive(Default)]
struct Sinumerik;

impl Rules for Sinumerik {
    const GROUP: [u8; 2] = *b"()";

    fn blanks(reader: &mut Reader<'_, Self>) {
        let blank = |byte: &&u8| matches!(byte, b' ' | b'\t' | b'\r' | b'&');
        reader.skip(reader.rest().iter().take_while(blank).count());
    }

    fn operand(reader: &mut Reader<'_, Self>, first: u8) -> Result<bool, Kind> {
        match first {
            b'\'' => operands::coded(reader).map(|()| true),
            b'"' => {
                let inside = reader.rest()[1..].iter().position(|&byte| byte == b'"');
                reader.take(inside.ok_or(Kind::MissingValue)? + 2);
                reader.named("\"");
                Ok(true)
            }
            b'$' | b'_' | b'a'..=b'z' | b'A'..=b'Z' => operands::name(reader),
            _ => Err(Kind::MissingValue),
        }
    }

    fn number(reader: &mut Reader<'_, Self>) -> Result<(), Kind> {
        operands::number(reader)
    }

    fn binary(reader: &Reader<'_, Self>) -> Option<(Binary, u8, usize)> {
        let rest = reader.rest();
        let sign = |binary, rank| Some((binary, rank, 1));
        let compared = |comparison, length| Some((Binary::Compared(comparison), 1, length));
        match (rest.first()?, rest.get(1)) {
            (b'+', _) => return sign(Binary::Add, 9),
            (b'-', _) => return sign(Binary::Subtract, 9),
            (b'*', _) => return sign(Binary::Multiply, 10),
            (b'/', _) => return sign(Binary::Divide, 10),
            (b'=', Some(b'=')) => return compared(Comparison::Equal, 2),
            (b'<', Some(b'>')) => return compared(Comparison::NotEqual, 2),
            (b'<', Some(b'=')) => return compared(Comparison::LessOrEqual, 2),
            (b'<', Some(b'<')) => return Some((Binary::Join, 2, 2)),
            (b'<', _) => return compared(Comparison::Less, 1),
            (b'>', Some(b'=')) => return compared(Comparison::GreaterOrEqual, 2),
            (b'>', _) => return compared(Comparison::Greater, 1),
            _ => {}
        }
        operator_word(operands::word(rest), &WORDS)
    }
}

const WORDS: [(&[u8], Binary, u8); 8] = [
    (b"DIV", Binary::WholeDivide, 10),
    (b"MOD", Binary::WholeRemainder, 10),
    (b"B_AND", Binary::WholeAnd, 8),
    (b"B_XOR", Binary::WholeXor, 7),
    (b"B_OR", Binary::WholeOr, 6),
    (b"AND", Binary::LogicalAnd, 5),
    (b"XOR", Binary::LogicalXor, 4),
    (b"OR", Binary::LogicalOr, 3),
];

#[cfg(test)]
mod tests;
