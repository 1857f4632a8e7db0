//! Evaluates expressions with the known variables of a run.
use super::alarms::{Mistake, rejected};
use super::system::Known;
use super::variables::{Class, Held, Variables, class};
use crate::{FaultKind, Refusal};
use std::cell::Cell;
use std::collections::HashMap;
use trunnion_dialect::Dialect;
use trunnion_formula::{Cursor, Formula, FormulaError, FormulaErrorKind, Grammar, Target, ValueError};
use trunnion_syntax::{Program, TextRange};

/// Where an expression is, which decides how it is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    /// After a letter: `#1`, `[#1+2]`, `-#1`, `SIN[30]`.
    Value,
    /// Of IF and WHILE: in brackets.
    Condition,
    /// After `=`: operators may be outside of brackets.
    Whole,
}

/// A place and what is wrong there.
pub(crate) type Trouble = (TextRange, FaultKind);

/// Compiled expressions by file and offset. A clone starts empty: it is quicker to compile again than to copy.
#[derive(Debug, Default)]
pub(crate) struct Compiled(HashMap<(u16, u32), Ready>);

/// Expressions kept; programs with more compile the rest each time.
const KEPT: usize = 4096;

impl Clone for Compiled {
    fn clone(&self) -> Self {
        Self::default()
    }
}

/// The source of a formula's variables.
pub(crate) struct View<'a> {
    pub(crate) variables: &'a Variables,
    pub(crate) known: Known<'a>,
    /// The first variable that was read and is unknown.
    pub(crate) unknown: Cell<Option<i64>>,
    /// A named variable was read that is unknown.
    pub(crate) unknown_name: Cell<bool>,
    /// ASIN or ATAN gave an angle below zero, and nothing says what the control makes of it.
    pub(crate) open_angle: Cell<bool>,
    /// A variable of the control was read, whose value changes without being assigned.
    pub(crate) asked_control: Cell<bool>,
}

impl trunnion_formula::Variables for View<'_> {
    fn numbered(&self, index: i64) -> Result<f64, ValueError> {
        let value = match (self.variables.get(index), class(index)) {
            (Some(held), _) => held.unwrap_or(0.0),
            (None, Class::System(number)) => {
                self.asked_control.set(true);
                let known = self.known.read(number);
                if known.is_nan() {
                    self.variables.of_control(number).unwrap_or(0.0)
                } else {
                    known
                }
            }
            _ => return Err(ValueError::OutOfRange),
        };
        if value.is_nan() && self.unknown.get().is_none() {
            self.unknown.set(Some(index));
        }
        Ok(value)
    }
    fn named(&self, name: &str) -> Result<f64, ValueError> {
        let value = self.variables.named(name).unwrap_or(f64::NAN);
        self.unknown_name.set(self.unknown_name.get() || value.is_nan());
        Ok(value)
    }
    fn named_at(&self, _: &str, _: i64) -> Result<f64, ValueError> {
        self.unknown_name.set(true);
        Ok(f64::NAN)
    }
    fn exists(&self, name: &str) -> bool {
        self.variables.named(name).is_some()
    }
    fn positive_angles(&self) -> Option<bool> {
        let declared = self.known.setup.control.positive_angles;
        self.open_angle.set(self.open_angle.get() || declared.is_none());
        declared
    }
    fn null(&self, index: i64) -> bool {
        match class(index) {
            Class::System(number) => self.variables.of_control(number).is_none(),
            _ => matches!(self.variables.get(index), Some(None)),
        }
    }
}

/// Why an angle is not known.
const OPEN_ANGLE: &str = "an angle of ASIN or ATAN below zero: a parameter of the control (Fanuc: 6004 bit 0, NAT) decides whether it is \
                          negative or between 180 and 360 deg (declare [control] positive_angles)";

impl View<'_> {
    /// Why the value that was just computed is unknown.
    pub(crate) fn reason(&self, text: &str) -> String {
        match self.unknown.get() {
            Some(index) => self.variables.reason(index),
            None if self.open_angle.get() => OPEN_ANGLE.to_owned(),
            None if self.unknown_name.get() => format!("{text}: a named variable with an unknown value"),
            None => text.to_owned(),
        }
    }
}

/// A compiled expression, and what to add to its ranges: one without brackets around it is compiled with them.
type Ready = (Formula, i64);

/// An expression of the program, compiled.
fn compile(program: &Program, range: TextRange, form: Form) -> Result<Ready, FormulaError> {
    let mut cursor = Cursor::new(program.source(), range);
    let formula = match form {
        Form::Condition => trunnion_formula::bracketed(&mut cursor, Grammar::MacroB),
        Form::Value | Form::Whole => trunnion_formula::value(&mut cursor, Grammar::MacroB),
    };
    match (formula, cursor.peek()) {
        (Ok(formula), None) => Ok((formula, 0)),
        (Ok(_), Some(_)) if form == Form::Whole => in_brackets(program, range),
        (Ok(_), Some(letter)) => Err(FormulaError {
            range: TextRange::new(cursor.at(), cursor.at() + 1),
            kind: FormulaErrorKind::UnknownOperator(letter.is_ascii_alphabetic().then(|| char::from(letter))),
        }),
        (Err(error), _) => Err(error),
    }
}

/// `#1+2`: operators outside of brackets, which only the right side of an assignment may have.
fn in_brackets(program: &Program, range: TextRange) -> Result<Ready, FormulaError> {
    let mut text = vec![b'['];
    text.extend_from_slice(program.bytes(range));
    text.push(b']');
    let shift = i64::from(range.start) - 1;
    let inside = TextRange::new(0, text.len() as u32);
    trunnion_formula::bracketed(&mut Cursor::new(&text, inside), Grammar::MacroB)
        .map(|formula| (formula, shift))
        .map_err(|error| shifted(error, shift))
}

/// The error with its place in the file.
fn shifted(mut error: FormulaError, shift: i64) -> FormulaError {
    let place = |offset: u32| u32::try_from(i64::from(offset) + shift).unwrap_or(0);
    error.range = TextRange::new(place(error.range.start), place(error.range.end));
    error
}

/// Reads an expression without evaluating it: what is wrong with its text.
pub(crate) fn only_read(dialect: &Dialect, program: &Program, range: TextRange, form: Form) -> Result<(), Trouble> {
    compile(program, range, form)
        .map(drop)
        .map_err(|error| trouble(dialect, program, range, &error))
}

/// The value of an expression: `None` is `<vacant>`, NaN unknown.
pub(crate) fn evaluate(
    dialect: &Dialect,
    (program, file): (&Program, u16),
    (range, form): (TextRange, Form),
    compiled: &mut Compiled,
    view: &View<'_>,
) -> Result<Held, Trouble> {
    let wrong = |error: &FormulaError| trouble(dialect, program, range, error);
    let run = |ready: &Ready| {
        let value = ready.0.eval_nullable(view);
        value.map_err(|error| wrong(&shifted(error, ready.1)))
    };
    let key = (file, range.start);
    if let Some(ready) = compiled.0.get(&key) {
        return run(ready);
    }
    let ready = compile(program, range, form).map_err(|error| wrong(&error))?;
    let value = run(&ready);
    if compiled.0.len() < KEPT {
        compiled.0.insert(key, ready);
    }
    value
}

/// The variable that an assignment names: its number (`None`: unknown), or its name.
pub(crate) enum Assigned {
    Number(Option<i64>),
    Name(Box<str>),
}

/// Reads and evaluates the left side of an assignment, `#` included.
pub(crate) fn assigned(
    dialect: &Dialect,
    program: &Program,
    range: TextRange,
    view: &View<'_>,
) -> Result<Assigned, Trouble> {
    let mut cursor = Cursor::new(program.source(), range);
    cursor.bump();
    let wrong = |error: &FormulaError| trouble(dialect, program, range, error);
    match trunnion_formula::target(&mut cursor, Grammar::MacroB).map_err(|error| wrong(&error))? {
        Target::Named(name) => Ok(Assigned::Name((&*name).into())),
        Target::Numbered(formula) => {
            let held = formula.eval_nullable(view).map_err(|error| wrong(&error))?;
            let number = held.unwrap_or(0.0);
            if number.is_nan() {
                return Ok(Assigned::Number(None));
            }
            // a control rounds the number of a variable
            Ok(Assigned::Number(Some(number.round() as i64)))
        }
    }
}

/// At most this much of an expression is quoted in a message, characters.
const QUOTED: usize = 80;

/// A mistake of an expression as a fact.
fn trouble(dialect: &Dialect, program: &Program, whole: TextRange, error: &FormulaError) -> Trouble {
    use FormulaErrorKind as Kind;
    let mistake = match &error.kind {
        Kind::DivisionByZero | Kind::NoTangent => Mistake::DividedByZero,
        Kind::Infinite | Kind::Undefined => Mistake::Overflow,
        Kind::ParameterOutOfRange(_) | Kind::NotInteger(_) | Kind::NotDefined(_) | Kind::NotReadable(_) => {
            Mistake::VariableNumber
        }
        Kind::TooDeep { .. } => Mistake::Brackets,
        Kind::NegativeRoot
        | Kind::AcosRange
        | Kind::AsinRange
        | Kind::LogarithmRange
        | Kind::NegativePower
        | Kind::NotDecimalCoded => Mistake::FunctionRange,
        _ => Mistake::Format,
    };
    let inside =
        error.range.start >= whole.start && error.range.end <= whole.end && error.range.start < error.range.end;
    let range = if inside { error.range } else { whole };
    let text = program.text(whole);
    let text = text.trim();
    let message = match text.char_indices().nth(QUOTED) {
        Some((end, _)) => format!("{error} in `{}...`", &text[..end]),
        None => format!("{error} in `{text}`"),
    };
    (range, rejected(dialect, mistake, Refusal::Expression, message))
}
