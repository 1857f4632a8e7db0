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

/// What became of the layers of a part.
#[derive(Debug, Default)]
struct Layers {
    count: usize,
    changes_of_posture: u64,
    /// Steps of C above 45 deg after it.
    large_steps: usize,
    /// Travel of C before and after it, deg.
    travel: [f64; 2],
}

impl Layers {
    /// `None`, and a line that says so, where the data is not there.
    fn of(set: &str, cost: &str) -> Option<Self> {
        let layers = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("../shared/data/waypoints")
            .join(set);
        let Ok(entries) = std::fs::read_dir(&layers) else {
            println!("skipped: {} is not there", layers.display());
            return None;
        };
        let folder = TempDir::new().expect("works");
        let machine = machine(&folder, "[-180, 180]");
        let mut all = Self::default();
        for entry in entries {
            let (program, travel) = layer(&entry.expect("listed").path());
            let file = write(&folder, "layer.mpf", &program);
            let (out, proof) = (folder.path().join("after.mpf"), folder.path().join("proof.json"));
            let _ = std::fs::remove_file(&proof);
            let files = ["fix", str(&file), "-o", str(&out), "--certificate", str(&proof)];
            let options = ["--rewrite", "switch-angles", "--cost", cost, "--machine", str(&machine)];
            let output = trunnion(&[&files[..], &options].concat());
            assert_eq!(status(&output), 0, "{}", text(&output.stderr));
            let after = std::fs::read_to_string(&out).expect("written");
            all.count += 1;
            all.large_steps += large_steps(&after);
            all.travel[0] += travel;
            let Ok(proof) = std::fs::read_to_string(&proof) else {
                // nothing to gain
                assert_eq!(after, program);
                all.travel[1] += travel;
                continue;
            };
            let found: Value = serde_json::from_str(&proof).expect("JSON");
            let number = |key: &str| {
                found["rotary"][0][key]
                    .as_f64()
                    .unwrap_or_else(|| panic!("{key}: {found}"))
            };
            assert!((number("travel_before_deg") - travel).abs() < 1e-4);
            all.travel[1] += number("travel_after_deg");
            all.changes_of_posture += found["postures"]["switches_after"].as_u64().unwrap_or(0);
        }
        Some(all)
    }

    /// Percent.
    fn gain(&self) -> f64 {
        100.0 * (self.travel[1] / self.travel[0] - 1.0)
    }
}

/// Steps of C above 45 deg.
fn large_steps(program: &str) -> usize {
    let words = program.split_whitespace().filter_map(|word| word.strip_prefix('C'));
    let c: Vec<f64> = words.map(|word| word.parse().expect("a number")).collect();
    c.windows(2).filter(|pair| (pair[1] - pair[0]).abs() > 45.0).count()
}

/// 24 layers of a freeform part (BSD-3 data): 23 changes of posture, and C travels 2.28 % less.
#[test]
fn layers_of_a_printed_part_are_switched_as_computed_independently() {
    let Some(found) = Layers::of("freeform", "travel") else {
        return;
    };
    assert_eq!((found.count, found.changes_of_posture), (24, 23));
    assert!((found.gain() + 2.28).abs() < 0.005, "{found:?}");
}

/// 20 layers of a curved part: 1329 changes of posture, C travels 23.57 % less, and 2032 steps of more than 45 deg are left; by the time 1326 and 2034.
#[test]
fn layers_that_pass_the_pole_often_are_switched_as_computed_independently() {
    for (cost, changes, steps) in [("travel", 1329, 2032), ("time", 1326, 2034)] {
        let Some(found) = Layers::of("simple_curve", cost) else {
            return;
        };
        let counts = (found.count, found.changes_of_posture, found.large_steps);
        assert_eq!(counts, (20, changes, steps), "{cost}");
        assert!(cost == "time" || (found.gain() + 23.57).abs() < 0.005, "{found:?}");
    }
}

/// Columns, and the largest deviation with the nearest turns, mm, which no change of posture makes smaller.
const FINE: [(u32, f64); 8] = [
    (40, 5.6673),
    (50, 4.0326),
    (60, 2.9756),
    (70, 2.2632),
    (80, 1.7659),
    (100, 1.1438),
    (150, 0.4979),
    (160, 0.4353),
];

#[test]
fn on_finer_saddles_no_change_of_posture_gains_anything() {
    let folder = TempDir::new().expect("works");
    let machine = machine(&folder, "[-120, 120]");
    for (columns, wanted) in FINE {
        for cost in ["travel", "time", "deviation"] {
            assert!(
                switched(str(&machine), columns, cost, &folder).is_none(),
                "{columns} {cost}"
            );
        }
        let (file, part) = saddle(str(&machine), columns, &folder);
        let judged = trunnion(
            &[
                &[
                    "surface",
                    str(&file),
                    "--required",
                    str(&part),
                    "--machine",
                    str(&machine),
                ],
                &["--close", "0.001", "--format", "json"][..],
            ]
            .concat(),
        );
        let deviation = json(&judged)["errors"]["from_segment"]["sampled_mm"].as_f64();
        let deviation = deviation.expect("a number");
        assert!((deviation - wanted).abs() < 1e-4, "{columns}: {deviation}");
    }
}
