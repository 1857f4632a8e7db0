//! Check-points of programs that name many labels, have many mistakes or set many variables.
use super::Session;
use crate::Settings;
use core::fmt::Write;
use trunnion_interp::{ProgramRun, Setup};
use trunnion_syntax::{BlockId, parse};

/// Nested O-words, and those that follow each other: a copy of the run holds each label that it has met. Copies at every thousandth block held
/// labels in proportion to the square of the program.
#[test]
fn check_points_hold_labels_in_proportion_to_the_program() {
    let dialect = trunnion_dialect::builtin("linuxcnc").expect("built in");
    let settings = Settings::new(dialect, None, Setup::default());
    let labels = 30_000_u32;
    let mut nested = "G21 G90 G17 F100\n".to_owned();
    let mut flat = nested.clone();
    for label in 0..labels {
        let _ = writeln!(nested, "o{label} if [1]\nG1 X{label}");
        let _ = writeln!(flat, "o{label} if [1]\nG1 X{label}\no{label} endif");
    }
    for label in (0..labels).rev() {
        let _ = writeln!(nested, "o{label} endif");
    }
    for mut text in [nested, flat] {
        text.push_str("M2\n");
        let program = parse(text.into_bytes(), dialect.lex);
        let session = Session::new(&program, &settings, &|| false).expect("not cancelled");
        let held: usize = session.check_points.iter().map(|one| one.interpreter.copied()).sum();
        assert!(session.check_points.len() > 5, "{}", session.check_points.len());
        assert!(held > labels as usize && held < 8 * labels as usize, "{held}");
        // in the middle of the last half
        let line = program.block_count() as u32 / 4;
        let told = session.describe(&program, &settings, BlockId(line));
        assert!(told.runs);
    }
}

/// What else a copy of a run holds: the faults that it has reported, the variables and tools that it has set, and the calls that led to its lines. Nested `IF THEN` of half a million lines
/// took 1.5 GB.
#[test]
fn check_points_hold_faults_and_variables_in_proportion_to_the_program() {
    let count = 30_000;
    let lines = |line: &dyn Fn(u32) -> String| (0..count).map(line).collect::<String>();
    for (name, text, grows) in [
        (
            "fanuc-30i",
            format!("GOTO 5\nN5\n{}", lines(&|_| "ENDIF\n".to_owned())),
            true,
        ),
        ("fanuc-30i", lines(&|i| format!("#{}=1\n", 100 + i % 400)), false),
        ("sinumerik-840d", lines(&|i| format!("R{i}=1\n")), true),
        ("fanuc-30i", lines(&|i| format!("T{i} M6\nG43 H{i} Z1.\n")), true),
        ("fanuc-30i", lines(&|i| format!("G10 L10 P{i} R1.\n")), true),
        (
            "heidenhain-klartext",
            lines(&|i| format!("TOOL DEF {i} L+9 R+5\n")),
            true,
        ),
        ("sinumerik-840d", lines(&|i| format!("DEF REAL A{i}=1\n")), true),
        (
            "heidenhain-klartext",
            lines(&|i| format!("FN 0: Q{} = 1\n", i % 1900)),
            false,
        ),
        ("okuma-osp", lines(&|i| format!("V{}=1\nGOTO NA\n", i % 200)), false),
        (
            "okuma-osp",
            format!(
                "MODIN OA\n{}MODOUT\nM2\nOA\nG1 F50\nRTS\n",
                lines(&|i| format!("X{i}\n"))
            ),
            true,
        ),
        (
            "haas-ngc",
            format!("{}M30\nO2\nG1 X1. F50.\nM99\n", lines(&|_| "M98 P2\n".to_owned())),
            true,
        ),
        (
            "linuxcnc",
            format!("{}M2\no2\nG1 X1 F50\nM99\n", lines(&|_| "M98 P2\n".to_owned())),
            true,
        ),
    ] {
        let dialect = trunnion_dialect::builtin(name).expect("built in");
        let settings = Settings::new(dialect, None, Setup::default());
        let program = parse(format!("G21 G90\n{text}M30\n").into_bytes(), dialect.lex);
        let session = Session::new(&program, &settings, &|| false).expect("not cancelled");
        let held: usize = session.check_points.iter().map(|one| one.interpreter.copied()).sum();
        let message = format!("{name}: {held} in {}", session.check_points.len());
        // a call of two lines runs four blocks
        assert!(held < 5 * count as usize, "{message}");
        assert!(!grows || held > count as usize / 2, "{message}");
    }
}

/// What a run reads of the whole text is read once, not for each of the first blocks that is described: the lines of a LinuxCNC program, and
/// which axes a program names.
#[test]
fn the_first_check_point_has_read_the_text() {
    let dialect = trunnion_dialect::builtin("linuxcnc").expect("built in");
    let settings = Settings::new(dialect, None, Setup::default());
    let program = parse(b"G21 G90\n#1=5\nM2\n".to_vec(), dialect.lex);
    let session = Session::new(&program, &settings, &|| false).expect("not cancelled");
    // parameters have values once the engine has the program
    assert!(session.check_points[0].interpreter.variable("#5220").is_some());
    let info = session.describe(&program, &settings, BlockId(1));
    assert_eq!(info.variables.value("#1")[1], Some(5.0));
}
