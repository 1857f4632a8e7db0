//! Okuma OSP through the command line: the shared part of five axes, programs of a shop, and the sample.
#![expect(clippy::print_stdout, reason = "a skipped test says so")]
use crate::cli::tools::{all_findings, json, str, text, trunnion, write};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

fn data(path: &str) -> Option<PathBuf> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data").join(path);
    if !file.exists() {
        println!("skipped: {} is not there", file.display());
        return None;
    }
    Some(file)
}

/// A Fanuc program of the shared part in words of OSP: G169 H for G43.4, G170 for the G49 that ends it, G15 H1 for G54, G16 H0 for G28.
fn rewritten(fanuc: &str) -> String {
    let mut under = false;
    let mut out = String::from("$5X-MILLING.MIN%\n");
    for line in fanuc.lines().map(str::trim_end) {
        let (number, words) = match line.split_once(' ') {
            Some((number, words)) if number.starts_with('N') => (format!("{number} "), words),
            _ => (String::new(), line),
        };
        let words = match words {
            "%" | "G69" => continue,
            "G80 G90 G94 G98" => "G80 G90 G94",
            "G54" => "G15 H1",
            "G43 Z189. H1" => "G56 H1 Z189.",
            "G43.4" => {
                under = true;
                "G169 H1"
            }
            "G49" if under => "G170",
            "G49" => "G53",
            "G91 G28 Z0" => "G16 H0 Z0",
            "G28 X0 Y0" => "G16 H0 X0 Y0",
            name if name.starts_with("O0001") => "O0001",
            other => other,
        };
        out += &number;
        out += words;
        out.push('\n');
    }
    out
}

/// The rows of a trace under tool centre point control: place and orientation of the tip, and the rotary axes.
fn tips(file: &Path) -> Vec<[f64; 8]> {
    let arguments = [
        "trace",
        "--machine",
        "mikron-ucp710",
        "--assume",
        "work-offset,tool-length",
        str(file),
    ];
    let table = text(&trunnion(&arguments).stdout);
    let mut lines = table.lines();
    let head: Vec<&str> = lines.next().expect("a head").split(',').collect();
    let at = |name: &str| head.iter().position(|column| *column == name).expect("a column");
    let wanted = ["x_mm", "y_mm", "z_mm", "i", "j", "k", "joint_a", "joint_c"].map(at);
    let under = at("tcp");
    lines
        .map(|line| line.split(',').collect::<Vec<_>>())
        .filter(|row| row[under] == "true")
        .map(|row| wanted.map(|column| row[column].parse().unwrap_or(f64::NAN)))
        .collect()
}

#[test]
fn the_five_axis_part_has_the_same_targets() {
    let Some(fanuc) = data("four-controls/fanuc/5X_MILLING.NC") else {
        return;
    };
    let folder = TempDir::new().expect("a folder");
    let own = write(
        &folder,
        "5x.min",
        &rewritten(&std::fs::read_to_string(&fanuc).expect("text")),
    );
    let (own, fanuc) = (tips(&own), tips(&fanuc));
    assert!(fanuc.len() >= 44_600, "{}", fanuc.len());
    assert_eq!(own.len(), fanuc.len());
    let differ = |(a, b): &(&[f64; 8], &[f64; 8])| {
        a.iter()
            .zip(*b)
            .any(|(a, b)| (a - b).abs() > 1e-3 || a.is_nan() || b.is_nan())
    };
    assert_eq!(own.iter().zip(&fanuc).filter(differ).count(), 0);
}

#[test]
fn most_tips_of_the_shared_part_are_known() {
    let Some(file) = data("four-controls/okuma/2.5D_MILLING.min") else {
        return;
    };
    let found = json(&trunnion(&[
        "check",
        "--format",
        "json",
        "--assume",
        "work-offset,tool-length",
        str(&file),
    ]));
    let coverage = &found["files"][0]["coverage"];
    let number = |key: &str| coverage[key].as_u64().expect("a number");
    assert_eq!(number("blocks"), number("blocks_run"));
    assert!(number("motions") > 750);
    assert!(number("motions_known") * 100 >= number("motions") * 90, "{coverage}");
}

/// Where programs of a shop are not followed to their end, each read in the program: all are arguments of a caller, the control's own variables
/// and subprograms, and functions of the machine.
const REVIEWED: &[&str] = &[
    "G116-NEW.LIB:9: where the program continues depends on whether PT has a value: no program that is read here writes it",
    "OPHAN.SSB:3: where the program continues depends on VORD: a variable of the control",
    "OROTA.SSB:3: where the program continues depends on whether PX has a value: no program that is read here writes it",
    "SET-MASTER-XY.MIN:1: program `OO30` not found",
    "SET-MASTER-Z.MIN:1: not modelled: VFST=#81H",
    "SET-MASTER-Z.MIN:3: program `OO30` not found",
];

#[test]
fn programs_of_a_shop_stop_where_only_the_machine_knows() {
    let Some(folder) = data("wild/MachinistFTW+OkumaMacros") else {
        return;
    };
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder)
        .expect("a folder")
        .map(|entry| entry.expect("an entry").path())
        .collect();
    files.sort();
    let mut arguments = vec!["check", "--format", "json", "--assume", "work-offset,tool-length"];
    arguments.extend(files.iter().map(|file| str(file)));
    let found = json(&trunnion(&arguments));
    let (mut stops, mut blocks, mut errors) = (BTreeSet::new(), 0, 0);
    for file in found["files"].as_array().expect("files") {
        let name = file["path"]
            .as_str()
            .expect("a path")
            .rsplit('/')
            .next()
            .expect("a name");
        let dialect = file["dialect"].as_str().expect("a name");
        assert!(dialect.starts_with("okuma-osp"), "{name}: {dialect}");
        blocks += file["coverage"]["blocks"].as_u64().expect("a number");
        let findings = all_findings(file);
        if dialect == "okuma-osp-lathe" {
            assert_eq!(findings.len(), 1, "{name}: one finding says so");
        }
        for one in findings {
            errors += u64::from(one["severity"] == "error");
            let rule = one["rule"].as_str().expect("a rule");
            if matches!(rule, "not-decided" | "not-modelled" | "missing-subprogram") {
                stops.insert(format!(
                    "{name}:{}: {}",
                    one["line"],
                    one["message"].as_str().expect("a text")
                ));
            }
        }
    }
    assert!(errors * 200 <= blocks, "{errors} errors in {blocks} blocks");
    let reviewed: BTreeSet<String> = REVIEWED.iter().map(|line| (*line).to_owned()).collect();
    assert_eq!(stops, reviewed);
}

#[test]
fn the_sample_runs_from_its_first_block_to_its_end() {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("samples/programs/okuma/ring-plate.min");
    let found = json(&trunnion(&[
        "check",
        "--format",
        "json",
        "--assume",
        "work-offset",
        str(&file),
    ]));
    let file = &found["files"][0];
    assert_eq!(file["dialect"], "okuma-osp");
    let coverage = &file["coverage"];
    assert!(coverage["given_up"].is_null(), "{coverage}");
    assert_eq!(coverage["blocks"], coverage["blocks_run"]);
    // 3 to start, 7 for each pocket, 2 at the end
    assert_eq!(coverage["motions"], 3 - 1 + 6 * 7 + 2, "{coverage}");
    let errors = all_findings(file)
        .into_iter()
        .filter(|one| one["severity"] == "error")
        .count();
    assert_eq!(errors, 0, "{file}");
}
