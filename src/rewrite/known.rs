//! What several rewrites ask of one program under the same settings, found when it is first asked for.
use crate::named_blocks::named_blocks;
use crate::polyline::{Chains, chains};
use crate::survey::runs_straight;
use core::cell::OnceCell;
use std::collections::HashSet;
use trunnion_check::Settings;
use trunnion_syntax::{BlockId, Program};

/// Facts about one program under one set of settings. Make a new one after each change of either.
#[derive(Debug, Default)]
pub struct Known {
    straight: OnceCell<Result<(), String>>,
    named: OnceCell<Result<HashSet<BlockId>, String>>,
    chains: OnceCell<Chains>,
}

impl Known {
    /// Whether each block runs once and in order; else why not.
    pub(crate) fn runs_straight(&self, program: &Program, settings: &Settings<'_>) -> Result<(), &String> {
        let found = self.straight.get_or_init(|| runs_straight(program, settings));
        found.as_ref().copied()
    }

    /// The chains of lines of a program, or why its blocks stay: see [`named_blocks`].
    pub(crate) fn chains(&self, program: &Program, settings: &Settings<'_>) -> Result<&Chains, String> {
        let named = self.named.get_or_init(|| named_blocks(program, settings)).as_ref()?;
        Ok(self.chains.get_or_init(|| chains(program, settings, named)))
    }
}
