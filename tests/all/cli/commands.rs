//! The command line as docs/commands.md says: formats, exit statuses, errors with their place.

use super::tools::{FLIP, json, status, str, text, trunnion, write};
use serde_json::Value;
use std::{
    fs,
    io::Write,
    process::{Command, Stdio},
};
use tempfile::TempDir;

/// The report of the published rows in JSON.
fn flip_as_json() -> std::process::Output {
    let folder = TempDir::new().expect("works");
    let file = write(&folder, "flip.nc", FLIP);
    trunnion(&[
        "check",
        str(&file),
        "--machine",
        "mikron-ucp710",
        "--dialect",
        "fanuc-30i",
        "--format",
        "json",
    ])
}

#[test]
fn check_json_is_the_document_of_the_interface() {
    let output = flip_as_json();
    assert_eq!(status(&output), 1, "{}", text(&output.stderr));
    let document = json(&output);
    assert_eq!(document["schema"], "trunnion-check/1");
    assert_eq!(document["machine"], "mikron-ucp710");
    let file = &document["files"][0];
    assert_eq!(
        (file["dialect"].as_str(), file["verdict"].as_str()),
        (Some("fanuc-30i"), Some("fail"))
    );
    let flips: Vec<&Value> = file["diagnostics"]
        .as_array()
        .expect("works")
        .iter()
        .filter(|d| d["rule"] == "pole-flip")
        .collect();
    assert_eq!(flips.len(), 2);
    let first = flips[0];
    assert_eq!(
        (first["line"].as_u64(), first["severity"].as_str()),
        (Some(8), Some("error"))
    );
    assert!((first["values"]["rotary_change_deg"].as_f64().expect("works") - 47.773).abs() < 1e-6);
    assert_eq!(first["docs"], "rules/pole-flip");
    assert_eq!(first["status"], "fail");
    let (start, end) = (
        first["byte_start"].as_u64().expect("works") as usize,
        first["byte_end"].as_u64().expect("works") as usize,
    );
    assert_eq!(&FLIP[start..end], "C52.595");
    let summary = &document["summary"];
    let count = |severity: &str| {
        file["diagnostics"]
            .as_array()
            .expect("works")
            .iter()
            .filter(|d| d["severity"] == severity && d["status"] == "fail")
            .count() as u64
    };
    assert_eq!(summary["errors"].as_u64(), Some(count("error")));
    assert_eq!(summary["warnings"].as_u64(), Some(count("warning")));
    assert_eq!(summary["files"], 1);
}

/// What follows from a flip is in the finding of the flip: with its own level in `also`, as a note in words, counted once.
#[test]
fn json_lists_what_a_flip_leads() {
    let output = flip_as_json();
    let document = json(&output);
    let flip = &document["files"][0]["diagnostics"][2];
    let led: Vec<[&str; 3]> = flip["also"]
        .as_array()
        .expect("a list")
        .iter()
        .map(|led| ["rule", "severity", "status"].map(|key| led[key].as_str().expect("a text")))
        .collect();
    insta::assert_debug_snapshot!(
        "flip_leads",
        (
            &flip["rule"],
            &flip["severity"],
            &flip["line"],
            led,
            &flip["notes"],
            &document["summary"]
        )
    );
}

/// Errors come first under `--limit`, and the last line counts all findings by the words before them.
#[test]
fn a_limit_keeps_the_worst_and_the_counts_are_of_what_is_printed() {
    let folder = TempDir::new().expect("works");
    let program = "G21 G17 G90\nG0 X0 Y0 Z5 S10 S20\nM3 S100\nG1 X#500 F100\nG1 Y5 G77.7\nM30\n";
    let file = write(&folder, "worst.nc", program);
    let run = |limit: &str| {
        let output = trunnion(&[
            "check",
            str(&file),
            "--dialect",
            "fanuc-30i",
            "--format",
            "short",
            "--limit",
            limit,
        ]);
        (text(&output.stdout), text(&output.stderr))
    };
    let (all, last) = run("0");
    let words = ["error", "warning", "info", "unknown"];
    let count = |word: &str| all.lines().filter(|line| line.contains(&format!(": {word}["))).count();
    assert!(words.iter().all(|word| count(word) > 0), "{all}");
    for word in words {
        let n = count(word);
        let plural = if n == 1 || word == "unknown" { "" } else { "s" };
        assert!(last.contains(&format!("{n} {word}{plural}")), "{word}: {last}\n{all}");
    }
    let (one, same) = run("1");
    assert!(
        one.lines().next().is_some_and(|line| line.contains(": error[")),
        "{one}"
    );
    assert_eq!(one.lines().count(), 2, "{one}");
    assert_eq!(last, same, "the last line counts all of them");
}

#[test]
fn pretty_shows_the_excerpt_and_short_one_line() {
    let folder = TempDir::new().expect("works");
    write(&folder, "flip.nc", FLIP);
    let run = |format: &str| {
        let output = Command::new(env!("CARGO_BIN_EXE_trunnion"))
            .current_dir(folder.path())
            .args([
                "check",
                "flip.nc",
                "--machine",
                "mikron-ucp710",
                "--dialect",
                "fanuc-30i",
                "--format",
                format,
            ])
            .output()
            .expect("works");
        text(&output.stdout)
    };
    insta::assert_snapshot!("check_pretty", run("pretty"));
    insta::assert_snapshot!("check_short", run("short"));
}

#[test]
fn a_folder_is_walked_and_an_empty_one_is_an_error() {
    let folder = TempDir::new().expect("works");
    fs::create_dir(folder.path().join("sub")).expect("works");
    write(&folder, "a.ngc", "G21 G1 X1 F100\nM2\n");
    write(&folder, "sub/b.NGC", "G21 G1 X1\nM2\n");
    write(&folder, "notes.md", "G999");
    let output = trunnion(&[
        "check",
        str(folder.path()),
        "--machine",
        "mill-3axis",
        "--format",
        "json",
    ]);
    let document = json(&output);
    let paths: Vec<_> = document["files"]
        .as_array()
        .expect("works")
        .iter()
        .map(|f| f["path"].as_str().expect("works"))
        .collect();
    assert_eq!(paths.len(), 2, "{paths:?}");
    assert!(paths[0].ends_with("a.ngc") && paths[1].ends_with("b.NGC"), "{paths:?}");
    assert_eq!(document["summary"]["files"], 2);
    let empty = TempDir::new().expect("works");
    let output = trunnion(&["check", str(empty.path())]);
    assert_eq!(status(&output), 2);
    assert!(text(&output.stderr).contains("no program"), "{}", text(&output.stderr));
}

#[test]
fn deny_strict_and_allow_decide_the_exit_status() {
    let folder = TempDir::new().expect("works");
    let good = write(
        &folder,
        "good.ngc",
        "G21 G90 G17 G94 G40\nS1000 M3\nG0 X0 Y0 Z5\nG1 X1 F100\nM5\nM2\n",
    );
    let assume = "work-offset,tool-length";
    let base = ["check", str(&good), "--machine", "mill-3axis", "--assume", assume];
    let with = |more: &[&str]| status(&trunnion(&[&base[..], more].concat()));
    assert_eq!(with(&[]), 0);
    assert_eq!(with(&["--strict"]), 0, "nothing is unknown in a plain 3-axis program");
    assert_eq!(
        status(&trunnion(&["check", str(&good)])),
        0,
        "without a machine the motions are judged"
    );
    assert_eq!(
        status(&trunnion(&["check", str(&good), "--strict"])),
        0,
        "and nothing of them is unknown"
    );
    assert_eq!(
        status(&trunnion(&["check", str(&good), "--strict", "--scope", "machine"])),
        1,
        "without a machine its axes are"
    );
    let bad = write(&folder, "bad.ngc", "G21 G90\nG1 X1 Y1 Z1\nM2\n");
    let base = ["check", str(&bad), "--machine", "mill-3axis"];
    assert_eq!(status(&trunnion(&base)), 1, "no feed");
    assert_eq!(
        status(&trunnion(&[&base[..], &["--allow", "missing-feed"]].concat())),
        0
    );
    let output = trunnion(&[&base[..], &["--allow", "no-such-rule"]].concat());
    assert_eq!(status(&output), 2);
    assert!(text(&output.stderr).contains("no-such-rule"));
}

#[test]
fn what_cannot_be_done_is_status_2_with_its_place() {
    let folder = TempDir::new().expect("works");
    let file = write(&folder, "a.ngc", "G21\nM2\n");
    let missing = folder.path().join("missing.nc");
    let output = trunnion(&["check", str(&missing)]);
    assert_eq!(status(&output), 2);
    assert!(text(&output.stderr).contains("missing.nc"));
    let output = trunnion(&["check", str(&file), "--machine", "nope"]);
    assert_eq!(status(&output), 2);
    assert!(
        text(&output.stderr).contains("mikron-ucp710"),
        "says what there is: {}",
        text(&output.stderr)
    );
    let machine = write(
        &folder,
        "broken.toml",
        "schema = \"ncmachine/1\"\nname = \"x\"\nbogus = 1\n",
    );
    let output = trunnion(&["check", str(&file), "--machine", str(&machine)]);
    assert_eq!(status(&output), 2);
    assert!(
        text(&output.stderr).contains("broken.toml:3:1"),
        "{}",
        text(&output.stderr)
    );
    write(
        &folder,
        "trunnion.toml",
        "machine = \"mill-3axis\"\n[rules]\nno-such = \"error\"\n",
    );
    let output = trunnion(&["check", str(&file)]);
    assert_eq!(status(&output), 2);
    assert!(
        text(&output.stderr).contains("trunnion.toml:3:1"),
        "{}",
        text(&output.stderr)
    );
    assert_eq!(status(&trunnion(&["check"])), 2, "bad arguments");
    assert_eq!(status(&trunnion(&["frobnicate"])), 2);
}

#[test]
fn settings_are_found_upward_and_the_command_line_wins() {
    let folder = TempDir::new().expect("works");
    fs::create_dir(folder.path().join("deep")).expect("works");
    write(
        &folder,
        "trunnion.toml",
        "machine = \"mill-3axis\"\n[rules]\nmissing-feed = \"info\"\n",
    );
    let file = write(&folder, "deep/a.ngc", "G21 G90\nG1 X1 Y1 Z1\nM2\n");
    let output = trunnion(&["check", str(&file), "--format", "json"]);
    assert_eq!(status(&output), 0, "{}", text(&output.stdout));
    assert_eq!(json(&output)["machine"], "mill-3axis");
    let output = trunnion(&["check", str(&file), "--format", "json", "--machine", "mikron-ucp710"]);
    assert_eq!(json(&output)["machine"], "mikron-ucp710");
}

#[test]
fn standard_input_is_a_program_too() {
    let mut child = Command::new(env!("CARGO_BIN_EXE_trunnion"))
        .args(["check", "-", "--machine", "mill-3axis", "--dialect", "linuxcnc"])
        .args(["--assume", "work-offset,tool-length"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .expect("works");
    child
        .stdin
        .take()
        .expect("works")
        .write_all(b"G21 G90 G0 X0\nG1 X1\nM2\n")
        .expect("works");
    let output = child.wait_with_output().expect("works");
    assert_eq!(status(&output), 1);
    assert!(
        text(&output.stdout).starts_with("<stdin>:2:"),
        "{}",
        text(&output.stdout)
    );
}

#[test]
fn explain_rules_and_machines_speak() {
    let output = trunnion(&["explain", "pole-flip"]);
    assert_eq!(status(&output), 0);
    assert!(text(&output.stdout).contains("# Why"), "{}", text(&output.stdout));
    assert_eq!(status(&trunnion(&["explain", "no-such"])), 2);
    let list = text(&trunnion(&["rules"]).stdout);
    for name in ["pole-flip", "path-deviation", "smooth-pole", "unwind-rotary"] {
        assert!(list.contains(name), "{name}");
    }
    for name in text(&trunnion(&["machine", "list"]).stdout)
        .lines()
        .map(|l| l.split(' ').next().expect("works"))
    {
        let show = trunnion(&["machine", "show", name]);
        insta::assert_snapshot!(format!("machine_show_{name}"), text(&show.stdout));
        let check = trunnion(&["machine", "check", name, "--poses", "2000"]);
        assert_eq!(status(&check), 0, "{name}: {}", text(&check.stdout));
    }
}

#[test]
fn parse_tokens_are_lossless() {
    let folder = TempDir::new().expect("works");
    let file = write(&folder, "flip.nc", FLIP);
    let output = trunnion(&["parse", str(&file), "--tokens", "--format", "json"]);
    let document = json(&output);
    let all: String = document["tokens"]
        .as_array()
        .expect("works")
        .iter()
        .map(|t| t["text"].as_str().expect("works"))
        .collect();
    assert_eq!(all, FLIP);
    let tree = text(&trunnion(&["parse", str(&file)]).stdout);
    assert!(tree.contains("word C 52.595"), "{tree}");
}
