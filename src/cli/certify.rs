//! `certify`: re-checks a certificate, or proves or refutes that AFTER is the same tool path as BEFORE.
use super::{
    Done,
    args::{Certify, ClaimOf, Global},
    diff,
    failure::Failure,
    load,
};
use std::io::Write;
use trunnion_certify::{Certificate, Claim, Outcome, certify_across, recheck};

/// Runs `certify`. Refuted or unknown makes the exit status 1.
pub(super) fn run(global: &Global, command: &Certify) -> Result<Done, Failure> {
    let loaded = load::load(global, &command.before)?;
    let machine = loaded.machine_or_fail("certify")?;
    let after = load::read_program(global, &command.after)?;
    let second = if load::is_stdin(&command.after) {
        None
    } else {
        load::load(global, &command.after).ok()
    };
    let before = loaded.program.source();
    let (dialect, setup) = (loaded.resolved.dialect, &loaded.resolved.setup);
    let outcome = if let Some(file) = &command.certificate {
        let text = std::fs::read_to_string(file).map_err(|e| Failure::io(file, "read the certificate", &e))?;
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
        // two languages: APT beside G code
        let other = load::load(global, &command.after)
            .ok()
            .map(|other| other.resolved.dialect);
        let other = other
            .filter(|other| other.lex.format != dialect.lex.format)
            .unwrap_or(dialect);
        certify_across(before, &after, [dialect, other], machine, setup, &claim)
    };
    let mut out = std::io::stdout().lock();
    let shared = || {
        let second = second.as_ref().filter(|_| command.certificate.is_none())?;
        let tolerances = (command.tolerance_mm, command.tolerance_deg);
        let path_only = command.claim == ClaimOf::Path;
        Some(diff::shared(&loaded, second, tolerances, path_only))
    };
    match outcome {
        Outcome::Proved(certificate) => {
            writeln!(out, "PROVED {}", certificate.summary())?;
            Ok(Done::Clean)
        }
        Outcome::Refuted(witness) => {
            let line = witness.line.map(|line| format!(":{line}")).unwrap_or_default();
            writeln!(out, "REFUTED {}{line}: {}", command.after.display(), witness.message)?;
            if let Some(line) = shared() {
                writeln!(out, "{line}")?;
            }
            Ok(Done::Found)
        }
        Outcome::Unknown(gap) => {
            writeln!(out, "UNKNOWN {}", gap.message)?;
            if let Some(line) = shared() {
                writeln!(out, "{line}")?;
            }
            Ok(Done::Found)
        }
    }
}
