//! Evaluation: one pass over the postfix code with a small stack of values.
use crate::arithmetic::{binary, checked, is_vacant, unary, vacant, whole};
use crate::code::{Binary, Code, Formula, Op, Step};
use crate::{FormulaError, FormulaErrorKind, Name, ValueError, Variables};

/// Formulas that keep at most this many values at once need no memory.
const SHALLOW: usize = 8;

impl Formula {
    /// The value; NaN if it depends on something that is not known. A `<vacant>` variable of Macro B counts as zero.
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
            Code::Steps { steps, depth } if *depth <= SHALLOW => run(steps, variables, &mut [0.0; SHALLOW]),
            Code::Steps { steps, depth } => run(steps, variables, &mut vec![0.0; *depth]),
        };
        result.map_err(|error| FormulaError {
            range: error.range.shifted(self.range.start),
            ..*error
        })
    }
}

/// Runs the code; `stack` is as long as the compiler counted. Errors are placed from the start of the formula, and are rare: they are
/// held elsewhere, so that a value is handed back in a register.
fn run(steps: &[Step], variables: &(impl Variables + ?Sized), stack: &mut [f64]) -> Result<f64, Box<FormulaError>> {
    let mut height = 0;
    for step in steps {
        let result = match &step.op {
            Op::Number(value) => {
                stack[height] = *value;
                height += 1;
                continue;
            }
            Op::Read(index) => match variables.numbered(*index) {
                Ok(value) => {
                    stack[height] = known(value);
                    height += 1;
                    continue;
                }
                error => of_number(*index, error),
            },
            Op::ReadNullable(index) => nullable(variables, *index),
            Op::Named(name) => match variables.named_as(name) {
                Ok(value) => {
                    stack[height] = known(value);
                    height += 1;
                    continue;
                }
                error => value_of(name, error),
            },
            Op::ExistsNamed(name) => Ok(f64::from(u8::from(variables.exists(name)))),
            Op::Fail(kind) => Err((**kind).clone()),
            Op::Binary(operation) => {
                height -= 2;
                let (a, b) = (stack[height], stack[height + 1]);
                let quick = of_numbers(*operation, a, b);
                if !quick.is_nan() {
                    stack[height] = quick;
                    height += 1;
                    continue;
                }
                // only Macro B's angles ask the control
                binary(*operation, a, b, || variables.positive_angles())
            }
            Op::Unary(operation) => {
                height -= 1;
                unary(*operation, stack[height], || variables.positive_angles())
            }
            on_index => {
                height -= 1;
                at_index(on_index, variables, stack[height])
            }
        };
        match result {
            Ok(value) => stack[height] = value,
            Err(kind) => {
                return Err(Box::new(FormulaError {
                    range: step.range,
                    kind,
                }));
            }
        }
        height += 1;
    }
    let (Some(value), Some(last)) = (stack.first(), steps.last()) else {
        return Ok(f64::NAN);
    };
    checked(*value).map_err(|kind| {
        Box::new(FormulaError {
            range: last.range,
            kind,
        })
    })
}

/// The commonest operations where both values are numbers and the result is one; NaN elsewhere: a number comes out of numbers alone.
#[inline]
fn of_numbers(operation: Binary, a: f64, b: f64) -> f64 {
    match operation {
        Binary::Add => a + b,
        Binary::Subtract => a - b,
        Binary::Multiply => a * b,
        Binary::Divide if b != 0.0 => a / b,
        Binary::Greater | Binary::Less if a < b => f64::from(u8::from(operation == Binary::Less)),
        Binary::Greater | Binary::Less if a > b => f64::from(u8::from(operation == Binary::Greater)),
        _ => f64::NAN,
    }
}

/// A value of a variable; a NaN of any kind is "not known".
#[inline]
fn known(value: f64) -> f64 {
    if value.is_nan() { f64::NAN } else { value }
}

#[inline]
fn numbered(variables: &(impl Variables + ?Sized), index: i64) -> Result<f64, FormulaErrorKind> {
    of_number(index, variables.numbered(index))
}

#[inline]
fn of_number(index: i64, value: Result<f64, ValueError>) -> Result<f64, FormulaErrorKind> {
    match value {
        Ok(value) => Ok(known(value)),
        Err(ValueError::NotReadable(reason)) => Err(FormulaErrorKind::NotReadable(reason)),
        Err(ValueError::OutOfRange | ValueError::NotDefined) => Err(FormulaErrorKind::ParameterOutOfRange(index)),
    }
}

fn nullable(variables: &(impl Variables + ?Sized), index: i64) -> Result<f64, FormulaErrorKind> {
    if index == 0 || variables.null(index) {
        Ok(vacant())
    } else {
        numbered(variables, index)
    }
}

#[inline]
fn value_of(name: &Name, value: Result<f64, ValueError>) -> Result<f64, FormulaErrorKind> {
    match value {
        Ok(value) => Ok(known(value)),
        Err(ValueError::NotReadable(reason)) => Err(FormulaErrorKind::NotReadable(reason)),
        Err(ValueError::OutOfRange | ValueError::NotDefined) => Err(FormulaErrorKind::NotDefined((&**name).into())),
    }
}

/// The steps that take the number of a variable from the stack. Of a number that is not known the variable is not known either.
fn at_index(op: &Op, variables: &(impl Variables + ?Sized), index: f64) -> Result<f64, FormulaErrorKind> {
    let index = if is_vacant(index) { 0.0 } else { index };
    if checked(index)?.is_nan() {
        return Ok(f64::NAN);
    }
    let nearest = match op {
        // Macro B rounds (trade knowledge)
        Op::ReadNullableAt | Op::NamedAt(_) => index.round(),
        _ => index,
    };
    let index = whole(nearest).ok_or(FormulaErrorKind::NotInteger(index))?;
    match op {
        Op::ReadAt => numbered(variables, index),
        Op::ReadNullableAt => nullable(variables, index),
        Op::NamedAt(name) => value_of(name, variables.named_at(name, index)),
        _ => Ok(f64::from(u8::from(variables.exists_numbered(index)))),
    }
}
