//! Refusals of LinuxCNC's interpreter as facts for the check floor.
use crate::{Fault, FaultKind};
use trunnion_ngc::{Class, Error};
use trunnion_syntax::{BlockId, TextRange};

/// A fact at a block and range of the program. `at`: the file and line that it is about, where that is a called one; said in its text, or apart.
pub(super) fn placed((block, range): (BlockId, TextRange), kind: FaultKind, at: Option<(&str, u32)>) -> Fault {
    let fault = |kind, place| Fault {
        block,
        range,
        kind,
        place,
    };
    let Some((path, line)) = at else {
        return fault(kind, None);
    };
    let place = format!("{path}, line {line}");
    let kind = match kind {
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
        other => return fault(other, Some(format!("{path} line {line}").into())),
    };
    fault(kind, None)
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
    if let Some(message) = error.abort() {
        let message = message.to_owned();
        return FaultKind::ProgramAlarm { message };
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
