//! Rewrites and their proposals.
use crate::Known;
use trunnion_certify::Claim;
use trunnion_certify::RefitSource;
use trunnion_certify::postures::PostureCost;
use trunnion_check::config::{FixCost, FixPoint, FixSettings, FixSource};
use trunnion_check::{Diagnostic, Settings};
use trunnion_syntax::{BlockId, Format, Program, TextEdit};

/// What the user allows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Options {
    /// Tip (or ball centre) may move by this much, mm.
    pub tolerance_mm: f64,
    /// Tool axis may turn by this much, deg.
    pub tolerance_deg: f64,
    /// What a sequence of postures is chosen by (`switch-angles`).
    pub cost: PostureCost,
    /// The tolerance that the user gave, mm, for rewrites with a default of their own: `insert-points` (the machine's tolerance of the tip) and
    /// `drop-redundant` (only points exactly on the line).
    pub given_mm: Option<f64>,
    /// Cuts that are slower than this are made as fast as the axes allow, up to this, mm/min (`adapt-feed`). 0: none is made faster.
    pub feed_mm_min: f64,
    /// What a refitted path must be near (`fit-arcs`, `fit-splines`).
    pub source: RefitSource,
    /// Which point of a ball X Y Z are (`smooth-pole`).
    pub point: ProgrammedPoint,
}

/// Which point of a ball X Y Z of a program are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ProgrammedPoint {
    /// Its tip.
    #[default]
    Tip,
    /// Its centre: the tool length is measured to there.
    Centre,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            tolerance_mm: 0.001,
            tolerance_deg: 0.1,
            cost: PostureCost::default(),
            given_mm: None,
            feed_mm_min: 0.0,
            source: RefitSource::default(),
            point: ProgrammedPoint::default(),
        }
    }
}

impl Options {
    /// The defaults, overridden by `[fix]` of `trunnion.toml`.
    pub fn of(settings: &FixSettings) -> Self {
        let defaults = Self::default();
        Self {
            tolerance_mm: settings.tolerance_mm.unwrap_or(defaults.tolerance_mm),
            tolerance_deg: settings.tolerance_deg.unwrap_or(defaults.tolerance_deg),
            cost: settings.cost.map_or(defaults.cost, |cost| match cost {
                FixCost::Travel => PostureCost::Travel,
                FixCost::Time => PostureCost::Time,
                FixCost::Deviation => PostureCost::Deviation,
            }),
            given_mm: settings.tolerance_mm,
            point: settings.point.map_or(defaults.point, |point| match point {
                FixPoint::Tip => ProgrammedPoint::Tip,
                FixPoint::Centre => ProgrammedPoint::Centre,
            }),
            source: settings.source.map_or(defaults.source, |source| match source {
                FixSource::Points => RefitSource::Points,
                FixSource::Chords => RefitSource::Chords,
            }),
            feed_mm_min: settings.feed_mm_min.unwrap_or(defaults.feed_mm_min),
        }
    }
}

/// What a rewrite wants at one place.
#[derive(Clone, Debug, PartialEq)]
pub enum Change {
    /// These edits: sorted, not overlapping, inside the place.
    Edits(Vec<TextEdit>),
    /// Nothing yet: it would be possible if something were declared or allowed; what that is.
    Possible(String),
    /// Nothing, and why.
    Refused(String),
}

/// Blocks that a rewrite changes together, or leaves together. Places do not overlap, and each can be left out without the others:
/// the claim holds for every subset.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// The first block whose motion changes.
    pub first: BlockId,
    /// The last block whose motion changes.
    pub last: BlockId,
    /// What is wanted.
    pub change: Change,
}

impl Place {
    /// The blocks of all edits as one place: what is changed as a whole or not at all.
    pub fn around(program: &Program, edits: Vec<TextEdit>) -> Self {
        let block = |edit: Option<&TextEdit>| {
            edit.and_then(|edit| program.block_at(edit.range.start))
                .unwrap_or_default()
        };
        Self {
            first: block(edits.first()),
            last: block(edits.last()),
            change: Change::Edits(edits),
        }
    }
}

/// A proposal: edits and what they claim.
#[derive(Clone, Debug, PartialEq)]
pub struct Proposal {
    /// In the order of the program.
    pub places: Vec<Place>,
    /// The claim to prove. It holds for every subset of the places.
    pub claim: Claim,
    /// What it does, in numbers, for people.
    pub summary: String,
}

/// Why a rewrite proposes nothing.
#[derive(Clone, Debug, PartialEq)]
pub enum Refusal {
    /// One reason for the whole program.
    Whole(Change),
    /// A reason for each place; none of them has edits.
    Places(Vec<Place>),
}

impl From<String> for Refusal {
    fn from(reason: String) -> Self {
        Self::Whole(Change::Refused(reason))
    }
}

impl From<&str> for Refusal {
    fn from(reason: &str) -> Self {
        reason.to_owned().into()
    }
}

impl Refusal {
    /// Something is missing that the user can declare or allow.
    pub fn missing(what: impl Into<String>) -> Self {
        Self::Whole(Change::Possible(what.into()))
    }
}

/// What a rewrite proposes for a program; `Ok(None)`: nothing to do.
pub type Proposed = Result<Option<Proposal>, Refusal>;

/// One rewrite; its docs are its file's header.
#[derive(Clone, Copy)]
pub struct Rewrite {
    /// `smooth-pole`.
    pub name: &'static str,
    /// Header of its file.
    pub docs: &'static str,
    /// Rules whose findings it may fix.
    pub cures: &'static [&'static str],
    /// What it reads and writes, in G code alone; `None`: it works on the blocks of any format.
    pub(crate) writes: Option<&'static str>,
    /// Proposes.
    pub(crate) proposes: fn(&Program, &Settings<'_>, &Options, &Known) -> Proposed,
}

impl Rewrite {
    /// Proposes. `known`: of this program.
    ///
    /// # Errors
    /// Why it proposes nothing.
    pub fn propose(&self, program: &Program, settings: &Settings<'_>, options: &Options, known: &Known) -> Proposed {
        if let Some(writes) = self.only_in_g_code(program) {
            return Err(
                format!("it reads and writes {writes}, and only in G code: nothing is written in Klartext").into(),
            );
        }
        (self.proposes)(program, settings, options, known)
    }

    /// Whether it changes motions, so that a program in which one word drives several has no place for it. New block numbers change none.
    pub(crate) fn changes_motions(&self) -> bool {
        self.name != "renumber"
    }

    /// What it reads and writes, where it does so in G code only and the program is Klartext.
    pub fn only_in_g_code(&self, program: &Program) -> Option<&'static str> {
        self.writes.filter(|_| program.options().format == Format::Klartext)
    }

    /// Whether it may fix this finding: the rule that reports it says so.
    pub fn may_fix(&self, finding: &Diagnostic) -> bool {
        finding.fixes.contains(&self.name)
    }
}
