//! Rewrites of programs with blocks that begin with `/`, where it is not declared whether these run: what is proved holds in both states.
use trunnion::certify::{Outcome, certify};
use trunnion::check::{Assume, Settings};
use trunnion::dialect::builtin;
use trunnion::interp::Setup;
use trunnion::machine;
use trunnion::rewrite::{Attempt, Options, attempt, rewrite, rewrites};
use trunnion::syntax::parse;

fn settings(dialect: &str) -> Settings<'static> {
    let dialect = builtin(dialect).expect("built in");
    let mut settings = Settings::new(dialect, machine::builtin("mikron-ucp710"), Setup::default());
    settings.assume = Assume::ALL;
    settings
}

const FANUC: &str = "%\nO1\nG21 G90 G94 G17 G40 G49 G80 G54\nT1 M6\nG0 X0. Y0. Z5. S8000 M3\nG1 Z0. F500.\n";

/// Dialect, and a program.
fn programs() -> Vec<(&'static str, String)> {
    let of = |blocks: &str| ("fanuc-30i", format!("{FANUC}{blocks}M30\n%\n"));
    let rows =
        "X1.9973 Y0.1047\nX1.9890 Y0.2091\n/X1.9754 Y0.3129\nX1.9563 Y0.4158\nX1.9319 Y0.5176\nX1.9021 Y0.6180\n";
    let turns = "TRAORI\nG0 X10 Y0 Z50 A10 C350.000 S8000 M3\nN10 G1 X9 Y1 A10.5 C358.500 F1000\n/N20 X8 Y2 A11 C6.250\nN30 X7 Y3 A11.5 C14.000\nM30\n";
    vec![
        of("X5.\n/X10.\nX10. Y0.\nY10.\n/G1 X0. F900.\nY20. F900.\nX0.\n"),
        of("X5.\n/G0 Z5.\nG1 X6.\nX7.\nX8.\n/F900.\nX9. F900.\nX9. F500.\n"),
        of(&format!("X2. Y0.\n{rows}Y5.\n")),
        of(&format!("X2. Y0.\n/2 Z1.\n{rows}Y5.\n")),
        ("sinumerik-840d", turns.to_owned()),
    ]
}

#[test]
fn what_is_proved_holds_whether_blocks_are_skipped_or_not() {
    let mut proofs = 0;
    for (dialect, before) in programs() {
        let settings = settings(dialect);
        let options = Options {
            tolerance_mm: 0.01,
            ..Options::default()
        };
        for rewrite in rewrites() {
            let program = parse(before.clone().into_bytes(), settings.dialect.lex);
            let Ok(Some(proved)) = attempt(rewrite, &program, &settings, &options).outcome() else {
                continue;
            };
            proofs += 1;
            for state in [false, true] {
                let mut setup = settings.setup.clone();
                setup.control.block_delete = Some(state);
                let machine = settings.machine.expect("a machine");
                let claim = &proved.certificate.claim;
                let found = certify(
                    before.as_bytes(),
                    &proved.after,
                    settings.dialect,
                    machine,
                    &setup,
                    claim,
                );
                let after = String::from_utf8_lossy(&proved.after);
                assert!(
                    matches!(found, Outcome::Proved(_)),
                    "{} {state}: {found:?}\n{after}",
                    rewrite.name
                );
            }
        }
    }
    assert!(proofs >= 3, "{proofs}");
}

fn lean(before: &str, settings: &Settings<'_>) -> Attempt {
    let program = parse(before.as_bytes().to_vec(), settings.dialect.lex);
    let rewrite = rewrite("drop-redundant").expect("known");
    attempt(rewrite, &program, settings, &Options::default())
}

/// A block that repeats the position moves the tool where the one before it is skipped.
#[test]
fn what_repeats_a_block_that_may_be_skipped_stays() {
    let settings = settings("fanuc-30i");
    let (_, before) = &programs()[0];
    let found = lean(before, &settings);
    let reasons = found.reasons().expect("something stays");
    assert!(reasons.contains("where blocks with / are skipped"), "{reasons}");
    if let Ok(Some(proved)) = found.outcome() {
        let after = String::from_utf8(proved.after).expect("ASCII");
        assert!(after.contains("/X10.\nX10."), "{after}");
    }
}

/// A post that writes full lines repeats G1 and the coordinate after it: both go, and the words between them and the rest stay apart.
#[test]
fn repeated_words_beside_each_other_are_deleted_together() {
    for (line, rest) in [
        ("G1 X1. Y-3.", "Y-3."),
        ("N40 G1 X1. Y-3.", "N40 Y-3."),
        ("G1 X1.  Y-3. Z0. F250.", "Y-3."),
        ("G1X1.Y-3.", "Y-3."),
    ] {
        let before = format!("G21 G90 G94 G17 G54\nG0 X1. Y1. Z0. S5000 M3\nG1 Y2. F250.\n{line}\nM30\n");
        let settings = settings("fanuc-30i");
        let after = lean(&before, &settings)
            .outcome()
            .expect("proved")
            .expect("changed")
            .after;
        let expected = before.replace(line, rest);
        assert_eq!(String::from_utf8_lossy(&after), expected);
    }
}
