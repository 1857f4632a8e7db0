//! What a program does apart from its motions, counted: a block that does much, or something that is not modelled, takes as long to compare as
//! many that only move.

/// A count with a bound: `[limits] steps`, or the number of blocks of the program where that is more.
#[derive(Debug)]
pub(crate) struct Actions {
    done: u64,
    most: u64,
}

impl Actions {
    /// Something that is not modelled, or refused: it is compared together with all that it may read.
    pub(crate) const OPEN: u64 = 4;
    /// A call of a program that is missing.
    pub(crate) const MISSING: u64 = 8;
    /// So many variables, kept because something may read them, count as one action.
    const VARIABLES: u64 = 2;

    /// None yet, of a program with this many blocks.
    pub(crate) fn new(blocks: usize, steps: u64) -> Self {
        Self {
            done: 0,
            most: steps.max(blocks as u64),
        }
    }

    /// Counts more.
    pub(crate) fn add(&mut self, actions: u64) {
        self.done += actions;
    }

    /// Counts variables that are kept.
    pub(crate) fn add_variables(&mut self, variables: usize) {
        self.done += variables as u64 / Self::VARIABLES;
    }

    /// Why the run ends here, if it does.
    pub(crate) fn exceeded(&self) -> Option<String> {
        self.beyond(self.most)
    }

    /// Why a comparison that follows so many ends here, if it does.
    pub(crate) fn beyond(&self, most: u64) -> Option<String> {
        (self.done > most).then(|| {
            format!(
                "it does more than {most} actions besides its motions (what is refused, not modelled or missing counts several times); use \
                 --max-steps N or raise `steps` of [limits] in trunnion.toml"
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::Actions;

    #[test]
    fn a_program_may_do_as_many_actions_as_it_has_blocks_or_steps_are_allowed() {
        for (blocks, steps) in [(5, 3), (3, 5)] {
            let mut actions = Actions::new(blocks, steps);
            actions.add(5);
            assert_eq!(actions.exceeded(), None);
            actions.add_variables(1);
            assert_eq!(actions.exceeded(), None);
            actions.add_variables(2);
            let why = actions.exceeded().expect("six are too many");
            assert!(
                why.contains("more than 5 actions") && why.contains("--max-steps"),
                "{why}"
            );
        }
    }
}
