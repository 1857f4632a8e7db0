//! The words for how bad a finding is.
use trunnion_check::{Diagnostic, Severity, Status};

/// The word before a finding: its severity, or `unknown` where the rule could not decide. The last line counts them by the same words.
pub fn weight(d: &Diagnostic) -> &'static str {
    match d.status {
        Status::Fail => severity(d.severity),
        Status::Unknown => "unknown",
    }
}

/// Lower-case word of a severity.
pub fn severity(severity: Severity) -> &'static str {
    match severity {
        Severity::Error => "error",
        Severity::Warning => "warning",
        Severity::Info => "info",
    }
}
