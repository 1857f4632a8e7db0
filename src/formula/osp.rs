//! Expressions of Okuma's user task: to postfix code, without recursion.
//!
//! Square brackets group and hold the arguments of functions; blanks end names (NC-PB/gEdit, syntax-okuma.md, from the OSP-P200L and P300 manuals).
//! `* /` bind tighter than `+ -`, these tighter than EQ NE GT GE LT LE, and equal ones bind from left to right. What no source states has no value
//! that is known (NaN): AND, OR and EOR beside each other or beside a comparison without brackets between them, and of other numbers than 0 and 1;
//! MOD and FIX of negative numbers, ROUND of a half, FUP below zero, ATAN, ATAN2, DROUND, DFIX, DFUP, BIN, BCD; comparisons of numbers that differ by less
//! than one part in 1e9.
use crate::code::{Binary, Code, Comparison, Formula, Op, Step, Unary};
use crate::{FormulaError, FormulaErrorKind as Kind, Name};
use trunnion_syntax::TextRange;

mod operands;

/// What is open or needs its second operand.
enum Waiting {
    Binary(Binary, u8),
    Unary(Unary),
    Group,
    /// `VZOFX[`
    Field(Name),
    One(Unary),
    /// A function of two arguments; whether the second is being read.
    Two(Binary, bool),
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

/// Reads the expression that begins at the start of `range`, as far as it extends: the formula, and one past its last byte. Variables are
/// queried by name in lower case, with their index where they have one; elements of several dimensions and functions without a known value by
/// the name with `[`.
///
/// # Errors
/// The text is no expression.
pub fn osp(source: &[u8], range: TextRange) -> Result<(Formula, u32), FormulaError> {
    let end = range.end.min(u32::try_from(source.len()).unwrap_or(u32::MAX));
    let start = range.start.min(end);
    let mut reader = Reader {
        text: &source[start as usize..end as usize],
        at: 0,
        behind: 0,
        steps: Vec::new(),
        waiting: Vec::new(),
        weak: vec![Weak::None],
        height: 0,
        depth: 0,
        one_index_to: 0,
    };
    match reader.run() {
        Ok(()) => {
            let formula = Formula {
                range: TextRange::new(start, start + reader.behind),
                code: Code::Steps {
                    steps: reader.steps,
                    depth: reader.depth,
                },
            };
            Ok((formula, start + reader.behind))
        }
        Err(kind) => {
            let at = (start + reader.at).min(end);
            Err(FormulaError {
                range: TextRange::new(at, (at + 1).min(end)),
                kind,
            })
        }
    }
}

struct Reader<'s> {
    text: &'s [u8],
    at: u32,
    /// One past the last byte that belongs to the expression.
    behind: u32,
    steps: Vec<Step>,
    waiting: Vec<Waiting>,
    /// One for the whole and one for each open bracket.
    weak: Vec<Weak>,
    height: usize,
    depth: usize,
    /// A bracket that opens before this byte holds one index: brackets inside each other are looked through once.
    one_index_to: u32,
}

/// What follows an operand.
enum Next {
    Operand,
    Closed,
    End,
}

impl<'s> Reader<'s> {
    fn rest(&self) -> &'s [u8] {
        &self.text[self.at as usize..]
    }

    fn peek(&self) -> Option<u8> {
        self.rest().first().copied()
    }

    /// Passes over blanks, and the line end and `$` of a block that continues.
    fn blanks(&mut self) {
        while let Some(byte) = self.peek() {
            let before = (self.at as usize).checked_sub(1).map(|at| self.text[at]);
            let continues = byte == b'$' && matches!(before, Some(b'\n' | b'\r'));
            if !byte.is_ascii_whitespace() && !continues {
                return;
            }
            self.at += 1;
        }
    }

    fn take(&mut self, bytes: usize) {
        self.at += bytes as u32;
        self.behind = self.at;
    }

    fn push(&mut self, op: Op) {
        self.height += 1;
        self.depth = self.depth.max(self.height);
        self.step(op);
    }

    fn step(&mut self, op: Op) {
        let range = TextRange::new(0, self.behind);
        self.steps.push(Step { op, range });
    }

    fn open(&mut self, waiting: Waiting) {
        self.waiting.push(waiting);
        self.weak.push(Weak::None);
    }

    fn run(&mut self) -> Result<(), Kind> {
        loop {
            self.blanks();
            if !self.operand()? {
                continue;
            }
            loop {
                while let Some(&Waiting::Unary(unary)) = self.waiting.last() {
                    self.waiting.pop();
                    self.step(Op::Unary(unary));
                }
                self.blanks();
                match self.operator()? {
                    Next::Operand => break,
                    Next::Closed => {}
                    Next::End => return Ok(()),
                }
            }
        }
    }

    /// Reads a sign, NOT, an opening bracket or a whole operand; whether it was a whole operand.
    fn operand(&mut self) -> Result<bool, Kind> {
        match self.peek() {
            Some(b'[') => {
                self.take(1);
                self.open(Waiting::Group);
                Ok(false)
            }
            Some(b'+') => {
                self.take(1);
                Ok(false)
            }
            Some(b'-') => {
                self.take(1);
                self.waiting.push(Waiting::Unary(Unary::Negate));
                Ok(false)
            }
            Some(b'0'..=b'9' | b'.') => self.number().map(|()| true),
            Some(b'#') => self.hexadecimal().map(|()| true),
            Some(b'a'..=b'z' | b'A'..=b'Z') => self.name(),
            _ => Err(Kind::MissingValue),
        }
    }

    /// What follows a whole operand.
    fn operator(&mut self) -> Result<Next, Kind> {
        match self.peek() {
            Some(b']') => return self.close(),
            Some(b',') => {
                let open = self
                    .waiting
                    .iter()
                    .rposition(|waiting| !matches!(waiting, Waiting::Binary(..)));
                if let Some(open) = open
                    && matches!(self.waiting[open], Waiting::Two(_, false))
                {
                    self.settle();
                    if let Some(weak) = self.weak.last_mut() {
                        *weak = Weak::None;
                    }
                    self.take(1);
                    if let Some(Waiting::Two(_, second)) = self.waiting.last_mut() {
                        *second = true;
                    }
                    return Ok(Next::Operand);
                }
            }
            _ => {}
        }
        let Some((binary, rank, length)) = self.binary() else {
            if self.weak.len() > 1 {
                return Err(Kind::UnclosedBracket);
            }
            self.settle();
            return Ok(Next::End);
        };
        if let Some(weak) = self.weak.last_mut() {
            let new = match rank {
                COMPARES => Weak::Comparison,
                JOINS => Weak::Logical(binary),
                _ => Weak::None,
            };
            *weak = match (*weak, new) {
                (old, Weak::None) => old,
                (Weak::None, new) => new,
                (Weak::Logical(old), Weak::Logical(new)) if old == new => *weak,
                _ => Weak::Several,
            };
        }
        self.reduce(rank);
        self.take(length);
        self.waiting.push(Waiting::Binary(binary, rank));
        Ok(Next::Operand)
    }

    /// Emits the operators inside the innermost bracket that bind at least as strongly as `rank`.
    fn reduce(&mut self, rank: u8) {
        while let Some(&Waiting::Binary(binary, own)) = self.waiting.last()
            && own >= rank
        {
            self.waiting.pop();
            self.height -= 1;
            let range = TextRange::new(0, self.behind);
            Step::push_binary(&mut self.steps, binary, range);
        }
    }

    /// Emits all of them; the value is unknown where their order is.
    fn settle(&mut self) {
        self.reduce(0);
        if self.weak.last() == Some(&Weak::Several) {
            self.step(Op::Unary(Unary::Unsettled));
        }
    }

    fn close(&mut self) -> Result<Next, Kind> {
        if self.weak.len() == 1 {
            // the bracket belongs to the text around the expression
            self.settle();
            return Ok(Next::End);
        }
        self.settle();
        let step = match self.waiting.pop() {
            Some(Waiting::Group) => None,
            Some(Waiting::Field(name)) => Some(Op::NamedAt(name)),
            Some(Waiting::One(unary)) => Some(Op::Unary(unary)),
            Some(Waiting::Two(binary, true)) => {
                self.height -= 1;
                Some(Op::Binary(binary))
            }
            Some(Waiting::Two(_, false)) => return Err(Kind::MissingComma),
            _ => return Err(Kind::UnclosedBracket),
        };
        self.weak.pop();
        self.take(1);
        if let Some(op) = step {
            self.step(op);
        }
        Ok(Next::Closed)
    }

    /// The operator at the cursor, its rank and its length.
    fn binary(&self) -> Option<(Binary, u8, usize)> {
        match self.peek()? {
            b'+' => return Some((Binary::Add, 9, 1)),
            b'-' => return Some((Binary::Subtract, 9, 1)),
            b'*' => return Some((Binary::Multiply, 10, 1)),
            b'/' => return Some((Binary::Divide, 10, 1)),
            _ => {}
        }
        let word = self.word();
        let known: [(&[u8], Binary, u8); 9] = [
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
        let found = known.iter().find(|(name, ..)| word.eq_ignore_ascii_case(name))?;
        Some((found.1, found.2, word.len()))
    }
}

#[cfg(test)]
mod tests;
