//! The planner against LinuxCNC's own: programs of tests/linuxcnc/programs in all modes of path control, with the servo cycles that LinuxCNC needed
//! for each line (tests/linuxcnc/measured, written by tests/linuxcnc/run.py).
//!
//! One short program also runs through LinuxCNC here where it is installed (Debian: linuxcnc-uspace). Motion is held back until the program is queued
//! and times are counted in servo cycles of 1 ms, so the speed of the computer does not count.
#![expect(clippy::print_stdout, reason = "a skipped test says so, and the table is of use")]
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;
use trunnion_dialect::builtin;
use trunnion_interp::{ModalState, Setup};
use trunnion_machine::{Leg, Machine, load};
use trunnion_planner::{Listener, Timed, time};
use trunnion_syntax::{LineIndex, Program, parse};

/// The same limits as run.py's configuration.
const MACHINE: &str = r#"schema = "ncmachine/1"
axis = [{letter="X", sign=1, dyn={vmax=200, amax=1000}}, {letter="Y", sign=1, dyn={vmax=200, amax=1000}}, {letter="Z", sign=1, dyn={vmax=100, amax=600}}]
[control]
family = "linuxcnc"
units = "mm"
rapid = "synchronous"
corner = { model = "linuxcnc-g64" }
"#;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/linuxcnc")
}

/// Planned milliseconds of each line.
#[derive(Default)]
struct Lines {
    index: Option<LineIndex>,
    times: BTreeMap<u32, f64>,
    nowhere: Vec<u32>,
    program: Option<Program>,
}

impl Listener for Lines {
    fn leg(&mut self, _: &Leg, _: &ModalState, _: u32) {}
    fn timed(&mut self, timed: &Timed, _: bool) {
        let (Some(index), Some(program)) = (&self.index, &self.program) else {
            return;
        };
        let start = program.block(timed.block).range().start;
        let (line, _) = index.line_column(program.source(), start);
        if timed.from_nowhere {
            self.nowhere.push(line);
        }
        *self.times.entry(line).or_default() += timed.seconds[1].expect("planned") * 1000.0;
    }
}

fn planned(machine: &Machine, text: &str) -> Lines {
    let dialect = builtin("linuxcnc").expect("there");
    let program = || parse(text.as_bytes().to_vec(), dialect.lex);
    let mut lines = Lines {
        index: Some(LineIndex::new(text.as_bytes())),
        program: Some(program()),
        ..Lines::default()
    };
    time(&program(), dialect, &Setup::default(), machine, &mut lines);
    lines
}

/// Servo cycles of each line, by mode.
fn measured(table: &Path) -> Vec<(String, BTreeMap<u32, f64>)> {
    let text = std::fs::read_to_string(table).unwrap_or_else(|error| panic!("{}: {error}", table.display()));
    let mut rows = text.lines();
    let head = rows.next().expect("a header");
    let mut out: Vec<(String, BTreeMap<u32, f64>)> = head
        .split('\t')
        .skip(1)
        .map(|mode| (mode.to_owned(), BTreeMap::new()))
        .collect();
    for row in rows {
        let mut fields = row.split('\t');
        let line: u32 = fields.next().and_then(|line| line.parse().ok()).expect("a line");
        for ((_, times), field) in out.iter_mut().zip(fields) {
            times.insert(line, field.parse().expect("cycles"));
        }
    }
    out
}

/// Compares one program in one mode; what lies outside the tolerances.
fn compare(name: &str, text: &str, mode: &str, found: &BTreeMap<u32, f64>) -> Vec<String> {
    let machine = load("witness", MACHINE).expect("valid");
    let own = planned(&machine, &text.replace("@MODE@", mode));
    let mut problems = Vec::new();
    let (mut operation, mut sums) = ("", BTreeMap::<&str, [f64; 2]>::new());
    let mut whole = [0.0; 2];
    let mut worst: f64 = 0.0;
    for (line, content) in (1_u32..).zip(text.lines()) {
        if let Some(rest) = content.strip_prefix("(operation ") {
            operation = rest.trim_end_matches(')');
        }
        if own.nowhere.contains(&line) {
            continue;
        }
        let pair = [
            found.get(&line).copied().unwrap_or(0.0),
            own.times.get(&line).copied().unwrap_or(0.0),
        ];
        for (sum, value) in sums.entry(operation).or_default().iter_mut().zip(pair) {
            *sum += value;
        }
        for (sum, value) in whole.iter_mut().zip(pair) {
            *sum += value;
        }
        if std::env::var_os("TRUNNION_LINES").is_some() {
            println!("    {line:4} {:6.0} {:8.1}  {content}", pair[0], pair[1]);
        }
        let share = match mode {
            "G61.1" => 0.02,
            "G61" => 0.05,
            _ => continue,
        };
        worst = worst.max(((pair[1] - pair[0]).abs() - 2.0).max(0.0) / pair[0].max(1.0));
        if (pair[1] - pair[0]).abs() > (share * pair[0]).max(2.0) {
            problems.push(format!(
                "{name} {mode} line {line} `{content}`: {:.1} ms, LinuxCNC {} ms",
                pair[1], pair[0]
            ));
        }
    }
    let off = |[found, own]: [f64; 2]| own / found.max(1.0) - 1.0;
    let parts: Vec<String> = sums
        .iter()
        .filter(|(_, sum)| sum[0] > 0.0)
        .map(|(operation, sum)| format!("{operation} {:+.1} %", 100.0 * off(*sum)))
        .collect();
    println!(
        "{name:10} {mode:10} LinuxCNC {:6.0} ms, planned {:8.1} ms, {:+.2} %; {}",
        whole[0],
        whole[1],
        100.0 * off(whole),
        parts.join(", ")
    );
    if off(whole).abs() > 0.05 {
        problems.push(format!("{name} {mode}: the program {:+.2} %", 100.0 * off(whole)));
    }
    for (operation, sum) in &sums {
        if sum[0] > 0.0 && off(*sum).abs() > 0.1 {
            problems.push(format!("{name} {mode} {operation}: {:+.2} %", 100.0 * off(*sum)));
        }
    }
    problems
}

fn check(name: &str, table: &Path) -> Vec<String> {
    let text = std::fs::read_to_string(folder().join("programs").join(format!("{name}.ngc"))).expect("a program");
    let modes = measured(table);
    assert!(modes.len() >= 3, "{name}: G61.1, G61 and G64 P");
    modes
        .iter()
        .flat_map(|(mode, found)| {
            assert!(found.values().sum::<f64>() > 1000.0, "{name} {mode}: a second at least");
            compare(name, &text, mode, found)
        })
        .collect()
}

#[test]
fn as_linuxcnc_measured() {
    let mut tables: Vec<PathBuf> = std::fs::read_dir(folder().join("measured"))
        .expect("recorded")
        .map(|entry| entry.expect("readable").path())
        .collect();
    tables.sort();
    let problems: Vec<String> = tables
        .iter()
        .flat_map(|table| check(table.file_stem().and_then(|name| name.to_str()).expect("a name"), table))
        .collect();
    assert!(
        problems.is_empty(),
        "{} places:\n{}",
        problems.len(),
        problems.join("\n")
    );
    assert!(tables.len() >= 7, "all programs");
}

/// What run.py exits with where LinuxCNC is not installed.
const ABSENT: i32 = 77;

#[test]
fn as_linuxcnc_runs_here() {
    let out = tempfile::tempdir().expect("works");
    let program = folder().join("programs/short.ngc");
    let python = ["/usr/bin/python3", "python3"]
        .into_iter()
        .find(|name| Command::new(name).arg("--version").output().is_ok());
    let Some(python) = python else {
        println!("skipped: there is no Python");
        return;
    };
    let run = Command::new(python)
        .arg(folder().join("run.py"))
        .arg(&program)
        .arg("-o")
        .arg(out.path())
        .args(["--modes", "G61.1,G61,G64 P0.05"])
        .output()
        .expect("Python runs");
    if run.status.code() == Some(ABSENT) {
        println!("skipped: LinuxCNC is not installed (Debian: linuxcnc-uspace)");
        return;
    }
    assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
    let problems = check("short", &out.path().join("short.tsv"));
    assert!(problems.is_empty(), "{}", problems.join("\n"));
    // what is on record is what it does: to a cycle per block
    let record = measured(&folder().join("measured/short.tsv"));
    for (mode, times) in measured(&out.path().join("short.tsv")) {
        let (_, recorded) = record.iter().find(|(name, _)| *name == mode).expect("recorded");
        let sum = |times: &BTreeMap<u32, f64>| times.iter().skip(1).map(|(_, cycles)| cycles).sum::<f64>();
        assert!((sum(recorded) - sum(&times)).abs() <= 0.01 * sum(recorded), "{mode}");
    }
}
