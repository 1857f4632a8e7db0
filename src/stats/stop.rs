//! Why a run was not followed to the end of its program: nothing after such a place was counted or compared.
use trunnion_dialect::Dialect;
use trunnion_interp::{Fault, FaultKind};
use trunnion_syntax::BlockId;

/// A place where a run may have stopped.
#[derive(Clone, Debug)]
pub(crate) struct Stop {
    /// The block of the main program.
    pub(crate) block: BlockId,
    /// A sentence.
    pub(crate) why: String,
    /// Blocks that ran since; a refused block stops the run only if none did.
    since: u8,
    /// The run stops here in any case.
    sure: bool,
}

/// Watches a run for the place where it stopped.
#[derive(Debug, Default)]
pub(crate) struct Stops(Option<Stop>);

impl Stops {
    /// Takes a fault of the run.
    pub(crate) fn fault(&mut self, fault: &Fault, dialect: &Dialect) {
        // LinuxCNC's interpreter continues after a refused block, and reads what follows the end
        let may_stop = !dialect.quirks.rs274();
        let (why, sure) = match &fault.kind {
            FaultKind::EndlessLoop { proved: true, .. } => {
                ("it never ends: a loop returns to the same values".to_owned(), true)
            }
            FaultKind::EndlessLoop { blocks, .. } => (format!("no end within {blocks} executed blocks"), true),
            FaultKind::NotDecided { what } => (format!("not decided: {what}"), true),
            FaultKind::Rejected { message, .. } if may_stop => (format!("the control refuses it: {message}"), false),
            FaultKind::MissingSubprogram { name, .. } if may_stop => (format!("program {name} not found"), false),
            _ => return,
        };
        if self.0.as_ref().is_none_or(|known| sure || !known.sure) {
            self.0 = Some(Stop {
                block: fault.block,
                why,
                since: 0,
                sure,
            });
        }
    }

    /// A block has run to its end.
    pub(crate) fn block_done(&mut self) {
        if let Some(stop) = &mut self.0 {
            stop.since = stop.since.saturating_add(1);
            if stop.since > 1 && !stop.sure {
                self.0 = None;
            }
        }
    }

    /// Where the run stopped before its end; asked when it is over.
    pub(crate) fn last(&self) -> Option<&Stop> {
        self.0.as_ref()
    }
}
