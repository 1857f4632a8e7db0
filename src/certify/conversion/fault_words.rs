//! Faults of a converted program in words.
use trunnion_interp::FaultKind;

/// What is wrong at a place, in words.
pub(super) fn why(kind: &FaultKind) -> String {
    match kind {
        FaultKind::NotModelled { what } => format!(" (not modelled: {what})"),
        FaultKind::Rejected { message, .. } => format!(" (the control refuses it: {message})"),
        FaultKind::NotDecided { what } => format!(" (what runs next depends on {what})"),
        FaultKind::UnknownCode { machine_builder: true } => " (a code of the machine builder)".to_owned(),
        FaultKind::UnknownCode { .. } => " (the control has no such code)".to_owned(),
        _ => "; `trunnion check` says why".to_owned(),
    }
}
