//! The line that says the verdict on a file: what was judged, how much of it, and the counts.
use super::failure::shown;
use std::fmt::Write;
use trunnion_check::{Coverage, Scope, Summary, Verdict};

/// What the verdict on a file says.
pub(super) struct Judged<'a> {
    /// Path as given.
    pub(super) name: &'a str,
    pub(super) verdict: Verdict,
    pub(super) summary: Summary,
    /// The machine it was checked for.
    pub(super) machine: Option<&'a str>,
    /// Why the file is not read, if it is not.
    pub(super) not_read: Option<String>,
    /// The dialect and why, where that was not certain.
    pub(super) read_as: Option<String>,
    /// How much was judged.
    pub(super) scope: Scope,
    pub(super) coverage: &'a Coverage,
    /// Undeclared values that were assumed.
    pub(super) assumptions: &'a [String],
    /// How many findings the baseline accepts.
    pub(super) accepted: usize,
}

/// In what a verdict was found: ` on mill-3axis`, ` in scope motion (no machine)`.
pub(super) fn judged_in(scope: Scope, machine: Option<&str>) -> String {
    match (scope, machine) {
        (Scope::Machine, Some(machine)) => format!(" on {machine}"),
        (Scope::Machine, None) => " on no machine".to_owned(),
        (scope, None) => format!(" in scope {} (no machine)", scope.name()),
        (scope, Some(_)) => format!(" in scope {}", scope.name()),
    }
}

/// What a verdict says nothing about: the machine, blocks that did not run, motions whose path is unknown.
pub(super) fn not_looked_at(file: &Judged<'_>) -> Vec<String> {
    let mut left = Vec::new();
    if file.not_read.is_some() {
        return left;
    }
    let why = |scope: Scope| match file.machine {
        None => "no machine is named".to_owned(),
        Some(_) => format!("the scope is {}", scope.name()),
    };
    match file.scope {
        Scope::Machine if file.machine.is_some() => {}
        Scope::Language => left.push(format!(
            "motions, and axes, limits and speeds of a machine ({})",
            why(file.scope)
        )),
        scope => left.push(format!("axes, limits and speeds of a machine ({})", why(scope))),
    }
    let c = file.coverage;
    if c.blocks_run < c.blocks {
        left.push(format!(
            "{} of {} that did not run",
            c.blocks - c.blocks_run,
            counted(c.blocks, "block")
        ));
    }
    if c.motions_known < c.motions {
        let unknown = c.motions - c.motions_known;
        left.push(format!(
            "where {unknown} of {} end, which is unknown",
            counted(c.motions, "motion")
        ));
    }
    if c.given_up.is_some() {
        left.push("everything after the run was given up".to_owned());
    }
    left
}

/// The last line of the pretty form: verdict and counts.
pub(super) fn verdict_line(file: &Judged<'_>, color: bool) -> String {
    let (word, code) = match file.verdict {
        Verdict::Pass => ("PASS", "32"),
        Verdict::Fail => ("FAIL", "31"),
        Verdict::Unknown => ("UNKNOWN", "33"),
    };
    let word = if color {
        format!("\u{1b}[1;{code}m{word}\u{1b}[0m")
    } else {
        word.to_owned()
    };
    if let Some(why) = &file.not_read {
        return format!("{word} {}: not read, because {why}", shown(file.name));
    }
    let of = judged_in(file.scope, file.machine);
    let s = &file.summary;
    let mut line = format!(
        "{word} {}{of}: {} of {} run, {}",
        shown(file.name),
        file.coverage.blocks_run,
        counted(file.coverage.blocks, "block"),
        counted(s.motions, "motion"),
    );
    // a few rapids at the beginning have none in most programs
    let c = &file.coverage;
    if c.motions_known * 2 < c.motions {
        let _ = write!(line, ", {} with a known end", c.motions_known);
    }
    if let Some(read_as) = &file.read_as {
        let _ = write!(line, ", read as {read_as}");
    }
    if !file.assumptions.is_empty() {
        let _ = write!(line, ", assuming {}", assumed(file.assumptions));
    }
    let found = [
        (s.errors, counted(s.errors, "error")),
        (s.warnings, counted(s.warnings, "warning")),
        (s.infos, counted(s.infos, "info")),
        (s.unknown, format!("{} unknown", s.unknown)),
    ];
    let found: Vec<&str> = found
        .iter()
        .filter(|(n, _)| *n > 0)
        .map(|(_, text)| text.as_str())
        .collect();
    if !found.is_empty() {
        let _ = write!(line, "; {}", found.join(", "));
    }
    if file.accepted > 0 {
        let _ = write!(
            line,
            "; {} accepted by the baseline",
            counted(file.accepted as u64, "finding")
        );
    }
    line
}

/// Assumptions in a line: the first few, and how many more there are.
fn assumed(all: &[String]) -> String {
    const MOST: usize = 4;
    let plain: Vec<&str> = all
        .iter()
        .map(|text| text.trim_end_matches(" (not declared)"))
        .collect();
    match plain.split_at_checked(MOST) {
        Some((some, rest)) if !rest.is_empty() => format!("{} and {} more", some.join(", "), rest.len()),
        _ => plain.join(", "),
    }
}

/// `1 error`, `2 errors`.
pub(super) fn counted(count: u64, what: &str) -> String {
    let plural = if count == 1 { "" } else { "s" };
    format!("{count} {what}{plural}")
}
