//! HEIDENHAIN Klartext: sentences at which the control stops, and sentences whose effect no source decides: each has a finding.
use crate::klartext::{NAME, program};
use crate::support::{faults, lines, run_bytes};
use trunnion_interp::{FaultKind, Refusal, Setup};

fn refused(blocks: &str, sort: Refusal) -> Vec<String> {
    let log = run_bytes(NAME, program(blocks).as_bytes(), &Setup::default()).1;
    let messages = log.faults.into_iter().filter_map(|fault| match fault.kind {
        FaultKind::Rejected { refusal, message, .. } if refusal == sort => Some(message),
        _ => None,
    });
    messages.collect()
}

/// Faults apart from the length of the tool.
fn told(blocks: &str) -> Vec<String> {
    let mut found = faults(NAME, &program(blocks));
    found.retain(|fault| !fault.contains("ToolLengthUnset"));
    found
}

/// Whether or not anything reads the parameter.
#[test]
fn arithmetic_without_a_value_is_refused_where_it_stands() {
    for (text, why) in [
        ("FN 4: Q1 = +5 DIV +0", "division by zero in FN 4"),
        ("Q3 = 0\nFN 4: Q1 = +5 DIV +Q3", "division by zero"),
        ("FN 5: Q2 = SQRT -4", "square root of a negative number in FN 5"),
        ("Q1 = 5 / 0", "division by zero in the formula of Q1"),
        ("Q1 = 2 * SQRT ( 3 - 4 )", "square root"),
        ("Q1 = SQRT -4", "square root"),
        ("Q1 = LN 0", "logarithm of zero"),
        ("Q1 = ASIN 2", "ASIN of a number outside"),
        ("QL1 = - ACOS ( 1.5 )", "ACOS of a number outside"),
    ] {
        let found = refused(&format!("{text}\nL X+5 FMAX\n"), Refusal::Expression);
        assert_eq!(found.len(), 1, "{text}: {found:?}");
        assert!(found[0].contains(why), "{text}: {found:?}");
    }
    assert_eq!(lines(NAME, &program("Q1 = 5 / 0\nL X+Q1 FMAX\n")), ["R -"]);
    // what is not known may have a value with which it has a result
    for text in [
        "FN 4: Q1 = +Q9 DIV +0",
        "FN 5: Q2 = SQRT +Q9",
        "Q1 = Q9 / 0",
        "Q1 = 5 / Q9",
        "FN 4: Q1 = +6 DIV +2",
    ] {
        let found = refused(&format!("{text}\nL X+5 FMAX\n"), Refusal::Expression);
        assert_eq!(found, [""; 0], "{text}");
    }
}

#[test]
fn text_after_the_values_of_a_function_is_named() {
    for text in [
        "FN 0: Q1 = +3 Q2 = +4",
        "FN 1: Q1 = +3 + +4 + +5",
        "FN 5: Q1 = SQRT +4 X",
        "FN 4: Q1 = +6 DIV +2 F100",
    ] {
        let found = told(&format!("{text}\nL X+5 FMAX\n"));
        assert!(
            found.len() == 1 && found[0].contains("after the values of FN"),
            "{text}: {found:?}"
        );
        assert_eq!(
            lines(NAME, &program(&format!("{text}\nL X+Q1 FMAX\n"))),
            ["R -"],
            "{text}"
        );
    }
    assert_eq!(told("FN 0: Q1 = +3 ; depth\nL X+Q1 FMAX\n"), [""; 0]);
}

#[test]
fn codes_that_exclude_each_other_are_named() {
    for codes in [
        "M3 M4", "M4 M3", "M13 M4", "M14 M3", "M13 M14", "M3 M5", "M5 M13", "M8 M9", "M9 M13", "M7 M9",
    ] {
        for block in [format!("L X+5 F100 {codes}"), codes.to_owned()] {
            let found = told(&format!("{block}\n"));
            assert!(
                found.len() == 1 && found[0].contains("in one block"),
                "{block}: {found:?}"
            );
        }
    }
    for codes in ["M3 M8", "M13 M8", "M3 M13", "M5 M9", "M7 M8", "M3 M91"] {
        let found = told(&format!("L X+5 F100 {codes}\n"));
        assert!(
            !found.iter().any(|found| found.contains("in one block")),
            "{codes}: {found:?}"
        );
    }
    let log = run_bytes(
        NAME,
        program("L X+0 F100 M3\nL X+5 M3 M4\nL X+6\n").as_bytes(),
        &Setup::default(),
    )
    .1;
    assert_eq!(log.state.expect("a run").spindle.on(), None);
}

#[test]
fn two_feeds_of_one_block_are_refused() {
    for feeds in [
        "FMAX F100",
        "F100 FMAX",
        "F100 F200",
        "F100 FAUTO",
        "FU0.1 F100",
        "F MAX F100",
    ] {
        let blocks = format!("L X+5 {feeds}\n");
        let found = told(&blocks);
        assert!(
            found.len() == 1 && found[0].contains("RepeatedWord"),
            "{feeds}: {found:?}"
        );
        assert_eq!(lines(NAME, &program(&blocks)), ["L X5"], "{feeds}");
    }
    // the second F of a block may be that of M128
    for feeds in ["F100", "FMAX", "F F100", "F100 M128 F500", "M128 F500 F100"] {
        let found = told(&format!("L X+5 {feeds}\n"));
        assert!(
            !found.iter().any(|found| found.contains("RepeatedWord")),
            "{feeds}: {found:?}"
        );
    }
}

#[test]
fn numbers_that_begin_with_zero_are_not_negative() {
    for (text, name) in [
        ("TOOL CALL 1 Z S-5", "S is negative"),
        ("TOOL CALL 1 Z S500 F-5", "F is negative"),
        ("TOOL CALL -1 Z", "the number of the tool is negative"),
        ("Q1 = -1\nTOOL CALL Q1 Z", "the number of the tool is negative"),
        ("TOOL DEF -1 L+5 R+2", "the number of the tool is negative"),
        ("RND R-1", "R of RND is negative"),
        ("RND -1", "R of RND is negative"),
        (
            "CYCL DEF 9.0 DWELL\nCYCL DEF 9.1 DWELL -2",
            "the time of a dwell is negative",
        ),
        ("FUNCTION DWELL TIME -2", "the time of a dwell is negative"),
    ] {
        let found = refused(&format!("L X+0 Y+0 F100\nL X+5\n{text}\nL Y+9\n"), Refusal::Number);
        assert!(found.len() == 1 && found[0].contains(name), "{text}: {found:?}");
    }
    for text in [
        "TOOL CALL 1 Z S0",
        "TOOL CALL 0 Z",
        "RND R1",
        "TOOL DEF 0",
        "FUNCTION DWELL TIME 0",
    ] {
        let found = refused(&format!("L X+0 Y+0 F100\nL X+5\n{text}\nL Y+9\n"), Refusal::Number);
        assert_eq!(found, [""; 0], "{text}");
    }
    // the corner is unknown, and so are its ends
    let found = lines(NAME, &program("L X+0 Y+0 Z+0 F100\nL X+5\nRND R-1\nL Y+9\n"));
    assert!(!found.iter().any(|line| line == "L X5 Y0 Z0 F100"), "{found:?}");
}

/// The last value of a parameter counts, and no cycle has so many of them.
#[test]
fn a_cycle_names_no_more_parameters_than_there_are() {
    let define = |numbers: core::ops::Range<u32>| {
        let given: Vec<String> = numbers.map(|number| format!(" ~\n Q{number}=+1")).collect();
        refused(
            &format!("CYCL DEF 200 DRILLING{}\n", given.concat()),
            Refusal::CannedCycle,
        )
    };
    assert_eq!(define(300..364), [""; 0]);
    let found = define(300..400);
    assert!(
        found.len() == 1 && found[0].contains("more than 64 parameters"),
        "{found:?}"
    );
}
