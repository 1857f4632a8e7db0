//! Custom macro B of Fanuc and the flow of its programs: variables, IF, GOTO, WHILE, M97, M98, G65, G66, M99.
//!
//! Source where none is named: Fanuc Series 30i operator's manual, chapters "Preparing programs" and "Custom macro"; levels of macro
//! calls, mixture of arguments and their units: Series 16i/18i-PB operator's manual, B-63684EN/01, p. 278.
//!
//! While a program has no such statement, nothing here runs: [`crate::flow::Flow::deep`] stays empty.
mod alarms;
mod arguments;
mod call;
mod evaluate;
mod finish;
mod index;
mod name;
mod read;
mod statement;
mod system;
mod variables;
mod words;

use crate::Argument;
use crate::flow::{Calling, Transfer, With as Handed};
pub(crate) use alarms::{Mistake, is_fanuc, rejected};
pub(crate) use call::{Level, With};
use evaluate::Compiled;
pub(crate) use index::index;
pub(crate) use name::{ProgramName, files};
pub(crate) use read::Macros;
use trunnion_flow::Key;
use trunnion_syntax::TextRange;
use variables::{Locals, Variables};

/// What a program with macro statements needs in addition to the flow.
#[derive(Clone, Debug, Default)]
pub(crate) struct Deep {
    pub(crate) variables: Variables,
    compiled: Compiled,
    /// Offsets of the control that the current block writes: number of the variable, value in program units.
    pub(crate) writes: Vec<(u32, f64)>,
    /// What the current block requests, done when it has run.
    pub(crate) pending: Option<Transfer>,
    /// A code of the current block that calls or returns.
    pub(crate) code: Option<(FlowCode, TextRange)>,
    /// The number of the variable that was assigned last, where it is known.
    pub(crate) assigned: Option<i64>,
    /// The current block assigns a variable or decides something.
    pub(crate) statement: Option<TextRange>,
    modal: Vec<Modal>,
    /// How many of the modal calls apply at this point of the run.
    modal_active: usize,
}

/// G66: a macro that is called after each motion.
#[derive(Clone, Debug)]
struct Modal {
    program: Key,
    times: u32,
    arguments: Box<Locals>,
}

/// A code that calls, or returns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum FlowCode {
    /// M98.
    Call,
    /// M97: by sequence number.
    CallLocal,
    /// M198: a program of an external memory.
    CallExternal,
    /// M96 of a Haas: jumps while an input is off.
    Branch,
    /// M99.
    Return,
    /// G65.
    Macro,
    /// G66.
    Modal,
    /// G67.
    ModalOff,
}

impl FlowCode {
    /// Whether the program may be called by its name.
    fn takes_name(self) -> bool {
        matches!(self, Self::Call | Self::CallExternal | Self::Macro | Self::Modal)
    }
}

impl Deep {
    /// The active modal calls as they are compared.
    pub(crate) fn modal_words(&self) -> impl Iterator<Item = Argument> {
        let active = self.modal.iter().take(self.modal_active);
        active.flat_map(|modal| macro_words(&modal.program, modal.times, &modal.arguments))
    }
    /// The macro that is called after a motion, if one is.
    pub(crate) fn modal_call(&self, range: impl FnOnce() -> TextRange) -> Option<Calling> {
        let place = self.modal_active.checked_sub(1)?;
        let modal = self.modal.get(place)?;
        Some(Calling {
            program: modal.program.clone(),
            times: modal.times,
            range: range(),
            with: Handed::MacroB(With {
                code: FlowCode::Macro,
                arguments: Some(modal.arguments.clone()),
                modal: Some(place),
            }),
        })
    }
}

/// A macro call as it is compared: its program, how often it runs, and its arguments.
pub(crate) fn macro_words(program: &Key, times: u32, locals: &Locals) -> Vec<Argument> {
    let mut words = vec![
        Argument::text("macro", &ProgramName(program).to_string()),
        Argument::number("times", f64::from(times)),
    ];
    let given = locals
        .iter()
        .enumerate()
        .filter_map(|(number, value)| Some((number, (*value)?)));
    words.extend(given.map(|(number, value)| Argument::number(format!("#{number}"), value)));
    words
}
