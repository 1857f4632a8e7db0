//! The JSON document of `check`, documented by its schema name `trunnion-check/1`.
use super::{check::Checked, failure::Failure, load::Loaded, short};
use serde::{Serialize, Serializer, ser::SerializeMap};
use serde_json::json;
use std::io::Write;
use trunnion_check::{Report, Scope, Status, ValueKey, Verdict};
use trunnion_syntax::LineIndex;

#[derive(Clone, Copy, Default, Serialize)]
struct Summary {
    files: u64,
    blocks: u64,
    motions: u64,
    errors: u64,
    warnings: u64,
    infos: u64,
    unknown: u64,
}

/// One file of the document.
#[derive(Serialize)]
pub(super) struct File {
    path: String,
    dialect: Option<String>,
    dialect_reason: String,
    machine: Option<String>,
    verdict: &'static str,
    scope: &'static str,
    blocks: u64,
    motions: u64,
    cycle_time_s: Option<[f64; 2]>,
    coverage: Coverage,
    assumptions: Vec<String>,
    diagnostics: Vec<Item>,
}

/// What was checked.
#[derive(Serialize)]
struct Coverage {
    blocks: u64,
    blocks_run: u64,
    motions: u64,
    motions_known: u64,
    not_run: Vec<NotRun>,
    given_up: Option<GivenUp>,
}

#[derive(Serialize)]
struct NotRun {
    line: u32,
    last_line: u32,
    reason: &'static str,
}

#[derive(Serialize)]
struct GivenUp {
    line: u32,
    reason: &'static str,
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
struct Item {
    rule: &'static str,
    severity: &'static str,
    line: u32,
    column: u32,
    end_line: u32,
    end_column: u32,
    byte_start: u32,
    byte_end: u32,
    block: Option<String>,
    message: String,
    notes: Vec<String>,
    help: Option<String>,
    values: Values,
    status: &'static str,
    fixes: Vec<&'static str>,
    docs: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    count: Option<u32>,
    #[serde(skip_serializing_if = "Option::is_none")]
    last_line: Option<u32>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    related: Vec<Related>,
    /// The other findings of the event that this one leads.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    also: Vec<Item>,
}

#[derive(Serialize)]
struct Related {
    line: u32,
    column: u32,
    message: String,
}

/// Values in the order the rule gave them.
struct Values(Vec<(&'static str, ValueKey)>);

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
fn item(loaded: &Loaded, lines: &LineIndex, d: &trunnion_check::Diagnostic) -> Item {
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
        also: d.also.iter().map(|led| item(loaded, lines, led)).collect(),
    }
}

/// One file.
pub(super) fn file(loaded: &Loaded, lines: &LineIndex, report: &Report, (outcome, scope): (Verdict, Scope)) -> File {
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
        diagnostics: report.diagnostics.iter().map(|d| item(loaded, lines, d)).collect(),
    }
}

/// A file or folder that could not be checked; the exit status is 2.
#[derive(Serialize)]
pub(super) struct NotChecked {
    /// Path, with the line where it is known.
    place: String,
    /// What is wrong, and what to do.
    message: String,
}

impl NotChecked {
    pub(super) fn of(failure: &Failure) -> Self {
        Self {
            place: failure.place().to_owned(),
            message: failure.message().to_owned(),
        }
    }
}

/// Writes the document of all files, one after the other as `each` hands them over, and their summary after them.
/// `each` returns what could not be checked.
pub(super) fn write<'n>(
    out: &mut impl Write,
    each: impl FnOnce(&mut dyn FnMut(Checked)) -> &'n [NotChecked],
) -> Result<(), Failure> {
    let mut summary = Summary::default();
    let mut machine = None;
    let mut error = None;
    write!(
        out,
        "{{\n  \"schema\": \"trunnion-check/1\",\n  \"version\": \"{}\",\n  \"files\": [",
        env!("CARGO_PKG_VERSION")
    )?;
    let not_checked = each(&mut |file| {
        let s = file.summary;
        if summary.files == 0 {
            machine.clone_from(&file.machine);
        } else if machine != file.machine {
            machine = None;
        }
        let comma = if summary.files == 0 { "" } else { "," };
        summary.files += 1;
        summary.blocks += s.blocks;
        summary.motions += s.motions;
        summary.errors += s.errors;
        summary.warnings += s.warnings;
        summary.infos += s.infos;
        summary.unknown += s.unknown;
        let text = file
            .json
            .as_ref()
            .map_or(Ok(String::new()), serde_json::to_string_pretty);
        let written = text
            .map_err(std::io::Error::from)
            .and_then(|text| write!(out, "{comma}\n    {}", text.replace('\n', "\n    ")));
        if let Err(failed) = written {
            error.get_or_insert(failed);
        }
    });
    if let Some(error) = error {
        return Err(error.into());
    }
    let rest =
        serde_json::to_string_pretty(&json!({ "machine": machine, "not_checked": not_checked, "summary": summary }))
            .map_err(std::io::Error::from)?;
    // its opening brace is that of the document
    writeln!(out, "\n  ],{}", &rest[1..])?;
    Ok(())
}

/// Writes any document, pretty, with a line end.
pub(super) fn write_json(out: &mut impl Write, document: &impl Serialize) -> Result<(), Failure> {
    serde_json::to_writer_pretty(&mut *out, document).map_err(|error| Failure::from(std::io::Error::from(error)))?;
    writeln!(out)?;
    Ok(())
}
