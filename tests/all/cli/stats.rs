//! `stats` and `parse --tree` on the command line.

use super::tools::{FLIP, json, status, str, text, trunnion, write};
use std::path::Path;
use tempfile::TempDir;

const PROGRAM: &str = "%\nO100\nG21 G90 G17 G94\nT3 M6\nS2000 M3\nG0 X0 Y0 Z5\nG1 Z-1 F100\nX30 F300\nG3 X30 Y40 I0 J20\nG4 P1500\nT7 M6\nS500 M3\n\
                       G0 X0 Y0 Z10\nG1 X1 F50\nM98 P200\nM98 P200\nM30\n%\n";

#[test]
fn a_program_in_numbers() {
    let folder = TempDir::new().expect("works");
    let file = write(&folder, "a.nc", PROGRAM);
    let output = trunnion(&["stats", str(&file), "--dialect", "fanuc-30i"]);
    assert_eq!(status(&output), 0, "{}", text(&output.stderr));
    insta::assert_snapshot!("stats_text", text(&output.stdout).replace(str(&file), "a.nc"));
    let output = trunnion(&["stats", str(&file), "--dialect", "fanuc-30i", "--format", "json"]);
    let document = json(&output);
    let file = &document["files"][0];
    // half a circle of radius 20 to the right of X30, so that X reaches 50
    assert_eq!(file["extents"]["x_mm"], serde_json::json!([0.0, 50.0]));
    assert_eq!(file["extents"]["z_mm"], serde_json::json!([-1.0, 10.0]));
    assert_eq!(file["motions_by_kind"]["arc"], 1);
    assert_eq!(file["feed"]["mm_min"], serde_json::json!([50.0, 300.0]));
}

/// A block is what `check` counts as one, and motions that are not measured are those that a picture does not draw.
#[test]
fn the_counts_of_check_stats_and_plot_agree() {
    let folder = TempDir::new().expect("a folder");
    let loop_of = "%\n(HEAD)\nO1\n\nG21 G90 G17 G94 G54\nS1000 M3\nG0 X0 Y0\nG43 H1 Z5\n#1 = 0\nWHILE [#1 LT 3] DO1\n#1 = #1 + 1\nG1 X[#1] F100\nEND1\nM30\n%\n";
    let klartext = "BEGIN PGM A MM\nL X+0 Y+0 FMAX\nL Z+5 FMAX\nL X+1 F100\nM30\nEND PGM A MM\n";
    for (name, program, dialect, blocks) in [
        ("a.nc", loop_of, "fanuc-30i", 11),
        ("a.h", klartext, "heidenhain-klartext", 5),
    ] {
        let file = write(&folder, name, program);
        let on = |command: &[&str]| {
            let of = [
                str(&file),
                "--machine",
                "mill-3axis",
                "--dialect",
                dialect,
                "--assume",
                "work-offset,tool-length",
            ];
            trunnion(&[command, &of].concat())
        };
        let checked = json(&on(&["check", "--format", "json"]));
        let coverage = &checked["files"][0]["coverage"];
        let counted = json(&on(&["stats", "--format", "json"]));
        let counted = &counted["files"][0];
        assert_eq!(
            [&coverage["blocks"], &coverage["blocks_run"]],
            [&counted["blocks"], &counted["blocks_run"]],
            "{name}"
        );
        assert_eq!(counted["blocks_run"].as_u64(), Some(blocks), "{name}");
        let said = text(&on(&["stats"]).stdout);
        assert!(
            said.contains(&format!("  blocks        {blocks} of {blocks} run")),
            "{said}"
        );
        let again = counted["block_runs"].as_u64().expect("a number");
        assert_eq!(
            (again > blocks, said.contains(&format!("run, {again} times in all"))),
            (name == "a.nc", name == "a.nc"),
            "{said}"
        );
        let unknown = counted["motions_of_unknown_length"].as_u64().expect("a number");
        assert_eq!(unknown, 2, "{said}");
        let lines = if name == "a.nc" { "(lines 7, 8)" } else { "(lines 2, 3)" };
        assert!(
            said.contains(&format!(
                "without 2 motions whose start or end in the part is not known {lines}"
            )),
            "{said}"
        );
        let drawn = on(&["plot", "--kind", "path"]);
        let picture = text(&drawn.stdout);
        let wanted = format!("2 motions not drawn: start or end not known {lines}");
        assert!(
            picture.contains(&wanted) && text(&drawn.stderr).contains(&wanted),
            "{}",
            text(&drawn.stderr)
        );
    }
}

/// A retract in machine coordinates says nothing about the part.
#[test]
fn machine_coordinates_are_no_extents() {
    let folder = TempDir::new().expect("a folder");
    let program = write(
        &folder,
        "a.nc",
        "G21 G90 G54\nG0 X0. Y0. Z10.\nG1 X50. Z-1. F500.\nG53 G0 Z300.\nM30\n",
    );
    let output = trunnion(&["stats", str(&program), "--dialect", "fanuc-30i", "--format", "json"]);
    let report: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(report["files"][0]["extents"]["z_mm"], serde_json::json!([-1.0, 10.0]));
}

#[test]
fn the_impeller_has_the_extents_of_its_own_footer() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/linuxcnc-5axis/impeller-7bl-xyzac.ngc");
    if !path.is_file() {
        println!("skipped: {} is absent", path.display());
        return;
    }
    let folder = TempDir::new().expect("works");
    // the machine that the program is for: M428 is tool centre point control
    let settings = "[control]\ntcp_codes = { on = [\"M428\"], off = [\"M429\"] }\n";
    let config = write(&folder, "trunnion.toml", settings);
    for said in [["--config", str(&config)], ["--machine", "linuxcnc-xyzac-trt"]] {
        extents_of_the_impeller(&path, said);
    }
}

fn extents_of_the_impeller(path: &Path, [option, value]: [&str; 2]) {
    let document = json(&trunnion(&["stats", str(path), option, value, "--format", "json"]));
    let end = |axis: &str, at: usize| document["files"][0]["extents"][axis][at].as_f64().expect("known");
    // ( Rmax 45.44 Zmin -2.65 Zmax 39.77 ) ( Amin -74.49 Amax 0.00 ) ( Cmin -399.81 Cmax 0.00 ), and the last block goes to Z40
    for (axis, low, high) in [("z_mm", -2.65, 40.0), ("a_deg", -74.49, 0.0), ("c_deg", -399.81, 0.0)] {
        assert!(
            (end(axis, 0) - low).abs() < 0.0051 && (end(axis, 1) - high).abs() < 0.0051,
            "{axis}"
        );
    }
}

#[test]
fn with_a_machine_joints_and_times_are_told() {
    let folder = TempDir::new().expect("works");
    let file = write(&folder, "flip.nc", FLIP);
    let output = trunnion(&[
        "stats",
        str(&file),
        "--dialect",
        "fanuc-30i",
        "--machine",
        "mikron-ucp710",
    ]);
    assert_eq!(status(&output), 0);
    insta::assert_snapshot!("stats_machine", text(&output.stdout).replace(str(&file), "flip.nc"));
}

/// An arc over the top reaches farther than both its ends, in X Y Z and in the joints.
#[test]
fn joints_include_the_inside_of_arcs() {
    let folder = TempDir::new().expect("works");
    let program = "G21 G17 G90 G94\nS1000 M3\nG0 X0. Y250. Z50.\nG1 Z0. F600.\nG2 X100. Y250. R60.\nG0 Z50.\nM30\n";
    let file = write(&folder, "arc.nc", program);
    let options = ["--dialect", "fanuc-30i", "--machine", "mill-3axis", "--format", "json"];
    let output = trunnion(&[&["stats", str(&file)][..], &options].concat());
    assert_eq!(status(&output), 0);
    let found = text(&output.stdout);
    // the arc's highest point, from its radius and half chord
    let top = 250.0 - (60f64.powi(2) - 50f64.powi(2)).sqrt() + 60.0;
    let json: serde_json::Value = serde_json::from_str(&found).expect("JSON");
    for [group, key] in [["extents", "y_mm"], ["joints", "joint_y_mm"]] {
        let ends = json["files"][0][group][key].to_string();
        let numbers: Vec<f64> = ends
            .split(|c: char| !(c.is_ascii_digit() || c == '.' || c == '-'))
            .filter_map(|number| number.parse().ok())
            .collect();
        let highest = numbers.iter().copied().fold(f64::MIN, f64::max);
        assert!(
            (highest - top).abs() < 2e-3,
            "{group}: {ends}, and {top} is wanted: {found}"
        );
    }
}

#[test]
fn the_tree_shows_words_expressions_and_problems() {
    let folder = TempDir::new().expect("works");
    let source = "N10 G1 X[#1 + SIN[2*#<a b>]] F=R1 (cut)\n/2 o100 while [#1 LT 5]\nX1..2 ; two points\n";
    let file = write(&folder, "a.ngc", source);
    let output = trunnion(&["parse", "--tree", str(&file)]);
    assert_eq!(status(&output), 1);
    insta::assert_snapshot!("parse_tree", text(&output.stdout));
    let document = json(&trunnion(&["parse", "--tree", "--format", "json", str(&file)]));
    assert_eq!(document["schema"], "trunnion-tree/2");
    let word = &document["blocks"][0]["items"][2];
    assert_eq!(
        (word["address"].as_str(), word["value"].as_str()),
        (Some("X"), Some("expression"))
    );
    assert_eq!(
        word["parts"][4],
        serde_json::json!({ "kind": "open", "depth": 1, "start": 17, "end": 18, "text": "[" })
    );
    assert_eq!(document["errors"].as_array().map(Vec::len), Some(1));
}

#[test]
fn a_tree_of_a_hundred_thousand_brackets_is_a_list() {
    let folder = TempDir::new().expect("works");
    let file = write(
        &folder,
        "deep.ngc",
        &format!("x{}1{}\n", "[".repeat(100_000), "]".repeat(100_000)),
    );
    for format in ["text", "json"] {
        let output = trunnion(&["parse", "--tree", "--format", format, str(&file)]);
        assert_eq!(status(&output), 0, "{format}");
        assert!(output.stdout.len() < 30_000_000);
    }
}
