//! SARIF 2.1.0: rules with their pages, results, and what was covered.
//!
//! Source: OASIS, Static Analysis Results Interchange Format (SARIF) Version 2.1.0, sections 3.14 (run), 3.27 (result), 3.49
//! (reporting descriptor).
use super::Tally;
use crate::cli::json::{File, Item};
use serde_json::{Value, json};
use std::fmt::Write;
use trunnion_check::{Guarantee, rules};

/// The name under which the fingerprint is published; a change of how it is computed needs a new one.
const FINGERPRINT: &str = "trunnionFinding/v1";

/// The start of the document, up to the first result.
pub(super) fn head() -> String {
    format!(
        "{{\n\"$schema\": \"https://json.schemastore.org/sarif-2.1.0.json\",\n\"version\": \"2.1.0\",\n\"runs\": [{{\n\"tool\": {},\n\
         \"columnKind\": \"unicodeCodePoints\",\n\
         \"originalUriBaseIds\": {{ \"SRCROOT\": {{ \"description\": {{ \"text\": \"The folder in which trunnion ran.\" }} }} }},\n\
         \"results\": [",
        tool()
    )
}

/// The end of the document after the files.
pub(super) fn tail(tally: &Tally, statistics: bool) -> String {
    let failed: Vec<Value> = tally
        .not_checked
        .iter()
        .map(|failed| json!({ "level": "error", "message": { "text": failed.text() } }))
        .collect();
    let invocation = json!({ "executionSuccessful": failed.is_empty(), "toolExecutionNotifications": failed });
    let mut properties = json!({
        "summary": tally.summary, "files": tally.files, "pass": tally.pass, "fail": tally.fail, "unknown": tally.unknown,
    });
    if statistics {
        properties["statistics"] = tally.statistics.json();
    }
    format!("\n],\n\"invocations\": [{invocation}],\n\"properties\": {properties}\n}}]\n}}\n")
}

fn tool() -> Value {
    let all: Vec<Value> = rules()
        .iter()
        .map(|rule| {
            let guarantee = if rule.guarantee == Guarantee::Sound {
                "sound"
            } else {
                "heuristic"
            };
            json!({
                "id": rule.name,
                "name": pascal(rule.name),
                "shortDescription": { "text": rule.summary() },
                "fullDescription": { "text": rule.summary() },
                "help": { "text": rule.docs, "markdown": rule.docs },
                "defaultConfiguration": { "level": level(crate::cli::short::severity(rule.severity)) },
                "properties": { "guarantee": guarantee, "tags": [rule.level()] },
            })
        })
        .collect();
    json!({ "driver": {
        "name": "trunnion",
        "version": env!("CARGO_PKG_VERSION"),
        "semanticVersion": env!("CARGO_PKG_VERSION"),
        "rules": all,
    }})
}

/// `axis-limit` as `AxisLimit`: the form of names that section 3.49.7 shows.
fn pascal(name: &str) -> String {
    let capital = |word: &str| word[..1].to_ascii_uppercase() + &word[1..];
    name.split('-').filter(|word| !word.is_empty()).map(capital).collect()
}

fn level(severity: &str) -> &'static str {
    match severity {
        "error" => "error",
        "warning" => "warning",
        _ => "note",
    }
}

/// The results of one file, with a comma between them. Those that the baseline accepts are suppressed.
pub(super) fn results(file: &File) -> String {
    let found = file.diagnostics.iter().map(|item| result(file, item, false));
    let accepted = file.accepted.iter().map(|item| result(file, item, true));
    let all: Vec<String> = found.chain(accepted).map(|value| value.to_string()).collect();
    all.join(",\n")
}

/// The file itself: what was covered and assumed.
pub(super) fn artifact(file: &File) -> String {
    json!({
        "location": location(&file.path),
        "roles": ["analysisTarget"],
        "properties": {
            "verdict": file.verdict,
            "scope": file.scope,
            "dialect": file.dialect,
            "dialectReason": file.dialect_reason,
            "machine": file.machine,
            "cycleTimeSeconds": file.cycle_time_s,
            "coverage": file.coverage,
            "assumptions": file.assumptions,
        },
    })
    .to_string()
}

fn result(file: &File, item: &Item, accepted: bool) -> Value {
    let unknown = item.status == "unknown";
    let mut text = item.message.clone();
    for more in item.notes.iter().chain(&item.help) {
        text.push('\n');
        text.push_str(more);
    }
    // a rule that could not decide is "open", and such a result has no level (section 3.27.9)
    let (kind, level) = if unknown {
        ("open", "none")
    } else {
        ("fail", level(item.severity))
    };
    let mut result = json!({
        "ruleId": item.rule,
        "ruleIndex": rules().iter().position(|rule| rule.name == item.rule).map_or(-1, |at| at as i64),
        "kind": kind,
        "level": level,
        "message": { "text": text },
        "locations": [{ "physicalLocation": {
            "artifactLocation": location(&file.path),
            "region": {
                "startLine": item.line, "startColumn": item.column,
                "endLine": item.end_line, "endColumn": item.end_column,
                "byteOffset": item.byte_start, "byteLength": item.byte_end - item.byte_start,
            },
        }}],
        "occurrenceCount": item.count.unwrap_or(1),
        "properties": {
            "status": item.status,
            "severity": item.severity,
            "values": item.values,
            "rewrites": item.fixes,
            "also": item.also,
        },
    });
    if let Some(mark) = &item.fingerprint {
        result["partialFingerprints"] = json!({ FINGERPRINT: mark });
    }
    if !item.related.is_empty() {
        let related = item.related.iter().enumerate().map(|(id, place)| {
            json!({
                "id": id,
                "message": { "text": place.message },
                "physicalLocation": {
                    "artifactLocation": location(&file.path),
                    "region": { "startLine": place.line, "startColumn": place.column },
                },
            })
        });
        result["relatedLocations"] = related.collect();
    }
    if let Some(replacement) = &item.replacement {
        result["fixes"] = json!([{
            "description": { "text": format!("write {replacement}") },
            "artifactChanges": [{
                "artifactLocation": location(&file.path),
                "replacements": [{
                    "deletedRegion": {
                        "startLine": item.line, "startColumn": item.column,
                        "endLine": item.end_line, "endColumn": item.end_column,
                    },
                    "insertedContent": { "text": replacement },
                }],
            }],
        }]);
    }
    if accepted {
        result["suppressions"] = json!([{ "kind": "external", "justification": "accepted by the baseline" }]);
    }
    result
}

/// A path as a URI reference: relative to the folder in which trunnion ran, or absolute.
fn location(path: &str) -> Value {
    let path = path.replace('\\', "/");
    let encoded = encode(path.trim_start_matches("./"));
    if path.starts_with('/') {
        json!({ "uri": format!("file://{encoded}") })
    } else {
        json!({ "uri": encoded, "uriBaseId": "SRCROOT" })
    }
}

/// Percent-encodes what may not stand in the path of a URI (RFC 3986, section 3.3).
fn encode(path: &str) -> String {
    let mut out = String::new();
    for byte in path.bytes() {
        if byte.is_ascii_alphanumeric() || b"-._~/!$&'()*+,;=@".contains(&byte) {
            out.push(char::from(byte));
        } else {
            let _ = write!(out, "%{byte:02X}");
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_are_those_of_sarif() {
        assert_eq!(location("./a b/ä.nc")["uri"], "a%20b/%C3%A4.nc");
        assert_eq!(location("/x/y#1.nc")["uri"], "file:///x/y%231.nc");
        assert_eq!(location("<stdin>")["uri"], "%3Cstdin%3E");
    }
}
