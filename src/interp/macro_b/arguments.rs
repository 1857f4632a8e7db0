//! The words of a call: program, repetitions, and the arguments of G65 and G66 as local variables.
//!
//! Letters are variables (specification I); more than one I, J or K makes triples of #4 to #33 (specification II). Where both name a
//! variable, the later word wins (B-63684EN/01, p. 278).
use super::evaluate::Form;
use super::read::Macros;
use super::variables::{Held, Locals};
use crate::FaultKind;
use trunnion_dialect::Dialect;
use trunnion_syntax::{Address, Block, Item, TextRange, Value};

/// Specification I: the variable of each letter from A; 0 where there is none.
const VARIABLES: [u8; 26] = [
    1, 2, 3, 7, 8, 9, 0, 11, 4, 5, 6, 0, 13, 0, 0, 0, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26,
];

/// Letters whose number has no unit: a missing decimal point changes nothing.
const WHOLE: &[u8] = b"DHMSTPL";

/// The words of a call.
pub(crate) struct CallWords {
    /// P, as it is written.
    pub(crate) program: Option<Held>,
    /// L.
    pub(crate) times: Option<Held>,
    pub(crate) arguments: Box<Locals>,
    /// Why P or L is not known.
    pub(crate) unknown: Option<(TextRange, String)>,
}

/// Which I, J, K of specification II is meant.
#[derive(Default)]
struct Triples {
    set: u32,
    last: u8,
}

impl Triples {
    /// The variable of the next I, J or K; `None` after the tenth triple.
    fn next(&mut self, letter: u8) -> Option<u8> {
        if self.last != 0 && letter <= self.last {
            self.set = self.set.saturating_add(1);
        }
        self.last = letter;
        let variable = 4 + 3 * u64::from(self.set) + u64::from(letter - b'I');
        u8::try_from(variable).ok().filter(|variable| *variable <= 33)
    }
}

/// Reads the words after G65 or G66 at `code`.
pub(crate) fn read(
    macros: &mut Macros<'_>,
    dialect: &Dialect,
    block: &Block<'_>,
    code: TextRange,
    report: &mut dyn FnMut(TextRange, FaultKind),
) -> CallWords {
    let mut words = CallWords {
        program: None,
        times: None,
        arguments: Box::new([None; 33]),
        unknown: None,
    };
    let mut triples = Triples::default();
    for item in block.items() {
        let Item::Word(word) = item else { continue };
        let (Address::Letter(letter), true) = (word.address, word.range.start >= code.end) else {
            continue;
        };
        let (held, reason) = match word.value {
            Value::Number(decimal) => {
                let sized = !decimal.has_point && decimal.mantissa != 0 && !WHOLE.contains(&letter);
                if sized && dialect.quirks.whole_numbers.lengths_ambiguous() {
                    report(word.range, FaultKind::AmbiguousDecimal);
                }
                (Some(decimal.to_f64()), None)
            }
            Value::Expression(range) => macros
                .value(dialect, block.program(), range, Form::Value)
                .unwrap_or_else(|(range, kind)| {
                    report(range, kind);
                    (Some(f64::NAN), Some("an expression without a value".to_owned()))
                }),
            // reported as an error of the text
            _ => (Some(f64::NAN), None),
        };
        if let (Some(reason), b'P' | b'L') = (reason, letter) {
            words.unknown = Some((word.range, reason));
        }
        let variable = match letter {
            b'P' => {
                words.program = Some(held);
                continue;
            }
            b'L' => {
                words.times = Some(held);
                continue;
            }
            b'I'..=b'K' => triples.next(letter),
            b'A'..=b'Z' => Some(VARIABLES[usize::from(letter - b'A')]).filter(|&variable| variable != 0),
            _ => None,
        };
        match variable {
            Some(variable) => words.arguments[usize::from(variable) - 1] = held,
            None => report(word.range, FaultKind::UnknownWord),
        }
    }
    words
}

#[cfg(test)]
mod tests {
    use super::Triples;

    #[test]
    fn triples_begin_anew_when_the_letters_do() {
        let mut triples = Triples::default();
        let got: Vec<_> = b"IJKIKIJ".iter().map(|&letter| triples.next(letter)).collect();
        assert_eq!(got, [4, 5, 6, 7, 9, 10, 11].map(Some));
        let mut triples = Triples::default();
        let got: Vec<_> = b"KKKKKKKKKKK".iter().map(|&letter| triples.next(letter)).collect();
        assert_eq!((got[9], got[10]), (Some(33), None));
    }
}
