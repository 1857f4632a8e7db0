//! From text to postfix code, without recursion: open brackets and pending operators are on stacks.
use crate::brackets::{Bracket, Compiler, Waiting};
use crate::code::{Code, Formula, Op, Step};
use crate::cursor::is_blank;
use crate::words::{Function, take_angled, take_function, take_name, take_numeral};
use crate::{Cursor, FormulaError, FormulaErrorKind, Grammar, Name, Target};
use smallvec::SmallVec;
use trunnion_syntax::{Decimal, TextRange};

/// Reads one value: a number, `#` parameter, `[expression]`, function, or any of them after signs.
///
/// The cursor comes after the value, or where reading stopped.
pub fn value(cursor: &mut Cursor<'_>, grammar: Grammar) -> Result<Formula, FormulaError> {
    match value_or_error(cursor, grammar) {
        (formula, None) => Ok(formula),
        (_, Some(error)) => Err(error),
    }
}

/// Like [`value`], but always returns a formula: evaluated, it gives the first error of a control that computes while it reads
/// (LinuxCNC): `[1/0 + ]` is a division by zero before it is a missing value.
pub fn value_or_error(cursor: &mut Cursor<'_>, grammar: Grammar) -> (Formula, Option<FormulaError>) {
    value_with(cursor, grammar, &mut Vec::new())
}

/// [`value_or_error`] with storage from a pool.
pub(crate) fn value_with(
    cursor: &mut Cursor<'_>,
    grammar: Grammar,
    pool: &mut Vec<Vec<Step>>,
) -> (Formula, Option<FormulaError>) {
    let start = cursor.at();
    if let Some(number) = plain_number(cursor) {
        return (number, None);
    }
    let mut compiler = Compiler {
        cursor,
        grammar,
        steps: pool.pop().unwrap_or_default(),
        waiting: SmallVec::new(),
        open: SmallVec::new(),
        starts: SmallVec::new(),
        depth: 0,
        end: start,
        plain: None,
    };
    let error = compiler.run().err();
    if let Some(error) = &error {
        compiler.steps.push(Step {
            op: Op::Fail(Box::new(error.kind.clone())),
            range: error.range,
        });
    }
    let formula = compiler.finish(start);
    if !compiler.steps.is_empty() {
        // it was a number and nothing else
        compiler.steps.clear();
        pool.push(compiler.steps);
    }
    (formula, error)
}

/// Reads a condition or expression in brackets: `[#1 GT 2]`.
pub fn bracketed(cursor: &mut Cursor<'_>, grammar: Grammar) -> Result<Formula, FormulaError> {
    if cursor.peek() == Some(b'[') {
        return value(cursor, grammar);
    }
    Err(FormulaError {
        range: cursor.here(),
        kind: FormulaErrorKind::MissingBracket,
    })
}

/// Reads what follows the `#` of an assignment: a number, `#`, `[expression]`, `<name>`, Macro B `_NAME`.
pub fn target(cursor: &mut Cursor<'_>, grammar: Grammar) -> Result<Target, FormulaError> {
    match take_variable_name(cursor, grammar, cursor.at())? {
        Some(name) => Ok(Target::Named(name)),
        None => value(cursor, grammar).map(Target::Numbered),
    }
}

/// The name of a variable at the cursor, if the grammar has named ones and there is one.
fn take_variable_name(cursor: &mut Cursor<'_>, grammar: Grammar, hash: u32) -> Result<Option<Name>, FormulaError> {
    match (grammar, cursor.peek()) {
        (Grammar::Rs274, Some(b'<')) => match take_angled(cursor) {
            Some(name) => Ok(Some(name)),
            None => Err(FormulaError {
                range: TextRange::new(hash, cursor.at() + 1),
                kind: FormulaErrorKind::UnclosedName,
            }),
        },
        (Grammar::MacroB, Some(b'_' | b'a'..=b'z')) => Ok(Some(take_name(cursor))),
        _ => Ok(None),
    }
}

/// The shortest path for what most values are: an unsigned or signed number without blanks.
#[inline]
fn plain_number(cursor: &mut Cursor<'_>) -> Option<Formula> {
    let rest = cursor.rest();
    let sign = usize::from(matches!(rest.first(), Some(b'-' | b'+')));
    let digits = rest[sign..]
        .iter()
        .position(|byte| !byte.is_ascii_digit() && *byte != b'.')
        .unwrap_or(rest.len() - sign);
    if digits == 0 {
        return None;
    }
    let length = sign + digits;
    if rest.get(length).copied().is_some_and(is_blank) && continues(&rest[length..]) {
        return None;
    }
    let decimal = Decimal::parse(&rest[..length])?;
    let start = cursor.at();
    let end = start + length as u32;
    cursor.skip_to(end);
    Some(Formula {
        range: TextRange::new(start, end),
        code: Code::Literal {
            value: signed(decimal, rest[0] == b'-'),
            decimal: Some(decimal),
        },
    })
}

/// The value with its sign, which a decimal does not keep of `-0`.
#[inline]
fn signed(decimal: Decimal, negative: bool) -> f64 {
    if decimal.mantissa == 0 && negative {
        -0.0
    } else {
        decimal.to_f64()
    }
}

/// The name before a bracket at the cursor, or the letter there alone.
fn called(mut cursor: Cursor<'_>) -> TextRange {
    let letter = cursor.here();
    while cursor.peek().is_some_and(|byte| byte.is_ascii_alphabetic()) {
        cursor.bump();
    }
    if cursor.peek() == Some(b'[') {
        cursor.since(letter.start)
    } else {
        letter
    }
}

/// Whether a number continues after the blanks at the start of `rest`.
fn continues(rest: &[u8]) -> bool {
    rest.iter()
        .find(|byte| !is_blank(**byte))
        .is_some_and(|byte| byte.is_ascii_digit() || *byte == b'.')
}

impl Compiler<'_, '_> {
    pub(crate) fn fail<T>(range: TextRange, kind: FormulaErrorKind) -> Result<T, FormulaError> {
        Err(FormulaError { range, kind })
    }

    fn run(&mut self) -> Result<(), FormulaError> {
        loop {
            if !self.operand()? {
                continue;
            }
            loop {
                self.apply_signs();
                if self.open.is_empty() {
                    return Ok(());
                }
                if self.after_operand()? {
                    break;
                }
            }
        }
    }

    fn finish(&mut self, start: u32) -> Formula {
        let range = self.cursor.since(start);
        if let (1, Some((value, decimal))) = (self.steps.len(), self.plain) {
            return Formula {
                range,
                code: Code::Literal { value, decimal },
            };
        }
        for step in &mut self.steps {
            step.range = step.range.shifted(range.start.wrapping_neg());
        }
        Formula {
            range,
            code: Code::Steps {
                steps: core::mem::take(&mut self.steps),
                depth: self.depth,
            },
        }
    }

    /// Reads a sign, the opening of a bracket, or a whole operand; whether it was a whole operand.
    fn operand(&mut self) -> Result<bool, FormulaError> {
        let start = self.cursor.at();
        let Some(byte) = self.cursor.peek() else {
            return Self::fail(self.cursor.here(), FormulaErrorKind::MissingValue);
        };
        match byte {
            b'[' => {
                self.open(Bracket::Plain, start)?;
                Ok(false)
            }
            b'#' => self.parameter(),
            b'+' | b'-' if !self.sign_of_number() => {
                self.cursor.bump();
                self.waiting.push(if byte == b'-' {
                    Waiting::Negate(start)
                } else {
                    Waiting::Plus(start)
                });
                Ok(false)
            }
            b'a'..=b'z' => self.function(),
            _ => {
                self.number()?;
                Ok(true)
            }
        }
    }

    /// Whether the sign at the cursor belongs to a number (or to nothing, at the end of the line).
    fn sign_of_number(&self) -> bool {
        match self.cursor.peek_second() {
            None => true,
            Some(next) => next.is_ascii_digit() || next == b'.',
        }
    }

    fn number(&mut self) -> Result<(), FormulaError> {
        let start = self.cursor.at();
        if let Some(Formula {
            range,
            code: Code::Literal { value, decimal },
        }) = plain_number(self.cursor)
        {
            self.plain = Some((value, decimal));
            self.push(Op::Number(value), start, range);
            return Ok(());
        }
        let digits = take_numeral(self.cursor);
        let range = self.cursor.since(start);
        let points = digits.bytes().filter(|byte| *byte == b'.').count();
        if !digits.bytes().any(|byte| byte.is_ascii_digit()) {
            let range = if digits.is_empty() { self.cursor.here() } else { range };
            return Self::fail(range, FormulaErrorKind::NotANumber { text: digits.into() });
        }
        if points > 1 {
            return Self::fail(range, FormulaErrorKind::TwoPoints { text: digits.into() });
        }
        let decimal = Decimal::parse(digits.as_bytes());
        let value = match decimal {
            Some(decimal) => signed(decimal, digits.starts_with('-')),
            None => digits.parse().unwrap_or(f64::NAN),
        };
        self.plain = Some((value, decimal));
        self.push(Op::Number(value), start, range);
        Ok(())
    }

    fn parameter(&mut self) -> Result<bool, FormulaError> {
        let start = self.cursor.at();
        self.cursor.bump();
        let Some(name) = take_variable_name(self.cursor, self.grammar, start)? else {
            self.waiting.push(Waiting::Read(start));
            return Ok(false);
        };
        if self.grammar == Grammar::MacroB && self.cursor.peek() == Some(b'[') {
            self.open(Bracket::Index(name), start)?;
            return Ok(false);
        }
        let range = self.cursor.since(start);
        self.push(Op::Named(name), start, range);
        Ok(true)
    }

    fn function(&mut self) -> Result<bool, FormulaError> {
        let start = self.cursor.at();
        let Some(function) = take_function(self.cursor, self.grammar) else {
            let letter = self.cursor.peek().map_or(' ', char::from);
            return Self::fail(called(*self.cursor), FormulaErrorKind::UnknownFunction(letter));
        };
        if self.cursor.peek() != Some(b'[') {
            return Self::fail(self.cursor.since(start), FormulaErrorKind::MissingBracket);
        }
        match function {
            Function::One(unary) => self.open(Bracket::Call(unary), start)?,
            Function::Atan => self.open(Bracket::First, start)?,
            Function::Pow => self.open(Bracket::PowBase, start)?,
            Function::Exists => return self.exists(start),
        }
        Ok(false)
    }

    /// `EXISTS[#<name>]`: the cursor is at `[`. A named parameter is read at once, a numbered one as a value in brackets.
    fn exists(&mut self, start: u32) -> Result<bool, FormulaError> {
        self.open(Bracket::ExistsNumbered, start)?;
        let hash = self.cursor.at();
        if !self.cursor.eat(b'#') {
            return Self::fail(self.cursor.here(), FormulaErrorKind::MissingParameter);
        }
        let Some(name) = take_variable_name(self.cursor, self.grammar, hash)? else {
            return Ok(false);
        };
        if let Some(open) = self.open.last_mut() {
            open.bracket = Bracket::ExistsNamed;
        }
        let range = self.cursor.since(hash);
        self.push(Op::ExistsNamed(name), hash, range);
        Ok(true)
    }
}
