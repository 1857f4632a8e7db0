//! One program, judged as the command line judges it.
use crate::Request;
use serde_json::{Value, json};
use std::path::Path;
use trunnion_document::{SCHEMA, Subject, file, fingerprints};
use trunnion_syntax::LineIndex;
use trunnion_workspace::{LoadError, resolve};

/// A larger program is refused, in megabytes of 1 000 000 bytes, as on the command line without `--max-file-mb`.
const MOST_MEGABYTES: usize = 64;

/// The document of `trunnion check --format json` for one program. A program that cannot be checked (settings with a mistake, an unknown
/// machine) is listed in `not_checked` with the place and the reason.
pub fn check(request: &Request, program: Vec<u8>) -> String {
    let document = match judge(request, program) {
        Ok(document) => document,
        Err(error) => failed(&error),
    };
    document.to_string()
}

fn judge(request: &Request, source: Vec<u8>) -> Result<Value, LoadError> {
    let path = Path::new(&request.name);
    if source.len() > MOST_MEGABYTES * 1_000_000 {
        let text = format!("is larger than {MOST_MEGABYTES} MB and was not read; check it with the command line");
        return Err(LoadError::file(path, text));
    }
    let resolved = resolve(Some(path), &source, &request.overrides())?;
    let program = trunnion_syntax::parse(source, resolved.dialect.lex);
    let mut settings = resolved.settings();
    settings.scope = request.scope();
    let report = trunnion_check::check(&program, &settings);
    let marks = fingerprints(program.source(), &report);
    let lines = LineIndex::new(program.source());
    let machine = resolved.machine.as_ref().map(|machine| machine.id.as_str());
    let subject = Subject {
        name: &request.name,
        program: &program,
        lines: &lines,
        dialect: resolved.dialect_name(),
        dialect_reason: &resolved.dialect_reason,
        machine,
    };
    let outcome = (report.verdict(request.deny()), settings.scope());
    let file = file(&subject, (&report, &marks), (&[], &[]), outcome);
    let summary = &report.summary;
    let counts = json!({
        "files": 1, "blocks": summary.blocks, "motions": summary.motions, "errors": summary.errors, "warnings": summary.warnings,
        "infos": summary.infos, "unknown": summary.unknown, "accepted": 0,
    });
    Ok(whole(&json!([file]), machine, &json!([]), &counts))
}

fn failed(error: &LoadError) -> Value {
    let counts = json!({
        "files": 0, "blocks": 0, "motions": 0, "errors": 0, "warnings": 0, "infos": 0, "unknown": 0, "accepted": 0,
    });
    let why = json!([{ "place": error.place, "message": error.message }]);
    whole(&json!([]), None, &why, &counts)
}

/// A request that cannot be read, as a document.
pub fn refused(message: &str) -> String {
    failed(&LoadError::new(message)).to_string()
}

fn whole(files: &Value, machine: Option<&str>, not_checked: &Value, summary: &Value) -> Value {
    json!({
        "schema": SCHEMA, "version": env!("CARGO_PKG_VERSION"), "files": files, "machine": machine, "not_checked": not_checked,
        "summary": summary,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn verdict(request: &str, program: &str) -> Value {
        let request = Request::read(request).expect("a request");
        serde_json::from_str(&check(&request, program.as_bytes().to_vec())).expect("JSON")
    }

    const PROGRAM: &str =
        "%\nO1\nG17 G21 G90 G94\nT1 M6\nG54 G0 X0. Y0.\nG43 H1 Z-10.\nS3000 M3\nG1 X20. F200.\nM5\nM30\n%\n";

    #[test]
    fn a_called_program_may_be_among_the_files() {
        let main = "%\nO1\nG21 G90 G94 G17\nG54 G0 X0. Y0. Z5.\nM98 P2000\nG0 Z5.\nM30\n%\n";
        let alone = verdict(r#"{"name": "a.nc", "dialect": "fanuc-30i"}"#, main);
        let has_missing = |found: &Value| found.to_string().contains("missing-subprogram");
        assert!(has_missing(&alone), "{alone}");
        let sub = r#"{"name": "a.nc", "dialect": "fanuc-30i", "files": {"O2000.nc": "%\nO2000\nG0 X7.\nM99\n%\n"}}"#;
        let found = verdict(sub, main);
        assert!(!has_missing(&found), "{found}");
        let motions = |found: &Value| found["summary"]["motions"].as_u64();
        assert_eq!((motions(&alone), motions(&found)), (Some(2), Some(3)), "{found}");
        // a file with another name is no such program, and the message says where it was searched
        let other = verdict(&sub.replace("\"O2000.nc\"", "\"other.nc\""), main);
        assert!(
            has_missing(&other) && other.to_string().contains("the files that were given"),
            "{other}"
        );
    }

    #[test]
    fn settings_and_machine_files_are_texts() {
        let found = verdict(r#"{"name": "a.nc", "machine": "mill-3axis"}"#, PROGRAM);
        assert_eq!(found["files"][0]["verdict"], "unknown", "{found}");
        let settings = json!({
            "name": "a.nc",
            "files": {
                "trunnion.toml": "machine = \"own.toml\"\nassume = [\"work-offset\", \"tool-length\"]\n",
                "own.toml": trunnion_machine::builtin_source("mill-3axis").expect("built in"),
            }
        });
        let found = verdict(&settings.to_string(), PROGRAM);
        assert_eq!(found["files"][0]["verdict"], "pass", "{found}");
        assert_eq!(found["files"][0]["machine"], "own");
    }

    #[test]
    fn what_cannot_be_checked_is_said() {
        let found = verdict(r#"{"name": "a.nc", "files": {"trunnion.toml": "machin = 5"}}"#, PROGRAM);
        assert_eq!(found["not_checked"][0]["place"], "trunnion.toml:1:1", "{found}");
        let found = verdict(r#"{"name": "a.nc", "machine": "mill"}"#, PROGRAM);
        let why = found["not_checked"][0]["message"].as_str().expect("a message");
        assert!(why.starts_with("unknown machine `mill`"), "{why}");
        assert!(refused("no").contains("\"message\":\"no\""));
    }
}
