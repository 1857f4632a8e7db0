//! Sinumerik: programs from outside the repository are followed, and where a run stops or a value stays open is a reviewed list.
#![expect(clippy::print_stdout, reason = "a skipped test says so")]
use crate::cli::tools::{str, trunnion};
use serde_json::Value;
use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::{Path, PathBuf};

fn data() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data")
}

/// All Sinumerik programs from outside.
fn programs() -> Option<Vec<PathBuf>> {
    fn walk(folder: &Path, found: &mut Vec<PathBuf>) {
        for entry in std::fs::read_dir(folder).expect("a folder").flatten() {
            let path = entry.path();
            let ending = path.extension().map(|ending| ending.to_string_lossy().to_lowercase());
            if path.is_dir() {
                // each line of these shows how a highlighter colours a word: they are no programs
                if !path.ends_with("s840d") {
                    walk(&path, found);
                }
            } else if matches!(ending.as_deref(), Some("mpf" | "spf")) {
                found.push(path);
            }
        }
    }
    let mut found = Vec::new();
    for folder in [
        "wild",
        "sinumerik",
        "controls/sinumerik",
        "four-controls/siemens",
        "five-axis-pairs",
        "guide-vane-2006",
    ] {
        let path = data().join(folder);
        if !path.is_dir() {
            println!("skipped: {} is not there", path.display());
            return None;
        }
        walk(&path, &mut found);
    }
    found.sort();
    Some(found)
}

/// Whether coordinates are computed: a program with `X=...`, or one that moves nothing of its own.
fn is_macro(source: &str) -> bool {
    let lines = source
        .lines()
        .map(|line| line.split(';').next().unwrap_or_default().to_ascii_uppercase());
    let mut literal = false;
    for line in lines {
        let bytes = line.as_bytes();
        for (at, byte) in bytes.iter().enumerate() {
            let begins = at == 0 || !(bytes[at - 1].is_ascii_alphanumeric() || matches!(bytes[at - 1], b'_' | b'$'));
            if !begins || !matches!(byte, b'X' | b'Y' | b'Z') {
                continue;
            }
            match bytes.get(at + 1) {
                Some(b'=') => return true,
                Some(b'0'..=b'9' | b'.' | b'+' | b'-') => literal = true,
                _ => {}
            }
        }
    }
    !literal
}

/// A message without the files that were looked at and without remarks in brackets.
fn cause(message: &str) -> String {
    let first = [" in /", " in ..", " ("]
        .iter()
        .fold(message, |text, end| text.split(end).next().unwrap_or(text));
    first.trim_start_matches("not modelled: ").to_owned()
}

/// Errors, the control, known ends of the tip in programs with literal coordinates, and by name everything that stops a run or leaves a value open. The
/// list next to this file was read: each line is a value of the machine, a program that is not there, or something no source states.
#[test]
fn programs_are_followed() {
    let Some(paths) = programs() else { return };
    assert!(paths.len() >= 60, "{}", paths.len());
    let mut arguments = vec!["check", "--format", "json", "-q", "--assume", "work-offset,tool-length"];
    arguments.extend(paths.iter().map(|path| str(path)));
    let document: Value = serde_json::from_slice(&trunnion(&arguments).stdout).expect("JSON");
    let root = data().canonicalize().expect("a folder");
    let (mut blocks, mut errors, mut motions, mut known) = (0, 0, 0, 0);
    let (mut causes, mut table) = (BTreeSet::new(), String::new());
    let faulty = std::fs::read_to_string(root.join("wild/faulty.tsv")).expect("a table");
    let faulty: BTreeSet<&str> = faulty.lines().filter_map(|line| line.split('\t').next()).collect();
    for file in document["files"].as_array().expect("files") {
        let path = Path::new(file["path"].as_str().expect("a path"))
            .canonicalize()
            .expect("there");
        let short = path.strip_prefix(&root).expect("below").display().to_string();
        assert_eq!(file["dialect"], "sinumerik-840d", "{short}");
        let number = |name: &str| file["coverage"][name].as_u64().expect("a number");
        let findings = file["diagnostics"].as_array().expect("findings");
        let source = String::from_utf8_lossy(&std::fs::read(&path).expect("readable")).into_owned();
        let wild = short.strip_prefix("wild/").is_some_and(|name| !faulty.contains(name));
        let counts = wild && !is_macro(&source);
        let wrong = findings.iter().filter(|found| found["severity"] == "error").count() as u64;
        writeln!(
            table,
            "{} {}/{} {wrong} {short}",
            if counts { "counts" } else { "apart" },
            number("motions_known"),
            number("motions")
        )
        .expect("memory");
        if wild {
            (errors, blocks) = (errors + wrong, blocks + number("blocks"));
        }
        if counts {
            (motions, known) = (motions + number("motions"), known + number("motions_known"));
        }
        let open = ["not-modelled", "not-decided", "missing-subprogram"];
        let of = findings
            .iter()
            .filter(|found| open.iter().any(|rule| found["rule"] == *rule));
        causes.extend(of.map(|found| cause(found["message"].as_str().expect("a message"))));
    }
    println!("{table}{errors} errors in {blocks} blocks; {known} of {motions} motions with literal coordinates known");
    assert!(errors * 200 <= blocks, "{errors} errors in {blocks} blocks");
    assert!(known * 10 >= motions * 9, "{known} of {motions}\n{table}");
    let reviewed = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/all/sinumerik/unknown.txt");
    let reviewed = std::fs::read_to_string(reviewed).expect("the list");
    let reviewed: BTreeSet<&str> = reviewed.lines().filter(|line| !line.starts_with("# ")).collect();
    let found: BTreeSet<&str> = causes.iter().map(String::as_str).collect();
    let new: Vec<_> = found.difference(&reviewed).collect();
    let gone: Vec<_> = reviewed.difference(&found).collect();
    assert!(
        new.is_empty() && gone.is_empty(),
        "not reviewed: {new:#?}\nnot found any more: {gone:#?}"
    );
}
