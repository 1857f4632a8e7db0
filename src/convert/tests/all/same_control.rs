//! What the target has in the same words: the tool's length beside the axis of the tool, tolerances of the same control, M codes of AUXFUN, and the last
//! value inside the travel.
use crate::support::{machine, refusal, text, to};
use trunnion_certify::conversion::Assume;
use trunnion_convert::{Options, Source, Target, Units, builtin_post, convert};
use trunnion_interp::{Setup, WorkOffset};

/// The lines of a program, without block numbers.
fn lines(text: &str) -> Vec<String> {
    let is_number = |word: &str| word.strip_prefix('N').is_some_and(|rest| rest.parse::<u32>().is_ok());
    text.lines()
        .map(|line| {
            line.split(' ')
                .filter(|word| !is_number(word))
                .collect::<Vec<_>>()
                .join(" ")
        })
        .collect()
}

#[track_caller]
fn has(text: &str, wanted: &[&str]) {
    let lines = lines(text);
    assert!(
        lines.windows(wanted.len()).any(|window| window == wanted),
        "{wanted:?} in\n{text}"
    );
}

#[test]
fn the_length_of_the_tool_is_in_the_first_block_that_moves_along_it() {
    let program = "G90 G17 G71 G94 G54\nT1 M6\nD1\nS2000 M3\nG0 X0 Y0\nG0 Z50\nG1 Z-2 F300\nM30\n";
    for (dialect, length) in [("fanuc-30i", "G43 H1"), ("haas-ngc", "G43 H1"), ("okuma-osp", "G56 H1")] {
        let made = text(to((program, "sinumerik-840d", ""), dialect, "", &Options::default()));
        has(
            &made,
            &["G0 X0. Y0.", &format!("{length} X0. Y0. Z50."), "G1 Z-2. F300."],
        );
        assert!(!lines(&made).iter().any(|line| line == length), "{made}");
    }
    // where all axes move at once, they do so in the output
    let together = program.replace("G0 X0 Y0\nG0 Z50", "G0 X0 Y0 Z50");
    let made = text(to(
        (&together, "sinumerik-840d", ""),
        "fanuc-30i",
        "",
        &Options::default(),
    ));
    has(&made, &["G0 G43 H1 X0. Y0. Z50.", "G1 Z-2. F300."]);
}

#[test]
fn tolerances_of_path_control_are_kept_for_the_same_control() {
    let part = |code: &str| {
        format!(
            "G21 G90 G17 G54 G94\nT1 M6\nS1000 M3\n{code}\nG0 X0. Y0.\nG43 H1 Z50.\nG1 Z-1. F100.\nX20.\nG0 Z50.\nM30\n"
        )
    };
    for (dialect, code, other) in [
        ("linuxcnc", "G64 P0.01", "haas-ngc"),
        ("linuxcnc", "G64 P0.01 Q0.02", "haas-ngc"),
        ("haas-ngc", "G187 P2 E0.05", "fanuc-30i"),
    ] {
        let program = part(code);
        let made = text(to((&program, dialect, ""), dialect, "", &Options::default()));
        has(&made, &[code]);
        let elsewhere = refusal(to((&program, dialect, ""), other, "", &Options::default()));
        assert!(elsewhere.message.contains("no counterpart"), "{elsewhere}");
        // its lengths are in the unit of the program
        let inch = Options {
            units: Units::Inch,
            ..Options::default()
        };
        let inch = refusal(to((&program, dialect, ""), dialect, "", &inch));
        assert!(inch.message.contains("no counterpart"), "{inch}");
        let dropped = Options {
            drop: vec![code.split(' ').next().unwrap_or_default().to_owned()],
            ..Options::default()
        };
        let made = text(to((&program, dialect, ""), dialect, "", &dropped));
        assert!(!made.contains(code), "{made}");
    }
}

#[test]
fn a_value_at_a_limit_is_rounded_to_the_inside() {
    let program = "G21 G90 G17 G54 G94\nT1 M6\nS1000 M3\nG0 X0. Y0.\nG43 H1 Z50.\nG1 Z-1. F100.\nX500. F500.\nX-500.\nX100.\nX500.\nG0 Z50.\nM30\n";
    let setup = Setup {
        work_offsets: vec![WorkOffset {
            name: "G54".to_owned(),
            values: [0.0; 9],
        }],
        ..Setup::default()
    };
    let source = Source {
        text: program.as_bytes(),
        dialect: trunnion_dialect::builtin("fanuc-30i").expect("built in"),
        machine: machine("mill-3axis"),
        setup: &setup,
        assume: Assume::default(),
    };
    let target = Target::Code {
        post: builtin_post("fanuc-30i").expect("built in"),
        machine: machine("mill-3axis"),
    };
    let inch = Options {
        units: Units::Inch,
        ..Options::default()
    };
    let made = text(convert(&source, &target, &inch));
    has(&made, &["X19.68503 F19.685", "X-19.68503", "X3.93701", "X19.68503"]);
}

/// AUXFUN is the M code of that number.
#[test]
fn auxiliary_functions_are_the_m_codes_of_the_target() {
    let program = |code: &str| {
        format!(
            "PARTNO A\nLOADTL/1\nSPINDL/1000,CLW\nFEDRAT/200,MMPM\n{code}\nRAPID\nGOTO/0,0,50\nGOTO/0,0,0\nGOTO/10,0,0\nFINI\n"
        )
    };
    for (code, dialect, wanted) in [
        ("AUXFUN/0", "fanuc-30i", "M0"),
        ("AUXFUN/1", "fanuc-30i", "M1"),
        ("AUXFUN/3", "fanuc-30i", "S1000 M3"),
        ("AUXFUN/4", "fanuc-30i", "S1000 M4"),
        ("AUXFUN/5", "fanuc-30i", "M5"),
        ("AUXFUN/7", "linuxcnc", "M7"),
        ("AUXFUN/8", "fanuc-30i", "M8"),
        ("COOLNT/ON\nAUXFUN/9", "fanuc-30i", "M9"),
        ("AUXFUN/30", "fanuc-30i", "M30"),
        ("AUXFUN/50", "fanuc-30i", "M50"),
        ("AUXFUN/3", "heidenhain-klartext", "M3"),
        ("AUXFUN/8", "heidenhain-klartext", "M8"),
        ("AUXFUN/4", "apt", "SPINDL/1000,RPM,CCLW"),
        ("AUXFUN/8", "apt", "COOLNT/FLOOD"),
    ] {
        let made = text(to((&program(code), "apt", ""), dialect, "", &Options::default()));
        assert!(
            lines(&made).iter().any(|line| line.ends_with(wanted)),
            "{code} for {dialect}:\n{made}"
        );
    }
    // a control without mist says so
    let mist = refusal(to(
        (&program("AUXFUN/7"), "apt", ""),
        "fanuc-30i",
        "",
        &Options::default(),
    ));
    assert!(mist.message.contains("coolant-mist"), "{mist}");
}
