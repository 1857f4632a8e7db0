//! `certify`: re-checks a certificate, or proves or refutes that AFTER is the same tool path as BEFORE.
use super::{
    Done,
    args::{Certify, ClaimOf, Global},
    diff,
    failure::Failure,
    load,
};
use crate::cli::out::Out;
use trunnion_certify::{Certificate, Claim, Outcome, certify_with_libraries, recheck};
use trunnion_same::{Difference, Verdict};

/// Runs `certify`. Refuted or unknown makes the exit status 1.
pub(super) fn run(global: &Global, command: &Certify) -> Result<Done, Failure> {
    let loaded = load::load(global, &command.before)?;
    let machine = loaded.machine_or_fail("certify")?;
    let (after, _) = load::read_program(global, &command.after)?;
    let second = if load::is_stdin(&command.after) {
        None
    } else {
        load::load(global, &command.after).ok()
    };
    let before = loaded.program.source();
    let (dialect, setup) = (loaded.resolved.dialect, &loaded.resolved.setup);
    let outcome = if let Some(file) = &command.certificate {
        let text = trunnion_files::read_text(file)?;
        let certificate = Certificate::from_json(&text).map_err(|e| Failure::file(file, e))?;
        recheck(&certificate, before, &after, dialect, machine, setup)
    } else {
        let (tolerance_mm, tolerance_deg) = (command.tolerance_mm, command.tolerance_deg);
        let claim = match command.claim {
            ClaimOf::All => Claim::SameToolPath {
                tolerance_mm,
                tolerance_deg,
            },
            ClaimOf::Path => Claim::SamePath {
                tolerance_mm,
                tolerance_deg,
            },
        };
        // two languages: APT against G code
        let other = load::load(global, &command.after)
            .ok()
            .map(|other| other.resolved.dialect);
        let other = other
            .filter(|other| other.lex.format != dialect.lex.format)
            .unwrap_or(dialect);
        let library = second
            .as_ref()
            .filter(|_| command.before.parent() != command.after.parent())
            .map_or(&setup.library, |second| &second.resolved.setup.library);
        certify_with_libraries([before, &after], [dialect, other], machine, (setup, library), &claim)
    };
    let mut out = Out::standard();
    let shared = |verdict: fn(Difference) -> Verdict, what: &str| {
        let second = second.as_ref().filter(|_| command.certificate.is_none())?;
        let tolerances = (command.tolerance_mm, command.tolerance_deg);
        let verdict = verdict(Difference {
            before: None,
            after: None,
            what: what.to_owned(),
        });
        Some(diff::shared(&loaded, second, tolerances, verdict))
    };
    let programs: Vec<&load::Loaded> = std::iter::once(&loaded).chain(second.as_ref()).collect();
    let assuming = load::assuming(&programs);
    let done = match outcome {
        Outcome::Proved(certificate) => {
            out.text(&format!("PROVED {}\n", certificate.summary()));
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
    };
    if let Some(line) = assuming {
        out.text(&format!("{line}\n"));
    }
    Ok(done)
}
