//! Words for blocks that a control refuses: one form for all rules that tell of them.
use crate::runs::SHORT_RUN;
use crate::sink::{Draft, Reporter};
use crate::words::hash;
use trunnion_interp::{Fault, FaultKind, Refusal};

/// Reports a block that the control refuses for one of these sorts of reasons, with what the control itself says of it.
pub(crate) fn refused<'r>(fault: &Fault, out: &'r mut Reporter<'_>, sorts: &[Refusal]) -> Option<&'r mut Draft> {
    let FaultKind::Rejected {
        refusal,
        message,
        alarm,
    } = &fault.kind
    else {
        return None;
    };
    if !sorts.contains(refusal) {
        return None;
    }
    let message = message.trim().trim_end_matches('.');
    let draft = out.report(fault.range, message);
    draft.merge_runs_over(SHORT_RUN, hash(message), 0.0);
    draft.note("the control refuses the block");
    if let Some(alarm) = alarm {
        draft.note(format!("the control says: {alarm}"));
        draft.value_text("alarm", alarm.clone());
    }
    Some(draft)
}
