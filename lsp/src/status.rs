//! The state of a document for a status bar.
use crate::{
    analysis::{Analysed, Version},
    outbox::Status,
};
use tower_lsp::lsp_types::Url;
use trunnion_check::{Severity, Verdict};
use trunnion_workspace::Resolved;

/// The state of a document of which only a part is judged so far: it has no verdict.
pub(crate) fn checking(uri: &Url, version: Version, resolved: &Resolved) -> Status {
    Status {
        uri: uri.clone(),
        machine: resolved.machine.as_ref().map(|machine| machine.id.clone()),
        dialect: Some(resolved.dialect.name.clone()),
        reason: resolved.dialect_reason.clone(),
        verdict: "checking".into(),
        errors: 0,
        warnings: 0,
        unknown: 0,
        version: version.client,
        blocks: 0,
        blocks_run: 0,
        cycle_time_s: None,
    }
}

/// Verdict, machine, dialect, coverage and time of an analysis.
pub(crate) fn status(analysed: &Analysed) -> Status {
    let parsed = &analysed.parsed;
    let (uri, version) = (parsed.uri.clone(), parsed.version);
    match (&parsed.outcome, &analysed.session) {
        (Ok(source), Some(session)) => {
            let report = &session.report;
            let verdict = match report.verdict(Severity::Error) {
                Verdict::Pass => "pass",
                Verdict::Fail => "fail",
                Verdict::Unknown => "unknown",
            };
            Status {
                verdict: verdict.into(),
                errors: report.summary.errors,
                warnings: report.summary.warnings,
                unknown: report.summary.unknown,
                blocks: report.coverage.blocks,
                blocks_run: report.coverage.blocks_run,
                cycle_time_s: report.cycle_time_s,
                ..checking(&uri, version, &source.resolved)
            }
        }
        (outcome, _) => Status {
            uri,
            machine: None,
            dialect: None,
            reason: outcome.as_ref().err().map(ToString::to_string).unwrap_or_default(),
            verdict: "unknown".into(),
            errors: 1,
            warnings: 0,
            unknown: 0,
            version: version.client,
            blocks: 0,
            blocks_run: 0,
            cycle_time_s: None,
        },
    }
}
