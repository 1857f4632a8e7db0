//! The variables of a program as formulas read them.
use super::{Own, Scope, prepared};
use core::ops::Bound;
use std::cell::RefCell;
use trunnion_formula::ValueError;

/// Whether the reason why a value is unknown is read: writing it costs more than the value.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Why {
    Read,
    NotRead,
}

/// The source of variables for formulas, and the first name whose value was not known.
pub(super) struct View<'a> {
    pub(super) own: &'a Own,
    /// Values of names with indices that are read before the formula.
    pub(super) elements: &'a [prepared::Element],
    pub(super) why: Why,
    pub(super) unknown: RefCell<Option<String>>,
}

impl Own {
    /// A subprogram begins with its own variables; returns those of the caller.
    pub(crate) fn begin_scope(&mut self) -> Scope {
        self.changes += 1;
        std::mem::take(&mut self.scope)
    }
    /// The caller continues with its variables; returns those of the subprogram.
    pub(crate) fn end_scope(&mut self, caller: Scope) -> Scope {
        self.changes += 1;
        std::mem::replace(&mut self.scope, caller)
    }
    /// How many entries of lists that grow with the program a clone copies.
    pub(crate) fn copied(&self) -> usize {
        let scope = &self.scope;
        let declared = scope.sorts.len()
            + scope.values.len()
            + scope.fields.len()
            + scope.frames.len()
            + scope.axes.len()
            + self.texts_held();
        let values = self.parameters.len() + self.others.len() + self.texts.len() + self.before_loss.len();
        let task = self
            .task
            .outer
            .iter()
            .map(std::collections::BTreeSet::len)
            .sum::<usize>()
            + self.task.written.len();
        let names = self.missing.len() + self.declared.len() + self.system.len() + task;
        declared + values + self.counted_to.len() + self.headed.len() + names + self.splines.copied()
    }
}

impl Scope {
    /// The value of a variable, as a caller reads it back.
    pub(crate) fn value(&self, name: &str) -> Option<f64> {
        self.values.get(name).copied()
    }
}

/// Longest text of an assignment that a reason repeats, bytes.
const LONGEST_SOURCE: usize = 60;

impl Own {
    /// Why a variable that is not local has no known value, its name in lower case.
    pub(crate) fn why_valueless(&self, name: &str) -> String {
        if self.is_fresh(name) {
            return "written in the same block".to_owned();
        }
        if let Some(lost) = self.lost {
            return lost.to_owned();
        }
        // R[1] may be written R[2-1]
        let by_index = || {
            let mut from = self.texts.range::<str, _>((Bound::Included("r["), Bound::Unbounded));
            from.next().is_some_and(|(written, _)| written.starts_with("r["))
        };
        match self.texts.get(name) {
            None if by_index() => "its value is unknown here".to_owned(),
            Some(text) if text.len() <= LONGEST_SOURCE => format!("from {text}"),
            Some(text) => format!("from {}...", &text[..text.floor_char_boundary(LONGEST_SOURCE)]),
            None => "the program does not set its value".to_owned(),
        }
    }
}

impl View<'_> {
    fn give(&self, value: Option<f64>, why: impl FnOnce() -> String) -> f64 {
        value.unwrap_or_else(|| {
            if self.why == Why::Read {
                self.unknown.borrow_mut().get_or_insert_with(why);
            }
            f64::NAN
        })
    }
}

impl trunnion_formula::Variables for View<'_> {
    fn numbered(&self, index: i64) -> Result<f64, ValueError> {
        if index < 0 {
            return Err(ValueError::OutOfRange);
        }
        let name = format!("r{index}");
        let fresh = self.own.is_fresh(&name);
        let value = self.own.parameters.get(&index).copied().filter(|_| !fresh);
        Ok(self.give(value, || format!("R{index}: {}", self.own.why_valueless(&name))))
    }
    fn named(&self, name: &str) -> Result<f64, ValueError> {
        if let Some(element) = prepared::element(self.elements, name) {
            return Ok(self.give(element.value, || match element.name.as_bytes() {
                [b'$', ..] => format!("{}: a variable of the control", element.name),
                _ => format!("{}: its value is unknown here", element.name),
            }));
        }
        let shown = || name.trim_end_matches(['[', '(']).to_ascii_uppercase();
        let value = if name.starts_with('$') {
            self.own.system.get(name).copied()
        } else {
            self.own.read(name)
        };
        Ok(self.give(value, || match name.as_bytes() {
            _ if self.own.is_task && !self.own.is_fresh(name) => crate::osp::why_unknown(self.own, name),
            [b'$', ..] => format!("{}: a variable of the control", shown()),
            [.., b'['] => format!("{}[]: array elements are not followed", shown()),
            [.., b'('] => format!("{}(): the function is not modelled", shown()),
            [b'"'] => "strings are not followed".to_owned(),
            _ if self.own.is_fresh(name) => format!("{}: written in the same block", shown()),
            _ if self.own.is_declared(name) => format!("{}: its value is unknown here", shown()),
            _ => format!("{}: not declared in this program", shown()),
        }))
    }
    fn named_at(&self, name: &str, index: i64) -> Result<f64, ValueError> {
        let one = self.own.is_task || self.own.is_one_row(name);
        let value = self.own.element(name, index).filter(|_| one);
        Ok(self.give(value, || {
            if self.own.is_task {
                return crate::osp::why_unknown(self.own, name);
            }
            format!("{}[{index}]: its value is unknown here", name.to_ascii_uppercase())
        }))
    }
    fn rounds_index(&self) -> bool {
        // what the control makes of a fraction is not documented
        false
    }
    fn exists(&self, name: &str) -> bool {
        self.own.read(name).is_some()
    }
}
