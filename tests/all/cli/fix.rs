//! `trace`, `fix` and `certify` on the command line: columns, diffs, files written, certificates.

use super::tools::{FLIP, json, status, str, text, trunnion, write};
use std::fs;
use tempfile::TempDir;

#[test]
fn trace_has_the_columns_of_the_interface() {
    let folder = TempDir::new().expect("works");
    let file = write(&folder, "flip.nc", FLIP);
    let base = [
        "trace",
        str(&file),
        "--machine",
        "mikron-ucp710",
        "--dialect",
        "fanuc-30i",
        "-q",
    ];
    let output = trunnion(&base);
    // the rows drop the feed far enough for an error of `check`, but a trace judges nothing
    assert_eq!(status(&output), 0, "{}", text(&output.stderr));
    let csv = text(&output.stdout);
    let mut lines = csv.lines();
    let head = lines.next().expect("works");
    assert!(head.starts_with(
        "line,block,motion,tcp,x_mm,y_mm,z_mm,i,j,k,feed_mm_min,duration_s,branch,pole_angle_deg,tip_deviation_mm,feed_limit_mm_min,limiting_axis,joint_"
    ));
    for joint in ["joint_x", "joint_y", "joint_z", "joint_a", "joint_c"] {
        assert!(head.split(',').any(|c| c == joint), "{joint}");
    }
    assert_eq!(lines.count(), 5);
    let output = trunnion(&[&base[..], &["--format", "json"]].concat());
    let rows = json(&output);
    let row = &rows["rows"][2];
    assert_eq!(row["line"], 8);
    assert_eq!(
        (row["joint_c"].as_f64(), row["limiting_axis"].as_str()),
        (Some(52.595), Some("C"))
    );
    assert!((row["feed_limit_mm_min"].as_f64().expect("works") - 46.0).abs() < 1.0);
}

#[test]
fn fix_proves_writes_and_certifies() {
    let folder = TempDir::new().expect("works");
    let file = write(&folder, "flip.nc", FLIP);
    let machine = ["--machine", "mikron-ucp710", "--dialect", "fanuc-30i"];
    let certificate = folder.path().join("proof.json");
    let fixed = folder.path().join("fixed.nc");
    let fix = ["fix", str(&file), "--rewrite", "smooth-pole", "--tolerance-deg", "0.08"];
    let output = trunnion(&[&fix[..], &machine].concat());
    assert_eq!(status(&output), 0, "{}", text(&output.stderr));
    let diff = text(&output.stdout);
    assert!(
        diff.contains("-X-28.38709 Y-1.53565 Z59.93222 A0.081 C52.595"),
        "{diff}"
    );
    assert_eq!(fs::read_to_string(&file).expect("works"), FLIP, "a diff writes nothing");
    let more = ["-o", str(&fixed), "--certificate", str(&certificate)];
    assert_eq!(status(&trunnion(&[&fix[..], &more, &machine].concat())), 0);
    let certify = ["certify", str(&file), str(&fixed), "--certificate", str(&certificate)];
    let output = trunnion(&[&certify[..], &machine].concat());
    assert_eq!(status(&output), 0, "{}", text(&output.stdout));
    assert!(text(&output.stdout).starts_with("PROVED"));
    fs::write(
        &fixed,
        fs::read_to_string(&fixed).expect("works").replace("A-1.676", "A-1.675"),
    )
    .expect("works");
    assert_eq!(
        status(&trunnion(&[&certify[..], &machine].concat())),
        1,
        "another text is refused"
    );
    let output = trunnion(&[&fix[..], &["--write", "--backup"], &machine].concat());
    assert_eq!(status(&output), 0);
    assert_ne!(fs::read_to_string(&file).expect("works"), FLIP);
    assert_eq!(
        fs::read_to_string(folder.path().join("flip.nc.bak")).expect("works"),
        FLIP
    );
    let leftovers = fs::read_dir(folder.path()).expect("works").count();
    assert_eq!(leftovers, 4, "no temporary file stays behind");
}

#[test]
fn fix_without_a_tool_is_refused_with_the_reason() {
    let folder = TempDir::new().expect("works");
    let file = write(
        &folder,
        "flip.nc",
        &FLIP.replace("(trunnion: tool 1 ball diameter 10)\n", ""),
    );
    let base = [
        "fix",
        str(&file),
        "--rewrite",
        "smooth-pole",
        "--machine",
        "mikron-ucp710",
        "--dialect",
        "fanuc-30i",
    ];
    let output = trunnion(&base);
    assert_eq!(status(&output), 1);
    assert!(text(&output.stderr).contains("tool"), "{}", text(&output.stderr));
    assert!(output.stdout.is_empty());
    let output = trunnion(&[&base[..], &["--tool", "ball:10", "--tolerance-deg", "0.08"]].concat());
    assert_eq!(status(&output), 0, "{}", text(&output.stderr));
}

/// What became of every place, and what is gained: contract section 8.6.
#[test]
fn fix_reports_every_place_and_what_is_gained() {
    let folder = TempDir::new().expect("works");
    // the same chain twice: with the ball of tool 1, and with a tool that nothing declares
    let body = FLIP
        .trim_end()
        .trim_end_matches("M30")
        .trim_end()
        .trim_end_matches("M5");
    let chain: Vec<&str> = FLIP.lines().skip(5).take(5).collect();
    let again = chain.join("\n").replace(" F2000", "");
    let twice = format!("{body}M5\nG49\nG0 X0 Y0 Z200\nT2 M6\nS12000 M3\nG43.4 H1\n{again}\nM5\nM30\n");
    let file = write(&folder, "twice.nc", &twice);
    let base = [
        "fix",
        str(&file),
        "--rewrite",
        "smooth-pole",
        "--tolerance-deg",
        "0.08",
        "--machine",
        "mikron-ucp710",
        "--dialect",
        "fanuc-30i",
        "--format",
        "json",
    ];
    let output = trunnion(&base);
    assert_eq!(status(&output), 0, "{}", text(&output.stderr));
    let document = json(&output);
    assert_eq!(document["schema"], "trunnion-fix/1");
    let places = document["places"].as_array().expect("a list");
    let states: Vec<_> = places.iter().map(|p| p["state"].as_str().expect("a state")).collect();
    assert_eq!(states[0], "applied", "{document:#}");
    assert!(states[1..].contains(&"possible"), "{document:#}");
    let missing = places.iter().find(|p| p["state"] == "possible").expect("one");
    assert!(
        missing["reason"].as_str().expect("a reason").contains("tool shape"),
        "{missing}"
    );
    assert!(missing["gains"].is_null());
    // the published rows: 51.8 deg become 1.146 deg, and the table limits the feed no longer
    let of = |gains: &serde_json::Value, name: &str| {
        ["before", "after"].map(|side| gains[name][side].as_f64().unwrap_or(f64::NAN))
    };
    let step = of(&places[0]["gains"], "largest_step_deg");
    assert!((step[0] - 55.681).abs() < 1e-3 && step[1] < 3.0, "{step:?}");
    let feed = of(&places[0]["gains"], "feed_limit_mm_min");
    assert!(
        (feed[0] - 33.137).abs() < 1e-3 && (feed[1] - 1571.0).abs() < 0.5,
        "{feed:?}"
    );
    assert_eq!(of(&places[0]["gains"], "blocks"), [4.0, 4.0]);
    let travel = of(&document["gains"], "rotary_travel_deg");
    assert!(travel[1] < travel[0], "{travel:?}");
    // only these lines: nothing of the first chain is touched
    let output = trunnion(&[&base[..], &["--lines", "18-30"]].concat());
    let document = json(&output);
    assert_eq!(document["changed"], false, "{document:#}");
    let lines = |p: &serde_json::Value| p["line"].as_u64().expect("a line");
    assert!(
        document["places"]
            .as_array()
            .expect("a list")
            .iter()
            .all(|p| lines(p) >= 18)
    );
    assert_eq!(status(&trunnion(&[&base[..], &["--lines", "30-18"]].concat())), 2);
}

/// Several rewrites make a chain of certificates; a chain for another program is refused.
#[test]
fn several_rewrites_make_a_chain_that_is_checked_again() {
    let folder = TempDir::new().expect("works");
    let file = write(&folder, "flip.nc", &FLIP.replace("A-1.676 C-0.905", "A-1.676 C359.095"));
    let machine = ["--machine", "mikron-ucp710", "--dialect", "fanuc-30i"];
    let (fixed, proof) = (folder.path().join("fixed.nc"), folder.path().join("proof.json"));
    let fix = [
        "fix",
        str(&file),
        "--rewrite",
        "unwind-rotary,smooth-pole",
        "--tolerance-deg",
        "0.08",
    ];
    let more = ["-o", str(&fixed), "--certificate", str(&proof)];
    let output = trunnion(&[&fix[..], &more, &machine].concat());
    assert_eq!(status(&output), 0, "{}", text(&output.stderr));
    assert!(
        text(&output.stderr).contains("rotary travel"),
        "{}",
        text(&output.stderr)
    );
    let certify = ["certify", str(&file), str(&fixed), "--certificate", str(&proof)];
    let output = trunnion(&[&certify[..], &machine].concat());
    let printed = text(&output.stdout);
    assert_eq!(status(&output), 0, "{printed}");
    assert!(printed.starts_with("PROVED in 2 steps\nstep 1: "), "{printed}");
    let chain = fs::read_to_string(&proof).expect("works");
    let first_edit = chain.find("\"text\": \"").expect("an edit") + "\"text\": \"".len();
    let mut other = chain.clone();
    other.replace_range(first_edit..=first_edit, "9");
    fs::write(&proof, other).expect("works");
    let output = trunnion(&[&certify[..], &machine].concat());
    assert_eq!(status(&output), 1);
    assert!(text(&output.stdout).starts_with("REFUTED"), "{}", text(&output.stdout));
    fs::write(&proof, chain).expect("works");
    fs::write(&fixed, fs::read_to_string(&fixed).expect("works") + "\n").expect("works");
    let output = trunnion(&[&certify[..], &machine].concat());
    assert_eq!(status(&output), 1);
    assert!(
        text(&output.stdout).contains("do not lead to the changed program"),
        "{}",
        text(&output.stdout)
    );
}
