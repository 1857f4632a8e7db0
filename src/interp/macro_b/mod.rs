//! Custom macro B of Fanuc and the flow of its programs: variables, IF, GOTO, WHILE, M97, M98, G65, G66, M99.
//!
//! Source where none is named: Fanuc Series 30i operator's manual, chapters "Preparing programs" and "Custom macro"; levels of macro
//! calls, mixture of arguments and their units: Series 16i/18i-PB operator's manual, B-63684EN/01, p. 278.
//!
//! While a program has no such statement, nothing here runs: [`Flow::deep`] stays empty.
mod alarms;
mod arguments;
mod call;
mod chains;
mod evaluate;
mod finish;
mod index;
mod jump;
mod name;
mod ran;
mod read;
mod run;
mod system;
mod through;
mod variables;
mod words;

use crate::ChainId;
use chains::Chains;
use evaluate::Compiled;
pub(crate) use index::Index;
pub(crate) use name::ProgramName;
use ran::{Ran, Told};
pub(crate) use read::Macros;
use std::collections::HashMap;
use std::sync::Arc;
use trunnion_syntax::{BlockId, Program, TextRange};
use variables::{Locals, Variables};

/// Where a run is in its program.
#[derive(Clone, Debug, Default)]
pub(crate) struct Flow {
    /// The block that runs next, of the file that runs.
    pub(crate) next: u32,
    /// The end was told.
    pub(crate) finished: bool,
    /// Blocks are run by [`crate::Interpreter::advance`], so that jumps are followed.
    pub(crate) follows: bool,
    /// The block of the main program whose call led to the other file that runs.
    pub(crate) called_at: Option<BlockId>,
    /// What macros need; empty until the first statement of one.
    pub(crate) deep: Option<Box<Deep>>,
}

/// What a program with macro statements needs.
#[derive(Clone, Debug, Default)]
pub(crate) struct Deep {
    pub(crate) variables: Variables,
    compiled: Compiled,
    /// Offsets of the control that the block in hand writes: number of the variable, value in program units.
    pub(crate) writes: Vec<(u32, f64)>,
    /// What the block in hand asks for, done when it has run.
    pub(crate) pending: Option<Pending>,
    /// A code of the block in hand that calls or returns.
    pub(crate) code: Option<(FlowCode, TextRange)>,
    /// The block in hand assigns a variable or decides something.
    pub(crate) statement: Option<TextRange>,
    calls: Vec<Call>,
    modal: Vec<Modal>,
    /// How many of the modal calls count where the run is.
    modal_active: usize,
    place: Place,
    /// Other programs: file `n` is at `n - 1`.
    files: Vec<Arc<Called>>,
    indexes: Vec<Option<Arc<Index>>>,
    ran: Ran,
    told: Told,
    chains: Arc<Chains>,
    /// Executed blocks.
    executed: u64,
    /// The DO to which an END has just gone back.
    again: Option<u32>,
    /// How often each loop, by file and opening block, began anew since it was entered, and what had changed by then.
    turns: HashMap<(u16, u32), Turns>,
    /// A loop whose turns are all alike.
    endless: Option<(u16, u32)>,
}

/// Where the run is.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Place {
    /// 0: the main program's file.
    file: u16,
    /// Blocks of the program that runs, among those of its file: first, one past the last. Not known before the first jump.
    section: Option<(u32, u32)>,
    /// The block of the main program's file that runs, or whose call led here.
    main: BlockId,
    main_range: TextRange,
}

/// Another file that is called.
#[derive(Debug)]
pub(crate) struct Called {
    name: ProgramName,
    path: String,
    program: Program,
}

/// Turns of a loop.
#[derive(Clone, Copy, Debug, Default)]
struct Turns {
    count: u64,
    /// [`Variables::changes`] when the last one began.
    changes: u64,
}

/// One call.
#[derive(Clone, Debug)]
struct Call {
    /// The block behind the call.
    back: u32,
    place: Place,
    chain: ChainId,
    /// First block of what is called.
    start: u32,
    /// Further times that it runs.
    times: u32,
    modal_active: usize,
    /// A macro call: the caller's variables, and the arguments, for each time anew.
    macro_level: Option<Box<(Locals, Locals)>>,
    /// The modal call that this is.
    modal: Option<usize>,
}

/// G66: a macro that is called after each motion.
#[derive(Clone, Debug)]
struct Modal {
    program: ProgramName,
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

/// What a block asks for.
#[derive(Clone, Debug)]
pub(crate) enum Pending {
    /// GOTO: the sequence number, and the place of the jump.
    Goto(u32, TextRange),
    /// DO, and whether its WHILE holds.
    Do(bool),
    /// END.
    End,
    /// M97, M98, M198, G65.
    Call(Calling),
    /// M99, with the sequence number to go to.
    Return(Option<u32>, TextRange),
    /// The program ends here: it cannot be followed, or stops itself with an alarm.
    Stop,
}

/// A call that a block asks for.
#[derive(Clone, Debug)]
pub(crate) struct Calling {
    code: FlowCode,
    program: ProgramName,
    times: u32,
    arguments: Option<Box<Locals>>,
    range: TextRange,
    modal: Option<usize>,
}
