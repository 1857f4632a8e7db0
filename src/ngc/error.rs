//! Why a line is refused.
use crate::FileId;
use std::sync::Arc;
use trunnion_syntax::TextRange;
use trunnion_vocabulary::Refusal as Class;

/// One cause of refusal. Each module declares its own as constants, next to the code that finds it.
#[derive(Debug, PartialEq, Eq)]
pub struct Problem {
    /// Sort.
    pub class: Class,
    /// The control's own message, as `rs274` prints it; `{}` is replaced by a detail.
    pub message: &'static str,
    /// What to do, one sentence; may be empty.
    pub help: &'static str,
}

/// A refused line.
#[derive(Clone, Debug, PartialEq)]
pub struct Error {
    /// Cause.
    pub problem: &'static Problem,
    /// The message where it has details (numbers, names); else that of the problem is used.
    pub detail: Option<String>,
    /// File.
    pub file: FileId,
    /// Bytes in that file: the word or part that is wrong.
    pub range: TextRange,
    /// The line that the control had read last, where that is not the line that is wrong: it is the one that `rs274` quotes.
    pub read_last: Option<(FileId, TextRange)>,
    /// The file name for messages; empty for the main program. Filled in by the engine.
    pub path: Arc<str>,
    /// A missing subprogram.
    pub missing: Option<Box<Missing>>,
}

/// A subprogram that was not found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Missing {
    /// Its name in the call.
    pub name: String,
    /// Folders that were searched, after the rest of the program.
    pub searched: Vec<crate::Searched>,
}

impl Error {
    /// A parameter is read that nothing has set: the line runs, and only what depends on it is unknown.
    pub fn is_of_unset(&self) -> bool {
        self.problem == &crate::flow::UNSET
    }

    /// The program stops itself with this text: `(ABORT,...)`.
    pub fn abort(&self) -> Option<&str> {
        let aborts = self.problem == &crate::comment::ABORT;
        aborts.then(|| self.detail.as_deref().unwrap_or_default())
    }

    /// A refusal without details. The file is filled in by the engine.
    #[cold]
    pub fn new(problem: &'static Problem, range: TextRange) -> Self {
        Self {
            problem,
            detail: None,
            file: FileId::MAIN,
            range,
            read_last: None,
            path: Arc::from(""),
            missing: None,
        }
    }
    /// A refusal whose message has details: the whole text as the control prints it.
    #[cold]
    pub fn with(problem: &'static Problem, range: TextRange, detail: String) -> Self {
        Self {
            detail: Some(detail),
            ..Self::new(problem, range)
        }
    }
    /// The control's own message.
    pub fn message(&self) -> &str {
        self.detail.as_deref().unwrap_or(self.problem.message)
    }
}
