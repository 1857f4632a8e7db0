//! Programs from public repositories as shops write them, for many controls: is the control recognised, how many errors come per 100
//! blocks, and does anything pass that was not looked at. The programs lie in ../shared/data/wild; the numbers are a snapshot.
#![expect(clippy::print_stdout, reason = "a skipped test says so")]
mod known;

use crate::cli::tools::{str, trunnion};
use known::Known;
use serde_json::Value;
use std::{
    collections::{BTreeMap, BTreeSet},
    fmt::Write,
    fs,
    path::{Path, PathBuf},
};

/// Dialects that are right for a control of `FILES.tsv`.
fn right(control: &str) -> &'static [&'static str] {
    match control {
        "apt" => &["apt"],
        "fanuc-mill" => &["fanuc-30i"],
        "haas-mill" => &["haas-ngc"],
        "haas-lathe" => &["haas-lathe"],
        "heidenhain" => &["heidenhain-klartext"],
        "hobby" => &["grbl", "iso-6983", "linuxcnc"],
        "linuxcnc" => &["linuxcnc"],
        "okuma" => &["okuma-osp", "okuma-osp-lathe"],
        "sinumerik" => &["sinumerik-840d"],
        "other:centroid" => &["centroid"],
        "other:eding" => &["eding"],
        "other:wire-edm" => &["wire-edm"],
        other => panic!("no dialect is known to be right for {other}"),
    }
}

/// Rows of a table without its head.
fn rows(path: &Path) -> Vec<Vec<String>> {
    let text = fs::read_to_string(path).expect("a table");
    let fields = |line: &str| line.split('\t').map(str::to_owned).collect();
    text.lines().skip(1).map(fields).collect()
}

/// What is counted for one control.
#[derive(Default)]
struct Counts {
    files: u64,
    right: u64,
    /// Blocks and errors of the files whose mistakes are not known.
    blocks: u64,
    errors: u64,
    motions: u64,
    known: u64,
    verdicts: BTreeMap<String, u64>,
    /// Errors by rule.
    rules: BTreeMap<String, u64>,
}

impl Counts {
    /// Whether the control of a file is recognised. Those of Klartext, Okuma and Sinumerik all are.
    fn recognised(&mut self, row: &[String], file: &Value, wrong: &mut String) {
        let dialect = file["dialect"].as_str().unwrap_or("none");
        let reason = file["dialect_reason"].as_str().unwrap_or_default();
        let is_right = right(&row[1]).contains(&dialect);
        let always = ["heidenhain", "okuma", "sinumerik"].contains(&row[1].as_str());
        assert!(is_right || !always, "{} {}: {dialect}, {reason}", row[1], row[0]);
        self.files += 1;
        self.right += u64::from(is_right);
        if !is_right {
            let _ = writeln!(wrong, "  {} {}: {dialect}, {reason}", row[1], row[0]);
        }
    }
}

/// Checks all files in a few calls; the JSON of each by its path.
fn checked(files: &[PathBuf], more: &[&str]) -> BTreeMap<PathBuf, Value> {
    let mut found = BTreeMap::new();
    for some in files.chunks(100) {
        let mut arguments = vec!["check", "--format", "json", "-q"];
        arguments.extend(more);
        arguments.extend(some.iter().map(|path| str(path)));
        let output = trunnion(&arguments);
        let document: Value =
            serde_json::from_slice(&output.stdout).expect("a JSON document: no file makes the check stop");
        for file in document["files"].as_array().expect("files") {
            found.insert(PathBuf::from(file["path"].as_str().expect("a path")), file.clone());
        }
    }
    found
}

/// `pass` without any motion, or although blocks that move were not run.
fn passes_unseen(file: &Value) -> bool {
    file["verdict"] == "pass" && file["coverage"]["motions"] == 0
}

/// The errors that are left, explained: the control, how the name of the file begins, the rule, and why the error is right.
const EXPLAINED: &[[&str; 4]] = &[
    [
        "hobby",
        "jsdc-laser.gcode",
        "spindle-off-cut",
        "it moves at feed with the laser off (M5) between its paths",
    ],
    [
        "hobby",
        "script_brush_v1583_",
        "missing-subprogram",
        "it calls O93 and O94, which are not there",
    ],
    [
        "linuxcnc",
        "p_bore.ngc",
        "bad-expression rejected-block",
        "it calls _pprobe_bore.ngc, the input of a generator with `if` without O-word",
    ],
    [
        "linuxcnc",
        "p_testbore.ngc",
        "bad-expression rejected-block",
        "it calls _pprobe_bore.ngc, the input of a generator with `if` without O-word",
    ],
];

/// Each error is explained, each explanation is needed, and no control has more than 0.5 errors per 100 blocks.
fn explained(errors: &[(String, String, String)], counts: &BTreeMap<&str, Counts>) -> String {
    let mut needed = vec![false; EXPLAINED.len()];
    for (control, path, rule) in errors {
        let name = path.rsplit('/').next().unwrap_or_default();
        let place = EXPLAINED.iter().position(|[of, begin, rules, _]| {
            of == control && name.starts_with(begin) && rules.split(' ').any(|known| known == rule)
        });
        needed[place.unwrap_or_else(|| panic!("an error that is not explained: {control} {path}: {rule}"))] = true;
    }
    let mut out = String::from("the errors:\n");
    for ([control, name, rules, why], needed) in EXPLAINED.iter().zip(needed) {
        assert!(needed, "explained, and not there: {name}");
        let _ = writeln!(out, "  {control}: {name} ({rules}): {why}");
    }
    for (control, of) in counts {
        assert!(
            of.errors * 200 <= of.blocks,
            "{control}: {} errors in {} blocks",
            of.errors,
            of.blocks
        );
    }
    out
}

/// Main programs under `--scope motion --assume work-offset,tool-length`: how many pass.
fn assumed(table: &[Vec<String>], faulty: &BTreeSet<String>, folder: &Path) -> String {
    let mut out = String::from("main programs that pass with --scope motion --assume work-offset,tool-length:\n");
    let (mut all, mut all_passed) = (0, 0);
    for control in ["fanuc-mill", "haas-mill", "hobby"] {
        let of = |row: &&Vec<String>| row[1] == control && !faulty.contains(&row[0]);
        let main = |path: &PathBuf| known::count(path, &mut Known::default());
        let paths: Vec<PathBuf> = table
            .iter()
            .filter(of)
            .map(|row| folder.join(&row[0]))
            .filter(main)
            .collect();
        let found = checked(&paths, &["--scope", "motion", "--assume", "work-offset,tool-length"]);
        let passed = found.values().filter(|file| file["verdict"] == "pass").count();
        let _ = writeln!(out, "  {control}: {passed} of {}", paths.len());
        (all, all_passed) = (all + paths.len(), all_passed + passed);
        for (path, file) in &checked(&paths, &["--machine", "mill-3axis"]) {
            let unset = |rule: &str| {
                let findings = file["diagnostics"].as_array().expect("findings");
                findings.iter().filter(|found| found["rule"] == rule).count()
            };
            assert!(
                unset("work-offset-unset") <= 1 && unset("tool-length-unset") <= 1,
                "{}",
                path.display()
            );
        }
    }
    assert!(all_passed * 100 >= all * 80, "{out}");
    out
}

/// Motions of main programs with a known end of the tip.
fn tips(table: &[Vec<String>], faulty: &BTreeSet<String>, folder: &Path) -> String {
    let mut out = String::from("motions of main programs with a known end:\n");
    for (control, least) in [
        ("fanuc-mill", 98.0),
        ("haas-mill", 98.0),
        ("hobby", 98.0),
        ("linuxcnc", 98.0),
        ("haas-lathe", 90.0),
    ] {
        let mut known = Known::default();
        for row in table
            .iter()
            .filter(|row| row[1] == control && !faulty.contains(&row[0]))
        {
            known::count(&folder.join(&row[0]), &mut known);
        }
        let outside: Vec<String> = known.outside.iter().map(|(why, n)| format!("{n} {why}")).collect();
        let open: u64 = known.open.values().sum();
        let _ = writeln!(
            out,
            "  {control}: {} programs, {:.1} % ({} of {}), without those whose end rests on something outside: {}",
            known.programs,
            known.per_cent(),
            known.in_full,
            known.in_full + open,
            if outside.is_empty() {
                "none".to_owned()
            } else {
                outside.join(", ")
            },
        );
        for (why, n) in &known.open {
            let _ = writeln!(out, "    {n}: {}", why.chars().take(100).collect::<String>());
        }
        assert!(known.per_cent() >= least, "{out}");
    }
    out
}

/// Findings that neither help nor name what is wrong and what to do after a colon, as refusals of LinuxCNC do.
fn without_advice<'f>(files: impl Iterator<Item = &'f Value>) -> Vec<String> {
    let mut found = Vec::new();
    for file in files {
        for finding in file["diagnostics"].as_array().expect("findings") {
            let message = finding["message"].as_str().unwrap_or_default();
            if finding["help"].is_null() && !message.contains(": ") {
                found.push(format!("{}: {}: {message}", file["path"], finding["rule"]));
            }
        }
    }
    found
}

/// The report on every file, as people see it, fits on a screen of 40 lines and says at its end what was checked; what it leaves out is counted,
/// with how to see it, and stands in the JSON document.
fn one_screen(found: &BTreeMap<PathBuf, Value>) {
    let mut long = String::new();
    for (path, file) in found {
        let output = trunnion(&["check", "--format", "pretty", str(path)]);
        let report = [output.stdout, output.stderr]
            .map(|part| String::from_utf8_lossy(&part).into_owned())
            .concat();
        let lines = report.lines().count();
        if lines > 40 {
            let _ = writeln!(long, "{lines} {}", path.display());
        }
        let last = report.lines().last().unwrap_or_default();
        let verdict = ["PASS", "FAIL", "UNKNOWN"]
            .iter()
            .any(|verdict| last.starts_with(verdict));
        assert!(verdict, "{}: {last}", path.display());
        let shown = |finding: &&Value| {
            let weight = match finding["status"].as_str() {
                Some("unknown") => "unknown",
                _ => finding["severity"].as_str().unwrap_or_default(),
            };
            report.contains(&format!("{weight}[{}]", finding["rule"].as_str().unwrap_or_default()))
        };
        let findings = file["diagnostics"].as_array().expect("findings");
        let all = report.matches("error[").count()
            + report.matches("warning[").count()
            + report.matches("info[").count()
            + report.matches("unknown[").count();
        if all < findings.len() {
            assert!(
                report.contains("--limit 0 shows them all"),
                "{}:\n{report}",
                path.display()
            );
        } else {
            assert!(
                findings.iter().all(|finding| shown(&finding)),
                "{}:\n{report}",
                path.display()
            );
        }
        // an error is never left out for something lighter
        if findings
            .iter()
            .any(|finding| finding["severity"] == "error" && finding["status"] == "fail")
        {
            assert!(report.contains("error["), "{}:\n{report}", path.display());
        }
    }
    assert_eq!(long, "", "reports of more than 40 lines");
}

/// A row for each control with the errors of each rule below it; how many files there are, and of how many the control was recognised.
fn listed(counts: &BTreeMap<&str, Counts>) -> (String, u64, u64) {
    let mut out = String::new();
    let (mut files, mut all_right) = (0, 0);
    for (control, of) in counts {
        files += of.files;
        all_right += of.right;
        let verdicts: Vec<String> = of.verdicts.iter().map(|(name, n)| format!("{n} {name}")).collect();
        let _ = writeln!(
            out,
            "{control}: {} of {} recognised; {}; {} errors in {} blocks ({:.2} per 100); {} of {} motions known",
            of.right,
            of.files,
            verdicts.join(", "),
            of.errors,
            of.blocks,
            100.0 * of.errors as f64 / of.blocks.max(1) as f64,
            of.known,
            of.motions,
        );
        for (rule, n) in &of.rules {
            let _ = writeln!(out, "  {rule}: {n}");
        }
    }
    (out, files, all_right)
}

#[test]
fn every_control_is_recognised_and_nothing_passes_unseen() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data/wild");
    if !folder.is_dir() {
        println!("skipped: {} is not there", folder.display());
        return;
    }
    let table = rows(&folder.join("FILES.tsv"));
    let faulty: BTreeSet<String> = rows(&folder.join("faulty.tsv"))
        .into_iter()
        .map(|row| row[0].clone())
        .collect();
    let paths: Vec<PathBuf> = table.iter().map(|row| folder.join(&row[0])).collect();
    let found = checked(&paths, &[]);
    let mut counts: BTreeMap<&str, Counts> = BTreeMap::new();
    let (mut wrong, mut unseen, mut errors) = (String::new(), Vec::new(), Vec::new());
    for (row, path) in table.iter().zip(&paths) {
        let file = &found[path];
        let of = counts.entry(&row[1]).or_default();
        of.recognised(row, file, &mut wrong);
        *of.verdicts
            .entry(file["verdict"].as_str().unwrap_or_default().to_owned())
            .or_default() += 1;
        let number = |key: &str| file["coverage"][key].as_u64().unwrap_or_default();
        of.motions += number("motions");
        of.known += number("motions_known");
        if passes_unseen(file) {
            unseen.push(row[0].clone());
        }
        if faulty.contains(&row[0]) {
            continue;
        }
        of.blocks += number("blocks");
        for finding in file["diagnostics"].as_array().expect("findings") {
            if finding["severity"] == "error" {
                let times = finding["count"].as_u64().unwrap_or(1);
                of.errors += times;
                errors.push((
                    row[1].clone(),
                    row[0].clone(),
                    finding["rule"].as_str().unwrap_or_default().to_owned(),
                ));
                let rule = finding["rule"].as_str().unwrap_or_default().to_owned();
                *of.rules.entry(rule).or_default() += times;
            }
        }
    }
    assert_eq!(
        without_advice(found.values()),
        [] as [String; 0],
        "findings that do not say what to do"
    );
    one_screen(&found);
    let on_machine = checked(&paths, &["--machine", "mill-3axis"]);
    unseen.extend(
        on_machine
            .values()
            .filter(|file| passes_unseen(file))
            .map(|file| file["path"].to_string()),
    );
    assert_eq!(unseen, [] as [String; 0], "passes without a motion");
    for control in ["heidenhain", "okuma", "sinumerik"] {
        assert!(counts[control].files > 0, "no program for {control}");
    }
    let (mut out, files, all_right) = listed(&counts);
    out.push_str(&assumed(&table, &faulty, &folder));
    out.push_str(&tips(&table, &faulty, &folder));
    out.push_str(&explained(&errors, &counts));
    let _ = write!(out, "all: {all_right} of {files} recognised; not:\n{wrong}");
    assert!(all_right * 100 >= files * 98, "{out}");
    insta::assert_snapshot!("wild", out);
}
