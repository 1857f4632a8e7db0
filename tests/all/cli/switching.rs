//! `fix --rewrite switch-angles`: the published saddle and printed parts with many points near the pole, computed independently.
use super::tools::{json, status, str, text, trunnion, write};
use serde_json::Value;
use std::fmt::Write;
use std::path::{Path, PathBuf};
use tempfile::TempDir;
use trunnion::geometry::{deg, math};

/// mikron-ucp710 with other travel of A, without its check rows.
fn machine(folder: &TempDir, travel: &str) -> PathBuf {
    let source = trunnion::machine::builtin_source("mikron-ucp710").expect("built in");
    let chain = source.split("[[check]]").next().expect("a machine");
    let changed = chain.replace("limits = [-30, 120]", &format!("limits = {travel}"));
    assert_ne!(changed, chain);
    write(folder, "wide.toml", &changed)
}

fn saddle(machine: &str, columns: u32, folder: &TempDir) -> (PathBuf, PathBuf) {
    let (file, part) = (folder.path().join("saddle.mpf"), folder.path().join("saddle.toml"));
    let columns = columns.to_string();
    let options = [
        "--columns",
        &columns,
        "--origin",
        "0,0,50",
        "--style",
        "joints",
        "--posture",
        "positive",
    ];
    let files = [
        "--windings",
        "nearest",
        "--required",
        str(&part),
        "-o",
        str(&file),
        "--machine",
        machine,
    ];
    let output = trunnion(&[&["sample", "saddle"], &options[..], &files[..]].concat());
    assert_eq!(status(&output), 0, "{}", text(&output.stderr));
    (file, part)
}

/// The certificate of switching, and the largest deviation after it, mm; none where nothing is to be gained.
fn switched(machine: &str, columns: u32, cost: &str, folder: &TempDir) -> Option<(Value, f64)> {
    let (file, part) = saddle(machine, columns, folder);
    let (after, certificate) = (folder.path().join("after.mpf"), folder.path().join("proof.json"));
    let options = [
        "--rewrite",
        "switch-angles",
        "--cost",
        cost,
        "--assume",
        "work-offset",
        "--machine",
        machine,
    ];
    let output = trunnion(
        &[
            &["fix", str(&file), "-o", str(&after), "--certificate", str(&certificate)],
            &options[..],
        ]
        .concat(),
    );
    assert_eq!(status(&output), 0, "{}", text(&output.stderr));
    if text(&output.stderr).contains("nothing to do") {
        return None;
    }
    let again = trunnion(&[
        "certify",
        str(&file),
        str(&after),
        "--certificate",
        str(&certificate),
        "--machine",
        machine,
    ]);
    assert!(text(&again.stdout).starts_with("PROVED"), "{}", text(&again.stdout));
    let judged = trunnion(&[
        "surface",
        str(&after),
        "--required",
        str(&part),
        "--machine",
        machine,
        "--close",
        "0.001",
        "--format",
        "json",
    ]);
    let deviation = json(&judged)["errors"]["from_segment"]["sampled_mm"]
        .as_f64()
        .expect("a number");
    let proof = std::fs::read_to_string(&certificate).expect("written");
    Some((serde_json::from_str(&proof).expect("JSON"), deviation))
}

/// Columns, cost, and after it: changes of posture, travel of C (deg), largest step of C (deg), largest deviation (mm).
const TABLE: [(u32, &str, u64, f64, f64, f64); 6] = [
    (20, "travel", 2, 3416.11, 90.0, 2.6316),
    (20, "time", 2, 3416.11, 90.0, 2.6316),
    (20, "deviation", 4, 3416.11, 90.0, 2.5514),
    (30, "travel", 2, 3513.0, 87.633, 5.7404),
    (30, "time", 2, 3513.0, 87.633, 5.7404),
    (30, "deviation", 4, 3607.17, 113.543, 5.7404),
];

/// Numbers of a program that knows nothing of this one (Munlin and Makhanov's surface, shortest paths recomputed).
#[test]
fn the_saddle_is_switched_as_computed_independently() {
    let folder = TempDir::new().expect("works");
    for travel in ["[-120, 120]", "[-45, 120]"] {
        let machine = machine(&folder, travel);
        for (columns, cost, switches, c_travel, c_step, deviation) in TABLE {
            let (proof, found) = switched(str(&machine), columns, cost, &folder).expect("a gain");
            let (c, postures) = (&proof["rotary"][0], &proof["postures"]);
            let near =
                |value: &Value, wanted: f64, within: f64| (value.as_f64().expect("a number") - wanted).abs() <= within;
            assert_eq!(c["axis"], "C");
            assert!(near(&c["travel_after_deg"], c_travel, 0.01), "{columns} {cost}: {c}");
            assert!(near(&c["step_after_deg"], c_step, 0.001), "{columns} {cost}: {c}");
            assert_eq!(
                (&postures["switches_before"], &postures["switches_after"]),
                (&0.into(), &switches.into())
            );
            assert!((found - deviation).abs() < 1e-4, "{columns} {cost}: {found}");
        }
        assert!(switched(str(&machine), 40, "travel", &folder).is_none());
    }
}

/// A stops at -30 deg there, and -36.1 deg would be needed.
#[test]
fn on_the_real_travel_nothing_is_gained() {
    let folder = TempDir::new().expect("works");
    for cost in ["travel", "time", "deviation"] {
        assert!(switched("mikron-ucp710", 20, cost, &folder).is_none(), "{cost}");
    }
}

/// A program with tool centre point control through the points of one layer: A from 0 to 180 deg, C nearest to the value before; and the
/// travel of C, deg.
fn layer(path: &Path) -> (String, f64) {
    let mut text = String::from("T1 M6\nTRAORI\nS8000 M3\nF2000\n");
    let (mut c, mut travel, mut first) = (0.0f64, 0.0, true);
    for row in std::fs::read_to_string(path).expect("readable").lines() {
        let numbers: Vec<f64> = row
            .split_whitespace()
            .map(|number| number.parse().expect("a number"))
            .collect();
        let [x, y, z, i, j, k] = numbers[..] else {
            panic!("{row}")
        };
        let tilt = deg(math::atan2(math::hypot(i, j), k));
        let turn = if i == 0.0 && j == 0.0 {
            c
        } else {
            deg(math::atan2(i, -j))
        };
        let next = turn + 360.0 * ((c - turn) / 360.0).round();
        travel += if first { 0.0 } else { (next - c).abs() };
        (c, first) = (next, false);
        let _ = writeln!(text, "G0 X{x:.5} Y{y:.5} Z{:.5} A{tilt:.9} C{c:.9}", z + 100.0);
    }
    text.push_str("M30\n");
    (text, travel)
}

/// 24 layers of a freeform part (BSD-3 data): 23 changes of posture, and C travels 2.28 % less.
#[test]
fn layers_of_a_printed_part_are_switched_as_computed_independently() {
    let layers = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/waypoints/freeform");
    let Ok(entries) = std::fs::read_dir(&layers) else {
        println!("skipped: {} is not there", layers.display());
        return;
    };
    let folder = TempDir::new().expect("works");
    let machine = machine(&folder, "[-180, 180]");
    let (mut switches, mut before, mut after, mut count) = (0, 0.0, 0.0, 0);
    for entry in entries {
        let (program, travel) = layer(&entry.expect("listed").path());
        let file = write(&folder, "layer.mpf", &program);
        let (out, proof) = (folder.path().join("after.mpf"), folder.path().join("proof.json"));
        let _ = std::fs::remove_file(&proof);
        let files = ["fix", str(&file), "-o", str(&out), "--certificate", str(&proof)];
        let output = trunnion(&[&files[..], &["--rewrite", "switch-angles", "--machine", str(&machine)]].concat());
        assert_eq!(status(&output), 0, "{}", text(&output.stderr));
        count += 1;
        before += travel;
        let Ok(proof) = std::fs::read_to_string(&proof) else {
            // nothing to gain
            after += travel;
            continue;
        };
        let found: Value = serde_json::from_str(&proof).expect("JSON");
        let number = |key: &str| {
            found["rotary"][0][key]
                .as_f64()
                .unwrap_or_else(|| panic!("{key}: {found}"))
        };
        assert!((number("travel_before_deg") - travel).abs() < 1e-4);
        after += number("travel_after_deg");
        switches += found["postures"]["switches_after"].as_u64().unwrap_or(0);
    }
    assert_eq!((count, switches), (24, 23));
    let gain = 100.0 * (after / before - 1.0);
    assert!((gain + 2.28).abs() < 0.005, "{gain}");
}
