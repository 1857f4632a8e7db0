//! LBL, CALL and SEL: which label or program is meant.
use super::Klartext;
use super::flow::{Level, Request};
use super::values::Value;
use super::words::{Kind, Parameter, Said, Words};
use crate::core::Report;
use crate::{FaultKind, Refusal};
use trunnion_flow::Key;
use trunnion_syntax::TextRange;

/// What belongs to a calling program alone.
#[derive(Clone, Debug)]
pub(crate) struct Caller {
    locals: Vec<(Parameter, Value)>,
    /// mm per unit of its lengths and of F: BEGIN PGM says them for one program.
    units: [f64; 2],
}

impl Klartext<'_> {
    /// What is kept while another program runs.
    pub(super) fn caller(&mut self) -> Caller {
        let state = &self.core.state;
        Caller {
            units: [state.coordinates.unit_mm(), state.feed.unit_mm()],
            locals: self.memory.parameters.take_locals(),
        }
    }

    /// A called program has ended. F stays: it is the same feed in the caller's unit.
    pub(super) fn come_back(&mut self, caller: Caller) {
        let [length, feed] = caller.units;
        self.core.state.own_units(length, feed);
        self.memory.parameters.put_locals(caller.locals);
        self.core.state.ended = false;
    }

    /// LBL: a label is passed; LBL 0 ends a subprogram.
    pub(crate) fn label(&mut self, value: Said<'_>, words: &mut Words<'_>) -> Request {
        let of_label = self
            .flow
            .course
            .programs()
            .last()
            .is_some_and(|level| matches!(level, Level::Label));
        match key_of(value, words) {
            Some(Key::Number(0)) if of_label => Request::Return,
            _ => Request::Next,
        }
    }

    /// CALL LBL, CALL PGM, CALL SELECTED PGM.
    pub(crate) fn call(&mut self, words: &mut Words<'_>, report: &mut Report<'_>) -> Request {
        let Some(first) = words.next() else {
            Self::rejected(Refusal::MissingWord, "CALL needs LBL or PGM", report);
            return Request::Next;
        };
        match first.name() {
            b"LBL" => {
                let Some(key) = self.key(first.value, words, report) else {
                    return Self::undecided("which label is called", report);
                };
                match words.next() {
                    Some(word) if word.is("REP") && word.value == Said::Nothing => {
                        // old controls show the question that was not answered, as `R F M` without values
                        self.not_modelled_once("REP without a number: taken as a call of the subprogram", report);
                        Request::Call(key)
                    }
                    Some(word) if word.is("REP") => match self.said(word.value, report) {
                        Some(times) if (0.0..65536.0).contains(&times) && times.fract() == 0.0 => {
                            Request::Repeat(key, times as u32)
                        }
                        _ => Self::undecided("how often the section runs", report),
                    },
                    _ => Request::Call(key),
                }
            }
            b"PGM" => {
                // a name may begin with digits, which the word has taken as its value
                let text = String::from_utf8_lossy(words.after_name(&first))
                    .trim()
                    .trim_matches(['"', '\''])
                    .to_owned();
                if text.is_empty() {
                    Self::rejected(Refusal::MissingWord, "CALL PGM needs the name of a program", report);
                    return Self::undecided("which program is called", report);
                }
                Request::Program(text)
            }
            b"SELECTED" => match self.flow.selected.clone() {
                Some(name) => Request::Program(name),
                None => Self::undecided("which program is selected", report),
            },
            _ => {
                Self::rejected(Refusal::Syntax, "CALL needs LBL or PGM", report);
                Request::Next
            }
        }
    }

    /// SEL PGM "NAME".
    pub(crate) fn select(&mut self, words: &mut Words<'_>, report: &mut Report<'_>) {
        if !words.takes_word("PGM") {
            return self.not_modelled_once("SEL of a table or contour", report);
        }
        let text = String::from_utf8_lossy(words.rest()).trim().to_owned();
        let plain = text.starts_with('"') && text.len() > 2;
        self.flow.selected = plain.then(|| text.trim_matches('"').to_owned());
    }

    /// What a program does that is not there is unknown.
    pub(super) fn call_is_not_followed(&mut self) {
        self.core.forget_everything();
        self.memory.parameters.lose();
        self.lose_system();
    }

    pub(crate) fn undecided(what: &str, report: &mut Report<'_>) -> Request {
        report.fault(TextRange::default(), FaultKind::NotDecided { what: what.to_owned() });
        Request::Stop
    }

    /// The label of a call or jump; one in a parameter is known where the parameter is.
    pub(crate) fn key(&mut self, value: Said<'_>, words: &mut Words<'_>, report: &mut Report<'_>) -> Option<Key> {
        if let Said::Parameter(_, parameter) = value {
            if parameter.kind == Kind::Text {
                let text = self.memory.parameters.texts.get(&parameter.number)?.clone()?;
                return Some(Key::Name(text.into()));
            }
            let number = self.said(value, report)?;
            return (number >= 0.0 && number.fract() == 0.0).then_some(Key::Number(number as u32));
        }
        key_of(value, words)
    }
}

/// A number, or the quoted text that follows.
pub(super) fn key_of(value: Said<'_>, words: &mut Words<'_>) -> Option<Key> {
    match value {
        Said::Number(number) if number >= 0.0 && number.fract() == 0.0 => Some(Key::Number(number as u32)),
        Said::Nothing => match words.next()?.value {
            Said::Text(text) => Some(Key::Name(String::from_utf8_lossy(text).into())),
            _ => None,
        },
        _ => None,
    }
}
