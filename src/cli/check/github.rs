//! Annotations for a GitHub workflow: `::error file=...,line=...::message`.
//!
//! Source: GitHub Docs, "Workflow commands for GitHub Actions": setting an error, warning or notice message.
use crate::cli::{
    failure::shown,
    json::{File, Item, NotChecked},
};
use std::fmt::Write;

/// The findings of one file. What is denied is an error; other warnings and what is unknown are warnings, the rest notices.
pub(super) fn annotations(file: &File, denied: impl Fn(&Item) -> bool) -> String {
    let mut out = String::new();
    for item in &file.diagnostics {
        let level = match (denied(item), item.status, item.severity) {
            (true, ..) => "error",
            (false, "unknown", _) | (false, _, "warning" | "error") => "warning",
            _ => "notice",
        };
        let unknown = if item.status == "unknown" { " (unknown)" } else { "" };
        let mut message = item.message.clone();
        for note in item.notes.iter().chain(&item.help) {
            message.push('\n');
            message.push_str(note);
        }
        let _ = writeln!(
            out,
            "::{level} file={},line={},endLine={},col={},endColumn={},title={}::{}",
            property(&file.path),
            item.line,
            item.end_line,
            item.column,
            item.end_column,
            property(&format!("{}{unknown}", item.rule)),
            data(&message)
        );
    }
    out
}

/// What stands below the line with the verdict: blocks that did not run, rules that judged nothing, where the run was given up, what is assumed. Each in a
/// line of its own, indented: none of them is a command.
pub(super) fn coverage(file: &File) -> String {
    let c = &file.coverage;
    let not_run = c
        .not_run
        .iter()
        .map(|part| format!("not run: lines {} to {}: {}", part.line, part.last_line, part.reason));
    let not_judged = c.not_judged.iter().map(|lacking| {
        let (rule, needs) = (&lacking.rule, &lacking.needs);
        format!("not judged: {rule}: the machine file does not declare {needs}")
    });
    let given_up = c
        .given_up
        .iter()
        .map(|end| format!("given up: line {}: {}", end.line, end.reason));
    let assumed = file.assumptions.iter().map(|text| format!("assumed: {text}"));
    let lines: Vec<String> = not_run.chain(not_judged).chain(given_up).chain(assumed).collect();
    let mut out = String::new();
    for line in &lines {
        let _ = write!(out, "\n  {}", shown(&line.replace('\n', " ")));
    }
    out
}

/// A file that could not be checked.
pub(super) fn not_checked(failed: &NotChecked) -> String {
    format!("::error title=not checked::{}\n", data(&failed.text()))
}

fn data(text: &str) -> String {
    let lines: Vec<_> = text.split('\n').map(|line| shown(line).into_owned()).collect();
    lines
        .join("\n")
        .replace('%', "%25")
        .replace('\r', "%0D")
        .replace('\n', "%0A")
}

fn property(text: &str) -> String {
    data(text).replace(':', "%3A").replace(',', "%2C")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_in_a_name_ends_the_command() {
        assert_eq!(property("a,b:c%\n::error::x"), "a%2Cb%3Ac%25%0A%3A%3Aerror%3A%3Ax");
        assert_eq!(data("a\x1b[0m"), "a\\x1b[0m");
    }
}
