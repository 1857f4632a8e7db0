//! User variables of a Sinumerik program: R parameters, DEF, and names that are declared elsewhere.
//!
//! Sinumerik 840D sl Programming Manual, Job Planning (variables; arithmetic operations and functions): INT variables are rounded when
//! they are written, a variable of DEF is zero before that and local to its program, R parameters are not. Expressions:
//! [`trunnion_formula::sinumerik`].
mod axis;
mod field;
mod named;
mod prepared;
mod refused;
mod sort;
mod strings;
mod text_functions;
mod view;
mod words;

use crate::flow::Transfer;
use crate::{Argument, FaultKind};
use field::Field;
pub(crate) use refused::without_value;
pub(crate) use sort::{Sort, is_of_text};
use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use trunnion_formula::FormulaErrorKind;
use trunnion_syntax::{Call, TextRange};
use view::{View, Why};

/// The variables that a program declares. Names are in lower case.
#[derive(Clone, Debug, Default)]
pub(crate) struct Scope {
    pub(crate) sorts: HashMap<Box<str>, Sort>,
    pub(crate) values: BTreeMap<Box<str>, f64>,
    fields: BTreeMap<Box<str>, Field>,
    strings: strings::Strings,
    /// Variables of the type FRAME; `None`: what they hold is not known.
    pub(crate) frames: BTreeMap<Box<str>, Option<crate::sinumerik::FrameValue>>,
    /// Variables of the type AXIS: the letter of the axis; `None`: which one is not known.
    axes: BTreeMap<Box<str>, Option<u8>>,
}

/// See the module.
#[derive(Clone, Debug, Default)]
pub(crate) struct Own {
    /// Variables and expressions are those of Okuma's user task.
    pub(crate) is_task: bool,
    /// What only the user task has.
    pub(crate) task: crate::osp::Task,
    parameters: BTreeMap<i64, f64>,
    /// Names that the program does not declare.
    pub(crate) others: BTreeMap<Box<str>, f64>,
    pub(crate) scope: Scope,
    /// What was last written, word for word, to names whose values are not followed: strings, axes, arrays, unknown expressions.
    texts: BTreeMap<Box<str>, Box<str>>,
    /// The values that were known before they were lost.
    before_loss: BTreeMap<Box<str>, f64>,
    /// What may have given variables other values: they have been lost since.
    lost: Option<&'static str>,
    /// Written in the current block: when the control writes is not documented, so they are not read in the same block.
    pub(crate) fresh: Vec<Box<str>>,
    /// Grows with everything that may change the outcome of a decision.
    pub(crate) changes: u64,
    /// Jumps and calls are followed.
    pub(crate) follows: bool,
    /// A subprogram runs, so that M17, M2 and M30 return.
    pub(crate) is_called: bool,
    /// Where a statement of the flow begins in the current block.
    pub(crate) statement: Option<TextRange>,
    /// A name in the current block that is not a code: perhaps a subprogram.
    pub(crate) called: Option<Call>,
    /// `L20` in the current block.
    pub(crate) called_by_number: Option<TextRange>,
    /// What the current block requests, done when it has run.
    pub(crate) pending: Option<Transfer>,
    /// The last values of FOR loops, by file and block.
    pub(crate) counted_to: HashMap<(u16, u32), f64>,
    /// Names that are not programs of the library.
    pub(crate) missing: BTreeSet<Box<str>>,
    /// Whether a file has program headers (`%_N_`), by its number.
    pub(crate) headed: HashMap<u16, bool>,
    /// The path words of the current block.
    pub(crate) path: crate::sinumerik::PathWords,
    /// PO and PL of the current block.
    pub(crate) polynomial: crate::sinumerik::PolynomialWords,
    /// What path words of blocks before leave behind.
    pub(crate) contour: crate::sinumerik::Contour,
    /// The spline that runs.
    pub(crate) splines: crate::sinumerik::Splines,
    /// Along which axes F is measured.
    pub(crate) feed_group: crate::sinumerik::FeedGroup,
    /// The subprogram of MCALL, and how many calls were open there.
    pub(crate) modal: Option<(crate::flow::Calling, usize)>,
    /// How many calls are open.
    pub(crate) levels: usize,
    /// The subprogram of MCALL runs.
    pub(crate) in_modal: bool,
    /// The block has only F or S, after which MCALL acts too.
    pub(crate) acts_again: bool,
    /// What the control knows, for blocks that ask for it: `$p_f`, `$p_ep[x]`.
    pub(crate) system: BTreeMap<Box<str>, f64>,
    /// Frames that the current block writes: the name, and the text of the value.
    pub(crate) written_frames: Vec<(TextRange, TextRange)>,
    /// The letters of the axes of the plane in effect, in its order.
    pub(crate) plane_letters: [u8; 3],
    /// The number of the spindle to which S and M3 belong, where it is known.
    pub(crate) main_spindle: Option<u32>,
    /// Codes of G groups that the program reads with $P_GG.
    pub(crate) groups: crate::sinumerik::Groups,
    /// ORIMKS: tool vectors are in the axes of the machine.
    pub(crate) machine_vectors: bool,
    /// Names that EXTERN declares as subprograms.
    pub(crate) declared: BTreeSet<Box<str>>,
    /// The names in the text of the program, once a declaration asks for them.
    pub(crate) names: std::sync::OnceLock<std::sync::Arc<crate::effects::Names>>,
}

impl Own {
    /// A block begins.
    pub(crate) fn begin_block(&mut self) {
        self.fresh.clear();
        self.written_frames.clear();
        self.splines.words = crate::sinumerik::SplineWords::default();
        if self.path.any() {
            self.path = crate::sinumerik::PathWords::default();
        }
        if self.polynomial.any() {
            self.polynomial = crate::sinumerik::PolynomialWords::default();
        }
    }
    /// All variables have unknown values.
    pub(crate) fn lose(&mut self) {
        self.changes += 1;
        self.lost = Some("jumps or calls before it are not followed");
        self.contour.euler = false;
        self.groups = crate::sinumerik::Groups::default();
        let known = self.known();
        if !known.is_empty() {
            self.before_loss = known;
        }
        self.parameters.clear();
        self.others.clear();
        self.scope.values.clear();
        self.scope.frames.values_mut().for_each(|frame| *frame = None);
        self.scope.axes.values_mut().for_each(|axis| *axis = None);
        self.lose_fields();
        self.lose_texts();
    }
    fn known(&self) -> BTreeMap<Box<str>, f64> {
        let parameters = (self.parameters.iter()).map(|(number, value)| (format!("r{number}").into(), *value));
        let named = (self.others.iter().chain(&self.scope.values)).map(|(name, value)| (name.clone(), *value));
        parameters.chain(named).chain(self.elements()).collect()
    }
    /// R parameters with known values: they keep their values after the program ends.
    pub(crate) fn parameters(&self) -> impl Iterator<Item = (String, f64)> {
        self.parameters
            .iter()
            .map(|(number, value)| (format!("R{number}"), *value))
            .chain(self.common())
    }
    /// Records what is written to a name whose value is not followed.
    pub(crate) fn note_text(&mut self, name: &str, text: &str) {
        let name: Box<str> = crate::written::packed(name).to_ascii_lowercase().into();
        let text = crate::written::packed(text);
        self.texts.insert(name, text.into());
    }
    /// All that is known of the variables: values, those from before they were lost, and what was written where the value is unknown.
    pub(crate) fn all(&self) -> Vec<Argument> {
        let mut values = self.before_loss.clone();
        values.extend(self.known());
        let values = values
            .into_iter()
            .map(|(name, value)| Argument::number(name.into_string(), value));
        let texts = self
            .texts
            .iter()
            .map(|(name, text)| Argument::text(name.to_string(), text));
        values.chain(texts).collect()
    }
    /// `R5`, `R[2+3]`, `_HOME` = a value.
    pub(crate) fn assign(&mut self, name: &str, value: Option<f64>) {
        self.changes += 1;
        let value = value.filter(|value| value.abs() <= crate::reader::LARGEST);
        let name = name.trim().to_ascii_lowercase();
        if self.is_task {
            return self.assign_of_task(&name, value);
        }
        let parameter = match name.split_once('[') {
            None => r_parameter(&name),
            Some((stem, index)) if stem.trim() == "r" => {
                let index = index.trim_end().strip_suffix(']').and_then(|text| self.value(text));
                let Some(number) = index.and_then(whole) else {
                    // it may be any of them
                    self.parameters.clear();
                    self.lost
                        .get_or_insert("a value before it goes to R[] with an unknown index");
                    return;
                };
                Some(number)
            }
            Some((stem, index)) => return self.assign_element(stem, index, value),
        };
        if let Some(number) = parameter {
            match value {
                Some(value) => self.parameters.insert(number, value),
                None => self.parameters.remove(&number),
            };
            self.fresh.push(format!("r{number}").into());
            return;
        }
        let key: Box<str> = name.into();
        if self.scope.fields.contains_key(&key) {
            self.assign_element(&key, "", None);
        }
        self.forget_text(&key);
        let (values, value) = match self.scope.sorts.get(&key) {
            Some(sort) => (&mut self.scope.values, value.and_then(|value| sort.takes(value))),
            // declared elsewhere: it may be an INT
            None => (&mut self.others, value.filter(|value| value.fract() == 0.0)),
        };
        match value {
            Some(value) => values.insert(key.clone(), value),
            None => values.remove(&key),
        };
        self.fresh.push(key);
    }
    /// A variable of the program, with its first value.
    pub(crate) fn declare(&mut self, name: &str, sort: Sort, value: Option<f64>) {
        let name = name.trim().to_ascii_lowercase();
        self.scope.sorts.insert(name.as_str().into(), sort);
        self.assign(&name, value);
    }
    /// `DEF REAL A, B=3`: everything after DEF. Returns what is wrong with it.
    pub(crate) fn define(&mut self, text: &str) -> Vec<FaultKind> {
        let mut wrong = Vec::new();
        let Some((kind, names)) = text.trim().split_once(char::is_whitespace) else {
            return wrong;
        };
        let Some(sort) = Sort::named(kind) else { return wrong };
        for one in arguments(names) {
            let (name, value) = match one.split_once('=') {
                None => (one, Some(0.0)),
                Some((name, value)) => (name, self.value(value)),
            };
            if !named::is_variable_name(name.split('[').next().unwrap_or(name).trim()) {
                continue;
            }
            let stem = name.split('[').next().unwrap_or(name).trim();
            if self.is_declared(stem) {
                let name = stem.to_ascii_uppercase();
                let what = format!("{name}: the program defines it twice (rename one of them)");
                wrong.push(FaultKind::NotModelled { what });
            }
            if kind.eq_ignore_ascii_case("FRAME") && !name.contains('[') {
                let name = name.trim().to_ascii_lowercase();
                let is_plain = value.is_some() && !one.contains('=');
                self.scope.frames.insert(name.into(), is_plain.then(Default::default));
            }
            let is_field = one.split('=').next().is_some_and(|name| name.contains('['));
            let known = if is_field {
                // fields of CHAR are texts
                self.define_field(if sort == Sort::Char { Sort::Other } else { sort }, one)
            } else {
                self.declare(name, sort, value);
                value.is_some() && sort != Sort::Other
            };
            let given = one.split_once('=').map(|(_, given)| given);
            wrong.extend(given.and_then(|given| {
                if is_field {
                    return self.list_misfit(&stem.to_ascii_lowercase(), 0, given);
                }
                self.misfit(name, given, value)
            }));
            if kind.eq_ignore_ascii_case("AXIS") && !is_field {
                self.declare_axis(name, given);
            }
            if is_of_text(kind) {
                self.declare_string(kind, name, given);
            }
            if let (Some((name, text)), false) = (one.split_once('='), known) {
                self.note_text(name.split('[').next().unwrap_or(name), text);
            }
        }
        wrong
    }
    /// The value of an expression; `None`: it is not known, or not of this language.
    pub(crate) fn value(&self, text: &str) -> Option<f64> {
        self.value_in(text, 0)
    }
    /// The same for an index, `deep` brackets inside others.
    fn value_in(&self, text: &str, deep: u32) -> Option<f64> {
        let (value, _, end) = self.evaluate_in(text.as_bytes(), 0, (deep, Why::NotRead)).ok()?;
        let whole = text.get(end..).is_some_and(|rest| rest.trim().is_empty());
        value.filter(|value| whole && value.is_finite())
    }
    /// The expression that begins at `from`, as far as it extends: its value or why that is unknown, and where it ends.
    pub(crate) fn evaluate(
        &self,
        text: &[u8],
        from: usize,
    ) -> Result<(Option<f64>, Option<String>, usize), FormulaErrorKind> {
        self.evaluate_in(text, from, (0, Why::Read))
    }
    fn evaluate_in(
        &self,
        text: &[u8],
        from: usize,
        (deep, why): (u32, Why),
    ) -> Result<(Option<f64>, Option<String>, usize), FormulaErrorKind> {
        let range = TextRange::new(from as u32, text.len() as u32);
        let prepared = self.prepared(text, from, deep);
        let text = prepared.as_ref().map_or(text, |(text, _)| text);
        let read = if self.is_task {
            trunnion_formula::osp
        } else {
            trunnion_formula::sinumerik
        };
        let (formula, end) = read(text, range).map_err(|error| error.kind)?;
        let view = View {
            own: self,
            elements: prepared.as_ref().map_or(&[][..], |(_, elements)| elements),
            why,
            unknown: RefCell::default(),
        };
        let end = end as usize;
        let value = match formula.eval(&view) {
            Ok(value) => value,
            // with another value of the operand that is not known it may have one
            Err(_) if view.unknown.borrow().is_some() => f64::NAN,
            Err(error) => return Err(error.kind),
        };
        if !value.is_nan() {
            return Ok((Some(value), None, end));
        }
        if why == Why::NotRead {
            return Ok((None, None, end));
        }
        let shown = || {
            let text = String::from_utf8_lossy(&text[from..end]);
            format!("{}: the control's answer is not documented", text.trim())
        };
        Ok((None, Some(view.unknown.take().unwrap_or_else(shown)), end))
    }
    /// Whether the program that runs declares a name.
    pub(crate) fn is_declared(&self, name: &str) -> bool {
        self.scope.sorts.contains_key(name.to_ascii_lowercase().as_str())
    }
    fn is_fresh(&self, name: &str) -> bool {
        self.fresh.iter().any(|written| **written == *name)
    }
    fn read(&self, name: &str) -> Option<f64> {
        let values = if self.scope.sorts.contains_key(name) {
            &self.scope.values
        } else {
            &self.others
        };
        values.get(name).copied().filter(|_| !self.is_fresh(name))
    }
}

/// The parts between commas outside of brackets and strings.
pub(crate) fn arguments(text: &str) -> Vec<&str> {
    let mut parts = Vec::new();
    let (mut deep, mut quoted, mut from) = (0i32, false, 0);
    for (at, byte) in text.bytes().enumerate() {
        match byte {
            b'"' => quoted = !quoted,
            b'(' | b'[' if !quoted => deep += 1,
            b')' | b']' if !quoted => deep -= 1,
            b',' if !quoted && deep == 0 => {
                parts.push(text[from..at].trim());
                from = at + 1;
            }
            _ => {}
        }
    }
    parts.push(text[from..].trim());
    parts
}

/// The number of an R parameter that is named in lower case.
fn r_parameter(name: &str) -> Option<i64> {
    let digits = name.strip_prefix('r')?;
    let number = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
    number.then(|| digits.parse().ok()).flatten()
}

/// The number of an R parameter.
fn whole(value: f64) -> Option<i64> {
    (value >= 0.0 && value.fract() == 0.0 && value <= 99_999.0).then_some(value as i64)
}

#[cfg(test)]
mod tests;
