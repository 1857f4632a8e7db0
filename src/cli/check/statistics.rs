//! `--statistics`: how many findings each rule has.
use crate::cli::short;
use serde::Serialize;
use std::{collections::BTreeMap, fmt::Write};
use trunnion_check::{Diagnostic, Report};

/// Findings of each rule: errors, warnings, infos, unknown.
#[derive(Clone, Debug, Default)]
pub(super) struct Statistics(BTreeMap<String, [u64; 4]>);

/// The words of the four columns.
const COLUMNS: [&str; 4] = ["error", "warning", "info", "unknown"];

/// The findings of one file, with those that others lead.
pub(super) fn of(report: &Report) -> BTreeMap<String, [u64; 4]> {
    let mut rules = BTreeMap::<String, [u64; 4]>::new();
    let mut add = |d: &Diagnostic| {
        let counts = rules.entry(d.rule.to_owned()).or_default();
        if let Some(column) = COLUMNS.iter().position(|word| *word == short::weight(d)) {
            counts[column] += 1;
        }
    };
    report.diagnostics.iter().for_each(&mut add);
    rules
}

/// One row of the document.
#[derive(Serialize)]
struct Row<'a> {
    rule: &'a str,
    errors: u64,
    warnings: u64,
    infos: u64,
    unknown: u64,
}

impl Statistics {
    /// Adds those of a file.
    pub(super) fn add(&mut self, rules: &BTreeMap<String, [u64; 4]>) {
        for (rule, counts) in rules {
            let all = self.0.entry(rule.clone()).or_default();
            all.iter_mut().zip(counts).for_each(|(all, count)| *all += count);
        }
    }
    /// A table for people, the most frequent rule first.
    pub(super) fn table(&self) -> String {
        let mut rows: Vec<_> = self.0.iter().collect();
        rows.sort_by_key(|(rule, counts)| (std::cmp::Reverse(counts.iter().sum::<u64>()), rule.as_str()));
        let mut out = format!(
            "{:28}{:>9}{:>9}{:>9}{:>9}\n",
            "findings by rule", "errors", "warnings", "infos", "unknown"
        );
        for (rule, [errors, warnings, infos, unknown]) in rows {
            let _ = writeln!(out, "{rule:28}{errors:>9}{warnings:>9}{infos:>9}{unknown:>9}");
        }
        out
    }
    /// Each rule with its four counts and their words.
    pub(super) fn rows(&self) -> impl Iterator<Item = (&str, [(&'static str, u64); 4])> {
        let named = |counts: &[u64; 4]| std::array::from_fn(|at| (COLUMNS[at], counts[at]));
        self.0.iter().map(move |(rule, counts)| (rule.as_str(), named(counts)))
    }
    /// As a list of objects.
    pub(super) fn json(&self) -> serde_json::Value {
        let rows = self.0.iter().map(|(rule, [errors, warnings, infos, unknown])| Row {
            rule,
            errors: *errors,
            warnings: *warnings,
            infos: *infos,
            unknown: *unknown,
        });
        serde_json::to_value(rows.collect::<Vec<_>>()).unwrap_or_default()
    }
}
