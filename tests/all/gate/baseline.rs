//! The baseline accepts what is known, and nothing else.
use super::{BAD, check, folder};
use crate::cli::tools::{json, status, text, write};

const JSON: [&str; 5] = [".", "--format", "json", "--baseline", "known.json"];

#[test]
fn what_is_known_passes_and_what_is_new_fails() {
    let folder = folder();
    assert_eq!(status(&check(&folder, &["."])), 1);
    let written = check(&folder, &[".", "--write-baseline", "known.json"]);
    assert_eq!(status(&written), 0, "{}", text(&written.stderr));
    let output = check(&folder, &JSON);
    assert_eq!(status(&output), 0, "{}", text(&output.stdout));
    let document = json(&output);
    assert_eq!(document["summary"]["errors"], 0);
    assert!(document["summary"]["accepted"].as_u64().is_some_and(|count| count >= 2));
    assert_eq!(document["files"][0]["verdict"], "pass");
    let line = text(&check(&folder, &[".", "--baseline", "known.json"]).stderr);
    assert!(line.contains("accepted by the baseline"), "{line}");

    // one more mistake of the same kind, in the same words
    write(&folder, "bad.nc", &BAD.replace("N60 ", "N55 G1 X10.\nN60 "));
    let output = check(&folder, &JSON);
    assert_eq!(status(&output), 1, "{}", text(&output.stdout));
}

#[test]
fn fingerprints_survive_new_numbers_and_inserted_lines() {
    let folder = folder();
    check(&folder, &[".", "--write-baseline", "known.json"]);
    let mut number = 1000;
    let renumbered: String = BAD
        .lines()
        .map(
            |line| match line.strip_prefix('N').and_then(|rest| rest.split_once(' ')) {
                Some((_, rest)) => {
                    number += 5;
                    format!("N{number} {rest}\n(a new line)\n")
                }
                None => format!("{line}\n"),
            },
        )
        .collect();
    write(&folder, "bad.nc", &renumbered);
    let output = check(&folder, &JSON);
    assert_eq!(status(&output), 0, "{}", text(&output.stdout));
    assert_eq!(json(&output)["summary"]["errors"], 0);
}

#[test]
fn a_finding_that_got_worse_is_new() {
    let folder = folder();
    let far = |x: &str| {
        format!(
            "%\nO3\nG17 G21 G90 G94\nT1 M6\nG54 G0 X0. Y0.\nG43 H1 Z-10.\nS3000 M3\n#1={x}\nG1 X#1 F200.\nM5\nM30\n%\n"
        )
    };
    write(&folder, "bad.nc", &far("2000."));
    check(&folder, &[".", "--write-baseline", "known.json"]);
    assert_eq!(status(&check(&folder, &JSON)), 0);
    write(&folder, "bad.nc", &far("9000."));
    assert_eq!(status(&check(&folder, &JSON)), 1);
}

#[test]
fn sarif_keeps_what_is_accepted_as_suppressed() {
    let folder = folder();
    check(&folder, &[".", "--write-baseline", "known.json"]);
    let document = json(&check(&folder, &[".", "--format", "sarif", "--baseline", "known.json"]));
    let results = document["runs"][0]["results"].as_array().expect("results");
    assert!(!results.is_empty());
    assert!(
        results
            .iter()
            .all(|result| result["suppressions"][0]["kind"] == "external")
    );
}

#[test]
fn a_baseline_that_is_none_is_refused_with_its_place() {
    let folder = folder();
    let missing = check(&folder, &JSON);
    assert_eq!(status(&missing), 2);
    assert!(
        text(&missing.stderr).contains("--write-baseline"),
        "{}",
        text(&missing.stderr)
    );
    write(&folder, "known.json", "{\n  \"schema\": 5\n}");
    let broken = check(&folder, &JSON);
    assert_eq!(status(&broken), 2);
    assert!(
        text(&broken.stderr).contains("known.json:2:"),
        "{}",
        text(&broken.stderr)
    );
}
