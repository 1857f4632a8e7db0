//! Refusals of LinuxCNC's interpreter as facts for the check floor.
use crate::FaultKind;
use trunnion_ngc::{Class, Error};

/// A fact about a line of a called file, reported at the call.
pub(super) fn placed(kind: FaultKind, place: String) -> FaultKind {
    match kind {
        FaultKind::Rejected {
            refusal,
            message,
            alarm,
        } => FaultKind::Rejected {
            refusal,
            message: format!("in {place}: {message}"),
            alarm,
        },
        FaultKind::NotModelled { what } => FaultKind::NotModelled {
            what: format!("in {place}: {what}"),
        },
        FaultKind::NotDecided { what } => FaultKind::NotDecided {
            what: format!("{what} in {place}"),
        },
        FaultKind::MissingSubprogram {
            name, searched, alarm, ..
        } => FaultKind::MissingSubprogram {
            name,
            searched,
            alarm,
            caller: Some(place),
        },
        other => other,
    }
}

/// Whether [`placed`] puts the place into the text of a fact.
pub(super) fn says_place(kind: &FaultKind) -> bool {
    matches!(
        kind,
        FaultKind::Rejected { .. }
            | FaultKind::NotModelled { .. }
            | FaultKind::NotDecided { .. }
            | FaultKind::MissingSubprogram { .. }
    )
}

/// The fact that reports an error.
pub(super) fn fault_of(error: &Error) -> FaultKind {
    if let Some(missing) = &error.missing {
        return FaultKind::MissingSubprogram {
            name: missing.name.clone(),
            searched: missing.searched.clone(),
            alarm: Some(format!("LinuxCNC: {}", error.message())),
            caller: None,
        };
    }
    let refusal = match error.problem.class {
        Class::ProgramEnd => return FaultKind::MissingProgramEnd,
        Class::NotModelled => {
            let what = error.message().to_owned();
            return FaultKind::NotModelled { what };
        }
        refusal => refusal,
    };
    let control = error.message();
    let help = error.problem.help;
    let message = if help.is_empty() {
        control.to_owned()
    } else {
        format!("{control}: {help}")
    };
    FaultKind::Rejected {
        refusal,
        message,
        alarm: Some(format!("LinuxCNC: {control}")),
    }
}
