//! SARIF, JUnit and GitHub annotations say what JSON says.
use super::{check, flip, folder, on_mikron};
use crate::cli::tools::{json, status, str, text, trunnion, write};
use serde_json::{Value, json as object};
use std::process::Command;
use tempfile::TempDir;

fn sarif(folder: &TempDir, more: &[&str]) -> Value {
    let mut arguments = vec![".", "--format", "sarif"];
    arguments.extend(more);
    json(&check(folder, &arguments))
}

#[test]
fn sarif_has_rules_results_and_coverage() {
    let folder = folder();
    let document = sarif(&folder, &[]);
    assert_eq!(document["version"], "2.1.0");
    let run = &document["runs"][0];
    let rules = run["tool"]["driver"]["rules"].as_array().expect("rules");
    assert_eq!(rules.len(), trunnion::check::rules().len());
    assert!(
        rules
            .iter()
            .all(|rule| rule["help"]["markdown"].as_str().is_some_and(|text| text.len() > 100))
    );
    let name = |rule: &Value| rule["name"].as_str().expect("a name").to_owned();
    assert!(
        rules
            .iter()
            .any(|rule| rule["id"] == "axis-limit" && name(rule) == "AxisLimit")
    );
    assert!(
        rules
            .iter()
            .all(|rule| name(rule).bytes().all(|b| b.is_ascii_alphanumeric()))
    );
    let plain = json(&check(&folder, &[".", "--format", "json"]));
    let found: usize = plain["files"]
        .as_array()
        .expect("files")
        .iter()
        .map(|f| f["diagnostics"].as_array().expect("list").len())
        .sum();
    let results = run["results"].as_array().expect("results");
    assert_eq!(results.len(), found);
    assert!(found > 1);
    for result in results {
        let index = result["ruleIndex"].as_u64().expect("an index") as usize;
        assert_eq!(rules[index]["id"], result["ruleId"]);
        assert!(result["partialFingerprints"]["trunnionFinding/v1"].is_string());
        let open = result["properties"]["status"] == "unknown";
        assert_eq!(result["kind"], if open { "open" } else { "fail" });
    }
    let artifacts = run["artifacts"].as_array().expect("files");
    assert_eq!(artifacts.len(), 2);
    for (artifact, file) in artifacts.iter().zip(plain["files"].as_array().expect("files")) {
        assert_eq!(artifact["properties"]["coverage"], file["coverage"]);
        assert_eq!(artifact["properties"]["assumptions"], file["assumptions"]);
        assert_eq!(artifact["properties"]["verdict"], file["verdict"]);
    }
    assert_eq!(run["properties"]["fail"], 1);
}

#[test]
fn sarif_offers_the_likely_text_as_a_fix() {
    let folder = TempDir::new().expect("a folder");
    write(&folder, "code.nc", "G21 G90 G94\nGO X1.\nM30\n");
    let document = sarif(&folder, &["--dialect", "fanuc-30i"]);
    let results = document["runs"][0]["results"].as_array().expect("results");
    let fixed = results.iter().find(|result| result["fixes"].is_array()).expect("a fix");
    assert_eq!(fixed["ruleId"], "unknown-code");
    let replacement = &fixed["fixes"][0]["artifactChanges"][0]["replacements"][0];
    assert_eq!(replacement["deletedRegion"], {
        let mut region = fixed["locations"][0]["physicalLocation"]["region"].clone();
        let places = region.as_object_mut().expect("a region");
        places.retain(|key, _| !key.starts_with("byte"));
        region
    });
    assert_eq!(replacement["insertedContent"]["text"], "G0");
}

#[test]
fn names_in_sarif_are_uris() {
    let folder = TempDir::new().expect("a folder");
    write(&folder, "a b#%.nc", "G1 X1\n");
    let document = sarif(&folder, &[]);
    assert_eq!(document["runs"][0]["artifacts"][0]["location"]["uri"], "a%20b%23%25.nc");
}

#[test]
fn junit_counts_what_it_lists() {
    let folder = folder();
    let output = check(&folder, &[".", "--format", "junit"]);
    assert_eq!(status(&output), 1);
    let text = text(&output.stdout);
    let document = roxmltree::Document::parse(&text).expect("XML");
    let suites: Vec<_> = document
        .descendants()
        .filter(|node| node.has_tag_name("testsuite"))
        .collect();
    assert_eq!(suites.len(), 2);
    for suite in suites {
        let count = |tag: &str| {
            suite
                .descendants()
                .filter(|node| node.has_tag_name(tag))
                .count()
                .to_string()
        };
        assert_eq!(suite.attribute("tests"), Some(count("testcase").as_str()));
        assert_eq!(suite.attribute("failures"), Some(count("failure").as_str()));
        assert_eq!(suite.attribute("skipped"), Some(count("skipped").as_str()));
        let names: Vec<_> = suite.descendants().filter_map(|node| node.attribute("name")).collect();
        assert!(
            names.contains(&"coverage.blocks_run") && names.contains(&"assumption"),
            "{names:?}"
        );
    }
}

#[test]
fn junit_obeys_its_schema() {
    let folder = folder();
    write(&folder, "h<o>&\"'.nc", "(<!-- ]]> \x01 -->)\nG1 X1\nG99999\n");
    let file = folder.path().join("report.xml");
    let output = check(&folder, &[".", "--format", "junit", "--statistics", "-o", str(&file)]);
    assert_eq!(status(&output), 1, "{}", text(&output.stderr));
    let schema = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/schemas/junit.xsd");
    match Command::new("xmllint")
        .args(["--noout", "--schema", schema, str(&file)])
        .output()
    {
        Ok(output) => assert!(output.status.success(), "{}", text(&output.stderr)),
        Err(_) => println!("skipped: xmllint is not installed"),
    }
}

#[test]
fn github_annotations_name_file_line_and_rule() {
    let folder = folder();
    let output = check(&folder, &[".", "--format", "github"]);
    assert_eq!(status(&output), 1);
    let text = text(&output.stdout);
    let errors: Vec<&str> = text.lines().filter(|line| line.starts_with("::error ")).collect();
    assert!(
        errors
            .iter()
            .any(|line| line.contains("bad.nc,line=7,") && line.contains("title=missing-feed::")),
        "{text}"
    );
    assert!(text.lines().any(|line| line.starts_with("FAIL ./bad.nc")), "{text}");
    assert!(text.ends_with("2 files: 1 pass, 1 fail, 0 unknown\n"), "{text}");
}

/// A program that is not decided is seen as such wherever somebody looks.
#[test]
fn unknown_is_visible_in_every_format() {
    let folder = TempDir::new().expect("a folder");
    write(&folder, "open.nc", "%\nO1\nG21 G90 G94\nM98 P4711\nM30\n%\n");
    let base = [
        "open.nc",
        "--dialect",
        "fanuc-30i",
        "--allow",
        "missing-subprogram",
        "--format",
    ];
    for (format, sign) in [
        ("pretty", "unknown["),
        ("short", "unknown["),
        ("json", "\"status\": \"unknown\""),
        ("sarif", "\"kind\":\"open\""),
        ("junit", "<skipped message=\"unknown: "),
        ("github", " (unknown)::"),
    ] {
        let mut arguments = base.to_vec();
        arguments.push(format);
        let output = check(&folder, &arguments);
        let text = text(&output.stdout);
        assert!(text.contains(sign), "{format}: {text}");
        assert_eq!(status(&output), 0, "{format}");
        arguments.push("--strict");
        assert_eq!(status(&check(&folder, &arguments)), 1, "{format}");
    }
}

#[test]
fn an_output_file_holds_what_standard_output_would() {
    let folder = folder();
    for format in ["short", "json", "sarif", "junit", "github"] {
        let plain = check(&folder, &[".", "--format", format, "--statistics"]);
        let filed = check(&folder, &[".", "--format", format, "--statistics", "-o", "out.txt"]);
        assert_eq!(status(&plain), status(&filed));
        assert!(filed.stdout.is_empty());
        let said = text(&filed.stderr);
        assert!(
            said.contains("FAIL ./bad.nc") && said.contains("2 files: 1 pass, 1 fail, 0 unknown"),
            "{format}: {said}"
        );
        let written = std::fs::read_to_string(folder.path().join("out.txt")).expect("written");
        let plain = text(&plain.stdout);
        // annotations stand between the lines of their files
        let all = written.lines().all(|line| plain.lines().any(|other| other == line));
        assert!(
            all && (format == "github" || plain.starts_with(&written)),
            "{format}: {written}\n{plain}"
        );
        assert!(!written.is_empty());
    }
    let refused = check(&folder, &[".", "-o", "bad.nc"]);
    assert_eq!(status(&refused), 2, "{}", text(&refused.stderr));
}

/// The log of a CI job shows what does not pass, and the sum.
#[test]
fn of_many_files_the_log_names_those_that_do_not_pass() {
    let folder = folder();
    for number in 0..300 {
        write(&folder, &format!("part{number}.nc"), super::GOOD);
    }
    for (format, file) in [("short", None), ("sarif", Some("out.sarif")), ("github", None)] {
        let mut arguments = vec![".", "--format", format];
        arguments.extend(file.iter().flat_map(|file| ["-o", file]));
        let output = check(&folder, &arguments);
        let said = text(&output.stdout) + &text(&output.stderr);
        let lines = |word: &str| said.lines().filter(|line| line.starts_with(word)).count();
        assert_eq!((lines("PASS"), lines("FAIL")), (0, 1), "{format}: {said}");
        assert!(
            said.contains("302 files: 301 pass, 1 fail, 0 unknown (-v prints"),
            "{format}: {said}"
        );
        arguments.push("-v");
        let said = text(&check(&folder, &arguments).stdout) + &text(&check(&folder, &arguments).stderr);
        assert_eq!(
            said.lines().filter(|line| line.starts_with("PASS")).count(),
            301,
            "{format}"
        );
    }
    let quiet = check(&folder, &[".", "-q"]);
    assert!(text(&quiet.stderr).is_empty(), "{}", text(&quiet.stderr));
}

#[test]
fn statistics_count_each_rule() {
    let folder = folder();
    let output = check(&folder, &[".", "--format", "json", "--statistics"]);
    let document = json(&output);
    let rows = document["statistics"].as_array().expect("rows");
    let sum: u64 = rows.iter().map(|row| row["errors"].as_u64().expect("a number")).sum();
    assert_eq!(document["summary"]["errors"].as_u64(), Some(sum));
    for format in ["short", "pretty", "github", "sarif", "junit"] {
        let said = text(&check(&folder, &[".", "--format", format, "--statistics"]).stdout);
        let without = text(&check(&folder, &[".", "--format", format]).stdout);
        let count = |text: &str| text.matches("missing-feed").count();
        assert!(count(&said) > count(&without), "{format}: {said}");
    }
    let junit = text(&check(&folder, &[".", "--format", "junit", "--statistics"]).stdout);
    assert!(
        junit.contains("<property name=\"statistics.missing-feed\" value=\"error 1, warning 0, info 0, unknown 0\"/>"),
        "{junit}"
    );
}

#[test]
fn a_file_that_cannot_be_read_is_in_every_document() {
    let folder = folder();
    for (format, sign) in [
        ("sarif", "toolExecutionNotifications\":[{"),
        ("junit", "<error type=\"not-checked\""),
        ("github", "::error title=not checked::"),
    ] {
        let output = check(&folder, &["missing.nc", "good.nc", "--format", format]);
        assert_eq!(status(&output), 2);
        assert!(
            text(&output.stdout).contains(sign),
            "{format}: {}",
            text(&output.stdout)
        );
    }
}

/// Whoever reads no terminal learns from the document that nothing was checked, and why.
#[test]
fn what_stops_the_whole_job_is_in_every_document() {
    let folder = folder();
    std::fs::create_dir(folder.path().join("empty")).expect("made");
    write(&folder, "other.json", "{}");
    let jobs: [(&[&str], &str); 6] = [
        (&[".", "--baseline", "nob.json"], "nob.json: does not exist"),
        (&[".", "--baseline", "other.json"], "this is not a baseline"),
        (&["empty"], "empty: no program in this directory"),
        (&[".", "--cache", "good.nc/x"], "good.nc/x: cannot make the folder"),
        (&[".", "--machine", "mill"], "unknown machine `mill`"),
        (&[".", "--config", "no.toml"], "no.toml: there is no such file"),
    ];
    for (job, reason) in jobs {
        for format in ["sarif", "junit", "github", "json"] {
            let mut arguments = job.to_vec();
            arguments.extend(["--format", format, "-o", "out.txt"]);
            let output = check(&folder, &arguments);
            assert_eq!(status(&output), 2, "{format} {job:?}");
            assert!(text(&output.stderr).contains(reason), "{}", text(&output.stderr));
            let document = std::fs::read_to_string(folder.path().join("out.txt")).expect("written");
            match format {
                "github" => {
                    let wanted = format!("::error title=not checked::{reason}");
                    assert!(
                        document.contains(&wanted) || reason.starts_with("this is"),
                        "{document}"
                    );
                }
                "junit" => assert!(document.contains("<error type=\"not-checked\""), "{document}"),
                "json" => {
                    let document: Value = serde_json::from_str(&document).expect("JSON");
                    assert_eq!(document["files"], object!([]));
                    assert_ne!(document["not_checked"], object!([]));
                }
                _ => {
                    let document: Value = serde_json::from_str(&document).expect("JSON");
                    let run = &document["runs"][0];
                    assert_eq!(run["results"], object!([]));
                    assert_eq!(run["invocations"][0]["executionSuccessful"], object!(false));
                    let said = &run["invocations"][0]["toolExecutionNotifications"][0]["message"]["text"];
                    assert!(said.as_str().expect("text").contains(reason), "{said}");
                }
            }
            std::fs::remove_file(folder.path().join("out.txt")).expect("removed");
        }
    }
    // an output that is an input stays
    let before = std::fs::read(folder.path().join("good.nc")).expect("read");
    let output = check(&folder, &["empty", "good.nc", "--format", "sarif", "-o", "good.nc"]);
    assert_eq!(status(&output), 2);
    assert_eq!(std::fs::read(folder.path().join("good.nc")).expect("read"), before);
}

#[test]
fn the_cache_says_the_same_and_sees_every_change() {
    let folder = folder();
    let file = flip(&folder);
    let cache = folder.path().join("cache");
    let mut arguments = vec!["check"];
    arguments.extend(on_mikron(&file));
    arguments.extend(["--format", "json", "--cache", str(&cache)]);
    let first = trunnion(&arguments);
    let entries = || std::fs::read_dir(&cache).expect("a folder").count();
    assert_eq!(entries(), 1);
    // an entry that is taken shows: its digest is right, its text another one
    let entry = std::fs::read_dir(&cache)
        .expect("a folder")
        .flatten()
        .next()
        .expect("one")
        .path();
    let kept = std::fs::read(&entry).expect("read");
    assert_eq!(first.stdout, trunnion(&arguments).stdout);
    std::fs::write(&entry, &kept[..kept.len() - 2]).expect("written");
    assert_eq!(
        first.stdout,
        trunnion(&arguments).stdout,
        "half an entry does not count"
    );
    assert_eq!(std::fs::read(&entry).expect("read"), kept);
    std::fs::write(&file, super::FLIP.replace("C52.595", "C4.9")).expect("written");
    assert_ne!(first.stdout, trunnion(&arguments).stdout);
    write(&folder, "trunnion.toml", "[rules]\npole-flip = \"allow\"\n");
    let count = entries();
    trunnion(&arguments);
    assert_eq!(entries(), count + 1, "settings are part of the key");
}
