//! The order in which the blocks of a program run, for all languages but LinuxCNC's: what trunnion-flow keeps, tied to the interpreter.
//!
//! A language reads its statements and leaves a [`Transfer`]; [`crate::Interpreter::advance`] does it. While a program has no such
//! statement, nothing here runs: [`Flow::trail`] stays empty.
mod call;
pub(crate) mod reported;
mod run;
pub(crate) mod through;
mod transfer;

use crate::macro_b::{self, Deep, Mistake};
use crate::{osp, sinumerik};
use reported::ReportedFaults;
pub(crate) use run::Running;
pub(crate) use sinumerik::Text;
use std::sync::Arc;
use trunnion_dialect::Language;
use trunnion_flow::{Course, Key, Library};
use trunnion_syntax::{Program, TextRange};

/// Where a run is in its program.
#[derive(Clone, Debug, Default)]
pub(crate) struct Flow {
    /// The block that runs next, of the file that runs.
    pub(crate) next: u32,
    /// The end was told.
    pub(crate) finished: bool,
    /// Blocks are run by [`crate::Interpreter::advance`], so that jumps are followed.
    pub(crate) follows: bool,
    /// What jumps, loops and calls need; empty until the first of them.
    pub(crate) trail: Option<Box<Trail>>,
    /// Variables of Macro B; empty until the first statement of a macro.
    pub(crate) deep: Option<Box<Deep>>,
}

/// What a program with jumps, loops or calls needs.
#[derive(Clone, Debug, Default)]
pub(crate) struct Trail {
    pub(crate) course: Course<Level>,
    pub(crate) library: Library,
    /// Targets of jumps, by file.
    indexes: Vec<Option<Arc<Index>>>,
    /// A program that is missing was called: it may have left a loop, or ended the run.
    called_unread: bool,
    reported: ReportedFaults,
}

/// What a language stores for a call.
#[derive(Clone, Debug)]
pub(crate) enum Level {
    /// A section of the program that is repeated: nothing.
    Section,
    MacroB(macro_b::Level),
    Sinumerik(Box<sinumerik::Level>),
    Task(Box<osp::Level>),
}

/// Targets of the jumps of a file.
pub(crate) type Index = trunnion_flow::Index<Broken>;

/// What a block requests.
pub(crate) type Transfer = trunnion_flow::Transfer<Label, Calling, Back>;

/// A mistake in the structure of a file, with its place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Broken {
    pub(crate) block: u32,
    pub(crate) range: TextRange,
    pub(crate) mistake: Mistake,
    pub(crate) message: String,
}

/// The target of a jump, and the place where it is written.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Label {
    pub(crate) key: Key,
    pub(crate) range: TextRange,
    /// A missing target is not a mistake: the run continues (GOTOC).
    pub(crate) may_miss: bool,
}

/// A return: the label of the caller to go to, and the place of the statement.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Back {
    pub(crate) label: Option<Key>,
    pub(crate) range: TextRange,
}

/// A call that a block requests.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Calling {
    pub(crate) program: Key,
    pub(crate) times: u32,
    pub(crate) range: TextRange,
    pub(crate) with: With,
}

/// What a language hands over with a call.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum With {
    MacroB(macro_b::With),
    Sinumerik(sinumerik::With),
    Task(osp::With),
}

impl Trail {
    /// Targets of the jumps of a file.
    pub(crate) fn index(&mut self, file: u16, read: impl FnOnce() -> Index) -> Arc<Index> {
        let place = usize::from(file);
        if self.indexes.len() <= place {
            self.indexes.resize(place + 1, None);
        }
        Arc::clone(self.indexes[place].get_or_insert_with(|| Arc::new(read())))
    }

    /// Whether no call is open and no jump, loop or call had to look for its target.
    pub(crate) fn follows_nothing(&self) -> bool {
        self.course.depth() == 0 && self.indexes.is_empty()
    }

    /// The same of a file that was indexed before.
    pub(crate) fn known_index(&self, file: u16) -> Option<&Arc<Index>> {
        self.indexes.get(usize::from(file))?.as_ref()
    }
}

impl Flow {
    /// How many entries of lists that grow with the program a clone copies.
    pub(crate) fn copied(&self) -> usize {
        let trail = self.trail.as_ref();
        let deep = self.deep.as_ref();
        trail.map_or(0, |trail| {
            trail.course.copied() + trail.reported.copied() + trail.library.copied()
        }) + deep.map_or(0, |deep| deep.variables.copied())
    }

    /// What jumps, loops and calls need.
    pub(crate) fn trail(&mut self) -> &mut Trail {
        self.trail.get_or_insert_default()
    }

    /// The file that runs: 0 is the main program's.
    #[inline]
    pub(crate) fn file(&self) -> u16 {
        self.trail.as_ref().map_or(0, |trail| trail.course.place().file)
    }

    /// The calls of a chain, outermost first.
    pub(crate) fn chain(&self, chain: crate::ChainId) -> Vec<crate::Frame> {
        let trail = self.trail.as_ref();
        trail.map_or_else(Vec::new, |trail| trail.course.frames(chain))
    }

    /// Common variables of Macro B that keep their values when the program ends, from the number `first` on.
    pub(crate) fn outliving(&self, first: u32) -> Vec<(String, f64)> {
        self.deep
            .as_ref()
            .map_or_else(Vec::new, |deep| deep.variables.kept(first))
    }

    /// Those from `first` on that are vacant.
    pub(crate) fn vacant(&self, first: u32) -> Vec<String> {
        self.deep
            .as_ref()
            .map_or_else(Vec::new, |deep| deep.variables.vacant(first).collect())
    }

    /// All variables of Macro B that have a value.
    pub(crate) fn all_variables(&self) -> Vec<crate::Argument> {
        self.deep.as_ref().map_or_else(Vec::new, |deep| deep.variables.all())
    }

    /// The one of [`Self::all_variables`] with this name.
    pub(crate) fn known_variable(&self, name: &str) -> Option<crate::Argument> {
        self.deep.as_ref()?.variables.of_all(name)
    }

    /// The value of a variable of Macro B as it is written.
    pub(crate) fn variable(&self, text: &str) -> Option<f64> {
        self.deep.as_ref()?.variables.written(text)
    }
}

/// The index of a file, as its language builds it.
pub(crate) fn index_of(dialect: &trunnion_dialect::Dialect, program: &Program) -> Index {
    match dialect.quirks.language {
        Language::Sinumerik => sinumerik::index(program),
        Language::UserTask => osp::index(program),
        Language::Words | Language::MacroB | Language::Linuxcnc => macro_b::index(program),
    }
}
