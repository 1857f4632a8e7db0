//! Programs with the calls that `rs274 -g` of LinuxCNC 2.9 made of them, held against ours.
//!
//! A file is a row of cases: the program, `---`, the calls and, marked by `!`, the error, `===`. The text before `+++` is the
//! machine's INI file.
use crate::listing;
use std::fmt::Write;
use std::path::Path;

/// Runs the cases of a file; what differs is reported whole.
fn compare(name: &str) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/all/oracle")
        .join(name);
    let text = std::fs::read_to_string(&path).expect("there");
    let mut failures = String::new();
    let mut count = 0;
    for case in text.split("===\n").filter(|case| !case.trim().is_empty()) {
        let (program, expected) = case.split_once("---\n").expect("there");
        let expected: Vec<&str> = expected.lines().collect();
        let (ini, program) = program.split_once("+++\n").unwrap_or(("", program));
        let setup = trunnion_ngc::Setup {
            ini: trunnion_ngc::Ini::parse(ini.as_bytes()),
            ..trunnion_ngc::Setup::default()
        };
        let listed = listing::list_with(program, &setup);
        let mut ours = listed.lines();
        ours.extend(listed.errors.first().map(|error| format!("! {}", error.trim_end())));
        count += 1;
        let same = ours.len() == expected.len() && ours.iter().zip(&expected).all(|(a, b)| listing::same(a, b));
        if !same {
            writeln!(
                failures,
                "{program}expected\n  {}\nours\n  {}\n",
                expected.join("\n  "),
                ours.join("\n  ")
            )
            .expect("there");
        }
    }
    assert!(failures.is_empty(), "{failures}");
    assert!(count > 20, "only {count} cases in {name}");
}

#[test]
fn compensation_is_that_of_the_control() {
    compare("compensation.txt");
}

#[test]
fn calls_under_compensation_come_in_the_controls_order() {
    compare("held.txt");
}

#[test]
fn cycles_are_those_of_the_control() {
    compare("cycles.txt");
}

#[test]
fn threads_and_splines_are_those_of_the_control() {
    compare("threads.txt");
}

#[test]
fn what_random_programs_have_found_stays() {
    compare("differential.txt");
}

#[test]
fn turning_cycles_are_those_of_the_control() {
    compare("turning.txt");
}

/// In a check the start is unknown: the cycle ends in one refusal where it would begin, and nothing hangs.
#[test]
fn a_turning_cycle_from_an_unknown_start_is_not_modelled() {
    let setup = trunnion_ngc::Setup {
        start: trunnion_ngc::Start::Unknown,
        ..trunnion_ngc::Setup::default()
    };
    let contour = "g18 f100\no1 sub\ng0 x2 z0\ng1 z-3\nx8\no1 endsub\n";
    for code in ["g70", "g71", "g71.1", "g71.2", "g72"] {
        let unknown = listing::list_with(&format!("{contour}{code} q1\nm2\n"), &setup);
        assert!(unknown.errors[0].contains("unknown value"), "{:?}", unknown.errors);
        let known = listing::list_with(&format!("{contour}{code} q1 x9 z1\nm2\n"), &setup);
        assert!(known.errors.is_empty(), "{:?}", known.errors);
    }
}
