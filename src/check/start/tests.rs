//! What programs rely on at power-on.
use crate::{Assume, Report, Settings, Severity, Verdict, check};
use trunnion_interp::{ControlData, Setup};

fn report(dialect: &str, text: &str, power_on: &[&str], usual: bool) -> Report {
    let dialect = trunnion_dialect::builtin(dialect).expect("built in");
    let control = ControlData {
        power_on: (!power_on.is_empty()).then(|| power_on.iter().map(|code| (*code).to_owned()).collect()),
        ..ControlData::default()
    };
    let setup = Setup {
        control,
        ..Setup::default()
    };
    let settings = Settings {
        assume: Assume {
            power_on: usual,
            ..Assume::default()
        },
        ..Settings::new(dialect, None, setup)
    };
    check(
        &trunnion_syntax::parse(text.as_bytes().to_vec(), dialect.lex),
        &settings,
    )
}

fn assumed(dialect: &str, text: &str) -> Vec<String> {
    report(dialect, text, &[], false).assumptions
}

const BARE: &str = "G0 X1. Y1. Z5.\nM3 S100\nG1 Z-1. F100.\nG2 X3. I1.\nM30\n";

#[test]
fn what_is_used_before_it_is_programmed_is_listed() {
    let listed = |dialect: &str, text: &str| assumed(dialect, text).join("; ");
    let found: Vec<String> = [
        ("fanuc-30i", BARE.to_owned()),
        ("fanuc-30i", format!("G17 G21 G90 G94\n{BARE}")),
        ("fanuc-30i", format!("G90 G21\n{BARE}")),
        (
            "fanuc-30i",
            "G21 G90 G94\nG0 X1. Y1. Z5.\nG81 Z-1. R1. F100.\nG80\nM30\n".to_owned(),
        ),
        (
            "fanuc-30i",
            "G21 G90 G94\nG0 X1. Y1. Z5.\nG1 X5. F100.\nM30\n".to_owned(),
        ),
        (
            "fanuc-30i",
            "G21 G90 G0 X1. Y1. Z5.\nG1 X5. F100.\nG94 G17\nG2 X7. I1.\nM30\n".to_owned(),
        ),
        ("sinumerik-840d", "G0 X1 Y1\nG1 X2 F100\nM30\n".to_owned()),
        ("linuxcnc", BARE.replace("M30", "M2")),
        ("grbl", BARE.to_owned()),
        (
            "fanuc-30i-lathe-a",
            "G21\nG0 X10. Z5.\nG1 Z1. F0.1\nG2 X12. Z0. R1.\nM30\n".to_owned(),
        ),
        ("haas-lathe", "G0 X10. Z5.\nM30\n".to_owned()),
        ("apt", "UNITS/MM\nGOTO/1,2,3\nFINI\n".to_owned()),
    ]
    .map(|(dialect, text)| listed(dialect, &text))
    .into();
    insta::assert_debug_snapshot!(found);
}

/// What the machine declares is in effect, and listed as declared.
#[test]
fn the_machine_declares_what_is_in_effect() {
    // in G18 and G95 the arc is about Y, with I and K
    let text = "G90 G21 G0 X0. Y0. Z0.\nM3 S100\nG1 X1. F0.1\nG2 X3. I1. K0.\nM30\n";
    let found = report("fanuc-30i", text, &["G18", "G95", "G40"], false);
    assert_eq!(found.assumptions, ["G18 G95 at power-on (declared)"]);
    assert_eq!(found.verdict(Severity::Error), Verdict::Pass, "{:?}", found.diagnostics);
    let found = report("fanuc-30i", text, &["G18"], false);
    assert_eq!(
        found.assumptions,
        ["G94 at power-on (not declared)", "G18 at power-on (declared)"]
    );
}

/// A unit of the settings is listed where the program names none, or names it too late; rotary words have none.
#[test]
fn a_declared_unit_is_listed_where_the_program_names_none() {
    let dialect = trunnion_dialect::builtin("fanuc-30i").expect("built in");
    let listed = |text: &str| {
        let control = ControlData {
            units: Some(trunnion_interp::LengthUnit::Millimetre),
            ..ControlData::default()
        };
        let setup = Setup {
            control,
            ..Setup::default()
        };
        let settings = Settings::new(dialect, None, setup);
        let program = trunnion_syntax::parse(text.as_bytes().to_vec(), dialect.lex);
        check(&program, &settings).assumptions.join("; ")
    };
    assert_eq!(listed("G17 G90 G94\nG0 X1. Y1.\nM30\n"), "G21 at power-on (declared)");
    assert_eq!(
        listed("G17 G90 G94\nG0 X1. Y1.\nG21\nX2.\nM30\n"),
        "G21 at power-on (declared)"
    );
    assert_eq!(listed("G17 G90 G94\nG21 G0 X1. Y1.\nM30\n"), "");
    assert_eq!(listed("G17 G90 G94\nG0 B45.\nM30\n"), "");
}

/// A motion before any motion code is unknown on a Fanuc, whose parameter decides; declared or assumed it is a rapid.
#[test]
fn the_first_motion_code_is_declared_or_assumed() {
    let text = "G21 G17 G90 G94\nX1. Y1. Z5.\nM30\n";
    let verdict = |power_on: &[&str], usual| report("fanuc-30i", text, power_on, usual).verdict(Severity::Error);
    assert_eq!(verdict(&[], false), Verdict::Unknown);
    assert_eq!(verdict(&["G0"], false), Verdict::Pass);
    assert_eq!(verdict(&[], true), Verdict::Pass);
    assert_eq!(
        report("fanuc-30i", text, &[], true).assumptions,
        ["G0 at power-on (not declared)"]
    );
}

/// `--assume power-on` takes the unit too, and says so in place of the finding.
#[test]
fn the_unit_is_a_finding_or_an_assumption() {
    let text = "G17 G90 G94\nG0 X1. Y1. Z5.\nM30\n";
    let units = |usual| {
        let report = report("fanuc-30i", text, &[], usual);
        let found = report.diagnostics.iter().any(|found| found.rule == "units-unset");
        (found, report.assumptions.join("; "))
    };
    assert_eq!(units(false), (true, "G21 at power-on (not declared)".to_owned()));
    assert_eq!(units(true), (false, "G21 at power-on (not declared)".to_owned()));
}

/// A branch that asks what is in effect relies on it, whatever moves: `#4006` before G20 or G21.
#[test]
fn what_a_program_asks_of_the_start_is_assumed() {
    for (dialect, text, wanted) in [
        (
            "fanuc-30i",
            "O1\nIF[#4003EQ91]GOTO10\nM3S900\nN10G21G90G94G17G1X1.F100\nM30\n",
            "G90 at power-on (not declared)",
        ),
        (
            "fanuc-30i",
            "O1\nIF[#4006 EQ 20]GOTO10\nM3S900\nN10G21G90G94G17G1X1.F100\nM30\n",
            "G21 at power-on (not declared)",
        ),
        (
            "sinumerik-840d",
            "IF $P_GG[6]==2 GOTOF LBX\nM3 S900\nLBX: G71 G90 G94 G17 G1 X1 F100\nM30\n",
            "G17 at power-on (not declared)",
        ),
        (
            "linuxcnc",
            "o1 if [#<_imperial>]\nm3 s900\no1 endif\ng21 g90 g94 g17 g1 x1 f100\nm2\n",
            "G21 at power-on (not declared)",
        ),
    ] {
        let core = trunnion_dialect::builtin(dialect).expect("built in");
        let program = trunnion_syntax::parse(text.as_bytes().to_vec(), core.lex);
        let settings = Settings::new(core, None, trunnion_interp::Setup::default());
        let report = crate::check(&program, &settings);
        assert!(
            report.assumptions.iter().any(|found| found == wanted),
            "{text}: {:?}",
            report.assumptions
        );
        let after = text
            .replace("O1\n", "O1\nG21 G90 G17\n")
            .replace("IF $P", "G17\nIF $P")
            .replace("o1 if", "g21\no1 if");
        let program = trunnion_syntax::parse(after.as_bytes().to_vec(), core.lex);
        let report = crate::check(&program, &settings);
        assert!(
            !report.assumptions.iter().any(|found| found == wanted),
            "{after}: {:?}",
            report.assumptions
        );
    }
    // a comment asks nothing
    let text = "G21 G90 G94 G17 (#4003 and #4006)\n(#4001)\nG1 X1. F100\nM30\n";
    assert_eq!(assumed("fanuc-30i", text), [] as [&str; 0]);
    let text = "(#4003)\nG21 G90 G94 G17 G1 X1. F100\nM30\n";
    assert_eq!(assumed("fanuc-30i", text), [] as [&str; 0]);
}

/// A subprogram alone: whether its words are absolute, and what moves, its caller says.
#[test]
fn a_subprogram_relies_on_its_caller() {
    for (dialect, text, wanted) in [
        ("sinumerik-840d", "X300 Y0 F100\nX400\nM17\n", Some("G1 G90")),
        ("fanuc-30i", "O1000\nG1 X300. F100.\nM99\n", Some("G90")),
        ("fanuc-30i", "O1000\nG90 G1 X300. F100.\nM99\n", None),
        ("fanuc-30i", "O1000\nG1 X300. F100.\nM30\n", None),
    ] {
        let found = |usual| {
            let report = report(dialect, text, &[], usual);
            let own = report
                .diagnostics
                .into_iter()
                .find(|found| found.rule == "position-unknown");
            own.map(|found| (found.status, found.message))
        };
        let message = wanted.map(|codes| {
            let message = format!("this subprogram does not say {codes}: its caller does");
            (crate::Status::Unknown, message)
        });
        assert_eq!(found(false), message, "{text}");
        assert_eq!(found(true), None, "{text}");
    }
}
