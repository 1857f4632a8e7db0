//! Rewrites, proposals, and what becomes of them.
use trunnion_certify::{Certificate, Claim};
use trunnion_check::Settings;
use trunnion_syntax::{Program, TextEdit};

/// What the user allows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Tip (or ball centre) may move by this much, mm.
    pub tolerance_mm: f64,
    /// Tool axis may turn by this much, deg.
    pub tolerance_deg: f64,
}

impl Default for Options {
    fn default() -> Self {
        Self { tolerance_mm: 0.001, tolerance_deg: 0.1 }
    }
}

/// A proposal: edits and what they claim.
#[derive(Clone, Debug, PartialEq)]
pub struct Proposal {
    /// Sorted, not overlapping.
    pub edits: Vec<TextEdit>,
    /// The claim to prove.
    pub claim: Claim,
    /// What it does, in numbers, for people.
    pub summary: String,
}

/// One rewrite; its docs are its file's header.
#[derive(Clone, Copy)]
pub struct Rewrite {
    /// `smooth-pole`.
    pub name: &'static str,
    /// Header of its file.
    pub docs: &'static str,
    /// Rules whose findings it may cure.
    pub cures: &'static [&'static str],
    /// Proposes; `Err` says why not (for people); `Ok(None)`: nothing to do.
    pub propose: fn(&Program, &Settings<'_>, &Options) -> Result<Option<Proposal>, String>,
}

/// What became of a rewrite.
#[derive(Clone, Debug)]
pub enum Attempt {
    /// Nothing to do.
    NothingToDo,
    /// Refused: the reason (undeclared tool shape, unknown position, not proved ...).
    Refused(String),
    /// Proved.
    Certified {
        /// Edits, sorted.
        edits: Vec<TextEdit>,
        /// The text after.
        after: Vec<u8>,
        /// The proof.
        certificate: Box<Certificate>,
        /// What it does.
        summary: String,
    },
}

/// Proposes, has it certified, and re-checks the certificate.
pub fn attempt(rewrite: &Rewrite, program: &Program, settings: &Settings<'_>, options: &Options) -> Attempt {
    let _ = (rewrite, program, settings, options);
    todo!()
}
