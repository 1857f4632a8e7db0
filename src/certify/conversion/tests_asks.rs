//! A conversion that loses what motions do not hold is refuted, whoever made it.
use super::*;
use crate::Outcome;
use trunnion_interp::{Setup, WorkOffset};

fn reading(text: &str, dialect: &str) -> Reading {
    let mut setup = Setup::default();
    let mut values = [0.0; 9];
    values[0] = 100.0;
    setup.work_offsets.push(WorkOffset {
        name: "G55".to_owned(),
        values,
    });
    read(&Run {
        text: text.as_bytes(),
        dialect: trunnion_dialect::builtin(dialect).expect("built in"),
        machine: None,
        setup: &setup,
        assume: Assume::default(),
    })
}

fn claim() -> ConversionClaim {
    ConversionClaim {
        end_mm: 1e-4,
        end_deg: 1e-4,
        path_mm: 1e-2,
        path_deg: None,
        feed_mm_min: 1e-3,
        time_share: 1e-4,
    }
}

fn outcome(before: (&str, &str), after: (&str, &str), dropped: &[String]) -> Result<(), String> {
    let (before, after) = (reading(before.0, before.1), reading(after.0, after.1));
    let parts = vec![Part::Moves(1); before.motions.len().max(after.motions.len())];
    let terms = Terms { dropped, meanings: &[] };
    match converted_on((&before, None), (&after, None), &parts, &claim(), &terms) {
        Ok(_) => Ok(()),
        Err(Outcome::Refuted(witness)) => Err(format!("refuted: {witness}")),
        Err(Outcome::Unknown(gap)) => Err(format!("unknown: {gap}")),
        Err(other) => panic!("{other:?}"),
    }
}

const HEAD: &str = "G21 G17 G90 G94 G54\nT1 M6\nS500 M3\nG0 X10. Y0. Z5.\n";
const TAIL: &str = "G1 X5. F100.\nM5\nM30\n";

#[track_caller]
fn lost(dialect: &str, before: &str, after: &str, why: &str) {
    let (before, after) = (format!("{HEAD}{before}\n{TAIL}"), format!("{HEAD}{after}\n{TAIL}"));
    let same = outcome((&before, dialect), (&before, dialect), &[]);
    assert_eq!(same, Ok(()), "{before}");
    let found = outcome((&before, dialect), (&after, dialect), &[]).expect_err(&before);
    assert!(found.contains(why), "{before}{after}{found}");
    // nor may it come from nowhere
    outcome((&after, dialect), (&before, dialect), &[]).expect_err(&after);
}

#[test]
fn a_tap_made_of_feed_motions_is_refuted() {
    lost(
        "fanuc-30i",
        "G84 Z-5. R2. F500.\nG80\nM3",
        "Z2.\nG1 Z-5. F500.\nZ2.\nG0 Z5.\nM3",
        "G84 R2. F500. (line 5 of the original) is lost",
    );
    lost(
        "haas-ngc",
        "M4\nG74 Z-5. R2. F500.\nG80\nM3",
        "M4\nZ2.\nG1 Z-5. F500.\nZ2.\nG0 Z5.\nM3",
        "is lost",
    );
    lost(
        "fanuc-30i",
        "G84 Z-5. R2. F500.\nG80\nM3",
        "G85 Z-5. R2. F500.\nG80\nM3",
        "is lost",
    );
    lost(
        "linuxcnc",
        "G33 Z-5 K1",
        "G95 G1 Z-5 F1\nG94",
        "G33 K1 (line 5 of the original) is lost",
    );
}

#[test]
fn a_lost_request_is_refuted() {
    for (dialect, request) in [
        ("fanuc-30i", "#3006=1(CHECK)"),
        ("fanuc-30i", "#500=1"),
        ("fanuc-30i", "M62"),
        ("fanuc-30i", "G61"),
        ("fanuc-30i", "G5.1 Q1"),
        ("fanuc-30i", "G92 S3000"),
        ("haas-ngc", "G187 P3"),
        ("haas-ngc", "M59 P1"),
        ("sinumerik-840d", "SPOS=90"),
        ("sinumerik-840d", "H5"),
        ("sinumerik-840d", "LIMS=3000"),
        ("sinumerik-840d", "R1=5"),
        ("sinumerik-840d", "COMPCAD"),
        ("sinumerik-840d", "CTOL=0.01"),
        ("linuxcnc", "M62 P1"),
        ("linuxcnc", "M68 E0 Q1"),
        ("linuxcnc", "G64 P0.1"),
        ("linuxcnc", "#100=1"),
        ("linuxcnc", "M0"),
        ("linuxcnc", "M1"),
        ("linuxcnc", "M8"),
        ("haas-ngc", "M88"),
    ] {
        let head = if dialect == "sinumerik-840d" {
            HEAD.replace("G21", "G710")
        } else {
            HEAD.to_owned()
        };
        let (before, after) = (format!("{head}{request}\n{TAIL}"), format!("{head}{TAIL}"));
        assert_eq!(
            outcome((&before, dialect), (&before, dialect), &[]),
            Ok(()),
            "{request}"
        );
        for (one, other) in [(&before, &after), (&after, &before)] {
            let found = outcome((one, dialect), (other, dialect), &[]).expect_err(request);
            assert!(found.starts_with("refuted"), "{request}: {found}");
        }
    }
}

#[test]
fn a_request_with_other_words_or_in_another_place_is_refuted() {
    lost("linuxcnc", "M62 P1", "M62 P2", "M62 P2 takes the place of M62 P1");
    lost("linuxcnc", "G64 P0.1", "G64 P0.2", "takes the place of");
    lost("linuxcnc", "M64 P1\nG1 X8 F100", "G1 X8 F100\nM64 P1", "is lost");
    lost(
        "linuxcnc",
        "M0\nG1 X8 F100",
        "G1 X8 F100\nM0",
        "a stop (line 5 of the original) is lost",
    );
    lost("linuxcnc", "M0", "M1", "an optional stop takes the place of a stop");
    lost(
        "linuxcnc",
        "M8\nG1 X8 F100\nM9",
        "M7\nG1 X8 F100\nM9",
        "the coolant is mist, but the original program has flood",
    );
    // a stop with the spindle running, and one without
    lost(
        "linuxcnc",
        "M5\nM0\nM3",
        "M0",
        "spindle or coolant are in another state",
    );
    lost(
        "linuxcnc",
        "M8\nM9\nM0\nM8",
        "M8\nM0",
        "spindle or coolant are in another state",
    );
    lost("linuxcnc", "M4", "M3", "the spindle differs");
}

/// M0 of a Haas stops the spindle; on a Fanuc the machine decides. At the stop itself both turn.
#[test]
fn a_spindle_that_is_left_to_the_machine_is_not_a_stopped_one() {
    let both = |request: &str| {
        let text = format!("{HEAD}{request}\n{TAIL}");
        outcome((&text, "fanuc-30i"), (&text, "haas-ngc"), &[])
    };
    let found = both("M0").expect_err("a cut after M0");
    assert!(found.contains("the spindle differs"), "{found}");
    assert_eq!(both("M0\nM3"), Ok(()));
    assert_eq!(both("M5 M0\nM3"), Ok(()));
}

#[test]
fn another_zero_point_is_refuted() {
    lost(
        "fanuc-30i",
        "G52 X3.\nG0 X10. Y0. Z5.",
        "G0 X10. Y0. Z5.",
        "shifts the zero point",
    );
    lost("fanuc-30i", "G55\nG0 X10. Y0. Z5.", "G0 X10. Y0. Z5.", "work offset");
}

/// The same text means something else on another control.
#[test]
fn the_text_of_another_control_is_no_counterpart() {
    let program = |request: &str| format!("{HEAD}{request}\n{TAIL}");
    for request in ["M19", "M62", "G9"] {
        let text = program(request);
        assert_eq!(outcome((&text, "fanuc-30i"), (&text, "fanuc-30i"), &[]), Ok(()));
        outcome((&text, "haas-ngc"), (&text, "fanuc-30i"), &[]).expect_err(request);
    }
    // a mode of path control is compared by what it demands
    let path = |from: &str, to: &str, old: &str, new: &str| outcome((&program(old), from), (&program(new), to), &[]);
    assert_eq!(path("haas-ngc", "fanuc-30i", "G61", "G61"), Ok(()));
    assert_eq!(path("fanuc-30i", "linuxcnc", "G61", "G61.1"), Ok(()));
    assert_eq!(path("fanuc-30i", "linuxcnc", "G64", ""), Ok(()));
    for (from, to, old, new) in [
        ("fanuc-30i", "linuxcnc", "G61", "G61"),
        ("fanuc-30i", "haas-ngc", "G61", ""),
        ("fanuc-30i", "haas-ngc", "G61", "G64"),
        ("fanuc-30i", "haas-ngc", "G64", "G61"),
        ("fanuc-30i", "haas-ngc", "", "G61"),
    ] {
        let found = path(from, to, old, new).expect_err("another mode");
        assert!(found.contains("in the original program"), "{old} {new}: {found}");
    }
    let deleted = program("/M8");
    let found = outcome((&deleted, "fanuc-30i"), (&deleted, "fanuc-30i"), &[]).expect_err("a switch");
    assert!(found.contains("depends on a switch"), "{found}");
    let (before, after) = (program("G9 G1 X8. F100."), program("G9\nG1 X8. F100."));
    outcome((&before, "fanuc-30i"), (&after, "fanuc-30i"), &[]).expect_err("no exact stop");
    let again = program("").replace("M30", "M99");
    outcome((&again, "fanuc-30i"), (&program(""), "fanuc-30i"), &[]).expect_err("it ends");
}

/// The user's word lets go of what moves nothing, never of a thread.
#[test]
fn what_moves_the_tool_is_never_dropped() {
    let drop = |name: &str| vec![name.to_owned()];
    let held = |request: &str, made: &str, name: &str| {
        let (before, after) = (format!("{HEAD}{request}\n{TAIL}"), format!("{HEAD}{made}\n{TAIL}"));
        outcome((&before, "linuxcnc"), (&after, "linuxcnc"), &drop(name))
    };
    assert_eq!(held("M62 P1", "", "m62"), Ok(()));
    assert_eq!(held("G64 P0.1", "", "G64"), Ok(()));
    held("M62 P1", "", "M63").expect_err("another name");
    held("G33 Z-5 K1", "G95 G1 Z-5 F1\nG94", "G33").expect_err("a thread");
}

/// `G0 X Y` before Z is known: the same words, no more and no less.
#[test]
fn a_rapid_in_some_axes_is_compared_by_its_words() {
    let tail = "G0 Z5.\nG1 Z0. F100.\nM30\n";
    let before = format!("G21 G17 G90 G94 G54\nG0 X10. Y20.\n{tail}");
    let held = |approach: &str| {
        let after = format!("G21 G17 G90 G94 G54\n{approach}\n{tail}");
        let (before, after) = (reading(&before, "fanuc-30i"), reading(&after, "fanuc-30i"));
        let parts = [Part::Words, Part::Moves(1), Part::Moves(1)];
        converted((&before, None), (&after, None), &parts, &claim())
    };
    held("G0 X10. Y20.").expect("the same");
    for wrong in [
        "G0 X10. Y20.1",
        "G0 X10.",
        "G0 X10. Y20. A5.",
        "G1 X10. Y20. F100.",
        "G0 X10. Y20. Z9.",
    ] {
        held(wrong).expect_err(wrong);
    }
}

/// Nobody says what a program means that is not understood.
#[test]
fn what_is_not_understood_before_is_no_proof() {
    let before = format!("{HEAD}G999\n{TAIL}");
    let after = format!("{HEAD}{TAIL}");
    let found = outcome((&before, "fanuc-30i"), (&after, "fanuc-30i"), &[]).expect_err("unknown");
    assert!(found.contains("G999 (line 5 of the original) is lost"), "{found}");
}
