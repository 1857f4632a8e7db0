//! Variables and short forms to read and evaluate.
use trunnion_formula::{Cursor, Formula, FormulaError, Grammar, ValueError, Variables, value, value_or_error};
use trunnion_syntax::TextRange;

/// Variables 1 to 5601, zero unless set, and a few named ones; #200 is unknown, #100 to #149 are vacant.
#[derive(Default)]
pub(crate) struct Table {
    pub(crate) values: Vec<(i64, f64)>,
    pub(crate) principal_angles: bool,
    pub(crate) open_angles: bool,
}

impl Variables for Table {
    fn numbered(&self, index: i64) -> Result<f64, ValueError> {
        match index {
            200 => Ok(f64::NAN),
            1..=5601 => Ok(self
                .values
                .iter()
                .find(|(own, _)| *own == index)
                .map_or(0.0, |own| own.1)),
            _ => Err(ValueError::OutOfRange),
        }
    }
    fn named(&self, name: &str) -> Result<f64, ValueError> {
        match name {
            "_vmajor" => Ok(2.9),
            "unknown" => Ok(f64::NAN),
            "_hal[x]" => Err(ValueError::NotReadable("no HAL pins here".into())),
            _ => Err(ValueError::NotDefined),
        }
    }
    fn named_at(&self, name: &str, index: i64) -> Result<f64, ValueError> {
        match name {
            "_absio" => Ok(10.0 * index as f64),
            _ => Err(ValueError::NotDefined),
        }
    }
    fn exists(&self, name: &str) -> bool {
        self.named(name).is_ok()
    }
    fn null(&self, index: i64) -> bool {
        (100..150).contains(&index)
    }
    fn positive_angles(&self) -> Option<bool> {
        (!self.open_angles).then_some(!self.principal_angles)
    }
}

pub(crate) fn whole(text: &str) -> TextRange {
    TextRange::new(0, text.len() as u32)
}

/// The formula `text` is, to its last sign.
pub(crate) fn read(text: &str, grammar: Grammar) -> Result<Formula, FormulaError> {
    let mut cursor = Cursor::new(text.as_bytes(), whole(text));
    let formula = value(&mut cursor, grammar)?;
    assert!(cursor.is_at_end(), "{text}: stopped at {}", cursor.at());
    Ok(formula)
}

/// The value of `text`, in the order in which a control meets errors that computes while it reads.
pub(crate) fn eval(text: &str, grammar: Grammar, table: &Table) -> Result<f64, FormulaError> {
    let mut cursor = Cursor::new(text.as_bytes(), whole(text));
    let (formula, error) = value_or_error(&mut cursor, grammar);
    assert!(
        error.is_some() || cursor.is_at_end(),
        "{text}: stopped at {}",
        cursor.at()
    );
    formula.eval(table)
}

/// The error of `text` with the part of it that is wrong.
pub(crate) fn refused(text: &str, grammar: Grammar) -> (String, String) {
    let error = eval(text, grammar, &Table::default()).expect_err(text);
    (error.to_string(), text[error.range.as_usize()].to_owned())
}
