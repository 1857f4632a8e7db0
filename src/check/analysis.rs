//! One check of one program: run, follow, judge.
use crate::{Diagnostic, Severity, Settings};
use trunnion_syntax::Program;

/// The verdict on a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Nothing at or above error, nothing unknown.
    Pass,
    /// Some error.
    Fail,
    /// No error, but something could not be decided.
    Unknown,
}

/// Counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Summary {
    /// Blocks with content (not empty lines).
    pub blocks: u64,
    /// Motions.
    pub motions: u64,
    /// Errors.
    pub errors: u64,
    /// Warnings.
    pub warnings: u64,
    /// Infos with status fail.
    pub infos: u64,
    /// Diagnostics with status unknown.
    pub unknown: u64,
}

/// What a check found.
#[derive(Clone, Debug)]
pub struct Report {
    /// Sorted by place.
    pub diagnostics: Vec<Diagnostic>,
    /// Counts.
    pub summary: Summary,
    /// Lowest and highest time the program takes, s, without acceleration (lowest) ...; `None`: unknown.
    pub cycle_time_s: Option<[f64; 2]>,
}

impl Report {
    /// The verdict when findings at or above `deny` count as failures.
    pub fn verdict(&self, deny: Severity) -> Verdict {
        let _ = deny;
        todo!()
    }
}

/// Checks a parsed program. Streams: memory beyond the program is small and does not grow with it.
pub fn check(program: &Program, settings: &Settings<'_>) -> Report {
    let _ = (program, settings);
    todo!()
}
