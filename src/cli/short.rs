//! One line per finding: `path:line:col: severity[rule] message`.
use super::load::Loaded;
use std::fmt::Write;
use trunnion_check::{Diagnostic, Report, Severity, Status};
pub(super) use trunnion_document::{severity, weight};
use trunnion_syntax::LineIndex;

/// The findings of one file; at most `limit` of them (0: all), and a line that counts the rest.
pub(super) fn short(loaded: &Loaded, lines: &LineIndex, report: &Report, limit: usize) -> String {
    let mut out = String::new();
    let shown = worst(report, limit);
    for d in &shown {
        let (line, column) = lines.line_column(loaded.program.source(), d.range.start);
        let _ = write!(
            out,
            "{}:{line}:{column}: {}[{}] {}",
            loaded.name,
            weight(d),
            d.rule,
            d.message
        );
        out.push_str(&repeats(loaded, lines, d));
        out.push('\n');
    }
    out.push_str(&rest(report, shown.len(), &loaded.name));
    out
}

/// The findings that are shown: all in the order of the file, or if there are more than `limit` (0: no limit) the worst of them, errors first.
pub(super) fn worst(report: &Report, limit: usize) -> Vec<&Diagnostic> {
    let mut found: Vec<&Diagnostic> = report.diagnostics.iter().collect();
    if limit > 0 && found.len() > limit {
        // stable: findings of one severity stay in the order of the file
        found.sort_by_key(|d| match (d.status, d.severity) {
            (Status::Fail, Severity::Error) => 0,
            (Status::Fail, Severity::Warning) => 1,
            (Status::Unknown, _) => 2,
            (Status::Fail, Severity::Info) => 3,
        });
        found.truncate(limit);
    }
    found
}

/// How often a finding was found, where that was more than once: again and again in one place (a loop, a subprogram), or in one
/// block after another.
pub(super) fn repeats(loaded: &Loaded, lines: &LineIndex, d: &Diagnostic) -> String {
    if d.count < 2 {
        return String::new();
    }
    let line = |offset| lines.line_column(loaded.program.source(), offset).0;
    let last = line(d.last.start);
    if last == line(d.range.start) {
        return format!(" ({} times)", d.count);
    }
    format!(" ({} blocks, to line {last})", d.count)
}

/// The line that counts what `limit` left out.
pub(super) fn rest(report: &Report, shown: usize, name: &str) -> String {
    match report.diagnostics.len().checked_sub(shown) {
        Some(more @ 1..) => format!("{name}: {more} more findings; --limit 0 shows them all\n"),
        _ => String::new(),
    }
}
