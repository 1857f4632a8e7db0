//! Check-points of programs that name many labels.
use super::Session;
use crate::Settings;
use core::fmt::Write;
use trunnion_interp::Setup;
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
