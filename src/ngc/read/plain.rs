//! The most frequent line, words with plain numbers, read directly into a block without a parsed form.
//!
//! It accepts only lines that the line reader and [`super::evaluate`] would read in the same way without an error; all others it leaves
//! to them (a test compares both).
use super::evaluate::put;
use crate::Block;
use crate::parameters::Values;
use trunnion_syntax::TextRange;

/// Powers of ten that a double holds exactly.
const POWERS: [f64; 19] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18,
];
/// Up to this whole number every one is a double.
const EXACT: u64 = 1 << 53;
/// Letters that begin a word of a value: all but N and O.
const LETTERS: u32 = 0x03ff_ffff & !bit(b'N') & !bit(b'O');
/// Letters of words that take any value: the axes.
const ANY_VALUE: u32 = crate::block::AXES;
/// Letters that may occur twice in a line: they name codes.
const CODES: u32 = bit(b'G') | bit(b'M');
/// The modal group of motion codes.
const MOTION: usize = 1;
/// A line with more bytes is not plain.
const LONGEST: usize = 250;

const fn bit(letter: u8) -> u32 {
    1 << (letter - b'A')
}

/// Reads the line that begins at byte `start` into `block`; one past its line end. `None` if it is not plain: then the contents of the
/// block are undefined.
#[inline(never)]
pub(crate) fn plain(source: &[u8], start: u32, values: &Values<'_>, block: &mut Block) -> Option<u32> {
    let from = start as usize;
    let text = &source[from..source.len().min(from + LONGEST)];
    // an O line and a blank in front are not plain: no letter that begins a word
    block.clear(TextRange::new(start, start));
    let mut open = LETTERS & !values.missing_axes();
    let (mut at, mut stop) = (0, 0);
    if matches!(text.first(), Some(b'N' | b'n')) {
        (block.number, at) = sequence_number(text)?;
    }
    if let Some(&[b'G', code @ (b'0' | b'1'), b' ']) = text.get(at..)?.first_chunk() {
        // how most lines begin
        stop = at + 2;
        let range = TextRange::new(start + at as u32, start + stop as u32);
        block.put_g(MOTION, i16::from(code - b'0') * 10, range);
        at = stop;
    }
    let mut next = if stop == 0 {
        *text.get(at)?
    } else {
        behind_blanks(text, &mut at)?
    };
    loop {
        let letter = next & !0x20;
        let place = letter.wrapping_sub(b'A');
        if place >= 26 || open >> place & 1 == 0 {
            break;
        }
        let (value, end) = number(text, at + 1)?;
        let range = TextRange::new(start + at as u32, start + end as u32);
        if ANY_VALUE >> place & 1 != 0 {
            block.put(letter, value, range);
        } else if letter == b'M' && value >= 98.0 {
            // calls and returns
            return None;
        } else if letter == b'G' && block.g[MOTION] < 0 && (value == 0.0 || value == 1.0) {
            block.put_g(MOTION, if value == 0.0 { 0 } else { 10 }, range);
        } else {
            put(letter, value, range, values, block).ok()?;
        }
        open &= !(1 << place) | CODES;
        (at, stop) = (end, end);
        // what continues after blanks must be a word: a digit or a point there belongs to the number before them
        next = behind_blanks(text, &mut at)?;
    }
    at += usize::from(text[at] == b'\r');
    if stop == 0 || *text.get(at)? != b'\n' {
        return None;
    }
    block.range = TextRange::new(start, start + stop as u32);
    Some(start + at as u32 + 1)
}

/// The byte after the blanks at `at`, which moves there.
#[inline]
fn behind_blanks(text: &[u8], at: &mut usize) -> Option<u8> {
    let mut next = *text.get(*at)?;
    while next == b' ' {
        *at += 1;
        next = *text.get(*at)?;
    }
    Some(next)
}

/// N at the line's start and the blanks after its number: digits, perhaps with one point between them.
fn sequence_number(text: &[u8]) -> Option<(Option<f64>, usize)> {
    text.get(1).filter(|byte| byte.is_ascii_digit())?;
    let (mantissa, places, mut end) = digits(text, 1)?;
    let value = quotient(mantissa, places);
    if text[end - 1] == b'.' {
        return None;
    }
    while *text.get(end)? == b' ' {
        end += 1;
    }
    Some((Some(value), end))
}

/// Sign, digits and point at `at`, and what follows them.
#[inline]
fn number(text: &[u8], at: usize) -> Option<(f64, usize)> {
    let sign = *text.get(at)?;
    let first = at + usize::from(sign == b'-' || sign == b'+');
    let (mantissa, places, end) = digits(text, first)?;
    let value = quotient(mantissa, places);
    Some((if sign == b'-' { -value } else { value }, end))
}

/// A number by its digits and how many of them are after the point.
#[inline]
fn quotient(mantissa: u64, places: usize) -> f64 {
    // both operands are exact, so the one operation rounds correctly
    mantissa as i64 as f64 / POWERS[places]
}

/// Digits and point: all digits as a whole number, how many are after the point, and where they end.
#[inline]
fn digits(text: &[u8], first: usize) -> Option<(u64, usize, usize)> {
    let (mut mantissa, mut end, mut point) = (0u64, first, usize::MAX);
    loop {
        let byte = *text.get(end)?;
        let digit = byte.wrapping_sub(b'0');
        if digit < 10 {
            mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(digit));
        } else if byte == b'.' && point == usize::MAX {
            point = end;
        } else {
            break;
        }
        end += 1;
    }
    let digits = end - first - usize::from(point != usize::MAX);
    if digits == 0 || digits > 18 || mantissa > EXACT {
        return None;
    }
    let places = if point == usize::MAX { 0 } else { end - point - 1 };
    Some((mantissa, places, end))
}

#[cfg(test)]
mod tests {
    use super::plain;
    use crate::block::{G_GROUPS, M_GROUPS};
    use crate::read::{Line, evaluate};
    use crate::{Block, Engine, Setup, Source};
    use proptest::prelude::*;
    use std::sync::Arc;
    use trunnion_syntax::TextRange;

    /// The results of both paths for a line; `None` where the short path leaves it to the other.
    fn both(text: &str) -> Option<(Block, u32, Block)> {
        let bytes = text.as_bytes();
        let engine = Engine::new(Arc::new(Source::new(String::new(), bytes.into())), &Setup::default());
        let (mut short, mut long, mut line) = (Block::new(), Block::new(), Line::default());
        let end = plain(bytes, 0, &engine.values(), &mut short)?;
        let stop = text.lines().next().unwrap_or_default().trim_end().len() as u32;
        Line::read(bytes, TextRange::new(0, stop), &mut line);
        assert_eq!(line.errors, []);
        assert_eq!(evaluate(&line, &engine.values(), &mut long), Ok(()));
        Some((short, end, long))
    }

    fn same(text: &str) -> bool {
        let Some((short, end, long)) = both(text) else {
            return false;
        };
        assert_eq!(end as usize, text.find('\n').map_or(0, |at| at + 1));
        let values = |block: &Block| {
            (b'A'..=b'Z')
                .map(|letter| (block.word(letter).map(f64::to_bits), block.range_of(letter)))
                .collect::<Vec<_>>()
        };
        assert_eq!(values(&short), values(&long), "{text:?}");
        assert_eq!(
            (short.g, short.m, short.m_count),
            (long.g, long.m, long.m_count),
            "{text:?}"
        );
        let ranges = |block: &Block| {
            let g = (0..G_GROUPS).map(|group| block.g_range(group));
            g.chain((0..M_GROUPS).map(|group| block.m_range(group)))
                .collect::<Vec<_>>()
        };
        assert_eq!((ranges(&short), short.range), (ranges(&long), long.range));
        assert_eq!(
            short.number.map(f64::to_bits),
            long.number.map(f64::to_bits),
            "{text:?}"
        );
        true
    }

    #[test]
    fn what_most_lines_are_is_plain() {
        for text in [
            "G1 X1.5 Y-2. Z.25 A+3 C-0\n",
            "g0x1y2\r\n",
            "F100  S2000 M3 \n",
            "X12345678901234.5\n",
            "N10 G1 X1\n",
            "n0010.50X1 Y2 \r\n",
            "G1 G90 M3 M8 X1\n",
            "G1.X.5Y1234.567Z12345.67A123456.7\n",
            "G-0 X1234567 Y.1234567 Z1234567.\n",
            "G0 X12345678 Y1234.5678 Z.12345678 \n",
            "G1 \n",
            "N7 G0  X1 G90\n",
            "G1 X1 Y2 Z3 A4 C5 F1\r\n",
            "G1 X0 Y9.9999999 Z-99.999999\r\n",
        ] {
            assert!(same(text), "{text:?}");
        }
        for text in [
            "X1 2\n",
            "X1X2\n",
            "N1. X1\n",
            "N-1 X1\n",
            "N1 5 X1\n",
            "N5\n",
            "X1 N5\n",
            "N.5X1\n",
            "(a) X1\n",
            "X[1]\n",
            "X#1\n",
            "M98 P1\n",
            "G77.7\n",
            "X1;\n",
            "X1",
            "X- 1\n",
            "X1 .5\n",
            "F-1\n",
            "G0 G1 X1\n",
            "G1 G1 X1\n",
            "G80 G1 X.\n",
            " X1\n",
            " G1 X1\n",
            "G1 5 X1\n",
            "G1 .5 X1\n",
            "G1 X1 G0\n",
            "G1 (a) X1\n",
            "G1.5 X1\n",
            "X1.2.3\n",
            "X1.-2 \n",
        ] {
            assert!(!same(text), "{text:?}");
        }
    }

    proptest! {
        #[test]
        fn both_ways_read_the_same(text in "(N[0-9]{0,3}[.]?[0-9]{0,2} ?)?([GMXYZFSTHPAx][-+]?[0-9]{0,3}[.]?[0-9]{0,3} ?){0,5}[\r]?\n") {
            same(&text);
        }
    }
}
