//! One checked file, in the form that is printed: texts and counts, so that it can be kept in a cache.
use super::{
    baseline::{self, Baseline, Entry},
    cache::{self, Cache},
    github, junit, sarif, statistics,
};
use crate::cli::{
    args::{Check, CheckFormat, Global},
    failure::{Failure, shown},
    json,
    load::{self, Loaded, Opened},
    render, short,
    verdict::{Judged, verdict_line},
};
use serde::{Deserialize, Serialize};
use std::{collections::BTreeMap, path::Path};
use trunnion_check::{Diagnostic, Report, Severity, Status, Summary, Verdict};
use trunnion_document::{Subject, fingerprints};
use trunnion_syntax::LineIndex;

/// How files are checked and in which form they are wanted.
pub(super) struct Job<'a> {
    pub(super) global: &'a Global,
    pub(super) command: &'a Check,
    pub(super) format: CheckFormat,
    pub(super) baseline: Option<&'a Baseline>,
    pub(super) cache: Option<&'a Cache>,
}

/// Counts of one file or of all.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Counts {
    pub(super) blocks: u64,
    pub(super) motions: u64,
    pub(super) errors: u64,
    pub(super) warnings: u64,
    pub(super) infos: u64,
    pub(super) unknown: u64,
    /// Findings that the baseline accepts; not among the others.
    pub(super) accepted: u64,
}

impl Counts {
    fn of(summary: &Summary, accepted: usize) -> Self {
        Self {
            blocks: summary.blocks,
            motions: summary.motions,
            errors: summary.errors,
            warnings: summary.warnings,
            infos: summary.infos,
            unknown: summary.unknown,
            accepted: accepted as u64,
        }
    }
    /// Adds those of another file.
    pub(super) fn add(&mut self, other: &Self) {
        self.blocks += other.blocks;
        self.motions += other.motions;
        self.errors += other.errors;
        self.warnings += other.warnings;
        self.infos += other.infos;
        self.unknown += other.unknown;
        self.accepted += other.accepted;
    }
}

/// One checked file, rendered.
#[derive(Debug, PartialEq, Serialize, Deserialize)]
pub(super) struct Checked {
    /// Path as given.
    pub(super) name: String,
    /// Its part of the document: findings as text, an object, a test suite.
    pub(super) text: String,
    /// What stands in another place of the document: of SARIF the file itself, of annotations what was not covered.
    pub(super) about: String,
    /// Its verdict in one line.
    pub(super) line: String,
    /// `pass`, `fail` or `unknown`.
    pub(super) verdict: String,
    /// Counts.
    pub(super) summary: Counts,
    /// Machine it was checked for.
    pub(super) machine: Option<String>,
    /// Some finding at or above `--deny`, or unknown under `--strict`.
    pub(super) found: bool,
    /// For `-v`.
    pub(super) explanation: String,
    /// Findings of each rule: errors, warnings, infos, unknown.
    pub(super) rules: BTreeMap<String, [u64; 4]>,
    /// For the baseline: its key and all findings, accepted ones too. Empty unless a baseline is written.
    pub(super) entries: (String, Vec<Entry>),
    /// Findings of the baseline that are not found any more.
    pub(super) gone: u64,
}

impl Job<'_> {
    /// Checks one file, or takes it from the cache.
    pub(super) fn check(&self, path: &Path) -> Result<Checked, Failure> {
        let opened = load::open(self.global, path)?;
        let cached = self.cache.and_then(|cache| Some((cache, self.key(path, &opened)?)));
        let Some((cache, key)) = cached else {
            return Ok(self.judge(&opened.parse()).0);
        };
        if let Some(checked) = cache.get(&key) {
            return Ok(checked);
        }
        let (checked, alone) = self.judge(&opened.parse());
        if alone {
            cache.put(&key, &checked);
        }
        Ok(checked)
    }

    /// Everything that the result depends on: `None` if some of it cannot be read.
    fn key(&self, path: &Path, opened: &Opened) -> Option<String> {
        let mut key = cache::Key::new();
        let words = [
            self.format.word(),
            if self.global.color.on() { "color" } else { "plain" },
        ];
        for word in words {
            key.add(word.as_bytes());
        }
        key.add(path.as_os_str().as_encoded_bytes());
        key.add(std::fs::canonicalize(path).ok()?.as_os_str().as_encoded_bytes());
        key.add(&opened.source);
        let resolved = &opened.resolved;
        for file in &resolved.files {
            key.add(file.as_os_str().as_encoded_bytes());
            key.add(&load::read(file).ok()?);
        }
        let reasons = [
            &resolved.dialect.name,
            &resolved.dialect_reason,
            &resolved.machine_reason,
        ];
        for text in reasons {
            key.add(text.as_bytes());
        }
        if let Some(baseline) = self.baseline {
            // what it accepts of this program
            let known = baseline.of(&baseline.key(path));
            key.add(&serde_json::to_vec(&known).ok()?);
        }
        Some(key.finish())
    }

    /// The judgement, and whether it depends on no file but those of the key.
    fn judge(&self, loaded: &Loaded) -> (Checked, bool) {
        let mut settings = loaded.resolved.settings();
        settings.scope = self.command.scope.map(super::CheckScope::scope);
        let mut report = trunnion_check::check(&loaded.program, &settings);
        let marks = fingerprints(loaded.program.source(), &report);
        let entries = self.entries(loaded, &report, &marks);
        let known = self
            .baseline
            .and_then(|baseline| baseline.of(&baseline.key(Path::new(&loaded.name))));
        let split = Split::of(&mut report, marks, known);
        let deny = self.global.deny.severity();
        let verdict = match report.verdict(deny) {
            // what is accepted is not decided by that
            Verdict::Pass if split.accepted.iter().any(|d| d.status == Status::Unknown) => Verdict::Unknown,
            verdict => verdict,
        };
        let judged = Judged {
            name: &loaded.name,
            verdict,
            summary: report.summary,
            machine: loaded.resolved.machine.as_ref().map(|m| m.id.as_str()),
            not_read: loaded.not_read(),
            read_as: (!loaded.resolved.dialect_certain)
                .then(|| format!("{} ({})", loaded.resolved.dialect.name, loaded.resolved.dialect_reason)),
            scope: settings.scope(),
            coverage: &report.coverage,
            assumptions: &report.assumptions,
            accepted: split.accepted.len(),
        };
        let line = verdict_line(&judged, self.colour());
        let (text, about) = self.text(loaded, &report, &split, &judged, &line);
        let checked = Checked {
            text,
            about,
            line,
            verdict: verdict.name().to_owned(),
            summary: Counts::of(&report.summary, split.accepted.len()),
            machine: judged.machine.map(str::to_owned),
            found: is_found(&report, deny, self.global.strict),
            explanation: loaded.explanation(),
            rules: statistics::of(&report),
            entries,
            gone: split.gone,
            name: loaded.name.clone(),
        };
        (checked, !loaded.resolved.looked_for_subprograms())
    }

    fn colour(&self) -> bool {
        self.format == CheckFormat::Pretty && self.command.output.is_none() && self.global.color.on()
    }

    /// For the baseline that is written.
    fn entries(&self, loaded: &Loaded, report: &Report, marks: &[String]) -> (String, Vec<Entry>) {
        let Some(file) = &self.command.write_baseline else {
            return (String::new(), Vec::new());
        };
        let all = report.diagnostics.iter().zip(marks);
        let all = all.map(|(d, mark)| Entry::of(d, mark)).collect();
        (baseline::key(file, Path::new(&loaded.name)), all)
    }

    /// The parts of the document.
    fn text(
        &self,
        loaded: &Loaded,
        report: &Report,
        split: &Split,
        judged: &Judged<'_>,
        line: &str,
    ) -> (String, String) {
        let lines = LineIndex::new(loaded.program.source());
        let limit = self.command.limit;
        match self.format {
            CheckFormat::Pretty => {
                let text = render::pretty(loaded, &lines, report, limit, self.colour());
                return (text, String::new());
            }
            CheckFormat::Short => {
                let text = shown(&short::short(loaded, &lines, report, limit.unwrap_or(200))).into_owned();
                return (text, String::new());
            }
            CheckFormat::Json | CheckFormat::Sarif | CheckFormat::Junit | CheckFormat::Github => {}
        }
        let accepted = (split.accepted.as_slice(), split.accepted_marks.as_slice());
        let outcome = (judged.verdict, judged.scope);
        let subject = Subject {
            name: &loaded.name,
            program: &loaded.program,
            lines: &lines,
            dialect: loaded.dialect_name(),
            dialect_reason: &loaded.resolved.dialect_reason,
            machine: judged.machine,
        };
        let file = trunnion_document::file(&subject, (report, &split.marks), accepted, outcome);
        let deny = self.global.deny.severity();
        let denied = |item: &json::Item| is_denied(item.severity, item.status, deny, self.global.strict);
        match self.format {
            CheckFormat::Sarif => (sarif::results(&file), sarif::artifact(&file)),
            CheckFormat::Junit => (junit::suite(&file, line, denied), String::new()),
            CheckFormat::Github => (github::annotations(&file, denied), github::coverage(&file)),
            _ => {
                let text = serde_json::to_string_pretty(&file).unwrap_or_default();
                (text.replace('\n', "\n    "), String::new())
            }
        }
    }
}

/// The findings of a report with what the baseline accepts taken out.
struct Split {
    /// Fingerprints of the findings that are left in the report.
    marks: Vec<String>,
    accepted: Vec<Diagnostic>,
    accepted_marks: Vec<String>,
    /// How many findings of the baseline are not found any more.
    gone: u64,
}

impl Split {
    fn of(report: &mut Report, all: Vec<String>, known: Option<&BTreeMap<String, Entry>>) -> Self {
        let (mut marks, mut accepted_marks) = (Vec::new(), Vec::new());
        let mut next = all.into_iter();
        let accepted = report.take_out(|d| {
            let Some(mark) = next.next() else { return false };
            let is_known = known.is_some_and(|known| known.get(&mark).is_some_and(|entry| entry.covers(d)));
            let list = if is_known { &mut accepted_marks } else { &mut marks };
            list.push(mark);
            is_known
        });
        let gone = known.map_or(0, |known| known.len().saturating_sub(accepted_marks.len())) as u64;
        Self {
            marks,
            accepted,
            accepted_marks,
            gone,
        }
    }
}

/// Whether the exit status is 1.
pub(in crate::cli) fn is_found(report: &Report, deny: Severity, strict: bool) -> bool {
    report.diagnostics.iter().any(|d| match d.status {
        Status::Fail => d.severity >= deny,
        Status::Unknown => strict,
    })
}

/// The same for a finding in the form of the document.
fn is_denied(severity: &str, status: &str, deny: Severity, strict: bool) -> bool {
    let severity = match severity {
        "error" => Severity::Error,
        "warning" => Severity::Warning,
        _ => Severity::Info,
    };
    if status == "unknown" { strict } else { severity >= deny }
}
