//! Refusals of LinuxCNC's interpreter as facts for the check floor.
use crate::{FaultKind, Refusal};
use trunnion_ngc::{Class, Error};

/// The fact that tells an error.
pub(super) fn fault_of(error: &Error) -> FaultKind {
    let refusal = match error.problem.class {
        Class::ProgramEnd => return FaultKind::MissingProgramEnd,
        Class::NotModelled => {
            let what = error.message().to_owned();
            return FaultKind::NotModelled { what };
        }
        Class::Syntax => Refusal::Syntax,
        Class::Number => Refusal::Number,
        Class::Expression => Refusal::Expression,
        Class::Variable => Refusal::Variable,
        Class::Label => Refusal::Label,
        Class::Subprogram => Refusal::Subprogram,
        Class::Structure => Refusal::Structure,
        Class::GroupConflict => Refusal::GroupConflict,
        Class::RepeatedWord => Refusal::RepeatedWord,
        Class::UnusedWord => Refusal::UnusedWord,
        Class::MissingWord => Refusal::MissingWord,
        Class::UnknownCode => Refusal::UnknownCode,
        Class::UnknownWord => Refusal::UnknownWord,
        Class::Feed => Refusal::Feed,
        Class::ArcRadius => Refusal::ArcRadius,
        Class::ArcCentre => Refusal::ArcCentre,
        Class::Compensation => Refusal::Compensation,
        Class::CannedCycle => Refusal::CannedCycle,
        Class::Other => Refusal::Other,
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
