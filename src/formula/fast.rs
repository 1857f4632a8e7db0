//! Values of RS274/NGC as they are mostly written, in one pass over the bytes: parameters, numbers, functions of one argument, signs,
//! brackets and operators.
//!
//! It takes only what the compiler would read in the same way without an error, and stops before all else (a test compares both).
use crate::code::{Binary, Code, Formula, Op, Step, Unary};
use crate::compile::{continues, signed};
use crate::cursor::is_blank;
use crate::words::{Function, Operator, operator, short_function, short_operator};
use crate::{Cursor, Name};
use trunnion_syntax::{Decimal, TextRange};

/// Values that are kept at once, operators that wait, and brackets that are open, at most.
const MOST: usize = 16;

/// A number that names a parameter here has at most so many digits.
const INDEX_DIGITS: usize = 9;

struct Fast<'t, 'v> {
    /// What is not read yet of the line when it begins.
    text: &'t [u8],
    at: usize,
    /// One past the last byte of the operand that was read last.
    end: usize,
    steps: &'v mut Vec<Step>,
    waiting: [Operator; MOST],
    waits: usize,
    /// Where each value that is on the stack begins.
    starts: [u32; MOST],
    height: usize,
    depth: usize,
    open: usize,
}

/// The value at the cursor, which then comes after it; `None` where the compiler has to look at it: then `steps` is empty again.
#[inline]
pub(crate) fn value(cursor: &mut Cursor<'_>, steps: &mut Vec<Step>) -> Option<Formula> {
    let text = cursor.rest();
    if !matches!(text.first()?, b'#' | b'[' | b'-' | b'+' | b'a'..=b'z' | b'A'..=b'Z') {
        return None;
    }
    let from = cursor.at();
    let mut fast = Fast {
        text,
        at: 0,
        end: 0,
        steps,
        waiting: [operator(Binary::Add, 0); MOST],
        waits: 0,
        starts: [0; MOST],
        height: 0,
        depth: 0,
        open: 0,
    };
    let read = fast.operand();
    let (end, depth) = (fast.end as u32, fast.depth);
    if read.is_none() || matches!(steps.as_slice(), [Step { op: Op::Number(_), .. }]) && text[0] != b'[' {
        steps.clear();
        return None;
    }
    cursor.skip_to(from + end);
    Some(Formula {
        range: TextRange::new(from, from + end),
        code: Code::Steps {
            steps: core::mem::take(steps),
            depth,
        },
    })
}

/// A part of the value's text.
#[inline]
fn range(start: usize, end: usize) -> TextRange {
    TextRange::new(start as u32, end as u32)
}

impl Fast<'_, '_> {
    #[inline]
    fn byte(&self) -> Option<u8> {
        self.text.get(self.at).copied()
    }

    #[inline]
    fn blanks(&mut self) {
        while self.byte().is_some_and(is_blank) {
            self.at += 1;
        }
    }

    #[inline]
    fn push(&mut self, op: Op, start: usize, end: usize) -> Option<()> {
        let range = range(start, end);
        *self.starts.get_mut(self.height)? = range.start;
        self.steps.push(Step { op, range });
        self.height += 1;
        self.depth = self.depth.max(self.height);
        Some(())
    }

    /// The value on top begins here.
    #[inline]
    fn begins(&mut self, start: usize) -> Option<()> {
        *self.starts.get_mut(self.height.checked_sub(1)?)? = start as u32;
        Some(())
    }

    /// Reads an operand; `end` is behind it.
    fn operand(&mut self) -> Option<()> {
        let start = self.at;
        match self.byte()? {
            b'#' => self.parameter(),
            b'[' => self.bracket(start, None),
            sign @ (b'-' | b'+') if !matches!(self.text.get(start + 1)?, b'0'..=b'9' | b'.') => {
                // a blank after a sign, and signs without end, are for the compiler
                if start > 0 && matches!(self.text[start - 1], b'-' | b'+') {
                    return None;
                }
                self.at += 1;
                self.operand()?;
                if sign == b'-' {
                    let range = range(start, self.end);
                    self.steps.push(Step {
                        op: Op::Unary(Unary::Negate),
                        range,
                    });
                }
                self.begins(start)
            }
            b'0'..=b'9' | b'.' | b'-' | b'+' => self.number(),
            _ => {
                let head = self.text.get(start..start + 4)?;
                let head = [head[0], head[1], head[2], head[3]].map(|byte| byte.to_ascii_lowercase());
                let (unary, length) = match short_function(head) {
                    Some((Function::One(unary), length)) => (unary, length as usize),
                    None if head == *b"roun" && self.text.get(start + 4)?.eq_ignore_ascii_case(&b'd') => {
                        (Unary::RoundToInt, 5)
                    }
                    _ => return None,
                };
                self.at = start + length;
                if self.byte() != Some(b'[') {
                    return None;
                }
                self.bracket(start, Some(unary))
            }
        }
    }

    /// How many bytes from here on are digits, or points where they may be; `None` where a number continues after blanks.
    #[inline]
    fn digits(&self, from: usize, points: bool) -> Option<usize> {
        let rest = &self.text[from..];
        let is_part = |byte: &u8| byte.is_ascii_digit() || points && *byte == b'.';
        let length = rest.iter().position(|byte| !is_part(byte)).unwrap_or(rest.len());
        let behind = &rest[length..];
        let goes_on = match behind.first() {
            Some(b'.') => true,
            Some(byte) if is_blank(*byte) => continues(behind),
            _ => false,
        };
        (length > 0 && !goes_on).then_some(length)
    }

    #[inline]
    fn number(&mut self) -> Option<()> {
        let start = self.at;
        let sign = usize::from(matches!(self.text[start], b'-' | b'+'));
        let end = start + sign + self.digits(start + sign, true)?;
        let decimal = Decimal::parse(&self.text[start..end])?;
        let value = signed(decimal, self.text[start] == b'-');
        (self.at, self.end) = (end, end);
        self.push(Op::Number(value), start, end)
    }

    #[inline]
    fn parameter(&mut self) -> Option<()> {
        let start = self.at;
        let (op, end) = if self.text.get(start + 1)? == &b'<' {
            let (name, length) = Name::before(&self.text[start + 2..], b'>')?;
            (Op::Named(name), start + length + 3)
        } else {
            let length = self.digits(start + 1, false).filter(|length| *length <= INDEX_DIGITS)?;
            let digits = &self.text[start + 1..=start + length];
            let index = digits
                .iter()
                .fold(0, |index, digit| 10 * index + i64::from(digit - b'0'));
            (Op::Read(index), start + 1 + length)
        };
        (self.at, self.end) = (end, end);
        self.push(op, start, end)
    }

    /// From a bracket to the one that closes it; `call`: the function before it, which begins at `start`.
    fn bracket(&mut self, start: usize, call: Option<Unary>) -> Option<()> {
        if self.open == MOST {
            return None;
        }
        self.open += 1;
        self.at += 1;
        let outside = self.waits;
        loop {
            self.blanks();
            self.operand()?;
            self.blanks();
            let Some(operator) = self.operator()? else { break };
            self.reduce(outside, operator.rank)?;
            *self.waiting.get_mut(self.waits)? = operator;
            self.waits += 1;
        }
        self.reduce(outside, 0)?;
        self.open -= 1;
        self.at += 1;
        self.end = self.at;
        let range = range(start, self.end);
        // the end of a value that may be infinite is marked where something continues after it
        let unary = call.or_else(|| {
            let infinite = self.steps.last().is_some_and(Step::is_binary);
            (self.open > 0 && infinite).then_some(Unary::Check)
        });
        if let Some(unary) = unary {
            self.steps.push(Step {
                op: Op::Unary(unary),
                range,
            });
        }
        self.begins(start)
    }

    /// The operator here, taken; `Some(None)`: a bracket closes.
    #[inline]
    #[expect(
        clippy::option_option,
        reason = "the end of a bracket and what is not for this reader are two answers"
    )]
    fn operator(&mut self) -> Option<Option<Operator>> {
        let (found, length) = match self.byte()? {
            b']' => return Some(None),
            b'+' => (operator(Binary::Add, 4), 1),
            b'-' => (operator(Binary::Subtract, 4), 1),
            b'/' => (operator(Binary::Divide, 5), 1),
            b'*' => {
                let behind = &self.text[self.at + 1..];
                if behind.first() == Some(&b'*') {
                    (operator(Binary::Power, 6), 2)
                } else if behind.iter().find(|byte| !is_blank(**byte)) == Some(&b'*') {
                    return None;
                } else {
                    (operator(Binary::Multiply, 5), 1)
                }
            }
            _ => {
                let head = self.text.get(self.at..self.at + 4)?;
                short_operator([head[0], head[1], head[2], head[3]].map(|byte| byte.to_ascii_lowercase()))?
            }
        };
        self.at += length as usize;
        Some(Some(found))
    }

    /// Emits the operators of the innermost bracket that bind at least as strongly as `rank`.
    #[inline]
    fn reduce(&mut self, outside: usize, rank: u8) -> Option<()> {
        while self.waits > outside && self.waiting[self.waits - 1].rank >= rank {
            self.waits -= 1;
            self.height = self.height.checked_sub(1)?;
            let start = *self.starts.get(self.height.checked_sub(1)?)?;
            let range = TextRange::new(start, self.end as u32);
            Step::push_binary(self.steps, self.waiting[self.waits].binary, range);
        }
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::value;
    use crate::compile::compiled;
    use crate::{Cursor, Grammar};
    use proptest::prelude::*;
    use trunnion_syntax::TextRange;

    /// Whether this path accepts the text; then it is what the compiler makes of it.
    fn same(text: &str) -> bool {
        let there = format!("G1 X{text}");
        let all = TextRange::new(4, there.len() as u32);
        let mut cursor = Cursor::new(there.as_bytes(), all);
        let mut general = cursor;
        let mut steps = Vec::new();
        let Some(fast) = value(&mut cursor, &mut steps) else {
            assert!(steps.is_empty());
            assert_eq!(cursor.at(), general.at(), "{text:?}");
            return false;
        };
        let (slow, error) = compiled(&mut general, Grammar::Rs274, &mut Vec::new());
        assert_eq!(error, None, "{text:?}");
        assert_eq!(fast, slow, "{text:?}");
        assert_eq!(
            (cursor.at(), cursor.behind()),
            (general.at(), general.behind()),
            "{text:?}"
        );
        true
    }

    #[test]
    fn what_most_values_are_is_read_at_once() {
        for text in [
            "#1",
            "#<w> Y2",
            "-#12X",
            "[#1 * 2 + #2 / 3.5]",
            "[ABS[SIN[#3]] ** 2 + SQRT[#<w> * #<w> + 1]]",
            "[#<w> GT 10 and #<h> LT 1000] (c)",
            "[ROUND[#1]]",
            "[[#1 + 2] * -[3 - #<a_b>] ]",
            "[-5 - -#1]",
            "[ 2 ]",
            "[--5]",
            "FUP[#3] MOD 7",
        ] {
            assert!(same(text), "{text:?}");
        }
        for text in [
            "5",
            "-5",
            "[#1",
            "[#1 5]",
            "##1",
            "#[1]",
            "ATAN[1]/[2]",
            "[1 * * 2]",
            "[- 5]",
            "[---#5]",
            "[1. 5]",
            "#1.5",
            "#1 5",
            "[EXISTS[#<a>]]",
            "#<a b>",
            "",
        ] {
            assert!(!same(text), "{text:?}");
        }
    }

    proptest! {
        #[test]
        fn whatever_it_takes_the_compiler_takes(
            text in "[-+]?(\\[|#|SIN\\[)(\\[|\\]|#[0-9<a>]| ?[-+*/] ?|\\*\\*| (MOD|gt|EQ|xor) ?|[0-9.]{1,4}|[ \t]|#<x>|fix\\[|ROUND\\[|LN\\[|ATAN){0,12}\\]{0,3}"
        ) {
            same(&text);
        }

        #[test]
        fn sound_values_too(
            text in "(\\[|COS\\[)(#[1-9]|#<x>|-?[0-9]{1,3}(\\.[0-9])?|\\[#2 ?[-+*/] ?3\\]|abs\\[#<y> ?- ?2\\])( ?([-+*/]|\\*\\*| MOD| OR) ?(#[1-9]|#<x>|-#3|[0-9]{1,3}|\\[#2 ?[-+*/] ?3\\])){0,5} ?\\]"
        ) {
            same(&text);
        }
    }
}
