//! What is pending while an expression is read: open brackets, operators, signs.
use crate::code::{Binary, Op, Step, Unary};
use crate::words::{Operator, take_operator};
use crate::{Cursor, FormulaError, FormulaErrorKind, Grammar, Name};
use smallvec::SmallVec;
use trunnion_syntax::{Decimal, TextRange};

/// Fanuc's macro B allows five levels of brackets, those of functions counted (operator's manual, chapter custom macro).
const MACRO_B_LEVELS: usize = 5;

/// What a closing bracket ends.
#[derive(Debug)]
pub(crate) enum Bracket {
    Plain,
    /// A function of one argument.
    Call(Unary),
    /// The first argument of ATAN.
    First,
    /// The second argument of ATAN or POW.
    Second(Binary),
    /// The first argument of POW.
    PowBase,
    /// The index of a named variable (Macro B).
    Index(Name),
    /// The named parameter that EXISTS tests: the answer is on the stack already.
    ExistsNamed,
    /// The number of the parameter that EXISTS tests.
    ExistsNumbered,
}

#[derive(Debug)]
pub(crate) struct Open {
    pub(crate) bracket: Bracket,
    /// Where the value begins: at the bracket, or at the function's name.
    pub(crate) start: u32,
    /// Where the bracket itself is.
    pub(crate) sign: u32,
    /// How many operators are pending outside.
    pub(crate) outside: usize,
}

#[derive(Debug)]
pub(crate) enum Waiting {
    Binary(Operator),
    /// A minus sign before a value.
    Negate(u32),
    /// A plus sign before a value: nothing to do.
    Plus(u32),
    /// A `#` before a value.
    Read(u32),
}

pub(crate) struct Compiler<'c, 's> {
    pub(crate) cursor: &'c mut Cursor<'s>,
    pub(crate) grammar: Grammar,
    pub(crate) steps: Vec<Step>,
    pub(crate) waiting: SmallVec<[Waiting; 12]>,
    pub(crate) open: SmallVec<[Open; 6]>,
    /// Where each value that is on the stack at this point begins.
    pub(crate) starts: SmallVec<[u32; 12]>,
    pub(crate) depth: usize,
    /// One past the last byte of the operand that was read last.
    pub(crate) end: u32,
    /// The number if nothing else was read so far, with its digits if they can be held exactly.
    pub(crate) plain: Option<(f64, Option<Decimal>)>,
}

impl Compiler<'_, '_> {
    /// Takes `[` and puts it on the stack.
    pub(crate) fn open(&mut self, bracket: Bracket, start: u32) -> Result<(), FormulaError> {
        let sign = self.cursor.at();
        self.cursor.bump();
        if self.grammar == Grammar::MacroB && self.open.len() == MACRO_B_LEVELS {
            return Self::fail(
                self.cursor.since(sign),
                FormulaErrorKind::TooDeep { limit: MACRO_B_LEVELS },
            );
        }
        self.open.push(Open {
            bracket,
            start,
            sign,
            outside: self.waiting.len(),
        });
        Ok(())
    }

    pub(crate) fn push(&mut self, op: Op, start: u32, range: TextRange) {
        self.steps.push(Step { op, range });
        self.starts.push(start);
        self.depth = self.depth.max(self.starts.len());
    }

    /// Applies the signs and `#` that come directly before the value that was just read.
    pub(crate) fn apply_signs(&mut self) {
        self.end = self.cursor.behind();
        while let Some(Waiting::Negate(start) | Waiting::Plus(start) | Waiting::Read(start)) = self.waiting.last() {
            let start = *start;
            if self.open.last().is_some_and(|open| self.waiting.len() <= open.outside) {
                return;
            }
            let range = self.cursor.since(start);
            match self.waiting.pop() {
                Some(Waiting::Negate(_)) => self.steps.push(Step {
                    op: Op::Unary(Unary::Negate),
                    range,
                }),
                Some(Waiting::Read(_)) => self.read(range),
                _ => {}
            }
            if let Some(own) = self.starts.last_mut() {
                *own = start;
            }
            self.plain = None;
        }
    }

    /// Reads the variable whose number is the value that was just compiled.
    fn read(&mut self, range: TextRange) {
        let nullable = self.grammar == Grammar::MacroB;
        if let Some(Step {
            op: Op::Number(index), ..
        }) = self.steps.last()
            && let Some(index) = crate::arithmetic::whole(*index)
        {
            self.steps.pop();
            let op = if nullable {
                Op::ReadNullable(index)
            } else {
                Op::Read(index)
            };
            self.steps.push(Step { op, range });
            return;
        }
        let op = if nullable { Op::ReadNullableAt } else { Op::ReadAt };
        self.steps.push(Step { op, range });
    }

    /// After a whole value inside a bracket: an operator (true: an operand must follow) or the end of the bracket.
    pub(crate) fn after_operand(&mut self) -> Result<bool, FormulaError> {
        let Some(open) = self.open.last() else {
            return Ok(true);
        };
        let sign = TextRange::new(open.sign, open.sign + 1);
        let exists = matches!(open.bracket, Bracket::ExistsNamed | Bracket::ExistsNumbered);
        match self.cursor.peek() {
            Some(b']') => return self.close(),
            _ if exists => return Self::fail(self.cursor.here(), FormulaErrorKind::MissingClose),
            None => return Self::fail(sign, FormulaErrorKind::UnclosedBracket),
            Some(b',') if matches!(open.bracket, Bracket::PowBase) => return Ok(self.comma(Binary::Power)),
            Some(b',') if self.grammar == Grammar::MacroB && matches!(open.bracket, Bracket::First) => {
                return Ok(self.comma(Binary::MacroAtan2));
            }
            Some(_) => {}
        }
        let Some(operator) = take_operator(self.cursor, self.grammar) else {
            let letter = self.cursor.peek().filter(u8::is_ascii_alphabetic).map(char::from);
            return Self::fail(self.cursor.here(), FormulaErrorKind::UnknownOperator(letter));
        };
        self.reduce(operator.rank);
        self.waiting.push(Waiting::Binary(operator));
        Ok(true)
    }

    /// Emits the operators of the innermost bracket that bind at least as strongly as `rank`.
    fn reduce(&mut self, rank: u8) {
        let outside = self.open.last().map_or(0, |open| open.outside);
        while self.waiting.len() > outside {
            let Some(Waiting::Binary(operator)) = self.waiting.last() else {
                return;
            };
            let operator = *operator;
            if operator.rank < rank {
                return;
            }
            self.waiting.pop();
            self.emit_binary(operator.binary);
        }
    }

    fn emit_binary(&mut self, binary: Binary) {
        self.starts.pop();
        let start = self.starts.last().copied().unwrap_or_default();
        let range = TextRange::new(start, self.end);
        Step::push_binary(&mut self.steps, binary, range);
    }

    /// From the first to the second argument of a function: the bracket stays open.
    fn comma(&mut self, binary: Binary) -> bool {
        self.reduce(0);
        self.cursor.bump();
        if let Some(open) = self.open.last_mut() {
            open.bracket = Bracket::Second(binary);
        }
        true
    }

    /// Takes `]`; false unless another operand must follow at once (the second argument of ATAN).
    fn close(&mut self) -> Result<bool, FormulaError> {
        self.reduce(0);
        let Some(open) = self.open.pop() else {
            return Ok(false);
        };
        self.cursor.bump();
        let range = self.cursor.since(open.start);
        self.plain = None;
        match open.bracket {
            Bracket::Plain => self.check(range),
            Bracket::ExistsNamed => {}
            Bracket::Call(unary) => self.steps.push(Step {
                op: Op::Unary(unary),
                range,
            }),
            Bracket::Second(binary) => {
                self.starts.pop();
                Step::push_binary(&mut self.steps, binary, range);
            }
            Bracket::Index(name) => self.steps.push(Step {
                op: Op::NamedAt(name),
                range,
            }),
            Bracket::ExistsNumbered => self.steps.push(Step {
                op: Op::ExistsAt,
                range,
            }),
            Bracket::PowBase => return Self::fail(range, FormulaErrorKind::MissingComma),
            Bracket::First => return self.second_of_atan(open.start, range),
        }
        if let Some(start) = self.starts.last_mut() {
            *start = open.start;
        }
        Ok(false)
    }

    /// Marks the end of a value in brackets where it may be infinite and something continues after it.
    fn check(&mut self, range: TextRange) {
        if !self.open.is_empty() && self.steps.last().is_some_and(Step::is_binary) {
            self.steps.push(Step {
                op: Op::Unary(Unary::Check),
                range,
            });
        }
    }

    /// After `ATAN[y]`: `/[`.
    fn second_of_atan(&mut self, start: u32, call: TextRange) -> Result<bool, FormulaError> {
        let slash = self.cursor.peek() == Some(b'/');
        let bracket = slash && self.cursor.peek_second() == Some(b'[');
        if self.grammar == Grammar::MacroB && !bracket {
            self.steps.push(Step {
                op: Op::Unary(Unary::Atan),
                range: call,
            });
            if let Some(own) = self.starts.last_mut() {
                *own = start;
            }
            return Ok(false);
        }
        if !slash {
            return Self::fail(call, FormulaErrorKind::MissingSlash);
        }
        self.cursor.bump();
        if !bracket {
            return Self::fail(self.cursor.here(), FormulaErrorKind::MissingSecondBracket);
        }
        let binary = match self.grammar {
            Grammar::Rs274 => Binary::Atan2,
            Grammar::MacroB => Binary::MacroAtan2,
        };
        self.open(Bracket::Second(binary), start)?;
        Ok(true)
    }
}
