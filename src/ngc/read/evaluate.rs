//! From a parsed line to values in their places. The control computes while it reads: the first error in reading order is its error.
use super::codes::{CANCEL, g_group, m_group};
use super::line::{Assignment, Item, Line, WordText};
use super::problems;
use crate::parameters::{Slot, Values};
use crate::{Block, Engine, Error, Problem};
use trunnion_formula::{Formula, FormulaError, FormulaErrorKind, Name, Target, ValueError, Variables};
use trunnion_syntax::TextRange;

/// Evaluates the line's words into `block`; assignments are evaluated for their errors and take effect with [`apply`].
///
/// # Errors
/// The first error in reading order: of the text, of a value, or of a code.
#[inline]
pub(crate) fn evaluate(line: &Line, values: &Values<'_>, block: &mut Block) -> Result<(), Error> {
    block.clear(line.range);
    block.number = line.number;
    for item in &line.items {
        match *item {
            Item::Word(index) => word(&line.words[index as usize], line, values, block)?,
            Item::Assignment(index) => {
                let assignment = &line.assignments[index as usize];
                let values = created(line, index + 1, values);
                slot(assignment, &values)?;
                value(&assignment.value, &values)?;
            }
            Item::Error(index) => return Err(line.errors[index as usize].clone()),
        }
    }
    Ok(())
}

/// All errors of a line in reading order: of the text, of values and of codes. Undecided values are not errors.
#[cold]
pub(crate) fn errors(line: &Line, values: &Values<'_>, block: &mut Block) -> Vec<Error> {
    block.clear(line.range);
    let mut found = line.errors.clone();
    for item in &line.items {
        let result = match *item {
            Item::Word(index) => word(&line.words[index as usize], line, values, block),
            Item::Assignment(index) => {
                let assignment = &line.assignments[index as usize];
                let values = created(line, index + 1, values);
                let slot = slot(assignment, &values).map(drop);
                slot.and_then(|()| value(&assignment.value, &values).map(drop))
            }
            Item::Error(_) => Ok(()),
        };
        let known = |error: &Error| found.iter().any(|other| other.range == error.range);
        if let Err(error) = result
            && error.problem != &problems::UNDECIDED
            && !known(&error)
        {
            found.push(error);
        }
    }
    found
}

/// Sets the parameters of a line, all at once: each right side has the values from before the line.
///
/// # Errors
/// A name that programs can only read: the control detects it when it sets it, after its checks of the block.
pub(crate) fn apply(engine: &mut Engine, line: &Line) -> Result<(), Error> {
    match &line.assignments[..] {
        [] => Ok(()),
        [one] => {
            let values = Values::new(engine);
            let values = created(line, 1, &values);
            let (slot, value) = (slot(one, &values)?, value(&one.value, &values)?);
            set(engine, one, slot, value)
        }
        many => {
            let mut results = Vec::with_capacity(many.len());
            let values = Values::new(engine);
            for (index, assignment) in many.iter().enumerate() {
                let values = created(line, index as u32 + 1, &values);
                results.push((slot(assignment, &values)?, value(&assignment.value, &values)?));
            }
            for (assignment, (slot, value)) in many.iter().zip(results) {
                set(engine, assignment, slot, value)?;
            }
            Ok(())
        }
    }
}

/// Whether a name is that of a number in the INI file; one that is not there is a parameter like others.
fn is_of_ini(engine: &Engine, name: &str) -> bool {
    let inside = name.strip_prefix("_ini[").and_then(|inside| inside.split_once(']'));
    inside.is_some_and(|(section, key)| {
        let number = engine
            .setup
            .ini
            .number(&section.to_ascii_uppercase(), &key.to_ascii_uppercase());
        number.is_some()
    })
}

/// In a check the INI file is not known.
const OF_INI: crate::Problem = crate::Problem {
    class: crate::Class::NotModelled,
    message: "assigning to a number of the INI file",
    help: "Choose a name that does not begin with `_ini[`.",
};

fn set(engine: &mut Engine, assignment: &Assignment, slot: Option<Slot>, value: f64) -> Result<(), Error> {
    match (&assignment.target, slot) {
        (Target::Numbered(_), Some(slot)) => engine.store.set(slot, value),
        (Target::Numbered(_), None) => engine.store.forget(),
        (Target::Named(name), _) if Values::is_system(name) || is_of_ini(engine, name) => {
            let text = format!("Cannot assign to read-only parameter #<{name}>");
            return Err(Error::with(&problems::READ_ONLY_NAME, assignment.target_range, text));
        }
        (Target::Named(name), _) if engine.setup.any_ini && name.starts_with("_ini[") => {
            // a name that the INI file does not have is a parameter like others
            let text = format!(
                "assigning to #<{name}>: an error where the INI file has this number, and that file is not known here"
            );
            return Err(Error::with(&OF_INI, assignment.target_range, text));
        }
        (Target::Named(name), _) => engine.store.set_named(name, value),
    }
    Ok(())
}

/// The values for the control at an item of a line: names that are set before it on the same line exist, with zero, and so does
/// the one that is being set.
struct Created<'a> {
    values: &'a Values<'a>,
    before: &'a [Assignment],
}

fn created<'a>(line: &'a Line, index: u32, values: &'a Values<'a>) -> Created<'a> {
    Created {
        values,
        before: &line.assignments[..index as usize],
    }
}

impl Created<'_> {
    fn makes(&self, name: &str) -> bool {
        self.before
            .iter()
            .any(|assignment| matches!(&assignment.target, Target::Named(own) if **own == *name))
    }
}

impl Variables for Created<'_> {
    fn numbered(&self, index: i64) -> Result<f64, ValueError> {
        self.values.numbered(index)
    }
    fn named(&self, name: &str) -> Result<f64, ValueError> {
        match self.values.named(name) {
            Err(ValueError::NotDefined) if self.makes(name) => Ok(0.0),
            other => other,
        }
    }
    #[inline]
    fn named_as(&self, name: &Name) -> Result<f64, ValueError> {
        match self.values.named_as(name) {
            Err(ValueError::NotDefined) if self.makes(name) => Ok(0.0),
            other => other,
        }
    }
    fn exists(&self, name: &str) -> bool {
        self.values.exists(name) || self.makes(name)
    }
}

#[inline]
fn value(formula: &Formula, variables: &impl Variables) -> Result<f64, Error> {
    if let Some(number) = formula.number() {
        return Ok(number);
    }
    formula.eval(variables).map_err(|error| problems::formula(&error))
}

/// The target of a numbered assignment; `None` for a name, and where the number is unknown.
fn slot(assignment: &Assignment, values: &Created<'_>) -> Result<Option<Slot>, Error> {
    let Target::Numbered(number) = &assignment.target else {
        return Ok(None);
    };
    let number = value(number, values)?;
    if number.is_nan() {
        return Ok(None);
    }
    let range = assignment.target_range;
    let kind = |kind| problems::formula(&FormulaError { range, kind });
    let Some(index) = integer(number) else {
        return Err(kind(FormulaErrorKind::NotInteger(number)));
    };
    match Slot::writable(index) {
        Ok(slot) => Ok(Some(slot)),
        Err(true) => Err(Error::new(&problems::READ_ONLY, range)),
        Err(false) => Err(kind(FormulaErrorKind::ParameterOutOfRange(index))),
    }
}

/// A whole number within 1e-4, as for parameter numbers and codes.
fn integer(value: f64) -> Option<i64> {
    let below = value.floor();
    let fraction = value - below;
    if fraction > 0.9999 {
        Some(below as i64 + 1)
    } else {
        (fraction <= 1e-4).then_some(below as i64)
    }
}

/// The same in 32 bits, which is what the control has: a larger number becomes the least one.
fn int(value: f64, range: TextRange) -> Result<i32, Error> {
    let number = integer(value).ok_or_else(|| Error::new(&problems::NOT_INTEGER, range))?;
    Ok(i32::try_from(number).unwrap_or(i32::MIN))
}

#[inline]
fn word(word: &WordText, line: &Line, values: &Values<'_>, block: &mut Block) -> Result<(), Error> {
    let place = word.letter.wrapping_sub(b'A');
    let bit = if place < 26 { 1 << place } else { 0 };
    if values.missing_axes() & bit != 0 {
        return Err(super::line::no_word(word));
    }
    if matches!(word.letter, b'P' | b'Q') && block.word(word.letter).is_some_and(|before| before > -1.0) {
        return Err(super::line::twice_there(word.letter, word.range));
    }
    let value = if line.assignments.is_empty() {
        value(&word.value, values)?
    } else {
        let before = line
            .assignments
            .partition_point(|assignment| assignment.target_range.start < word.range.start);
        value(&word.value, &created(line, before as u32, values))?
    };
    if bit & crate::block::AXES != 0 {
        // any value will do
        block.put(word.letter, value, word.range);
        return Ok(());
    }
    put(word.letter, value, word.range, values, block)
}

/// Puts the value of a word into its place.
#[inline]
pub(super) fn put(
    letter: u8,
    value: f64,
    range: TextRange,
    values: &Values<'_>,
    block: &mut Block,
) -> Result<(), Error> {
    let least = |problem: &'static Problem, holds: bool| {
        if holds { Err(Error::new(problem, range)) } else { Ok(()) }
    };
    match letter {
        b'G' => return g_code(value, range, values, block),
        b'M' => return m_code(value, range, values, block),
        b'@' => block.radius = Some(value),
        b'^' => block.angle = Some(value),
        b'$' => block.spindle = Some(value as i32),
        letter => {
            let value = match letter {
                b'H' | b'L' | b'T' if !value.is_nan() => f64::from(int(value, range)?),
                _ => value,
            };
            match letter {
                b'F' => least(&problems::NEGATIVE_F, value < 0.0)?,
                b'S' => least(&problems::NEGATIVE_S, value < 0.0)?,
                b'H' => least(&problems::NEGATIVE_H, value < -1.0)?,
                b'L' => least(&problems::NEGATIVE_L, value < 0.0)?,
                b'T' => least(&problems::NEGATIVE_T, value < 0.0)?,
                _ => {}
            }
            block.put(letter, value, range);
        }
    }
    Ok(())
}

fn g_code(value: f64, range: TextRange, values: &Values<'_>, block: &mut Block) -> Result<(), Error> {
    if value.is_nan() {
        return Err(undecided(range, 'G'));
    }
    let refuse = |problem: &'static Problem| Err(Error::new(problem, range));
    let tenths = match value as u8 {
        // most are whole numbers
        whole @ 0..=99 if f64::from(whole) == value => Ok(i16::from(whole) * 10),
        _ => g_tenths(value),
    };
    let code = match tenths {
        Ok(code) => code,
        Err(problem) => return refuse(problem),
    };
    let Some(group) = g_group(code) else {
        if own(b'G', u32::from(code.unsigned_abs()), range, values, block) {
            return Ok(());
        }
        return refuse(&problems::G_UNKNOWN);
    };
    match block.g_code(group) {
        Some(_) if code == CANCEL => return Ok(()),
        Some(other) if other != CANCEL => return refuse(&problems::G_GROUP),
        _ => {}
    }
    block.put_g(group, code, range);
    Ok(())
}

/// Ten times the number of a G code: 0 to 999.
#[inline(never)]
fn g_tenths(value: f64) -> Result<i16, &'static Problem> {
    let code = (value * 10.0 + 0.5).floor();
    if (value - code / 10.0).abs() > 1e-4 {
        return Err(&problems::G_RANGE);
    }
    // a number beyond 32 bits is negative to the control
    if code < 0.0 || code > f64::from(i32::MAX) {
        return Err(&problems::NEGATIVE_G);
    }
    if code > 999.0 {
        return Err(&problems::G_RANGE);
    }
    Ok(code as i16)
}

fn m_code(value: f64, range: TextRange, values: &Values<'_>, block: &mut Block) -> Result<(), Error> {
    if value.is_nan() {
        return Err(undecided(range, 'M'));
    }
    let code = int(value, range)?;
    if code < 0 {
        return Err(Error::new(&problems::NEGATIVE_M, range));
    }
    // a number that overflows when multiplied by ten is not a code of any machine
    let tenths = code.unsigned_abs().checked_mul(10);
    if m_group(code).is_none() && tenths.is_some_and(|tenths| own(b'M', tenths, range, values, block)) {
        return Ok(());
    }
    if code > 199 {
        let text = format!("M-code greater than 199: M{code}");
        return Err(Error::with(&problems::M_RANGE, range, text));
    }
    let Some(group) = m_group(code) else {
        let text = format!("Unknown m code used: M{code}");
        return Err(Error::with(&problems::M_UNKNOWN, range, text));
    };
    if block.m_code(group).is_some() {
        return Err(Error::new(&problems::M_GROUP, range));
    }
    block.put_m(group, code as i16, range);
    block.m_count += 1;
    Ok(())
}

/// Takes one of the machine's own codes; returns whether it is one.
#[cold]
fn own(letter: u8, tenths: u32, range: TextRange, values: &Values<'_>, block: &mut Block) -> bool {
    let owns = values.owns(letter, tenths);
    if owns {
        block.own.push(crate::OwnCode { letter, tenths, range });
    }
    owns
}

fn undecided(range: TextRange, letter: char) -> Error {
    let text = format!("which {letter} code this is depends on an unknown value");
    Error::with(&problems::UNDECIDED, range, text)
}
