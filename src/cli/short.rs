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
    out.push_str(&rest(report, &shown, &loaded.name));
    out
}

/// The findings that are shown: all in the order of the file, or if there are more than `limit` (0: no limit) the worst of them, errors first.
pub(super) fn worst(report: &Report, limit: usize) -> Vec<&Diagnostic> {
    let mut found: Vec<&Diagnostic> = report.diagnostics.iter().collect();
    if limit > 0 && found.len() > limit {
        // stable: findings of one severity stay in the order of the file
        found.sort_by_key(|d| rank(d));
        found.truncate(limit);
    }
    found
}

/// How bad a finding is: 0 is an error.
pub(super) fn rank(d: &Diagnostic) -> u8 {
    match (d.status, d.severity) {
        (Status::Fail, Severity::Error) => 0,
        (Status::Fail, Severity::Warning) => 1,
        (Status::Unknown, _) => 2,
        (Status::Fail, Severity::Info) => 3,
    }
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

/// The line that counts what is not among `shown`, by rule, the worst first.
pub(super) fn rest(report: &Report, shown: &[&Diagnostic], name: &str) -> String {
    /// Rules that are named.
    const NAMED: usize = 6;
    let is_shown = |d: &Diagnostic| shown.iter().any(|known| core::ptr::eq(*known, d));
    let mut left: Vec<&Diagnostic> = Vec::new();
    if shown.len() < report.diagnostics.len() {
        left.extend(report.diagnostics.iter().filter(|d| !is_shown(d)));
    }
    if left.is_empty() {
        return String::new();
    }
    // the worst finding of each rule, and how many there are
    let mut rules: Vec<(u8, &str, usize)> = Vec::new();
    for d in &left {
        match rules.iter_mut().find(|of| of.1 == d.rule) {
            Some(of) => *of = (of.0.min(rank(d)), of.1, of.2 + 1),
            None => rules.push((rank(d), d.rule, 1)),
        }
    }
    rules.sort_by_key(|of| of.0);
    // one rule is named in no more room than "1 of other rules"
    let names = if rules.len() <= NAMED + 1 { rules.len() } else { NAMED };
    let mut named: Vec<String> = rules[..names].iter().map(|of| format!("{} {}", of.2, of.1)).collect();
    if names < rules.len() {
        let more: usize = rules[names..].iter().map(|of| of.2).sum();
        named.push(format!("{more} of other rules"));
    }
    let noun = if left.len() == 1 { "finding" } else { "findings" };
    let (count, named) = (left.len(), named.join(", "));
    format!("{name}: {count} more {noun} ({named}); --limit 0 shows them all\n")
}
