//! Programs that were judged wrongly once, each the smallest that shows it: what is reported of them, and how many of their motions have a
//! known end. What cannot be seen so is shown by the test that is named.
mod five_axes;
mod items;
mod state;
mod unknown_values;
mod words;

use crate::cli::tools::{json, trunnion, write};
use five_axes::{FIVE_AXES, machine};
use items::ITEMS;
use state::STATE;
use std::{fmt::Write, fs, path::Path};
use tempfile::TempDir;
use trunnion::check::{Assume, Diagnostic, Settings, Severity, Status, check};
use trunnion::interp::Setup;
use trunnion::syntax::parse;
use unknown_values::UNKNOWN_VALUES;
use words::WORDS;

/// What is shown by other tests: the file and its test.
const ELSEWHERE: &[[&str; 3]] = &[
    [
        "CASE in fmt",
        "src/layout/tests/all/forms.rs",
        "GOTOF LBL1 2 GOTOF LBL2",
    ],
    [
        "CASE runs",
        "src/interp/tests/all/sinumerik_flow.rs",
        "CASE R1 OF 1 GOTOF LBL1 2 GOTOF LBL2",
    ],
    ["L140(1)", "src/syntax/tests/all/iso_items.rs", "L140(1)"],
    [
        "G93 with a standing tip",
        "src/check/axis_overspeed_tests.rs",
        "inverse_time_is_judged_where_the_tip_stands_still",
    ],
];

fn findings(found: &[Diagnostic], text: &str) -> Vec<String> {
    let of_every_program = ["machine-unset", "missing-program-end", "not-run"];
    let own = found.iter().filter(|found| !of_every_program.contains(&found.rule));
    own.map(|found| {
        let line = text[..found.range.start as usize].matches('\n').count() + 1;
        let level = match (found.status, found.severity) {
            (Status::Unknown, _) => "unknown",
            (_, Severity::Error) => "error",
            (_, Severity::Warning) => "warning",
            (_, Severity::Info) => "info",
        };
        format!("{line} {level} {}", found.rule)
    })
    .collect()
}

#[test]
fn each_is_judged_as_it_should_be() {
    let mut wrong = String::new();
    let items = ITEMS
        .iter()
        .chain(STATE)
        .chain(WORDS)
        .chain(FIVE_AXES)
        .chain(UNKNOWN_VALUES);
    for (name, [dialect, on], text, wanted, motions) in items {
        let dialect = trunnion::dialect::builtin(dialect).expect("built in");
        let own = machine(on);
        let machine = own.as_ref().or_else(|| trunnion::machine::builtin(on));
        let mut setup = Setup::default();
        trunnion::machine::Machine::tell(machine, &mut setup.control);
        let mut settings = Settings::new(dialect, machine, setup);
        settings.assume = Assume::ALL;
        let text = text.concat();
        let report = check(&parse(text.clone().into_bytes(), dialect.lex), &settings);
        let found = findings(&report.diagnostics, &text);
        let known = [report.coverage.motions_known, report.coverage.motions];
        if found != *wanted || known != *motions {
            let _ = writeln!(wrong, "{name}: {found:?} {known:?}");
        }
        let says_nan =
            |found: &Diagnostic| found.message.contains("NaN") || found.notes.iter().any(|note| note.contains("NaN"));
        assert!(!report.findings().any(says_nan), "{name}: {:?}", report.diagnostics);
    }
    assert!(wrong.is_empty(), "{wrong}");
}

#[test]
fn the_others_are_shown_elsewhere() {
    for [name, file, holds] in ELSEWHERE {
        let text = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(file)).unwrap_or_default();
        assert!(text.contains(holds), "{name}: {file} does not hold {holds}");
    }
}

/// Settings are those of the folder in which the program really is.
#[test]
fn a_path_with_dots_has_the_settings_of_its_own_folder() {
    let folder = TempDir::new().expect("works");
    for (name, machine) in [("here", "mill-3axis"), ("there", "gantry-mill")] {
        fs::create_dir(folder.path().join(name)).expect("works");
        let settings = format!("machine = \"{machine}\"\n");
        fs::write(folder.path().join(name).join("trunnion.toml"), settings).expect("works");
    }
    write(&folder, "there/a.nc", "G21 G0 X1\nM30\n");
    let path = folder.path().join("here/../there/a.nc");
    let found = json(&trunnion(&["check", "--format", "json", path.to_str().expect("UTF-8")]));
    assert_eq!(found["files"][0]["machine"], "gantry-mill");
}
