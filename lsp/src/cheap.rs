//! The first batch: what the text of a program alone says. The rules that follow a machine take longer and come after it.
use crate::analysis::Parsed;
use trunnion_check::{Diagnostic, Session, Settings};

/// Whether a finding is of a rule that reads nothing but the text.
pub(crate) fn is_cheap(found: &Diagnostic) -> bool {
    trunnion_check::rule(found.rule).is_some_and(|rule| rule.level() == "text")
}

/// The findings of the text; `None` when `cancelled` returned true, and where there is no machine: then all findings are cheap.
pub(crate) fn findings(parsed: &Parsed, cancelled: &dyn Fn() -> bool) -> Option<Vec<Diagnostic>> {
    let source = parsed.outcome.as_ref().ok()?;
    source.resolved.machine.as_ref()?;
    let settings = Settings {
        machine: None,
        ..source.resolved.settings()
    };
    let session = Session::new(&source.program, &settings, cancelled)?;
    let mut found = session.report.diagnostics;
    found.retain(is_cheap);
    Some(found)
}
