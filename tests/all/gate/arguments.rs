//! Arguments that `check` does not understand: the document for CI is written and says so.
use super::{check, folder};
use crate::cli::tools::{json, status, text, trunnion_in};
use serde_json::Value;

/// The document says what is wrong; where it goes is read all the same.
#[test]
fn wrong_arguments_are_in_every_document() {
    let folder = folder();
    let wrong: [(&[&str], &str); 5] = [
        (&["good.nc", "--frmat", "x"], "unexpected argument '--frmat' found"),
        (
            &["good.nc", "--limit", "many"],
            "invalid value 'many' for '--limit <LIMIT>'",
        ),
        (
            &["good.nc", "--deny", "sometimes"],
            "invalid value 'sometimes' for '--deny <DENY>'",
        ),
        (
            &["good.nc", "--machine"],
            "a value is required for '--machine <NAME|FILE>'",
        ),
        (&[], "required arguments were not provided: <PATHS>..."),
    ];
    for (wrong, reason) in wrong {
        for format in ["sarif", "junit", "github", "json"] {
            let mut arguments = vec!["--format", format, "--output=out.txt"];
            arguments.extend(wrong);
            let output = check(&folder, &arguments);
            assert_eq!(status(&output), 2, "{format} {wrong:?}");
            assert!(
                text(&output.stderr).contains("try '--help'"),
                "{}",
                text(&output.stderr)
            );
            let document = std::fs::read_to_string(folder.path().join("out.txt")).expect("written");
            let said = match format {
                "github" => document.trim_start_matches("::error title=not checked::").to_owned(),
                "junit" => document
                    .replace("&apos;", "'")
                    .replace("&lt;", "<")
                    .replace("&gt;", ">"),
                "json" => {
                    let document: Value = serde_json::from_str(&document).expect("JSON");
                    document["not_checked"][0]["message"].as_str().expect("text").to_owned()
                }
                _ => {
                    let document: Value = serde_json::from_str(&document).expect("JSON");
                    let said = &document["runs"][0]["invocations"][0]["toolExecutionNotifications"][0];
                    said["message"]["text"].as_str().expect("text").to_owned()
                }
            };
            assert!(said.contains(reason), "{format}: {said}");
            std::fs::remove_file(folder.path().join("out.txt")).expect("removed");
        }
    }
    // to standard output without -o; no document for people, for help, and for other commands
    let output = check(&folder, &["--bogus", "--format", "json"]);
    assert_eq!(json(&output)["not_checked"].as_array().map(Vec::len), Some(1));
    for other in [
        &["check", "--bogus"][..],
        &["check", "--bogus", "--format", "short"],
        &["stats", "check", "--bogus", "--format", "json"],
        &["--machine", "check", "rules", "--bogus", "--format", "json"],
    ] {
        let output = trunnion_in(folder.path(), other);
        assert_eq!((status(&output), text(&output.stdout).as_str()), (2, ""), "{other:?}");
    }
    // a program is never replaced
    let before = std::fs::read(folder.path().join("good.nc")).expect("read");
    for arguments in [&["good.nc", "-o", "good.nc"][..], &[".", "-ogood.nc"]] {
        let output = check(&folder, &[arguments, &["--bogus", "--format", "sarif"]].concat());
        assert_eq!(status(&output), 2, "{arguments:?}");
        assert!(
            text(&output.stderr).contains("also an input"),
            "{}",
            text(&output.stderr)
        );
        assert_eq!(std::fs::read(folder.path().join("good.nc")).expect("read"), before);
    }
}
