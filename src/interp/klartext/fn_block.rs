//! FN 0 to FN 29, and assignments of formulas.
use super::Klartext;
use super::flow::Request;
use super::formula::{BY_ZERO, NEGATIVE_ROOT, formula};
use super::reason::Reason;
use super::values::Value;
use super::words::{Kind, Parameter, Said, Words};
use crate::core::Report;
use crate::frames::sin_cos_degrees;
use crate::{FaultKind, Refusal};
use trunnion_flow::Key;
use trunnion_geometry::math::atan2;
use trunnion_syntax::TextRange;

/// Longest text of a QS parameter that is followed, bytes.
const MOST_TEXT: usize = 4096;

impl Klartext<'_> {
    /// `FN n: ...`, after FN.
    pub(crate) fn function_of_parameters(
        &mut self,
        number: Said<'_>,
        words: &mut Words<'_>,
        report: &mut Report<'_>,
    ) -> Request {
        let Said::Number(number) = number else {
            Self::rejected(Refusal::Syntax, "FN needs its number", report);
            return Request::Next;
        };
        words.takes(b':');
        match number as u32 {
            0..=8 | 13 => self.arithmetic(number as u32, words, report),
            9..=12 => return self.jump_if(number as u32, words, report),
            14 => {
                let text = String::from_utf8_lossy(words.rest()).trim().to_owned();
                let message = format!("FN 14: {text}");
                report.fault(TextRange::default(), FaultKind::ProgramAlarm { message });
                return Request::Stop;
            }
            // reads of the control and of tables: the parameters that they fill are unknown
            18 | 19 | 20 | 28 => {
                let text = String::from_utf8_lossy(words.rest()).trim().to_owned();
                let target: Vec<Parameter> = words
                    .by_ref()
                    .filter_map(|word| match word.value {
                        Said::Parameter(_, parameter) => Some(parameter),
                        _ => None,
                    })
                    .take(1)
                    .collect();
                let what = text.split(';').next().unwrap_or_default().trim();
                let what = format!("FN {number}: {what}");
                for parameter in target {
                    self.memory.parameters.set_from(parameter, None, Some(what.clone()));
                }
                self.not_modelled_once(&what, report);
            }
            // what it writes may be the preset, or a tool
            17 | 25 => {
                self.not_modelled_once(&format!("FN {number}: what it writes"), report);
                self.flush(report);
                self.lose(Reason::Other);
            }
            // the centre and the radius of a circle through points, in three parameters
            23 | 24 => {
                self.not_modelled_once(&format!("FN {number}: the circle that it computes"), report);
                self.memory.parameters.lose();
            }
            15 | 16 | 26 | 27 | 29 | 37 | 38 => {
                self.not_modelled_once(&format!("FN {number}: what it writes or sends"), report);
            }
            _ => {
                Self::not_modelled(format!("FN {number}"), report);
                self.memory.parameters.lose();
            }
        }
        Request::Next
    }

    /// `Q1 = formula`; text parameters hold texts.
    pub(crate) fn assignment(&mut self, text: &[u8], report: &mut Report<'_>) -> Request {
        let mut words = Words::new(text);
        words.blanks();
        let Some(target) = words.parameter() else {
            return Request::Next;
        };
        if !words.takes(b'=') {
            Self::rejected(Refusal::Syntax, format!("`=` is missing after {target}"), report);
            return Request::Next;
        }
        if target.kind == Kind::Text {
            let text = self.text_of(&mut words, report);
            self.memory.parameters.changes += 1;
            self.memory.parameters.texts.insert(target.number, text);
            return Request::Next;
        }
        let cause = self.memory.parameters.cause_in(words.rest());
        match formula(&mut words, &self.memory.parameters) {
            Ok((_, Some(why))) if words.rest().trim_ascii().is_empty() => {
                self.memory
                    .parameters
                    .set_from(target, None, Some(format!("{target}: {why}")));
                Self::rejected(Refusal::Expression, format!("{why} in the formula of {target}"), report);
            }
            Ok((value, None)) if words.rest().trim_ascii().is_empty() => {
                let own = || {
                    format!(
                        "{target}: the formula that sets it (a function before `*`, `/` or `^` needs brackets: its priority is not taken from a source)"
                    )
                };
                self.memory
                    .parameters
                    .set_from(target, value, cause.or_else(|| Some(own())));
            }
            Ok(_) => {
                self.memory.parameters.set(target, None);
                let rest = String::from_utf8_lossy(words.rest()).trim().to_owned();
                self.not_modelled_once(&format!("`{rest}` in a formula"), report);
            }
            Err(message) => {
                self.memory.parameters.set(target, None);
                Self::rejected(Refusal::Expression, message, report);
            }
        }
        Request::Next
    }

    /// Quoted texts and QS parameters, joined by `||`. A text that is joined to itself doubles: one beyond [`MOST_TEXT`] is unknown.
    fn text_of(&mut self, words: &mut Words<'_>, report: &mut Report<'_>) -> Option<String> {
        let mut joined = String::new();
        loop {
            match words.next()?.value {
                Said::Text(text) => joined.push_str(&String::from_utf8_lossy(text)),
                Said::Parameter(_, parameter) if parameter.kind == Kind::Text => {
                    joined.push_str(self.memory.parameters.texts.get(&parameter.number)?.as_ref()?);
                }
                _ => return None,
            }
            if joined.len() > MOST_TEXT {
                self.not_modelled_once(&format!("a text of more than {MOST_TEXT} bytes"), report);
                return None;
            }
            if !words.takes(b'|') {
                break;
            }
            words.takes(b'|');
        }
        words.rest().trim_ascii().is_empty().then_some(joined)
    }

    /// `Qn = +a`, `Qn = +a + +b`, `- `, `*`, `DIV`; SQRT, SIN, COS; LEN and ANG of two sides.
    fn arithmetic(&mut self, number: u32, words: &mut Words<'_>, report: &mut Report<'_>) {
        words.blanks();
        let target = words.parameter();
        let (Some(target), true) = (target, words.takes(b'=')) else {
            Self::rejected(Refusal::Syntax, format!("FN {number} needs `Q... =`"), report);
            return;
        };
        let cause = self.memory.parameters.cause_in(words.rest());
        let value = self.fn_value(number, words, report);
        let rest = words.rest().trim_ascii();
        if value.is_some() && !rest.is_empty() {
            self.memory.parameters.set(target, None);
            let rest = String::from_utf8_lossy(rest).into_owned();
            self.not_modelled_once(&format!("`{rest}` after the values of FN {number}"), report);
        } else if let Some(value) = value {
            self.memory.parameters.set_from(target, value, cause);
        } else {
            self.memory.parameters.set(target, None);
            Self::rejected(Refusal::Expression, format!("FN {number} is incomplete"), report);
        }
    }

    fn operand(&mut self, words: &mut Words<'_>, report: &mut Report<'_>) -> Option<Value> {
        words.blanks();
        match words.value() {
            Said::Nothing | Said::Sign(_) | Said::Text(_) => None,
            said => Some(self.said(said, report)),
        }
    }

    fn fn_value(&mut self, number: u32, words: &mut Words<'_>, report: &mut Report<'_>) -> Option<Value> {
        match number {
            0 => self.operand(words, report),
            5..=7 => {
                // SQRT, SIN, COS: the value may stand with the word
                let value = match words.next()?.value {
                    Said::Nothing => self.operand(words, report)?,
                    said => self.said(said, report),
                };
                if number == 5 && value.is_some_and(|value| value < 0.0) {
                    Self::rejected(Refusal::Expression, format!("{NEGATIVE_ROOT} in FN 5"), report);
                }
                Some(value.and_then(|value| match number {
                    5 => (value >= 0.0).then(|| value.sqrt()),
                    6 => Some(sin_cos_degrees(value).0),
                    _ => Some(sin_cos_degrees(value).1),
                }))
            }
            _ => {
                let first = self.operand(words, report)?;
                let taken = match number {
                    1 => words.takes(b'+'),
                    2 => words.takes(b'-'),
                    3 => words.takes(b'*'),
                    _ => {
                        words.blanks();
                        let letters = words
                            .rest()
                            .iter()
                            .take_while(|byte| byte.is_ascii_alphabetic())
                            .count();
                        words.at += letters;
                        letters > 0
                    }
                };
                let second = self.operand(words, report).filter(|_| taken)?;
                if number == 4 && first.is_some() && second == Some(0.0) {
                    Self::rejected(Refusal::Expression, format!("{BY_ZERO} in FN 4"), report);
                }
                Some(first.zip(second).and_then(|(a, b)| match number {
                    1 => Some(a + b),
                    2 => Some(a - b),
                    3 => Some(a * b),
                    4 => (b != 0.0).then(|| a / b),
                    8 => Some(trunnion_geometry::math::hypot(a, b)),
                    _ => (a != 0.0 || b != 0.0).then(|| atan2(a, b).to_degrees().rem_euclid(360.0)),
                }))
            }
        }
    }

    /// `IF +Q1 EQU +5 GOTO LBL 3`, `IF Q1 IS UNDEFINED GOTO LBL 3`.
    fn jump_if(&mut self, number: u32, words: &mut Words<'_>, report: &mut Report<'_>) -> Request {
        let Some(opens) = words.next().filter(|word| word.is("IF")) else {
            Self::rejected(Refusal::Syntax, "a jump needs IF", report);
            return Request::Stop;
        };
        let first = match opens.value {
            Said::Nothing => {
                words.blanks();
                words.value()
            }
            said => said,
        };
        let relation = words.next();
        if relation.is_some_and(|word| word.is("IS")) {
            return self.jump_if_defined(number, first, words, report);
        }
        let second = match relation.map(|word| word.value) {
            Some(Said::Nothing) => {
                words.blanks();
                words.value()
            }
            Some(said) => said,
            None => Said::Nothing,
        };
        let names = ["EQU", "NE", "GT", "LT"];
        let wanted = names.get(number as usize - 9).copied().unwrap_or_default();
        let fits = relation.is_some_and(|word| word.is(wanted)) && words.takes_word("GOTO");
        let target = words.find(|word| word.is("LBL")).filter(|_| fits);
        let key = target.and_then(|word| self.key(word.value, words, report));
        if first == Said::Nothing || second == Said::Nothing || target.is_none() {
            Self::rejected(
                Refusal::Syntax,
                format!("FN {number} is IF, a value, {wanted}, a value, GOTO LBL"),
                report,
            );
            return Request::Stop;
        }
        let holds = match (self.said(first, report), self.said(second, report)) {
            (Some(a), Some(b)) => match number {
                9 => a == b,
                10 => a != b,
                11 => a > b,
                _ => a < b,
            },
            _ => return Self::undecided("the values of a jump", report),
        };
        Self::jump_where(holds, key, report)
    }

    fn jump_where(holds: bool, key: Option<Key>, report: &mut Report<'_>) -> Request {
        match (holds, key) {
            (false, _) => Request::Next,
            (true, Some(key)) => Request::Jump(key),
            (true, None) => Self::undecided("to which label the program jumps", report),
        }
    }

    /// `FN 9: IF +Q1 IS DEFINED GOTO LBL 3`, after IS.
    fn jump_if_defined(
        &mut self,
        number: u32,
        first: Said<'_>,
        words: &mut Words<'_>,
        report: &mut Report<'_>,
    ) -> Request {
        let wanted = if words.takes_word("DEFINED") {
            Some(true)
        } else {
            words.takes_word("UNDEFINED").then_some(false)
        };
        let goes = words.takes_word("GOTO");
        let target = words.find(|word| word.is("LBL")).filter(|_| goes);
        let (Some(wanted), Said::Parameter(_, parameter), Some(target)) = (wanted, first, target) else {
            let message = format!("FN {number} with IS is IF, a parameter, IS DEFINED or IS UNDEFINED, GOTO LBL");
            Self::rejected(Refusal::Syntax, message, report);
            return Request::Stop;
        };
        if number != 9 {
            // the question belongs to FN 9: what another number makes of it is in no source
            return Self::undecided(&format!("FN {number} with IS DEFINED or IS UNDEFINED"), report);
        }
        let Some(is_defined) = self.memory.parameters.is_defined(parameter) else {
            let cause = self.memory.parameters.cause(parameter);
            return Self::undecided(&format!("whether {parameter} is defined ({cause})"), report);
        };
        let key = self.key(target.value, words, report);
        Self::jump_where(is_defined == wanted, key, report)
    }
}
