//! The Python module gives what the command line gives.
use super::{flip, folder};
use crate::cli::tools::{json, str, text, trunnion};
use std::{path::Path, process::Command};
use tempfile::TempDir;

/// Runs Python code with the module and the built program; `None` where Python or NumPy is missing.
fn python(folder: &TempDir, code: &str) -> Option<String> {
    let module = Path::new(env!("CARGO_MANIFEST_DIR")).join("python/src");
    let built = Path::new(env!("CARGO_BIN_EXE_trunnion")).parent().expect("a folder");
    let old = std::env::var("PATH").unwrap_or_default();
    let run = |code: &str| {
        let mut command = Command::new("python3");
        command
            .args(["-B", "-c", code])
            .current_dir(folder.path())
            .env("PYTHONPATH", &module);
        command.env("PATH", format!("{}:{old}", built.display())).output()
    };
    if !run("import numpy").is_ok_and(|output| output.status.success()) {
        println!("skipped: Python with NumPy is not installed");
        return None;
    }
    let output = run(code).expect("runs");
    assert!(output.status.success(), "{}", text(&output.stderr));
    Some(text(&output.stdout))
}

#[test]
fn check_and_trace_are_those_of_the_command_line() {
    let folder = TempDir::new().expect("a folder");
    let file = flip(&folder);
    let code = "import trunnion, json\n\
        report = trunnion.check('flip.nc', machine='mikron-ucp710', dialect='fanuc-30i')\n\
        rows = trunnion.trace('flip.nc', machine='mikron-ucp710', dialect='fanuc-30i')\n\
        print(json.dumps([report['files'][0]['verdict'], report['summary'], len(rows), rows['joint_c'].tolist()[-5:], rows['motion'][-1], str(rows['line'].dtype)]))";
    let Some(said) = python(&folder, code) else { return };
    let said: serde_json::Value = serde_json::from_str(&said).expect("JSON");
    let base = [
        str(&file),
        "--machine",
        "mikron-ucp710",
        "--dialect",
        "fanuc-30i",
        "--format",
        "json",
    ];
    let report = json(&trunnion(&[&["check"][..], &base[..]].concat()));
    let trace = json(&trunnion(&[&["trace"][..], &base[..]].concat()));
    assert_eq!(said[0], report["files"][0]["verdict"]);
    assert_eq!(said[1], report["summary"]);
    let rows = trace["rows"].as_array().expect("rows");
    assert_eq!(said[2], rows.len());
    let last: Vec<_> = rows[rows.len() - 5..]
        .iter()
        .map(|row| row["joint_c"].clone())
        .collect();
    assert_eq!(said[3], serde_json::Value::Array(last));
    assert_eq!((&said[4], &said[5]), (&"linear".into(), &"int64".into()));
}

/// A program with a rapid whose start is unknown: its row has no numbers, and the example still prints one.
#[test]
fn the_example_of_the_page_prints_a_verdict_and_a_number() {
    let page = include_str!("../../../docs/install.md");
    let (_, example) = page.split_once("```python\n").expect("an example");
    let (example, _) = example.split_once("```").expect("it ends");
    let folder = TempDir::new().expect("a folder");
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let program = root.join("samples/programs/guide-vane/strategy-2.mpf");
    std::fs::copy(program, folder.path().join("part.mpf")).expect("copied");
    let Some(said) = python(&folder, example) else { return };
    let (verdict, number) = said.trim().split_once('\n').expect("two lines");
    let number: f64 = number.trim().parse().expect("a number");
    assert!(verdict == "fail" && number.is_finite(), "{said}");
}

#[test]
fn a_failure_is_an_exception_with_the_message() {
    let folder = folder();
    let code = "import trunnion\ntry:\n    trunnion.check('missing.nc')\nexcept trunnion.TrunnionError as error:\n    print(error)";
    let Some(said) = python(&folder, code) else { return };
    assert!(said.contains("missing.nc"), "{said}");
}
