//! One file of the document.
use crate::severity;
use serde::{Serialize, Serializer, ser::SerializeMap};
use trunnion_check::{Diagnostic, Report, Scope, Status, ValueKey, Verdict};
use trunnion_syntax::{LineIndex, Program};

/// The program that was checked.
#[derive(Clone, Copy)]
pub struct Subject<'a> {
    /// Its path or name as given.
    pub name: &'a str,
    /// Parsed.
    pub program: &'a Program,
    /// Its lines.
    pub lines: &'a LineIndex,
    /// The name of the dialect, or of the control that is not supported; none for a file that is not a program.
    pub dialect: Option<&'a str>,
    /// Why this dialect.
    pub dialect_reason: &'a str,
    /// The machine.
    pub machine: Option<&'a str>,
}

/// One file of the document.
#[derive(Serialize)]
pub struct File {
    /// Path as given.
    pub path: String,
    /// Dialect, or control that is not supported.
    pub dialect: Option<String>,
    /// Why this dialect.
    pub dialect_reason: String,
    /// Machine.
    pub machine: Option<String>,
    /// `pass`, `fail` or `unknown`.
    pub verdict: &'static str,
    /// What was judged.
    pub scope: &'static str,
    /// Blocks of the text.
    pub blocks: u64,
    /// Motions that were run.
    pub motions: u64,
    /// Shortest and longest time, s.
    pub cycle_time_s: Option<[f64; 2]>,
    /// What was run.
    pub coverage: Coverage,
    /// What was taken as given.
    pub assumptions: Vec<String>,
    /// Findings.
    pub diagnostics: Vec<Item>,
    /// Findings that the baseline accepts.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub accepted: Vec<Item>,
}

/// What was checked.
#[derive(Serialize)]
pub struct Coverage {
    /// Blocks of the text.
    pub blocks: u64,
    /// Of these, how many ran.
    pub blocks_run: u64,
    /// Motions that were run.
    pub motions: u64,
    /// Motions whose end is known.
    pub motions_known: u64,
    /// Blocks that did not run.
    pub not_run: Vec<NotRun>,
    /// Rules that judged nothing, because the machine file does not declare what they need.
    pub not_judged: Vec<NotJudged>,
    /// Where the run could not be followed further.
    pub given_up: Option<GivenUp>,
}

/// Blocks that did not run.
#[derive(Serialize)]
pub struct NotRun {
    /// First line, from 1.
    pub line: u32,
    /// Last line.
    pub last_line: u32,
    /// Why.
    pub reason: &'static str,
}

/// A rule that judged nothing.
#[derive(Serialize)]
pub struct NotJudged {
    /// Its name.
    pub rule: &'static str,
    /// What the machine file would have to declare.
    pub needs: &'static str,
}

/// Where the run ended early.
#[derive(Serialize)]
pub struct GivenUp {
    /// First line, from 1.
    pub line: u32,
    /// Why.
    pub reason: &'static str,
}

impl Coverage {
    fn of(subject: &Subject<'_>, report: &Report) -> Self {
        let line = |block| {
            let start = subject.program.block(block).range().start;
            subject.lines.line_column(subject.program.source(), start).0
        };
        let found = &report.coverage;
        Self {
            blocks: found.blocks,
            blocks_run: found.blocks_run,
            motions: found.motions,
            motions_known: found.motions_known,
            not_run: found
                .not_run
                .iter()
                .map(|part| NotRun {
                    line: line(part.first),
                    last_line: line(part.last),
                    reason: part.reason.name(),
                })
                .collect(),
            not_judged: found
                .not_judged
                .iter()
                .map(|lacking| NotJudged {
                    rule: lacking.rule,
                    needs: lacking.needs,
                })
                .collect(),
            given_up: found.given_up.as_ref().map(|given_up| GivenUp {
                line: line(given_up.block),
                reason: given_up.reason,
            }),
        }
    }
}

/// A finding.
#[derive(Serialize)]
pub struct Item {
    /// Name of the rule.
    pub rule: &'static str,
    /// `error`, `warning` or `info`.
    pub severity: &'static str,
    /// First line, from 1.
    pub line: u32,
    /// First column, from 1.
    pub column: u32,
    /// Line of its end.
    pub end_line: u32,
    /// Column of its end.
    pub end_column: u32,
    /// First byte.
    pub byte_start: u32,
    /// Byte after the last.
    pub byte_end: u32,
    /// Number of the block.
    pub block: Option<String>,
    /// What is wrong.
    pub message: String,
    /// More about it.
    pub notes: Vec<String>,
    /// What to do.
    pub help: Option<String>,
    /// The numbers of the message.
    pub values: Values,
    /// `fail` or `unknown`.
    pub status: &'static str,
    /// Rewrites that cure it.
    pub fixes: Vec<&'static str>,
    /// Page of the rule.
    pub docs: String,
    /// What recognises the finding in a later text of the program; only the findings of the list have one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fingerprint: Option<String>,
    /// The text that the place should have instead.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub replacement: Option<String>,
    /// How many findings were put together.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub count: Option<u32>,
    /// Last line.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub last_line: Option<u32>,
    /// Other places.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub related: Vec<Related>,
    /// The other findings of the event that this one leads.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub also: Vec<Item>,
}

/// Another place that a finding names.
#[derive(Serialize)]
pub struct Related {
    /// First line, from 1.
    pub line: u32,
    /// First column, from 1.
    pub column: u32,
    /// What is wrong.
    pub message: String,
}

/// Values in the order the rule gave them.
pub struct Values(pub Vec<(&'static str, ValueKey)>);

impl Serialize for Values {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for (key, value) in &self.0 {
            match value {
                ValueKey::Number(number) if key.contains("bound") => map.serialize_entry(key, &tidy_up(*number))?,
                ValueKey::Number(number) => map.serialize_entry(key, &tidy(*number))?,
                ValueKey::Text(text) => map.serialize_entry(key, text)?,
            }
        }
        map.end()
    }
}

/// Rounded to a millionth of its unit: anything smaller is rounding noise.
pub fn tidy(value: f64) -> f64 {
    let rounded = (value * 1e6).round() / 1e6;
    if rounded.is_finite() { rounded + 0.0 } else { value }
}

/// As [`tidy`], but never below the value: for proven upper bounds.
fn tidy_up(value: f64) -> f64 {
    let rounded = (value * 1e6).ceil() / 1e6;
    if rounded.is_finite() { rounded + 0.0 } else { value }
}

/// One finding, with those that it leads.
fn item(subject: &Subject<'_>, d: &Diagnostic, fingerprint: Option<&str>) -> Item {
    let place = |offset| subject.lines.line_column(subject.program.source(), offset);
    let (line, column) = place(d.range.start);
    let (end_line, end_column) = place(d.range.end);
    let merged = d.count > 1;
    Item {
        rule: d.rule,
        severity: severity(d.severity),
        line,
        column,
        end_line,
        end_column,
        byte_start: d.range.start,
        byte_end: d.range.end,
        block: d.block.clone(),
        message: d.message.clone(),
        notes: d.notes.clone(),
        help: d.help.clone(),
        values: Values(d.values.clone()),
        status: if d.status == Status::Fail { "fail" } else { "unknown" },
        fixes: d.fixes.clone(),
        docs: format!("rules/{}", d.rule),
        fingerprint: fingerprint.map(str::to_owned),
        replacement: d.replacement.clone(),
        count: merged.then_some(d.count),
        last_line: merged.then(|| place(d.last.start).0),
        related: d
            .related
            .iter()
            .map(|(range, message)| {
                let (line, column) = place(range.start);
                Related {
                    line,
                    column,
                    message: message.clone(),
                }
            })
            .collect(),
        also: d.also.iter().map(|led| item(subject, led, None)).collect(),
    }
}

/// Findings with their fingerprints.
pub type Marked<'a> = (&'a [Diagnostic], &'a [String]);

/// What the findings mean together: the verdict, and what was judged.
pub type Outcome = (Verdict, Scope);

/// One file: its report, whose findings have the fingerprints `marks`, and what the baseline accepts.
pub fn file(
    subject: &Subject<'_>,
    (report, marks): (&Report, &[String]),
    accepted: Marked<'_>,
    (verdict, scope): Outcome,
) -> File {
    let items = |(found, marks): Marked<'_>| {
        let each = found.iter().zip(marks);
        each.map(|(d, mark)| item(subject, d, Some(mark))).collect()
    };
    File {
        path: subject.name.to_owned(),
        dialect: subject.dialect.map(str::to_owned),
        dialect_reason: subject.dialect_reason.to_owned(),
        machine: subject.machine.map(str::to_owned),
        verdict: verdict.name(),
        scope: scope.name(),
        blocks: report.summary.blocks,
        motions: report.summary.motions,
        cycle_time_s: report.cycle_time_s.map(|t| t.map(tidy)),
        coverage: Coverage::of(subject, report),
        assumptions: report.assumptions.clone(),
        diagnostics: items((&report.diagnostics, marks)),
        accepted: items(accepted),
    }
}
