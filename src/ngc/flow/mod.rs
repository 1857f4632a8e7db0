//! The order of execution: O words, calls, files, `%`, the bounds of a run.
//!
//! A line is fetched, read and run. The parsed form of lines that run again is looked up by their text.
pub(crate) mod context;

mod call;
mod chain;
mod contour;
mod definitions;
mod endless;
mod ends;
mod fetch;
mod glance;
mod label;
mod labels;
mod lines;
mod numbered;
mod oline;
mod plain;
mod problems;
mod refused;
mod rest;
mod seek;
mod step;
mod structure;
mod texts;
mod undecided;

pub(crate) use problems::UNSET;
pub use refused::Refused;

use crate::read::Line;
use crate::{At, ChainId, Error, FileId, Setup};
use chain::Chains;
use context::Context;
use labels::{LabelId, Labels, NameId, Place, Style};
use lines::Lines;
use oline::OLine;
use trunnion_syntax::TextRange;

/// A line did not run to its end. That is rare: the reason is stored separately, so that success is returned in a register.
#[derive(Debug)]
pub(crate) struct Halt(Box<Why>);

/// Why a line did not run to its end.
#[derive(Debug)]
pub(crate) enum Why {
    /// The control refuses it.
    Refused(Error),
    /// The control refuses it, and the errors are reported.
    Told,
    /// What happens depends on something unknown: the sentence that says so.
    Undecided(String),
    /// The loop that this line opens never ends.
    Endless(Place),
}

impl From<Why> for Halt {
    #[cold]
    fn from(why: Why) -> Self {
        Self(Box::new(why))
    }
}

impl From<Error> for Halt {
    #[cold]
    fn from(error: Error) -> Self {
        Why::Refused(error).into()
    }
}

/// The kind of a line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum Kind {
    /// Nothing to run.
    #[default]
    Blank,
    /// `%` alone.
    Percent,
    /// Words, assignments, comments.
    Words,
    /// An O line.
    Label,
    /// `M98`, the words after it.
    CallNumbered,
    /// `M99`: a return inside a call, words outside.
    ReturnNumbered,
}

/// A line in its parsed form.
#[derive(Debug, Default)]
pub(crate) struct Compiled {
    place: Place,
    next: Place,
    kind: Kind,
    /// It is one assignment and nothing else.
    only_sets: bool,
    o: Option<Box<OLine>>,
    /// Its former O line, kept for its storage.
    spare: Option<Box<OLine>>,
    /// The text cut off by a NUL, until it is reported.
    cut: Option<TextRange>,
    /// What is wrong with its text as a whole; it is not read further then.
    flaw: Option<Error>,
    line: Line,
    /// Where skipping from here ended the last time.
    skip: lines::Skip,
    /// The text of which it is the parsed form.
    origin: texts::Origin,
}

/// The goal for which lines are skipped.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Goal {
    /// The next line that concerns this label.
    Label(LabelId, NameId),
    /// The end of the definition of a subprogram.
    Definition(NameId),
    /// The first line of a subprogram that was called in this style.
    Subprogram(NameId, Style),
}

/// Lines are being skipped.
#[derive(Clone, Copy, Debug)]
struct Seeking {
    goal: Goal,
    /// The line that began it.
    opener: Place,
    /// `break` or `continue` began it.
    leaving: bool,
    /// `continue`: the loop continues where it ends.
    again: bool,
    /// A branch of this `if` has run.
    satisfied: bool,
    /// The path of the skip does not depend on values.
    fixed: bool,
    /// `here` is where it ends.
    known: bool,
}

/// A call in progress.
#[derive(Clone, Debug)]
struct Call {
    /// The line after the call.
    back: Place,
    /// The line of the call.
    site: At,
    /// Which subprogram made the call, in which style it is written, and the chain that led there.
    sub: NameId,
    style: Style,
    chain: ChainId,
    /// The subprogram's second line, and the rounds (`L`) that are left.
    body: Option<Place>,
    rounds: i64,
    context: Option<Box<Context>>,
}

/// Where the run is.
#[derive(Debug, Clone)]
pub(crate) struct Flow {
    here: Place,
    /// The line that ran last.
    at: At,
    /// The line that ran last, with its first byte.
    ran: Place,
    started: bool,
    ended: bool,
    /// The line that ended the main program.
    end: Option<Place>,
    /// The program began with `%`.
    percent: bool,
    /// Fanuc-style subprograms are switched off.
    no_fanuc: bool,
    sub: NameId,
    chain: ChainId,
    calls: Vec<Call>,
    /// Style of the subprogram that runs.
    style: Style,
    /// Something was called: as on the control, the main program may `return` from then on.
    called: bool,
    seeking: Option<Seeking>,
    /// Lines of the main program that had words.
    did: u64,
    /// The subprograms that the main program defined, in order, and how many of them were entered without a call.
    defined: Vec<NameId>,
    entered: usize,
    /// A `do` line has ended the skip of a `break`, which the next end of a loop obeys, as on the control.
    broken: bool,
    labels: Labels,
    chains: Chains,
    /// The innermost loop was entered, as far as its lines show: what runs now will run again and is worth keeping.
    looping: bool,
    lines: Vec<Lines>,
    /// Lines that may still run again.
    fuel: u64,
    /// Saved by M70 and M73 outside of calls.
    context: Option<Box<Context>>,
    /// What was reported of parameters that nothing has set.
    unset: std::collections::BTreeSet<String>,
    /// Passes of loops without a call to the machine.
    watch: endless::Watch,
    /// Where the last missing subprogram was searched.
    searched: Vec<crate::Searched>,
    /// What the last refused line named.
    refused: Refused,
    /// Lines in their parsed form.
    texts: texts::Texts,
}

impl Flow {
    /// A motion of a cycle counts as an executed line.
    pub(crate) fn spend(&mut self) {
        self.fuel = self.fuel.saturating_sub(1);
    }
    /// Whether the definition of a subroutine is skipped.
    pub(crate) fn is_defining(&self) -> bool {
        self.seeking
            .is_some_and(|seeking| matches!(seeking.goal, Goal::Definition(_)))
    }
    /// How many names, labels and chains of calls a copy copies, or the first change after it.
    pub(crate) fn copied(&self) -> usize {
        self.labels.count() + self.chains.count()
    }
    /// Whether the bound on lines is reached.
    pub(crate) fn is_spent(&self) -> bool {
        self.fuel == 0
    }
    /// Before the first line.
    pub(crate) fn new(setup: &Setup) -> Self {
        Self {
            here: Place::default(),
            at: At::default(),
            ran: Place::default(),
            started: false,
            ended: false,
            end: None,
            percent: false,
            no_fanuc: fanuc_is_off(setup),
            sub: NameId::MAIN,
            chain: ChainId::default(),
            calls: Vec::new(),
            style: Style::Sub,
            called: false,
            seeking: None,
            did: 0,
            defined: Vec::new(),
            entered: 0,
            broken: false,
            looping: false,
            labels: Labels::new(),
            chains: Chains::default(),
            lines: vec![Lines::default()],
            fuel: setup.limits.blocks,
            context: None,
            unset: std::collections::BTreeSet::new(),
            watch: endless::Watch::default(),
            searched: Vec::new(),
            refused: Refused::default(),
            texts: texts::Texts::default(),
        }
    }
    /// The line that ran last.
    pub(crate) fn at(&self) -> At {
        self.at
    }
    /// M2, M30 or M99 has ended the program.
    pub(crate) fn met_end(&self) -> bool {
        self.end.is_some()
    }
    /// The calls of a chain, outermost first.
    pub(crate) fn frames(&self, id: ChainId) -> Vec<crate::Frame> {
        self.chains.frames(id, &self.labels)
    }
    /// The context saved at this level of calls.
    fn saved(&mut self) -> &mut Option<Box<Context>> {
        match self.calls.last_mut() {
            Some(call) => &mut call.context,
            None => &mut self.context,
        }
    }
    /// What is remembered about a file's lines.
    fn lines(&mut self, file: FileId) -> &mut Lines {
        let at = file.0 as usize;
        if at >= self.lines.len() {
            self.lines.resize_with(at + 1, Lines::default);
        }
        &mut self.lines[at]
    }
}

/// `[RS274NGC] DISABLE_FANUC_STYLE_SUB`: off where it is a number other than 0.
fn fanuc_is_off(setup: &Setup) -> bool {
    let key = ("RS274NGC".to_owned(), "DISABLE_FANUC_STYLE_SUB".to_owned());
    let value = setup.ini.values.get(&key).map_or("", String::as_str);
    value.trim().parse::<i64>().is_ok_and(|number| number != 0)
}
