//! Expressions of a Sinumerik 840D sl: to postfix code, without recursion. Other than in RS274/NGC and Macro B blanks end names, round
//! brackets group, and an expression needs no brackets around it.
//!
//! Priority (Sinumerik 840D sl Programming Manual, Job Planning, arithmetic operations: priority of the operations), highest first, equal
//! ones from left to right: NOT, B_NOT; `* / DIV MOD`; `+ -`; B_AND; B_XOR; B_OR; AND; XOR; OR; `<<`; `== <> > < >= <=`. So
//! `R1>5 AND R2<3` compares R1 with `5 AND R2` and the outcome with 3.
//!
//! What is not documented has no value that is known (NaN): comparisons of numbers that differ by less than one part in 1e9 (the control
//! compares REAL with a relative tolerance), TRUNC that near to a whole number, ROUND of a negative half, DIV, MOD and bits of fractions.
use crate::code::{Binary, Code, Comparison, Formula, Op, Step, Unary};
use crate::{FormulaError, FormulaErrorKind as Kind, Name};
use trunnion_syntax::TextRange;

mod operands;
mod values;

pub(crate) use values::{binary, unary};

/// What is open or needs its second operand.
enum Waiting {
    Binary(Binary, u8),
    Unary(Unary),
    Group,
    /// `R[`
    Index,
    /// `FIELD[`
    Field(Name),
    One(Unary),
    /// A function of two arguments; whether the second is being read.
    Two(Binary, bool),
}

/// Reads the expression that begins at the start of `range`, as far as it extends: the formula, and one past its last byte. Variables are
/// queried by number (`R5`) or by name in lower case; elements of fields of one dimension by name and index, others by the name with `[`, unknown
/// functions with `(`, texts as `"`.
///
/// # Errors
/// The text is no expression.
pub fn sinumerik(source: &[u8], range: TextRange) -> Result<(Formula, u32), FormulaError> {
    let end = range.end.min(u32::try_from(source.len()).unwrap_or(u32::MAX));
    let start = range.start.min(end);
    let mut reader = Reader {
        text: &source[start as usize..end as usize],
        at: 0,
        behind: 0,
        steps: Vec::new(),
        waiting: Vec::new(),
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
    height: usize,
    depth: usize,
    /// A bracket that opens before this byte holds one index: brackets inside each other are looked through once.
    one_index_to: u32,
}

fn is_name(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || byte == b'_'
}

impl<'s> Reader<'s> {
    fn rest(&self) -> &'s [u8] {
        &self.text[self.at as usize..]
    }

    fn peek(&self) -> Option<u8> {
        self.rest().first().copied()
    }

    fn blanks(&mut self) {
        let blank = |byte: &&u8| matches!(byte, b' ' | b'\t' | b'\r' | b'&');
        self.at += self.rest().iter().take_while(blank).count() as u32;
    }

    fn take(&mut self, bytes: usize) -> &'s [u8] {
        let taken = &self.rest()[..bytes];
        self.at += bytes as u32;
        self.behind = self.at;
        taken
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

    fn unknown(&mut self, name: &str) {
        self.push(Op::Named(Name::new(name)));
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
                    NextToken::Operand => break,
                    NextToken::Closed => {}
                    NextToken::End => return Ok(()),
                }
            }
        }
    }

    /// Reads a sign, NOT, an opening bracket or a whole operand; whether it was a whole operand.
    fn operand(&mut self) -> Result<bool, Kind> {
        let Some(byte) = self.peek() else {
            return Err(Kind::MissingValue);
        };
        match byte {
            b'(' => {
                self.take(1);
                self.waiting.push(Waiting::Group);
                Ok(false)
            }
            b'+' => {
                self.take(1);
                Ok(false)
            }
            b'-' => {
                self.take(1);
                self.waiting.push(Waiting::Unary(Unary::Negate));
                Ok(false)
            }
            b'0'..=b'9' | b'.' => self.number().map(|()| true),
            b'\'' => self.coded().map(|()| true),
            b'"' => {
                let inside = self.rest()[1..].iter().position(|&byte| byte == b'"');
                let Some(inside) = inside else {
                    return Err(Kind::MissingValue);
                };
                self.take(inside + 2);
                self.unknown("\"");
                Ok(true)
            }
            b'$' | b'_' | b'a'..=b'z' | b'A'..=b'Z' => self.name(),
            _ => Err(Kind::MissingValue),
        }
    }

    /// What follows a whole operand.
    fn operator(&mut self) -> Result<NextToken, Kind> {
        match self.peek() {
            Some(b')') => return self.close(b')'),
            Some(b']') => return self.close(b']'),
            Some(b',') => {
                let open = self
                    .waiting
                    .iter()
                    .rposition(|waiting| !matches!(waiting, Waiting::Binary(..)));
                if let Some(open) = open
                    && matches!(self.waiting[open], Waiting::Two(_, false))
                {
                    self.reduce(0);
                    self.take(1);
                    if let Some(Waiting::Two(_, second)) = self.waiting.last_mut() {
                        *second = true;
                    }
                    return Ok(NextToken::Operand);
                }
            }
            _ => {}
        }
        let Some((binary, rank, length)) = self.binary() else {
            let open = self
                .waiting
                .iter()
                .any(|waiting| !matches!(waiting, Waiting::Binary(..)));
            if open {
                return Err(Kind::UnclosedBracket);
            }
            self.reduce(0);
            return Ok(NextToken::End);
        };
        self.reduce(rank);
        self.take(length);
        self.waiting.push(Waiting::Binary(binary, rank));
        Ok(NextToken::Operand)
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

    fn close(&mut self, sign: u8) -> Result<NextToken, Kind> {
        self.reduce(0);
        let step = match (self.waiting.last(), sign) {
            // the bracket belongs to the text around the expression
            (None, _) => return Ok(NextToken::End),
            (Some(Waiting::Group), b')') => None,
            (Some(Waiting::Index), b']') => Some(Op::ReadAt),
            (Some(Waiting::Field(name)), b']') => Some(Op::NamedAt(name.clone())),
            (Some(&Waiting::One(unary)), b')') => Some(Op::Unary(unary)),
            (Some(&Waiting::Two(binary, true)), b')') => {
                self.height -= 1;
                Some(Op::Binary(binary))
            }
            (Some(Waiting::Two(_, false)), b')') => return Err(Kind::MissingComma),
            _ => return Err(Kind::UnclosedBracket),
        };
        self.waiting.pop();
        self.take(1);
        if let Some(op) = step {
            self.step(op);
        }
        Ok(NextToken::Closed)
    }

    /// The operator at the cursor, its rank and its length.
    fn binary(&self) -> Option<(Binary, u8, usize)> {
        let rest = self.rest();
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
        let word = self.word();
        let known: [(&[u8], Binary, u8); 8] = [
            (b"DIV", Binary::WholeDivide, 10),
            (b"MOD", Binary::WholeRemainder, 10),
            (b"B_AND", Binary::WholeAnd, 8),
            (b"B_XOR", Binary::WholeXor, 7),
            (b"B_OR", Binary::WholeOr, 6),
            (b"AND", Binary::LogicalAnd, 5),
            (b"XOR", Binary::LogicalXor, 4),
            (b"OR", Binary::LogicalOr, 3),
        ];
        let found = known.iter().find(|(name, ..)| word.eq_ignore_ascii_case(name))?;
        Some((found.1, found.2, word.len()))
    }
}

/// What follows an operand.
enum NextToken {
    /// An operator: an operand must follow.
    Operand,
    /// The end of a bracket, which is an operand as a whole.
    Closed,
    /// Nothing that belongs to the expression.
    End,
}

#[cfg(test)]
mod tests;
