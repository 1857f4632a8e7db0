//! `servo` and `plot --kind servo`: the corner of paper 002, found in a program.
use super::tools::{json, status, str, text, trunnion, write};
use serde_json::Value;
use std::path::PathBuf;
use tempfile::TempDir;

const CORNER: &str = "\
G21 G90 G17
G0 X0 Y0 Z0
G1 X20 Y0 F1000
G1 X5.857864376 Y14.142135624
G4 P1
G1 X0
M2
";

fn corner(folder: &TempDir) -> PathBuf {
    write(folder, "corner.ngc", CORNER)
}

fn servo(file: &str, line: &str, options: &[&str]) -> std::process::Output {
    let common = [
        "servo",
        file,
        "--at",
        line,
        "--machine",
        "mill-3axis",
        "--kv",
        "16.666666667",
        "--acc",
        "33.33",
    ];
    trunnion(&[&common[..], options].concat())
}

fn number(document: &Value, key: &str) -> f64 {
    document[key].as_f64().unwrap_or_else(|| panic!("{key}: {document}"))
}

#[test]
fn the_corner_of_the_paper() {
    let folder = TempDir::new().expect("works");
    let file = corner(&folder);
    let run = |options: &[&str]| {
        let output = servo(str(&file), "4", &[options, &["--format", "json"]].concat());
        (json(&output), status(&output))
    };
    let near = |document: &Value, key: &str, wanted: f64, share: f64| {
        let found = number(document, key);
        assert!((found / wanted - 1.0).abs() <= share, "{key}: {found}, wanted {wanted}");
    };
    let (first, clean) = run(&[]);
    assert_eq!(clean, 0);
    assert_eq!(first["schema"], "trunnion-servo/1");
    near(&first, "corner_deg", 45.0, 1e-6);
    near(&first, "feed_mm_min", 1000.0, 1e-9);
    near(&first, "closed_form_um", 23.121, 1e-4);
    near(&first, "error_exact_um", 23.117, 1e-4);
    let (sampled, _) = run(&["--sample-ms", "1"]);
    near(&sampled, "closed_form_um", 22.736, 1e-4);
    near(&sampled, "error_exact_um", 22.73, 5e-4);
    let third = ["--plant", "third", "--bandwidth-hz", "60", "--sample-ms", "1"];
    let (plain, _) = run(&third);
    near(&plain, "error_exact_um", 22.814, 0.002);
    near(&plain, "error_sampled_um", 22.572, 0.005);
    near(&plain, "error_radial_um", 58.22, 0.005);
    let (predicted, _) = run(&[&third[..], &["--corner-gain", "145", "--delay", "4", "--predict"]].concat());
    near(&predicted, "error_exact_um", 8.63, 0.002);
    let (late, found) = run(&[&third[..], &["--corner-gain", "300", "--delay", "4"]].concat());
    assert_eq!((&late["unstable"], found), (&Value::Bool(true), 1));
    let (through, _) = run(&["--corner-feed", "1000"]);
    // e^-1 v/Kv sin(turn) = 0.367879 mm 0.70711
    near(&through, "closed_form_um", 260.13, 1e-4);
    near(&through, "error_exact_um", 260.13, 1e-3);
}

/// What `servo` prints has the keys and types that `schema servo` names, and no others.
#[test]
fn as_its_schema_says() {
    let folder = TempDir::new().expect("works");
    let file = corner(&folder);
    let schema = json(&trunnion(&["schema", "servo"]));
    let fits = |value: &Value, schema: &Value, name: &str| {
        let found = match value {
            Value::Null => "null",
            Value::Bool(_) => "boolean",
            Value::Number(number) if number.is_i64() || number.is_u64() => "integer",
            Value::Number(_) => "number",
            Value::String(_) => "string",
            Value::Array(_) => "array",
            Value::Object(_) => "object",
        };
        let known = match &schema["type"] {
            Value::String(kind) => vec![kind.as_str()],
            Value::Array(kinds) => kinds.iter().filter_map(Value::as_str).collect(),
            _ => {
                let listed = schema["enum"].as_array().is_some_and(|values| values.contains(value));
                assert!(listed || schema["const"] == *value, "{name}: {value}");
                return;
            }
        };
        let whole = found == "integer" && known.contains(&"number");
        assert!(known.contains(&found) || whole, "{name}: {value} is no {known:?}");
    };
    for options in [
        &["--format", "json"][..],
        &["--format", "json", "--sample-ms", "1", "--tolerance-mm", "0.01"],
        &[
            "--format",
            "json",
            "--plant",
            "third",
            "--bandwidth-hz",
            "60",
            "--corner-gain",
            "300",
            "--delay",
            "4",
        ],
    ] {
        let document = json(&servo(str(&file), "4", options));
        for (part, schema) in [
            (&document, &schema),
            (&document["within"], &schema["properties"]["within"]),
        ] {
            let Some(object) = part.as_object() else { continue };
            let properties = schema["properties"].as_object().expect("properties");
            for (key, value) in object {
                let own = properties
                    .get(key)
                    .unwrap_or_else(|| panic!("{key} is not in the schema"));
                fits(value, own, key);
            }
            for key in schema["required"].as_array().expect("required") {
                assert!(object.contains_key(key.as_str().expect("a key")), "{key} is missing");
            }
        }
        assert_eq!(document["within"].is_object(), options.contains(&"--tolerance-mm"));
    }
}

#[test]
fn in_words() {
    let folder = TempDir::new().expect("works");
    let file = corner(&folder);
    let output = servo(str(&file), "4", &["--tolerance-mm", "0.01"]);
    let shown = text(&output.stdout).replace(str(&file), "corner.ngc");
    insta::assert_snapshot!(shown);
}

#[test]
fn where_there_is_no_corner_it_says_why() {
    let folder = TempDir::new().expect("works");
    let file = corner(&folder);
    for (line, why) in [
        ("3", "no motion with a known path before it"),
        ("6", "follows a dwell (line 5)"),
        ("1", "no motion with a known path starts in this line"),
        ("99", "has the lines 1 to"),
    ] {
        let output = servo(str(&file), line, &[]);
        assert_eq!(status(&output), 2);
        assert!(
            text(&output.stderr).contains(why),
            "line {line}: {}",
            text(&output.stderr)
        );
    }
    let turning = write(
        &folder,
        "turning.ngc",
        "G21 G90\nG0 X0 Y0 Z0 A0 C0\nG1 X10 A5 F500\nG1 Y10\nM2\n",
    );
    let output = trunnion(&[
        "servo",
        str(&turning),
        "--at",
        "4",
        "--machine",
        "linuxcnc-xyzac-trt",
        "--kv",
        "16",
        "--acc",
        "33",
    ]);
    assert!(
        text(&output.stderr).contains("rotary axes turn"),
        "{}",
        text(&output.stderr)
    );
    let output = trunnion(&["servo", str(&file), "--at", "4", "--machine", "mill-3axis"]);
    assert!(text(&output.stderr).contains("--kv"), "{}", text(&output.stderr));
    for wrong in [
        ["--kv", "-1"],
        ["--acc", "nan"],
        ["--sample-ms", "0"],
        ["--corner-gain", "-5"],
    ] {
        let output = servo(str(&file), "4", &[&format!("{}={}", wrong[0], wrong[1])]);
        assert_eq!(status(&output), 2, "{wrong:?}");
    }
}

/// Only X and Y are known: that is enough for a corner in their plane.
#[test]
fn an_axis_that_is_not_named_need_not_be_known() {
    let folder = TempDir::new().expect("works");
    let file = write(&folder, "xy.ngc", "G21 G90 G17\nG0 X0 Y0\nG1 X20 F1000\nG1 Y20\nM2\n");
    let output = servo(str(&file), "4", &["--format", "json"]);
    assert_eq!(status(&output), 0, "{}", text(&output.stderr));
    let document = json(&output);
    assert!((number(&document, "corner_deg") - 90.0).abs() < 1e-9);
    // 0.272511 A/Kv^2
    assert!((number(&document, "closed_form_um") - 32.698).abs() < 0.01);
}

#[test]
fn its_picture() {
    let folder = TempDir::new().expect("works");
    let (file, picture) = (corner(&folder), folder.path().join("corner.svg"));
    let common = [
        "plot",
        str(&file),
        "--kind",
        "servo",
        "--machine",
        "mill-3axis",
        "-o",
        str(&picture),
    ];
    let third = [
        "--kv",
        "16.667",
        "--acc",
        "33.33",
        "--plant",
        "third",
        "--bandwidth-hz",
        "60",
    ];
    let output = trunnion(&[&common[..], &third, &["--at", "4"]].concat());
    assert_eq!(status(&output), 0, "{}", text(&output.stderr));
    let drawn = std::fs::read_to_string(&picture).expect("written");
    for wanted in [
        "Corner at line 4",
        "along the incoming leg / mm",
        "time from the corner / ms",
        "22.",
    ] {
        assert!(drawn.contains(wanted), "{wanted}");
    }
    assert!(drawn.len() < 1_000_000);
    let output = trunnion(&[&common[..], &third].concat());
    assert_eq!(status(&output), 2);
    assert!(text(&output.stderr).contains("--at LINE"));
}
