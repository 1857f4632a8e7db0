//! Converting in tests.
use trunnion_certify::conversion::Assume;
use trunnion_convert::{Converted, Options, Refused, Source, Target, builtin_post, convert};
use trunnion_interp::Setup;
use trunnion_machine::{Machine, builtin};

/// A machine by its name; none for an empty one.
pub(crate) fn machine(name: &str) -> Option<&'static Machine> {
    (!name.is_empty()).then(|| builtin(name).expect("built in"))
}

/// What a program is converted from: text, dialect, machine.
pub(crate) type From<'a> = (&'a str, &'a str, &'a str);

/// Converts to a dialect for a machine.
pub(crate) fn to(from: From<'_>, dialect: &str, target: &str, options: &Options) -> Result<Converted, Refused> {
    assuming(from, Assume::default(), dialect, target, options)
}

pub(crate) fn assuming(
    (text, dialect, source): From<'_>,
    assume: Assume,
    target_dialect: &str,
    target: &str,
    options: &Options,
) -> Result<Converted, Refused> {
    let mut setup = Setup::default();
    Machine::tell(machine(source), &mut setup.control);
    let source = Source {
        text: text.as_bytes(),
        dialect: trunnion_dialect::builtin(dialect).expect("built in"),
        machine: machine(source),
        setup: &setup,
        assume,
    };
    let target = if target_dialect == "apt" {
        Target::Apt
    } else {
        Target::Code {
            post: builtin_post(target_dialect).expect("built in"),
            machine: machine(target),
        }
    };
    convert(&source, &target, options)
}

/// The text of a conversion that must succeed.
#[track_caller]
pub(crate) fn text(converted: Result<Converted, Refused>) -> String {
    converted.unwrap_or_else(|refused| panic!("{refused}")).text
}

/// The refusal of a conversion that must not succeed.
#[track_caller]
pub(crate) fn refusal(converted: Result<Converted, Refused>) -> Refused {
    match converted {
        Ok(converted) => panic!("converted:\n{}", converted.text),
        Err(refused) => refused,
    }
}
