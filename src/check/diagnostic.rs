//! A finding, as plain data: terminal, JSON and LSP are all its clients.
use trunnion_interp::ChainId;
use trunnion_syntax::TextRange;

/// How bad.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// Worth knowing.
    Info,
    /// Probably wrong or costly.
    Warning,
    /// Wrong: must not run.
    Error,
}

/// Whether the rule decided.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Status {
    /// The rule is broken.
    Fail,
    /// The rule could not decide; the message says what is missing.
    Unknown,
}

/// A number or text in `values`; keys carry their unit as suffix (`rotary_change_deg`).
#[derive(Clone, Debug, PartialEq)]
pub enum ValueKey {
    /// A number.
    Number(f64),
    /// A text, e.g. an axis letter.
    Text(String),
}

/// One finding.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// The rule's name.
    pub rule: &'static str,
    /// How bad.
    pub severity: Severity,
    /// Decided or not.
    pub status: Status,
    /// Bytes in the file.
    pub range: TextRange,
    /// Block number as written (`N2930`), if any.
    pub block: Option<String>,
    /// What is wrong, in one sentence with numbers and units.
    pub message: String,
    /// Why it matters, other numbers.
    pub notes: Vec<String>,
    /// What to do.
    pub help: Option<String>,
    /// Every number of the message.
    pub values: Vec<(&'static str, ValueKey)>,
    /// Rewrites that may cure it.
    pub fixes: Vec<&'static str>,
    /// The text that the place of the finding should have instead, where one is likely: an editor offers it.
    pub replacement: Option<String>,
    /// Other places of interest in the file.
    pub related: Vec<(TextRange, String)>,
    /// How many executed blocks share the finding (1 for one): consecutive ones, and those of later passes of a loop.
    pub count: u32,
    /// Range of the last of the consecutive ones.
    pub last: TextRange,
    /// The other findings of the event that this one leads; its notes say each in a sentence.
    pub also: Vec<Diagnostic>,
    /// Its level without the other findings of its event, where one of them raised it.
    pub(crate) own_severity: Option<Severity>,
    /// How the run reached it; the notes report it.
    pub(crate) origin: Origin,
}

impl Diagnostic {
    /// How bad it is by itself: its `severity` is also that of the other findings of its event.
    pub fn own_severity(&self) -> Severity {
        self.own_severity.unwrap_or(self.severity)
    }

    /// Whether it follows from the blocks at its place and shortly before: not where it is reported once for the program, and not where it
    /// was found by looking at the program as a whole.
    pub fn is_of_place(&self) -> bool {
        !self.origin.of_whole
    }
}

/// How a run came to a finding.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Origin {
    /// The calls.
    pub(crate) chain: ChainId,
    /// Counter of what later passes find here.
    pub(crate) later: Option<u32>,
    /// It is reported once for the program, or follows from all of it.
    pub(crate) of_whole: bool,
}
