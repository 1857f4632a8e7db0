//! Undeclared values that a program depends on, for commands that take them as zero and judge nothing.
use super::{Missing, OffsetName};
use crate::keyed::Keyed;
use trunnion_dialect::Dialect;
use trunnion_interp::{Fault, LengthOf, ModalState, Motion, Setup, Sink, Undeclared, run};
use trunnion_syntax::Program;

/// The work offsets and tool lengths that the motions of `program` use and that are not declared, in the order of their first use, as a check
/// lists them: `G54 = 0 (not declared)`. Runs the program.
pub fn assumptions(program: &Program, dialect: &Dialect, setup: &Setup) -> Vec<String> {
    let mut listed = Listed::default();
    run(program, dialect, setup, &mut listed);
    listed
        .missing
        .keys()
        .map(|missing| missing.assumption(dialect))
        .collect()
}

#[derive(Default)]
struct Listed {
    missing: Keyed<Missing, ()>,
    /// What the last motion depended on, so that nothing is looked up twice.
    last: Option<(Undeclared, OffsetName, LengthOf)>,
}

impl Sink for Listed {
    fn motion(&mut self, motion: &Motion, state: &ModalState) {
        if !motion.undeclared.any() {
            return;
        }
        let offset = state.zero.offset().map(OffsetName::new).unwrap_or_default();
        let own = (motion.undeclared, offset, state.length.of());
        if self.last == Some(own) {
            return;
        }
        self.last = Some(own);
        let zero = (motion.undeclared.zero != 0).then_some(Missing::Offset(offset));
        let length = motion.undeclared.length.then_some(Missing::Length(state.length.of()));
        for missing in zero.into_iter().chain(length) {
            self.missing.insert(missing, ());
        }
    }

    fn fault(&mut self, _: Fault) {}
    fn reads_faults(&self) -> bool {
        false
    }
}
