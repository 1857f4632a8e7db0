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
