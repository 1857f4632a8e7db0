//! `stats --time` and the last columns of `trace`: against times computed by hand.
use super::tools::{json, status, str, text, trunnion, write};
use serde_json::Value;
use std::path::PathBuf;
use tempfile::TempDir;

/// Limits that are easy to compute with.
const MACHINE: &str = r#"schema = "ncmachine/1"
name = "test"
axis = [{letter="X", sign=1, dyn={vmax=200, amax=1000, jmax=20000}}, {letter="Y", sign=1, dyn={vmax=200, amax=1000, jmax=20000}}, {letter="Z", sign=1, dyn={vmax=100, amax=1000, jmax=20000}}]
[control]
family = "linuxcnc"
corner = { model = "linuxcnc-g64" }
planner = { tool_change_time = 4, m_times = { M3 = 1.5 } }
"#;

const PROGRAM: &str = "\
G21 G90 G17 G61.1
T1 M6
S1000 M3
G0 X0 Y0 Z0
G1 X100 F6000
Y100
G4 P0.5
G1 X99.9 F6000
M2
";

fn files(folder: &TempDir, program: &str) -> (PathBuf, PathBuf) {
    (write(folder, "m.toml", MACHINE), write(folder, "p.ngc", program))
}

fn close(found: &Value, wanted: f64) {
    let value = found.as_f64().unwrap_or_else(|| panic!("{found}"));
    assert!((value - wanted).abs() < 1e-6, "{value}, wanted {wanted}");
}

#[test]
fn a_program_by_hand() {
    let folder = TempDir::new().expect("works");
    let (machine, program) = files(&folder, PROGRAM);
    let output = trunnion(&[
        "stats",
        str(&program),
        "--machine",
        str(&machine),
        "--time",
        "--format",
        "json",
    ]);
    assert_eq!(status(&output), 0, "{}", text(&output.stderr));
    let file = &json(&output)["files"][0];
    // G61.1: two moves of L/v + v/a + a/j, the last one too short for its acceleration: 4 cbrt(L/(2j)) where a is not reached
    let long = 1.0 + 0.1 + 0.05;
    let short = (32.0_f64 * 0.1 / 20000.0).cbrt();
    let planned = 4.0 + 1.5 + 2.0 * long + 0.5 + short;
    close(&file["cycle_time_s"][1], planned);
    close(&file["time"]["time_s"][1], planned);
    close(&file["time"]["waits_s"], 5.5);
    close(
        &file["cycle_time_s"][0],
        5.5 + 2.2 + 0.5 + 2.0 * (0.1_f64 / 1000.0).sqrt(),
    );
    assert_eq!(file["time"]["tools"][0]["tool"], 1);
    let worst = &file["time"]["worst"][0];
    assert_eq!(
        (&worst["line"], &worst["limited_by"]),
        (&Value::from(8), &Value::from("jerk"))
    );
    let shown = trunnion(&["stats", str(&program), "--machine", str(&machine), "--time"]);
    let shown = text(&shown.stdout);
    for wanted in ["planned", "T1", "slowest", "limited by jerk"] {
        assert!(shown.contains(wanted), "{wanted}: {shown}");
    }
}

#[test]
fn the_trace_ends_with_time_feed_and_reason() {
    let folder = TempDir::new().expect("works");
    let (machine, program) = files(&folder, PROGRAM);
    let output = trunnion(&["trace", str(&program), "--machine", str(&machine), "--format", "json"]);
    assert_eq!(status(&output), 0, "{}", text(&output.stderr));
    let document = json(&output);
    let rows = document["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), 5);
    close(&rows[1]["time_s"], 1.15);
    close(&rows[1]["reached_feed_mm_min"], 6000.0);
    assert_eq!(rows[1]["limited_by"], "feed");
    assert_eq!(
        (&rows[0]["time_s"], &rows[0]["limited_by"]),
        (&Value::Null, &Value::Null),
        "from nowhere"
    );
    close(&rows[3]["time_s"], 0.5);
    let names = trunnion(&["trace", str(&program), "--machine", str(&machine)]);
    let head = text(&names.stdout).lines().next().map(str::to_owned).expect("a header");
    assert!(head.ends_with(",time_s,reached_feed_mm_min,limited_by"), "{head}");
}

/// G64 P: the corner is rounded, or both legs overlap; which one is LinuxCNC's choice (docs/kinematics.md#time).
#[test]
fn path_control_of_the_program_counts() {
    let folder = TempDir::new().expect("works");
    let time = |mode: &str| {
        let (machine, program) = files(&folder, &PROGRAM.replace("G61.1", mode));
        let output = trunnion(&["stats", str(&program), "--machine", str(&machine), "--format", "json"]);
        json(&output)["files"][0]["cycle_time_s"][1].as_f64().expect("known")
    };
    let (stop, exact, blend, wide) = (time("G61.1"), time("G61"), time("G64 P0.01"), time("G64 P0.5"));
    // every corner here turns: both stop, and under G61 LinuxCNC keeps a tenth of the acceleration back
    assert!(exact > stop && exact < 1.06 * stop, "{exact} {stop}");
    assert!(blend > wide, "{blend} {wide}");
}
