//! What a rule is: data, and a function that reads one level of the analysis.
use crate::{Severity, sink::Reporter};
use trunnion_interp::Fault;
use trunnion_machine::{Leg, Machine};
use trunnion_syntax::{Program, SyntaxError};

/// What a rule reads.
#[derive(Clone, Copy)]
pub enum Level {
    /// Each problem of the text.
    Text(fn(&Program, &SyntaxError, &mut Reporter<'_>)),
    /// Each fault of the run.
    Fault(fn(&Program, &Fault, &mut Reporter<'_>)),
    /// Each leg of the machine.
    Leg(fn(&Machine, &Leg, &mut Reporter<'_>)),
}

/// What silence means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Guarantee {
    /// Silence is a proof in the stated model; where the rule cannot decide it says unknown.
    Sound,
    /// Silence proves nothing.
    Heuristic,
}

/// One rule. Its name is its file's name with dashes, its documentation its file's header.
#[derive(Clone, Copy)]
pub struct Rule {
    /// `pole-flip`.
    pub name: &'static str,
    /// The header of its file, Markdown, without the comment marks.
    pub docs: &'static str,
    /// Severity unless the message says otherwise.
    pub severity: Severity,
    /// What silence means.
    pub guarantee: Guarantee,
    /// What it reads.
    pub level: Level,
}
