//! `certify`: re-checks a certificate, or proves or refutes that AFTER is the same tool path as BEFORE.
mod settings;

use super::{
    Done,
    args::{Certify, ClaimOf, Global},
    diff,
    failure::Failure,
    load, waiting,
};
use crate::cli::out::Out;
use std::fmt::Write;
use trunnion_certify::conversion::{Conversion, ConversionCertificate};
use trunnion_certify::{Certificate, Chain, Claim, Gap, Outcome, certify_with_libraries};
use trunnion_interp::Setup;
use trunnion_machine::Machine;
use trunnion_same::{Difference, Verdict};
use trunnion_workspace::find_machine;

/// Runs `certify`. Refuted or unknown makes the exit status 1.
pub(super) fn run(global: &Global, command: &Certify) -> Result<Done, Failure> {
    let loaded = load::load(global, &command.before)?;
    let (after, _) = load::read_program(global, &command.after)?;
    if let Some(file) = &command.certificate {
        let text = trunnion_files::read_text(file)?;
        if ConversionCertificate::is_one(&text) {
            let certificate = ConversionCertificate::from_json(&text).map_err(|e| Failure::file(file, e))?;
            return conversion(global, command, &certificate, &loaded, &after);
        }
    }
    let machine = loaded.machine_or_fail("certify")?;
    let second = if load::is_stdin(&command.after) {
        None
    } else {
        Some(load::load(global, &command.after)?)
    };
    let before = loaded.program.source();
    let programs: Vec<&load::Loaded> = std::iter::once(&loaded).chain(second.as_ref()).collect();
    let (dialect, setup) = (
        loaded.resolved.dialect,
        &load::with_assumed(&loaded.resolved.setup, &programs),
    );
    let mut steps = Vec::new();
    let unlike = second.as_ref().and_then(|second| settings::differ(&loaded, second));
    let outcome = if let Some(message) = unlike {
        Outcome::Unknown(Gap { message, line: None })
    } else if let Some(file) = &command.certificate {
        let text = trunnion_files::read_text(file)?;
        let chain = Chain::from_json(&text).map_err(|e| Failure::file(file, e))?;
        let outcome = waiting::during(global, "proving", &command.after, || {
            checked_again(&chain, [before, &after], (&loaded, setup), machine)
        });
        outcome.map_or_else(
            |outcome| outcome,
            |(earlier, last)| {
                steps = earlier;
                Outcome::Proved(Box::new(last))
            },
        )
    } else {
        let claim = claimed(command);
        // a program that is certainly for another control; what may be for any is read as the first
        let other = second.as_ref().map(|other| &other.resolved);
        let other = other.filter(|other| other.dialect_certain || other.dialect.lex.format != dialect.lex.format);
        let other = other.map_or(dialect, |other| other.dialect);
        let library = second
            .as_ref()
            .filter(|_| command.before.parent() != command.after.parent())
            .map_or(&setup.library, |second| &second.resolved.setup.library);
        waiting::during(global, "proving", &command.after, || {
            certify_with_libraries([before, &after], [dialect, other], machine, (setup, library), &claim)
        })
    };
    let shared = |verdict: fn(Difference) -> Verdict, what: &str| {
        let second = second.as_ref().filter(|_| command.certificate.is_none())?;
        let tolerances = (command.tolerance_mm, command.tolerance_deg);
        let verdict = verdict(Difference {
            before: None,
            after: None,
            what: what.to_owned(),
        });
        Some(waiting::during(global, "comparing with", &command.after, || {
            diff::shared(&loaded, second, tolerances, verdict)
        }))
    };
    let assuming = load::assuming(&programs);
    let done = say(command, &steps, outcome, shared);
    if let Some(line) = assuming {
        Out::standard().text(&format!("{line}\n"));
    }
    Ok(done)
}

/// What is to be proved of two programs.
fn claimed(command: &Certify) -> Claim {
    let (tolerance_mm, tolerance_deg) = (command.tolerance_mm, command.tolerance_deg);
    match command.claim {
        ClaimOf::All => Claim::SameToolPath {
            tolerance_mm,
            tolerance_deg,
        },
        ClaimOf::Path => Claim::SamePath {
            tolerance_mm,
            tolerance_deg,
        },
    }
}

/// Checks the certificate of a conversion again.
fn conversion(
    global: &Global,
    command: &Certify,
    certificate: &ConversionCertificate,
    loaded: &load::Loaded,
    after: &[u8],
) -> Result<Done, Failure> {
    let found = command
        .to_machine
        .as_ref()
        .map(|name| find_machine(name, None))
        .transpose()?;
    let machine = loaded.resolved.machine.as_ref();
    let name = &certificate.after.dialect.name;
    let Some(dialect) = trunnion_dialect::builtin(name) else {
        let hint = trunnion_dialect::dialect_hint(name);
        return Err(Failure::new(format!(
            "the certificate names an unknown dialect `{name}`{hint}"
        )));
    };
    // CL data are for no machine
    let target = found.as_ref().map(|found| &found.machine).or(machine);
    let target = target.filter(|_| certificate.after.machine.is_some());
    let outcome = waiting::during(global, "proving", &command.after, || {
        certificate.recheck(&Conversion {
            texts: [loaded.program.source(), after],
            dialects: [loaded.resolved.dialect, dialect],
            machines: [machine, target],
            setup: &loaded.resolved.setup,
        })
    });
    let mut out = Out::standard();
    match outcome {
        Ok(fresh) => {
            out.text(&format!("PROVED {}\n", fresh.summary()));
            Ok(Done::Clean)
        }
        Err(outcome) => Ok(say(command, &[], outcome, |_, _| None)),
    }
}

/// Prints the verdict. `shared`: how far two programs agree that are not proved the same, where that is asked.
fn say(
    command: &Certify,
    steps: &[Certificate],
    outcome: Outcome,
    shared: impl Fn(fn(Difference) -> Verdict, &str) -> Option<String>,
) -> Done {
    let mut out = Out::standard();
    match outcome {
        Outcome::Proved(certificate) => {
            out.text(&format!("PROVED {}\n", in_all(steps, &certificate)));
            Done::Clean
        }
        Outcome::Refuted(witness) => {
            let line = witness.line.map(|line| format!(":{line}")).unwrap_or_default();
            out.text(&format!(
                "REFUTED {}{line}: {}\n",
                command.after.display(),
                witness.message
            ));
            if let Some(line) = shared(Verdict::Differs, &witness.message) {
                out.text(&format!("{line}\n"));
            }
            Done::Found
        }
        Outcome::Unknown(gap) => {
            out.text(&format!("UNKNOWN {}\n", gap.message));
            if let Some(line) = shared(Verdict::Unknown, &gap.message) {
                out.text(&format!("{line}\n"));
            }
            Done::Found
        }
    }
}

/// What is proved, for people: by one certificate, or by several steps.
fn in_all(earlier: &[Certificate], last: &Certificate) -> String {
    if earlier.is_empty() {
        return last.summary();
    }
    let mut text = format!("in {} steps", earlier.len() + 1);
    for (index, step) in earlier.iter().chain([last]).enumerate() {
        let _ = write!(text, "\nstep {}: {}", index + 1, step.summary());
    }
    text
}

/// Checks a chain again: the certificates of its steps, the last one apart. `Err`: what the step gave that fails.
fn checked_again(
    chain: &Chain,
    [before, after]: [&[u8]; 2],
    (loaded, assumed): (&load::Loaded, &Setup),
    machine: &Machine,
) -> Result<(Vec<Certificate>, Certificate), Outcome> {
    let (dialect, setup) = (loaded.resolved.dialect, &loaded.resolved.setup);
    let fresh = chain.recheck(before, after, dialect, machine, (setup, assumed));
    match fresh {
        Ok((earlier, last)) => Ok((earlier, last)),
        Err((_, outcome)) if chain.steps.len() == 1 => Err(outcome),
        Err((step, outcome)) => Err(in_step(step, outcome)),
    }
}

/// What one step of a chain gave.
fn in_step(step: usize, outcome: Outcome) -> Outcome {
    match outcome {
        Outcome::Refuted(mut witness) => {
            // lines of a text between two steps are no lines of the changed program
            let place = witness.line.take().map(|line| format!(" (line {line} after it)"));
            witness.message = format!("step {step}{}: {}", place.unwrap_or_default(), witness.message);
            Outcome::Refuted(witness)
        }
        Outcome::Unknown(mut gap) => {
            gap.message = format!("step {step}: {}", gap.message);
            Outcome::Unknown(gap)
        }
        proved @ Outcome::Proved(_) => proved,
    }
}
