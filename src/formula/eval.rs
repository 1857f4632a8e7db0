//! Evaluation: one pass over the postfix code with a small stack of values.
use crate::arithmetic::{binary, checked, is_vacant, unary, vacant, whole};
use crate::code::{Code, Formula, Op, Step};
use crate::{FormulaError, FormulaErrorKind, Name, ValueError, Variables};

/// Formulas that keep at most this many values at once need no memory.
const SHALLOW: usize = 8;

impl Formula {
    /// The value; NaN if it depends on something unknown. A `<vacant>` variable of Macro B is taken as zero.
    #[inline]
    pub fn eval(&self, variables: &(impl Variables + ?Sized)) -> Result<f64, FormulaError> {
        let value = self.run(variables)?;
        Ok(if is_vacant(value) { 0.0 } else { value })
    }

    /// The value as Macro B has it: `None` if the formula is a `<vacant>` variable and nothing else (`#2=#1`, `X#1`). In arithmetic
    /// `<vacant>` is zero.
    #[inline]
    pub fn eval_nullable(&self, variables: &(impl Variables + ?Sized)) -> Result<Option<f64>, FormulaError> {
        let value = self.run(variables)?;
        Ok((!is_vacant(value)).then_some(value))
    }

    #[inline]
    fn run(&self, variables: &(impl Variables + ?Sized)) -> Result<f64, FormulaError> {
        let result = match &self.code {
            Code::Literal { value, .. } => return Ok(*value),
            Code::Steps { steps, depth } if *depth <= SHALLOW => run::<[f64; SHALLOW]>(steps, variables, *depth),
            Code::Steps { steps, depth } => run::<Vec<f64>>(steps, variables, *depth),
        };
        result.map_err(|error| FormulaError {
            range: error.range.shifted(self.range.start),
            ..*error
        })
    }
}

/// Room for pending values.
trait Room {
    fn of(depth: usize) -> Self;
    fn at(&mut self, height: usize) -> &mut f64;
}

impl Room for [f64; SHALLOW] {
    #[inline]
    fn of(_: usize) -> Self {
        [0.0; SHALLOW]
    }
    /// Heights are below the size, which the remainder says to the compiler.
    #[inline]
    fn at(&mut self, height: usize) -> &mut f64 {
        &mut self[height % SHALLOW]
    }
}

impl Room for Vec<f64> {
    fn of(depth: usize) -> Self {
        vec![0.0; depth]
    }
    #[inline]
    fn at(&mut self, height: usize) -> &mut f64 {
        &mut self[height]
    }
}

/// The stack of values; the last one is kept in a variable, and what that held before the first one is at the bottom.
struct Stack<R> {
    waiting: R,
    height: usize,
    last: f64,
}

impl<R: Room> Stack<R> {
    #[inline]
    fn push(&mut self, value: f64) {
        *self.waiting.at(self.height) = self.last;
        self.height += 1;
        self.last = value;
    }
    /// Takes the value before the last one.
    #[inline]
    fn before_last(&mut self) -> f64 {
        self.height -= 1;
        *self.waiting.at(self.height)
    }
}

/// Runs the code; `depth`: how many values the compiler counted. Errors are placed from the start of the formula, and are rare: they are
/// stored separately, so that a value is returned in a register.
fn run<R: Room>(steps: &[Step], variables: &(impl Variables + ?Sized), depth: usize) -> Result<f64, Box<FormulaError>> {
    let mut stack = Stack {
        waiting: R::of(depth),
        height: 0,
        last: f64::NAN,
    };
    for step in steps {
        let failed = |kind| failure(step, kind);
        let (operation, first, second) = match &step.op {
            Op::WithNumber(operation, number) => (*operation, stack.last, *number),
            Op::Binary(operation) => (*operation, stack.before_last(), stack.last),
            Op::Number(value) => {
                stack.push(*value);
                continue;
            }
            Op::Read(index) => {
                match variables.numbered(*index) {
                    Ok(value) => stack.push(known(value)),
                    Err(error) => return Err(failed(no_number(*index, error))),
                }
                continue;
            }
            Op::Named(name) => {
                match variables.named_as(name) {
                    Ok(value) => stack.push(known(value)),
                    Err(error) => return Err(failed(no_value(name, error))),
                }
                continue;
            }
            Op::Unary(operation) => {
                let value = unary(*operation, stack.last, &|| variables.positive_angles());
                stack.last = value.map_err(failed)?;
                continue;
            }
            Op::ReadNullable(index) => {
                stack.push(nullable(variables, *index).map_err(failed)?);
                continue;
            }
            Op::ExistsNamed(name) => {
                stack.push(f64::from(u8::from(variables.exists(name))));
                continue;
            }
            Op::Bound => {
                let most = stack.before_last();
                let least = stack.before_last();
                stack.last = crate::sinumerik::bound(least, most, stack.last);
                continue;
            }
            Op::Fail(kind) => return Err(failed((**kind).clone())),
            on_index => {
                stack.last = at_index(on_index, variables, stack.last).map_err(failed)?;
                continue;
            }
        };
        // only Macro B's angles depend on the control
        stack.last = binary(operation, first, second, &|| variables.positive_angles()).map_err(failed)?;
    }
    let Some(last) = steps.last() else {
        return Ok(f64::NAN);
    };
    checked(stack.last).map_err(|kind| failure(last, kind))
}

/// The error of a step.
#[cold]
#[inline(never)]
#[expect(clippy::unnecessary_box_returns, reason = "a value is handed back in a register")]
fn failure(step: &Step, kind: FormulaErrorKind) -> Box<FormulaError> {
    let range = step.range;
    Box::new(FormulaError { range, kind })
}

/// A value of a variable; a NaN of any kind means "unknown".
#[inline]
fn known(value: f64) -> f64 {
    if value.is_nan() { f64::NAN } else { value }
}

#[inline]
fn numbered(variables: &(impl Variables + ?Sized), index: i64) -> Result<f64, FormulaErrorKind> {
    match variables.numbered(index) {
        Ok(value) => Ok(known(value)),
        Err(error) => Err(no_number(index, error)),
    }
}

/// Why a number has no variable to read.
#[cold]
#[inline(never)]
fn no_number(index: i64, error: ValueError) -> FormulaErrorKind {
    match error {
        ValueError::NotReadable(reason) => FormulaErrorKind::NotReadable(reason),
        ValueError::OutOfRange | ValueError::NotDefined => FormulaErrorKind::ParameterOutOfRange(index),
    }
}

#[inline(never)]
fn nullable(variables: &(impl Variables + ?Sized), index: i64) -> Result<f64, FormulaErrorKind> {
    if index == 0 || variables.null(index) {
        Ok(vacant())
    } else {
        numbered(variables, index)
    }
}

/// Why a name has no value.
#[cold]
#[inline(never)]
fn no_value(name: &Name, error: ValueError) -> FormulaErrorKind {
    match error {
        ValueError::NotReadable(reason) => FormulaErrorKind::NotReadable(reason),
        ValueError::OutOfRange | ValueError::NotDefined => FormulaErrorKind::NotDefined((&**name).into()),
    }
}

/// The steps that take the number of a variable from the stack. If the number is unknown, so is the variable.
#[inline(never)]
fn at_index(op: &Op, variables: &(impl Variables + ?Sized), index: f64) -> Result<f64, FormulaErrorKind> {
    let index = if is_vacant(index) { 0.0 } else { index };
    if checked(index)?.is_nan() {
        return Ok(f64::NAN);
    }
    let nearest = match op {
        // Macro B rounds (trade knowledge)
        Op::ReadNullableAt => index.round(),
        Op::NamedAt(_) if variables.rounds_index() => index.round(),
        _ => index,
    };
    let index = whole(nearest).ok_or(FormulaErrorKind::NotInteger(index))?;
    match op {
        Op::ReadAt => numbered(variables, index),
        Op::ReadNullableAt => nullable(variables, index),
        Op::NamedAt(name) => match variables.named_at(name, index) {
            Ok(value) => Ok(known(value)),
            Err(error) => Err(no_value(name, error)),
        },
        _ => Ok(f64::from(u8::from(variables.exists_numbered(index)))),
    }
}
