//! Programs that people wrote, checked as they come: every finding is listed with its reason, and each was judged by hand, for LinuxCNC
//! programs beside the answer of `rs274 -g`. The programs lie in ../shared/data.
#![expect(clippy::print_stdout, reason = "a skipped test says so")]
use crate::cli::tools::{self, str, text, trunnion};
use std::{
    collections::BTreeSet,
    fmt::Write,
    fs,
    path::{Path, PathBuf},
};

/// Findings of one file that are listed; the command counts the others.
const LISTED: &str = "30";

fn data(folder: &str) -> Option<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../shared/data")
        .join(folder);
    if path.is_dir() {
        return Some(path);
    }
    println!("skipped: {} is not there", path.display());
    None
}

/// All files below a folder whose name ends like this, sorted.
fn programs(folder: &Path, endings: &[&str]) -> BTreeSet<PathBuf> {
    let mut found = BTreeSet::new();
    for entry in fs::read_dir(folder).expect("a folder").flatten() {
        let path = entry.path();
        if path.is_dir() {
            found.extend(programs(&path, endings));
        } else if path
            .extension()
            .is_some_and(|ending| endings.iter().any(|known| ending == *known))
        {
            found.insert(path);
        }
    }
    found
}

/// Dialect, reason and findings of every program below a folder, one finding a line.
fn findings(folder: &Path, endings: &[&str]) -> String {
    let mut out = String::new();
    for path in programs(folder, endings) {
        let name = path.strip_prefix(folder).expect("below it").display().to_string();
        let output = trunnion(&["check", "-v", "--format", "short", "--limit", LISTED, str(&path)]);
        let remarks = text(&output.stderr);
        let dialect = remarks
            .lines()
            .find(|line| line.contains("dialect"))
            .unwrap_or("no dialect");
        let full = str(&path);
        let dialect = dialect.trim_start_matches(full).trim_start_matches(": ");
        let dialect = dialect.split(';').next().unwrap_or(dialect);
        let _ = writeln!(out, "== {name}: {dialect}");
        let place = format!("{}/", str(folder));
        for line in text(&output.stdout).lines() {
            let line = line.replace(full, "").replace(&place, "");
            let _ = writeln!(out, "{}", line.trim_start_matches(':'));
        }
    }
    out
}

fn list(snapshot: &str, folder: &str, endings: &[&str]) {
    let Some(folder) = data(folder) else { return };
    insta::assert_snapshot!(snapshot, findings(&folder, endings));
}

#[test]
fn macros_for_linuxcnc() {
    list("macro", "macro", &["ngc"]);
}

#[test]
fn five_axis_programs_for_linuxcnc() {
    list("linuxcnc-5axis", "linuxcnc-5axis", &["ngc"]);
}

#[test]
fn programs_of_hobby_machines_and_plotters() {
    list("loose", "loose", &["ngc", "nc", "tap", "gcode", "txt"]);
}

/// What is reported for each rejected program of LinuxCNC's suite: rule, place, and also the missing end. The first line of the
/// program is the control's message.
#[test]
fn programs_that_linuxcnc_rejects() {
    let Some(folder) = data("linuxcnc-interp/bad") else {
        return;
    };
    let cases = [
        ("bad-arc.big.imperial.center-format", "6:9", "arc-radius-mismatch", true),
        ("bad-arc.big.metric.center-format", "6:10", "arc-radius-mismatch", true),
        (
            "bad-arc.medium.imperial.center-format",
            "6:9",
            "arc-radius-mismatch",
            true,
        ),
        (
            "bad-arc.medium.metric.center-format",
            "6:10",
            "arc-radius-mismatch",
            true,
        ),
        (
            "bad-arc.small.metric.center-format",
            "6:14",
            "arc-radius-mismatch",
            true,
        ),
        ("ccomp-arcexit", "7:1", "cutter-compensation", true),
        ("exists-2", "2:15", "bad-expression", false),
        ("exists-7", "2:19", "bad-expression", false),
        ("probe-no-axes", "2:1", "missing-word", true),
    ];
    assert_eq!(
        programs(&folder, &["ngc"]).len(),
        cases.len(),
        "each of them has its case"
    );
    for (name, place, rule, endless) in cases {
        let path = folder.join(format!("{name}.ngc"));
        let program = fs::read_to_string(&path).expect("text");
        let control = program.lines().next().expect("a line");
        let control = control.trim_start_matches([';', '(']).trim_end_matches(')');
        let output = trunnion(&["check", "--format", "short", str(&path)]);
        let told = text(&output.stdout).replace(str(&path), "");
        let told: Vec<&str> = told.lines().map(|line| line.trim_start_matches(':')).collect();
        let first = format!("{place}: error[{rule}] {control}");
        assert!(told.iter().any(|line| line.starts_with(&first)), "{name}: {told:?}");
        let ends = told.iter().filter(|line| line.contains("error[missing-program-end]"));
        assert_eq!(ends.count(), usize::from(endless), "{name}: {told:?}");
        let errors = told.iter().filter(|line| line.contains(": error["));
        assert_eq!(errors.count(), 1 + usize::from(endless), "each is told once: {told:?}");
    }
}

/// One bad word hides neither the others of its line nor those of other lines.
#[test]
fn all_mistakes_of_a_linuxcnc_program_are_told() {
    let folder = tempfile::TempDir::new().expect("a folder");
    let program = "g0 x1 x2 g198\ng1 x[1/0] f100\ng2 x5 i1 r2\no1 if [1]\nm2\n";
    let path = tools::write(&folder, "bad.ngc", program);
    let output = trunnion(&["check", "--format", "short", str(&path)]);
    let told = text(&output.stdout).replace(str(&path), "");
    let told: Vec<&str> = told
        .lines()
        .filter(|line| line.contains(": error["))
        .map(|line| line.trim_start_matches(':').split_once(']').expect("a rule").0)
        .collect();
    insta::assert_snapshot!(told.join("\n"));
}
