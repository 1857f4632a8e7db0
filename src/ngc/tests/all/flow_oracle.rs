//! The order of execution: programs with the calls that `rs274 -g` of LinuxCNC 2.9 made of them, held against ours; and, where it is
//! installed, the control itself.
// helpers of tests may panic, and say what they skip
#![allow(clippy::unwrap_used, clippy::print_stdout)]
use crate::listing;
use std::fmt::Write;
use std::path::Path;
use std::process::Command;
use std::sync::Arc;
use trunnion_ngc::{Engine, Setup, Source};

/// What every program begins with, `^` in the files.
const HEAD: [&str; 6] = [
    "USE_LENGTH_UNITS(CANON_UNITS_MM)",
    "SET_G5X_OFFSET(1, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)",
    "SET_G92_OFFSET(0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)",
    "SET_XY_ROTATION(0.0000)",
    "SET_FEED_REFERENCE(CANON_XYZ)",
    "ON_RESET()",
];
/// Resets are of the program `rs274`: listings are compared without them.
const RESET: &str = "ON_RESET()";
/// What M2 does where nothing was changed, `$` in the files.
const END: [&str; 7] = [
    "SET_G5X_OFFSET(1, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000, 0.0000)",
    "SET_XY_ROTATION(0.0000)",
    "SET_FEED_MODE(0, 0)",
    "SET_FEED_RATE(0.0000)",
    "STOP_SPINDLE_TURNING(0)",
    "SET_SPINDLE_MODE(0 0.0000)",
    "PROGRAM_END()",
];

/// Our listing with the first error; the program is called `t.ngc`, as it was for the control.
fn ours(program: &[u8]) -> Vec<String> {
    let source = Source::new("t.ngc".to_owned(), Arc::from(program));
    let mut engine = Engine::new(Arc::new(source), &Setup::default());
    let mut listed = listing::Listed::default();
    engine.run(true, &mut listed);
    let mut lines = listed.lines();
    lines.extend(listed.errors.first().map(|error| format!("! {error}")));
    lines
}

fn same(ours: &[String], theirs: &[String]) -> bool {
    ours.len() == theirs.len() && ours.iter().zip(theirs).all(|(a, b)| listing::same(a, b))
}

/// Every case of a file: the program, and the control's lines.
fn cases(name: &str) -> Vec<(Vec<u8>, Vec<String>)> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/all/oracle")
        .join(name);
    let bytes = std::fs::read(path).unwrap();
    // one byte, one letter: a program may hold any bytes
    let text: String = bytes.iter().copied().map(char::from).collect();
    let case = |case: &str| {
        let (program, expected) = case.split_once("---\n").unwrap();
        let mut lines: Vec<String> = Vec::new();
        for line in expected.lines() {
            match line {
                "^" => lines.extend(HEAD.map(str::to_owned)),
                "$" => lines.extend(END.map(str::to_owned)),
                line => lines.push(line.to_owned()),
            }
        }
        lines.retain(|line| line != RESET);
        (program.chars().map(|letter| letter as u8).collect(), lines)
    };
    text.split("===\n").filter(|text| !text.is_empty()).map(case).collect()
}

/// Runs the cases of a file; what differs is reported whole.
fn compare(name: &str, least: usize) {
    let cases = cases(name);
    assert!(cases.len() >= least, "only {} cases in {name}", cases.len());
    let mut failures = String::new();
    for (program, theirs) in &cases {
        let ours = ours(program);
        if !same(&ours, theirs) {
            let program = String::from_utf8_lossy(program);
            let (theirs, ours) = (theirs.join("\n  "), ours.join("\n  "));
            writeln!(failures, "{program}expected\n  {theirs}\nours\n  {ours}\n").unwrap();
        }
    }
    assert!(failures.is_empty(), "{failures}");
}

#[test]
fn structures_are_those_of_the_control() {
    compare("flow-structures.txt", 150);
}

#[test]
fn calls_are_those_of_the_control() {
    compare("flow-calls.txt", 120);
}

#[test]
fn beginnings_and_ends_are_those_of_the_control() {
    compare("flow-ends.txt", 80);
}

#[test]
fn comments_and_saved_modes_are_those_of_the_control() {
    compare("flow-comments.txt", 30);
}

/// What the control itself lists; `None` where it does not end.
fn theirs(folder: &Path, program: &[u8]) -> Option<Vec<String>> {
    std::fs::write(folder.join("t.ngc"), program).unwrap();
    let output = Command::new("timeout")
        .args(["5", "rs274", "-g", "t.ngc"])
        .current_dir(folder)
        .output()
        .unwrap();
    if output.status.code().is_none_or(|code| code > 1) {
        return None;
    }
    let latin = |bytes: &[u8]| bytes.iter().copied().map(char::from).collect::<String>();
    let text = latin(&output.stdout);
    let mut lines: Vec<String> = text
        .lines()
        .map(listing::bare)
        .filter(|line| !line.is_empty())
        .collect();
    lines.retain(|line| line != RESET);
    let errors = latin(&output.stderr);
    let error = errors
        .lines()
        .find(|line| !line.trim().is_empty() && *line != "executing");
    lines.extend(error.map(|error| format!("! {error}")));
    Some(lines)
}

/// A small program of O words from a seed: structures that often do not fit together.
fn program(seed: u64) -> String {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut next = |below: u64| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        state % below
    };
    let mut text = String::new();
    for _ in 0..4 + next(14) {
        let label = ["1", "2", "<a>"][next(3) as usize];
        let condition = ["[0]", "[1]", "[#1 lt 3]", "[#<_value>]"][next(4) as usize];
        match next(20) {
            0..=2 => writeln!(text, "o{label} if {condition}"),
            3 => writeln!(text, "o{label} elseif {condition}"),
            4 => writeln!(text, "o{label} else"),
            5..=6 => writeln!(text, "o{label} endif"),
            7 => writeln!(text, "o{label} while {condition}"),
            8 => writeln!(text, "o{label} endwhile"),
            9 => writeln!(text, "o{label} do"),
            10 => writeln!(text, "o{label} repeat [2]\no{label} endrepeat"),
            11 => writeln!(text, "o{label} break"),
            12 => writeln!(text, "o{label} sub\n(debug,in #1)"),
            13 => writeln!(text, "o{label} endsub [#1]"),
            14 => writeln!(text, "o{label} call [#1]"),
            15 => writeln!(text, "m98 p{}", next(3)),
            16 => writeln!(text, "m99"),
            17 => writeln!(text, "(debug,#1 #<_value> #<_call_level> #<_line>)"),
            _ => writeln!(text, "#1=[#1+1]"),
        }
        .unwrap();
    }
    text + "m2\n"
}

#[test]
fn random_programs_run_as_on_the_control() {
    if Command::new("rs274").arg("-?").output().is_err() {
        println!("skipped: rs274 (Debian: linuxcnc-uspace) is not installed");
        return;
    }
    let count: u64 = std::env::var("TRUNNION_RS274_PROGRAMS")
        .ok()
        .and_then(|text| text.parse().ok())
        .unwrap_or(12);
    let folder = std::env::temp_dir().join(format!("trunnion-flow-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let mut failures = String::new();
    for seed in 0..count {
        let program = program(seed);
        let Some(theirs) = theirs(&folder, program.as_bytes()) else {
            continue;
        };
        let ours = ours(program.as_bytes());
        if !same(&ours, &theirs) {
            let (theirs, ours) = (theirs.join("\n  "), ours.join("\n  "));
            writeln!(failures, "{program}rs274\n  {theirs}\nours\n  {ours}\n").unwrap();
        }
    }
    std::fs::remove_dir_all(&folder).unwrap();
    assert!(failures.is_empty(), "{failures}");
}
