//! Why it is unknown what runs next: which values are unknown, and where they come from.
use super::oline::{Keyword, OLine};
use super::problems;
use crate::{Engine, Error, Sink, read};
use trunnion_formula::{Formula, Variable, Variables};

/// It has no source of its own.
const COMPUTED: &str = "which was computed from unknown values";

/// At most this many parameters that nothing has set are reported in one run.
const REPORTED: usize = 100;

/// The most names in one sentence.
const NAMES: usize = 3;

impl Engine {
    /// A condition, count or label is unknown.
    pub(super) fn undecided(&self, formula: &Formula, line: &OLine) -> String {
        let what = match line.keyword {
            Keyword::If | Keyword::ElseIf => "whether this branch runs",
            Keyword::While => "whether this loop continues",
            Keyword::Repeat => "how many times this loop runs",
            _ => "which label this is",
        };
        let reasons = self.reasons(formula);
        if reasons.is_empty() {
            return format!("{what} depends on a value that is not known before the program runs");
        }
        format!("{what} depends on {}", reasons.join(" and "))
    }
    /// A word is unknown.
    pub(super) fn undecided_word(letter: char, what: &str) -> String {
        format!("{what} depends on {letter}, whose value is not known before the program runs")
    }
    /// Reports why the value of a word is unknown, and the parameters that an assignment reads and nothing has set: each once in a run. What is
    /// assigned from an unknown value is reported where a word reads it.
    #[inline]
    pub(super) fn report_unset(&mut self, line: &read::Line, sink: &mut dyn Sink) {
        let computes = |formula: &Formula| formula.number().is_none();
        let some = line.words.iter().any(|word| computes(&word.value))
            || line.assignments.iter().any(|one| computes(&one.value));
        // in a file that only defines subprograms the caller gives what is missing, and the file never passes
        if some && self.setup.start == crate::Start::Unknown && !self.entered_alone() {
            self.report_unset_of(line, sink);
        }
    }
    fn report_unset_of(&mut self, line: &read::Line, sink: &mut dyn Sink) {
        let words = line.words.iter().map(|word| (&word.value, word.range, true));
        let assigned = line.assignments.iter().map(|one| (&one.value, one.target_range, false));
        for (formula, range, is_word) in words.chain(assigned) {
            let unset = formula.reads().filter_map(|variable| match variable {
                Variable::Numbered(index) if self.is_unset(index) => {
                    Some(format!("#{index}: read before the program assigns it"))
                }
                _ => None,
            });
            let mut reasons: Vec<String> = unset.collect();
            let computed = || {
                formula
                    .reads()
                    .any(|variable| matches!(variable, Variable::Computed(_)))
            };
            if reasons.is_empty() && (is_word || computed()) && self.value(formula).is_ok_and(f64::is_nan) {
                reasons = self.reasons(formula);
            }
            for text in reasons {
                if self.flow.unset.len() < REPORTED && self.flow.unset.insert(text.clone()) {
                    self.tell(&Error::with(&problems::UNSET, range, text), sink);
                }
            }
        }
    }
    /// Whether nothing has set a parameter that keeps its value between programs.
    fn is_unset(&self, index: i64) -> bool {
        // in a call the first ones are its arguments
        let argument = (1..=30).contains(&index) && !self.flow.calls.is_empty();
        (1..=5000).contains(&index)
            && !argument
            && !self.store.is_assigned(index)
            && self.values().numbered(index).is_ok_and(f64::is_nan)
    }
    /// The variables of a formula that are unknown.
    fn reasons(&self, formula: &Formula) -> Vec<String> {
        let values = self.values();
        let mut reasons: Vec<String> = Vec::new();
        for variable in formula.reads() {
            let reason = match variable {
                Variable::Numbered(index) if values.numbered(index).is_ok_and(f64::is_nan) => {
                    let argument = (1..=30).contains(&index) && self.entered_alone();
                    let source = if argument {
                        "an argument that the caller gives"
                    } else if self.store.is_assigned(index) {
                        COMPUTED
                    } else {
                        numbered(index)
                    };
                    format!("#{index}, {source}")
                }
                Variable::Named(name) if values.named(name).is_ok_and(f64::is_nan) => {
                    format!("#<{name}>, {}", named(name))
                }
                Variable::Computed(range) => {
                    let at = self.at();
                    let bytes = self.files[at.file.0 as usize].bytes();
                    let text = bytes.get(range.as_usize()).unwrap_or_default();
                    format!("{}, whose number or value is unknown", String::from_utf8_lossy(text))
                }
                _ => continue,
            };
            if reasons.len() < NAMES && !reasons.contains(&reason) {
                reasons.push(reason);
            }
        }
        reasons
    }
}

/// The source of the value of an unknown numbered parameter.
fn numbered(index: i64) -> &'static str {
    match index {
        5061..=5069 => "the position where the probe touched",
        5070 => "whether the probe touched",
        5161..=5189 => "a position of the machine (G28, G30)",
        5210..=5390 => "an offset set on the machine",
        5399 => "the result of M66",
        5400..=5413 => "data of the tool that is in the spindle",
        5420..=5428 => "the position of the machine",
        1..=5000 => "which keeps its value between programs and is not set here",
        _ => COMPUTED,
    }
}

/// The same for a named one.
fn named(name: &str) -> &'static str {
    if name.starts_with("_hal[") {
        "a pin of the machine"
    } else if name.starts_with("_ini[") {
        "a value of the machine's INI file"
    } else if matches!(name, "_x" | "_y" | "_z" | "_a" | "_b" | "_c" | "_u" | "_v" | "_w") || name.starts_with("_abs_")
    {
        "the position of the machine"
    } else if crate::parameters::is_system_name(name) {
        "which the program has not set before"
    } else {
        COMPUTED
    }
}
