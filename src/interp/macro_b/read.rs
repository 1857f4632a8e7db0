//! Reads macro statements as they occur: assignments, IF, WHILE, GOTO, DO, END, and values that are expressions.
use super::alarms::{Mistake, is_fanuc, rejected};
use super::evaluate::{Assigned, Compiled, Form, Trouble, View, assigned, evaluate, only_read};
use super::statement::{Statement, statement};
use super::system::{Kept, Known, is_followed};
use super::variables::{Class, Held, Variables, class};
use super::{Deep, FlowCode};
use crate::flow::{Label, Transfer};
use crate::frames::Frames;
use crate::reader::{LARGEST, Reader};
use crate::words::{Number, WordValue};
use crate::{FaultKind, ModalState, Refusal, Setup};
use std::cell::Cell;
use trunnion_dialect::{Action, Code, CodeKind, Dialect};
use trunnion_flow::Search;
use trunnion_syntax::{Address, Call, Program, TextRange, Value, Word};

/// How far macro statements are followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Mode {
    /// Jumps and calls too.
    Follow,
    /// Assignments; the caller chooses the blocks.
    Step,
    /// Nothing is evaluated: only the text is read.
    Text,
}

/// What the reader needs for macro statements.
pub(crate) struct Macros<'a> {
    pub(crate) mode: Mode,
    pub(crate) deep: &'a mut Option<Box<Deep>>,
    /// The file that runs.
    pub(crate) file: u16,
    pub(crate) state: &'a ModalState,
    pub(crate) setup: &'a Setup,
    pub(crate) frames: &'a Frames,
    pub(crate) kept: Kept,
}

/// The code of a call or return that a G or M code is, number in tenths.
fn flow_code(dialect: &Dialect, kind: CodeKind, tenths: u32) -> Option<FlowCode> {
    let calls = |code: Option<&Code>| code.is_some_and(|code| code.action == Action::SubprogramCall);
    match (kind, tenths) {
        (CodeKind::M, 980) => Some(FlowCode::Call),
        (CodeKind::M, 990) => Some(FlowCode::Return),
        (CodeKind::M, 960) if calls(dialect.m(960)) => Some(FlowCode::Branch),
        (CodeKind::M, 970) if calls(dialect.m(970)) => Some(FlowCode::CallLocal),
        (CodeKind::M, 1980) if calls(dialect.m(1980)) => Some(FlowCode::CallExternal),
        (CodeKind::G, 650) => Some(FlowCode::Macro),
        (CodeKind::G, 660) => Some(FlowCode::Modal),
        (CodeKind::G, 670) => Some(FlowCode::ModalOff),
        _ => None,
    }
}

impl Macros<'_> {
    fn deep(&mut self) -> &mut Deep {
        let setup = self.setup;
        self.deep.get_or_insert_with(|| {
            Box::new(Deep {
                variables: Variables::with(&setup.variables),
                ..Deep::default()
            })
        })
    }

    /// What formulas read from.
    fn view<'v>(&'v mut self, dialect: &Dialect) -> (View<'v>, &'v mut Compiled, u16) {
        let (state, setup, frames, kept, file) = (self.state, self.setup, self.frames, self.kept, self.file);
        let deep = self.deep();
        let view = View {
            variables: &deep.variables,
            known: Known {
                state,
                setup,
                frames,
                kept,
                fanuc: is_fanuc(dialect),
                diameter: dialect.quirks.diameter,
            },
            unknown: Cell::new(None),
            unknown_name: Cell::new(false),
            open_angle: Cell::new(false),
            asked_control: Cell::new(false),
        };
        (view, &mut deep.compiled, file)
    }

    /// The value of an expression, and why it is not known where it is NaN.
    pub(crate) fn value(
        &mut self,
        dialect: &Dialect,
        program: &Program,
        range: TextRange,
        form: Form,
    ) -> Result<(Held, Option<String>), Trouble> {
        if self.mode == Mode::Text {
            only_read(dialect, program, range, form)?;
            return Ok((Some(f64::NAN), None));
        }
        let (view, compiled, file) = self.view(dialect);
        let held = evaluate(dialect, (program, file), (range, form), compiled, &view)?;
        let reason = held
            .is_some_and(f64::is_nan)
            .then(|| view.reason(program.text(range).trim()));
        if view.asked_control.get() {
            self.deep().variables.changes += 1;
        }
        Ok((held, reason))
    }
}

impl<F: FnMut(TextRange, FaultKind)> Reader<'_, '_, F> {
    /// The value of a word that is an expression; `Nothing` where it is `<vacant>`: the control then takes the word as not written.
    pub(crate) fn macro_value(&mut self, word: &Word, range: TextRange) -> WordValue {
        let Some(macros) = &mut self.macros else {
            return WordValue::Unread;
        };
        match macros.value(self.dialect, self.program, range, Form::Value) {
            Ok((None, _)) => WordValue::Nothing,
            Ok((Some(value), _)) if value.abs() <= LARGEST => WordValue::Number(Number {
                value,
                // a variable is taken as written with a decimal point; P has none
                has_point: word.address != Address::Letter(b'P') || value.fract() != 0.0,
                range: word.range,
            }),
            Ok((_, reason)) => {
                if let Some(what) = reason {
                    (self.report)(word.value_range, FaultKind::NotModelled { what });
                }
                WordValue::Unread
            }
            Err((range, kind)) => {
                (self.report)(range, kind);
                WordValue::Unread
            }
        }
    }

    /// A code whose number is an expression, in tenths: `G#1`. `None`: `<vacant>`, unknown, or not a code number.
    pub(crate) fn macro_code(&mut self, word: &Word, range: TextRange) -> Option<u32> {
        match self.macro_value(word, range) {
            WordValue::Nothing => None,
            WordValue::Number(number) if number.value >= 0.0 => {
                let tenths = (number.value * 10.0).round();
                ((tenths - number.value * 10.0).abs() < 1e-6 && tenths < 1e5).then_some(tenths as u32)
            }
            _ => {
                self.words.forgets_all = true;
                None
            }
        }
    }

    /// Takes a code that calls or returns, where calls are followed.
    pub(crate) fn takes_flow_code(&mut self, kind: CodeKind, tenths: u32, range: TextRange) -> bool {
        let macros = self.macros.as_mut().filter(|macros| macros.mode != Mode::Step);
        let (Some(macros), Some(code)) = (macros, flow_code(self.dialect, kind, tenths)) else {
            return false;
        };
        macros.deep().code = Some((code, range));
        (self.words.flow, self.words.reads_input) = (true, code == FlowCode::Branch);
        // what follows are arguments, which have their own reader
        self.words.declares = matches!(code, FlowCode::Macro | FlowCode::Modal);
        true
    }

    /// After a call or jump that is not followed all variables are unknown.
    pub(crate) fn flow_is_lost(&mut self, code: &Code) {
        if code.action == Action::SubprogramCall
            && let Some(macros) = &mut self.macros
        {
            macros.deep().variables.lose();
        }
    }

    /// A statement of a macro, where jumps are followed; false for other names.
    pub(crate) fn macro_statement(&mut self, call: &Call) -> bool {
        let Some(macros) = self.macros.as_mut().filter(|macros| macros.mode != Mode::Step) else {
            return false;
        };
        let Some(statement) = statement(self.program.bytes(call.name)) else {
            return false;
        };
        if self.words.declares {
            return true;
        }
        self.words.flow = true;
        macros.deep().statement.get_or_insert(call.range);
        match statement {
            Statement::Then => self.then(call),
            Statement::If => {
                let end = self.program.block(self.block).range().end;
                let rest = self
                    .program
                    .text(TextRange::new(call.range.end.min(end), end))
                    .to_ascii_uppercase();
                if !rest.contains("GOTO") && !rest.contains("THEN") {
                    let message = "IF without GOTO or THEN in its block".to_owned();
                    let kind = rejected(self.dialect, Mistake::Format, Refusal::Structure, message);
                    (self.report)(call.range, kind);
                }
                if self.condition(call) != Some(true) {
                    self.words.declares = true;
                }
            }
            Statement::While => {
                let holds = self.condition(call);
                if holds.is_none() {
                    self.words.declares = true;
                }
                self.pend(Transfer::Open(holds == Some(true)));
            }
            Statement::Do => self.loop_start(),
            Statement::End => self.pend(Transfer::Close),
            Statement::Goto => self.goto(call),
        }
        true
    }

    /// `<SUB>` after G65 or G66, whose other words are arguments.
    pub(crate) fn program_name_of_macro(&mut self, range: TextRange) {
        let named = self.program.bytes(range).first() == Some(&b'<');
        let deep = self.macros.as_ref().and_then(|macros| macros.deep.as_ref());
        if named && deep.is_some_and(|deep| deep.code.is_some()) {
            self.program_name(range);
        }
    }

    /// `<SUB>` names the program of the call before it; alone in a line of a Fanuc it is the name of the program; elsewhere it has no meaning.
    pub(crate) fn program_name(&mut self, range: TextRange) {
        let calls = self.macros.as_mut().is_some_and(|macros| {
            let code = macros.deep.as_ref().and_then(|deep| deep.code);
            macros.mode == Mode::Step || matches!(code, Some((code, _)) if code.takes_name())
        });
        let text = self.program.text(range);
        if calls {
            self.words.program_name = Some(range);
        } else if is_fanuc(self.dialect) && self.is_alone(range) && text.trim_end().ends_with('>') {
            // the name of the program, in place of its number
            self.words.has_values = false;
        } else {
            (self.report)(range, FaultKind::UnknownWord);
        }
    }

    /// Whether nothing else is in the line.
    fn is_alone(&self, range: TextRange) -> bool {
        let block = self
            .program
            .block_at(range.start)
            .map(|id| self.program.block(id).range());
        block.is_some_and(|block| self.program.text(block).trim() == self.program.text(range).trim())
    }

    /// Keeps what is to be done when the block has run; a run that cannot continue stays so.
    fn pend(&mut self, pending: Transfer) {
        if let Some(macros) = &mut self.macros
            && macros.mode == Mode::Follow
        {
            let deep = macros.deep();
            if !matches!(deep.pending, Some(Transfer::End)) {
                deep.pending = Some(pending);
            }
        }
    }

    /// DO: alone it opens a loop without condition.
    fn loop_start(&mut self) {
        let waits = self.macros.as_mut().is_some_and(|macros| {
            let pending = &macros.deep().pending;
            matches!(pending, Some(Transfer::Open(_) | Transfer::End))
        });
        if !waits {
            self.pend(Transfer::Open(true));
        }
    }

    /// Whether a condition holds; `None` where it is unknown, which ends the run.
    fn condition(&mut self, call: &Call) -> Option<bool> {
        let range = call.arguments.unwrap_or(call.range);
        let macros = self.macros.as_mut()?;
        let follows = macros.mode == Mode::Follow;
        match macros.value(self.dialect, self.program, range, Form::Condition) {
            Ok((held, None)) if follows => return Some(held.unwrap_or(0.0) != 0.0),
            // only its text is read: the rest of the block too
            Ok((_, None)) => return Some(true),
            Ok((_, Some(what))) => (self.report)(range, FaultKind::NotDecided { what }),
            Err((range, kind)) => (self.report)(range, kind),
        }
        self.pend(Transfer::End);
        None
    }

    fn goto(&mut self, call: &Call) {
        let range = call.arguments.unwrap_or(call.range);
        let Some(macros) = self.macros.as_mut() else { return };
        let follows = macros.mode == Mode::Follow;
        let wrong = match macros.value(self.dialect, self.program, range, Form::Value) {
            Ok((_, None)) if !follows => return,
            Ok((_, Some(what))) => Some((range, FaultKind::NotDecided { what })),
            Err(trouble) => Some(trouble),
            Ok((held, None)) => {
                if let Some(number) = held.and_then(sequence_number) {
                    let label = Label::number(number, range);
                    return self.pend(Transfer::Jump(label, Search::ForwardThenStart));
                }
                let message = format!("`{}` is not a sequence number", self.program.text(range).trim());
                let kind = rejected(self.dialect, Mistake::SequenceNumber, Refusal::Label, message);
                Some((range, kind))
            }
        };
        if let Some((range, kind)) = wrong {
            (self.report)(range, kind);
            self.pend(Transfer::End);
        }
    }

    /// `#1=`, `#[..]=`, `#_NAME=`; true where it was taken.
    pub(crate) fn macro_assignment(&mut self, name: TextRange, word: &Word) -> bool {
        let Some(macros) = &mut self.macros else { return false };
        macros.deep().statement.get_or_insert(word.range);
        self.words.has_values = true;
        self.words.flow = true;
        let value = match word.value {
            Value::Number(decimal) => Ok((Some(decimal.to_f64()), None)),
            Value::Expression(range) => macros.value(self.dialect, self.program, range, Form::Whole),
            _ => Ok((Some(f64::NAN), None)),
        };
        let (held, reason) = value.unwrap_or_else(|(range, kind)| {
            (self.report)(range, kind);
            (Some(f64::NAN), Some("an expression without a value".to_owned()))
        });
        let Some(macros) = &mut self.macros else { return true };
        let (view, ..) = macros.view(self.dialect);
        let target = assigned(self.dialect, self.program, name, &view);
        macros.deep().assigned = match target {
            Ok(Assigned::Number(index)) => index,
            _ => None,
        };
        match target {
            _ if macros.mode == Mode::Text => {}
            Ok(Assigned::Name(name)) => macros.deep().variables.set_named(&name, held),
            Ok(Assigned::Number(Some(index))) => self.assign(index, held, reason.as_deref(), word.range),
            Ok(Assigned::Number(None)) => {
                macros.deep().variables.lose();
                self.system_word(b"#", word.range);
            }
            Err((range, kind)) => (self.report)(range, kind),
        }
        true
    }

    fn assign(&mut self, index: i64, held: Held, reason: Option<&str>, range: TextRange) {
        let Some(macros) = &mut self.macros else { return };
        let (mistake, message) = match class(index) {
            Class::Local(_) | Class::Common(_) => {
                macros.deep().variables.set(index, held, reason);
                return;
            }
            Class::System(3000) if macros.mode == Mode::Follow => return self.alarm(held),
            Class::System(3006) if macros.mode == Mode::Follow => return,
            Class::System(number) if is_followed(number, self.dialect) && held.is_some_and(f64::is_finite) => {
                macros.deep().writes.push((number, held.unwrap_or(0.0)));
                return;
            }
            Class::System(number) => {
                macros.deep().variables.control_written(number);
                return self.system_word(format!("#{number}").as_bytes(), range);
            }
            Class::Vacant => (
                Mistake::ProtectedVariable,
                "#0 is always vacant and cannot be assigned".to_owned(),
            ),
            Class::Missing => (Mistake::VariableNumber, format!("there is no variable #{index}")),
        };
        (self.report)(range, rejected(self.dialect, mistake, Refusal::Variable, message));
    }

    /// `#3000=1(TEXT)`: the program stops itself with an alarm.
    fn alarm(&mut self, held: Held) {
        let block = self.program.block(self.block);
        let text = block.comments().next().map(|comment| self.text(comment.inner));
        let number = held
            .filter(|number| number.is_finite())
            .map(|number| format!("{}", 3000.0 + number));
        let parts = [number, text];
        let message = parts.into_iter().flatten().collect::<Vec<_>>().join(" ");
        (self.report)(block.range(), FaultKind::ProgramAlarm { message });
        self.pend(Transfer::End);
        self.words.declares = true;
    }
}

/// A number as in an N word.
fn sequence_number(value: f64) -> Option<u32> {
    (value >= 0.0 && value.fract() == 0.0 && value <= 99_999_999.0).then_some(value as u32)
}
