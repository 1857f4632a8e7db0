//! Refusals of LinuxCNC's interpreter as facts for the check floor.
use crate::FaultKind;
use trunnion_ngc::{Class, Error};

/// The fact that tells an error.
pub(super) fn fault_of(error: &Error) -> FaultKind {
    if let Some(missing) = &error.missing {
        return FaultKind::MissingSubprogram {
            name: missing.name.clone(),
            searched: missing.searched.clone(),
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
