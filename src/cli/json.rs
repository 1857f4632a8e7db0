//! The JSON document of `check`, documented by its schema name `trunnion-check/1`.
use super::{failure::Failure, load::Loaded, short};
use serde::{Deserialize, Serialize, Serializer, ser::SerializeMap};
use std::io::Write;
use trunnion_check::{Diagnostic, Report, Scope, Status, ValueKey, Verdict};
use trunnion_syntax::LineIndex;

/// One file of the document.
#[derive(Serialize)]
pub(super) struct File {
    pub(super) path: String,
    pub(super) dialect: Option<String>,
    pub(super) dialect_reason: String,
    pub(super) machine: Option<String>,
    pub(super) verdict: &'static str,
    pub(super) scope: &'static str,
    pub(super) blocks: u64,
    pub(super) motions: u64,
    pub(super) cycle_time_s: Option<[f64; 2]>,
    pub(super) coverage: Coverage,
    pub(super) assumptions: Vec<String>,
    pub(super) diagnostics: Vec<Item>,
    /// Findings that the baseline accepts.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) accepted: Vec<Item>,
}

/// What was checked.
#[derive(Serialize)]
pub(super) struct Coverage {
    pub(super) blocks: u64,
    pub(super) blocks_run: u64,
    pub(super) motions: u64,
    pub(super) motions_known: u64,
    pub(super) not_run: Vec<NotRun>,
    pub(super) given_up: Option<GivenUp>,
}

#[derive(Serialize)]
pub(super) struct NotRun {
    pub(super) line: u32,
    pub(super) last_line: u32,
    pub(super) reason: &'static str,
}

#[derive(Serialize)]
pub(super) struct GivenUp {
    pub(super) line: u32,
    pub(super) reason: &'static str,
}

impl Coverage {
    fn of(loaded: &Loaded, lines: &LineIndex, report: &Report) -> Self {
        let line = |block| {
            let start = loaded.program.block(block).range().start;
            lines.line_column(loaded.program.source(), start).0
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
            given_up: found.given_up.as_ref().map(|given_up| GivenUp {
                line: line(given_up.block),
                reason: given_up.reason,
            }),
        }
    }
}

#[derive(Serialize)]
pub(super) struct Item {
    pub(super) rule: &'static str,
    pub(super) severity: &'static str,
    pub(super) line: u32,
    pub(super) column: u32,
    pub(super) end_line: u32,
    pub(super) end_column: u32,
    pub(super) byte_start: u32,
    pub(super) byte_end: u32,
    pub(super) block: Option<String>,
    pub(super) message: String,
    pub(super) notes: Vec<String>,
    pub(super) help: Option<String>,
    pub(super) values: Values,
    pub(super) status: &'static str,
    pub(super) fixes: Vec<&'static str>,
    pub(super) docs: String,
    /// What recognises the finding in a later text of the program; only the findings of the list have one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) fingerprint: Option<String>,
    /// The text that the place should have instead.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) replacement: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) count: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) last_line: Option<u32>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) related: Vec<Related>,
    /// The other findings of the event that this one leads.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) also: Vec<Item>,
}

#[derive(Serialize)]
pub(super) struct Related {
    pub(super) line: u32,
    pub(super) column: u32,
    pub(super) message: String,
}

/// Values in the order the rule gave them.
pub(super) struct Values(pub(super) Vec<(&'static str, ValueKey)>);

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
pub(super) fn tidy(value: f64) -> f64 {
    let rounded = (value * 1e6).round() / 1e6;
    if rounded.is_finite() { rounded + 0.0 } else { value }
}

/// As [`tidy`], but never below the value: for proven upper bounds.
fn tidy_up(value: f64) -> f64 {
    let rounded = (value * 1e6).ceil() / 1e6;
    if rounded.is_finite() { rounded + 0.0 } else { value }
}

/// The word of a verdict.
pub(super) fn verdict(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Pass => "pass",
        Verdict::Fail => "fail",
        Verdict::Unknown => "unknown",
    }
}

/// One finding, with those that it leads.
fn item(loaded: &Loaded, lines: &LineIndex, d: &Diagnostic, fingerprint: Option<&str>) -> Item {
    let place = |offset| lines.line_column(loaded.program.source(), offset);
    let (line, column) = place(d.range.start);
    let (end_line, end_column) = place(d.range.end);
    let merged = d.count > 1;
    Item {
        rule: d.rule,
        severity: short::severity(d.severity),
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
        also: d.also.iter().map(|led| item(loaded, lines, led, None)).collect(),
    }
}

/// Findings with their fingerprints.
pub(super) type Marked<'a> = (&'a [Diagnostic], &'a [String]);

/// One file: its report, whose findings have the fingerprints `marks`, and what the baseline accepts.
pub(super) fn file(
    loaded: &Loaded,
    lines: &LineIndex,
    (report, marks): (&Report, &[String]),
    accepted: Marked<'_>,
    (outcome, scope): (Verdict, Scope),
) -> File {
    let items = |(found, marks): Marked<'_>| {
        let each = found.iter().zip(marks);
        each.map(|(d, mark)| item(loaded, lines, d, Some(mark))).collect()
    };
    File {
        path: loaded.name.clone(),
        dialect: loaded.dialect_name().map(str::to_owned),
        dialect_reason: loaded.resolved.dialect_reason.clone(),
        machine: loaded.resolved.machine.as_ref().map(|m| m.id.clone()),
        verdict: verdict(outcome),
        scope: scope.name(),
        blocks: report.summary.blocks,
        motions: report.summary.motions,
        cycle_time_s: report.cycle_time_s.map(|t| t.map(tidy)),
        coverage: Coverage::of(loaded, lines, report),
        assumptions: report.assumptions.clone(),
        diagnostics: items((&report.diagnostics, marks)),
        accepted: items(accepted),
    }
}

/// A file or folder that could not be checked; the exit status is 2.
#[derive(Clone, Serialize, Deserialize)]
pub(super) struct NotChecked {
    /// Path, with the line where it is known.
    pub(super) place: String,
    /// What is wrong, and what to do.
    pub(super) message: String,
}

impl NotChecked {
    pub(super) fn of(failure: &Failure) -> Self {
        Self {
            place: failure.place().to_owned(),
            message: failure.message().to_owned(),
        }
    }
}

/// Writes any document, pretty, with a line end.
pub(super) fn write_json(out: &mut impl Write, document: &impl Serialize) -> Result<(), Failure> {
    serde_json::to_writer_pretty(&mut *out, document).map_err(|error| Failure::from(std::io::Error::from(error)))?;
    writeln!(out)?;
    Ok(())
}
