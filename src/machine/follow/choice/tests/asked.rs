//! Postures that a program asks for.
use super::*;

/// Rotary values modulo a turn, degrees.
fn assert_near_modulo(found: [f64; 2], wanted: [f64; 2]) {
    for (found, wanted) in found.iter().zip(wanted) {
        let turns = ((found - wanted) / 360.0).round();
        assert!((found - wanted - 360.0 * turns).abs() < 1e-4, "{found}, not {wanted}");
    }
}

/// iTNC 530 user's manual, 6/2010, page 404: PLANE SPATIAL SPA+0 SPB+45 SPC+0 on a C table on a tilting table A, from these values of A and
/// C, with the travel of A and SEQ. Where both ways are equal the manual's row has A+45; it names no rule, so the verdict stays open.
#[test]
fn heidenhain_tilting_solutions_of_the_manual() {
    let normal = Vec3::new(0.5_f64.sqrt(), 0.0, 0.5_f64.sqrt());
    let rows = [
        ("[-120,120]", [0.0, 0.0], "", Some([90.0, 45.0]), true),
        ("[-120,120]", [0.0, 0.0], "+", Some([90.0, 45.0]), false),
        ("[-120,120]", [0.0, 0.0], "-", Some([-90.0, -45.0]), false),
        ("[-120,120]", [-105.0, 0.0], "", Some([-90.0, -45.0]), false),
        ("[-120,120]", [-105.0, 0.0], "+", Some([90.0, 45.0]), false),
        ("[-120,120]", [-105.0, 0.0], "-", Some([-90.0, -45.0]), false),
        ("[-90,10]", [0.0, 0.0], "", Some([-90.0, -45.0]), false),
        ("[-90,10]", [0.0, 0.0], "+", None, false),
        ("[-120,120]", [-135.0, 0.0], "+", Some([90.0, 45.0]), false),
    ];
    for (travel, before, seq, wanted, open) in rows {
        let tilt = A_TABLE.replace("[-120,120]", travel);
        let seq = if seq.is_empty() {
            String::new()
        } else {
            format!(", seq = \"{seq}\"")
        };
        let control = format!("family = \"heidenhain-klartext\"\nbranch = {{ rule = \"heidenhain\"{seq} }}");
        let machine = machine(C_TABLE, &tilt, &control);
        let found = choose(&machine, &normal, &from(&machine, before.map(rad)));
        match (found, wanted) {
            (Ok(found), Some(wanted)) => {
                assert_near_modulo(found.q.map(deg), wanted);
                assert_eq!(
                    found.open.is_some(),
                    open,
                    "{travel} {before:?} {seq}: {:?}",
                    found.open
                );
            }
            // the control stops with the error that the angle is not permitted
            (Err(NoStance::PostureRefused { axis, value }), None) => {
                assert_eq!((axis, deg(value).round()), (b'A', -45.0));
            }
            (found, wanted) => panic!("{travel} {before:?} {seq}: {found:?}, not {wanted:?}"),
        }
    }
    // the family alone documents the rule
    let family = machine(C_TABLE, A_TABLE, "family = \"heidenhain-klartext\"");
    assert_near_modulo(chosen(&family, normal, [-105.0, 0.0]).0, [-90.0, -45.0]);
}

/// The tool axis of C 270 A 30, which is C 90 A -30 too. TU: bit 3 is A's, bit 4 C's.
#[test]
fn turn_bits_choose_posture_and_winding() {
    let control = "family = \"sinumerik-840d\"\nposture_words = { turn = { A = 3, C = 4 }, status = { bit = 0, axis = \"A\", set = \"negative\" } }";
    let c = C_TABLE.replace("\"unbounded\"", "[-360,360]");
    let declared = machine(&c, A_TABLE, control);
    let axis = crate::tool_axis_at(&declared, [rad(270.0), rad(30.0)]);
    let ask = |machine: &Machine, status: Option<u16>, turn: Option<u16>| {
        let before = Before {
            wish: Posture::Bits { status, turn },
            ..from(machine, [0.0, rad(5.0)])
        };
        choose(machine, &axis, &before).map(|found| (found.q.map(deg), found.open.map(|open| open.cause)))
    };
    for (turn, wanted) in [
        (0b00000, [270.0, 30.0]),
        (0b10000, [-90.0, 30.0]),
        (0b01000, [90.0, -30.0]),
        (0b11000, [-270.0, -30.0]),
    ] {
        let (q, open) = ask(&declared, None, Some(turn)).expect("legal");
        assert_near(q, wanted);
        assert_eq!(open, None, "{turn:b}");
    }
    // STAT alone chooses the posture, the shortest way the winding
    for (status, wanted) in [(0, [-90.0, 30.0]), (1, [90.0, -30.0])] {
        let (q, open) = ask(&declared, Some(status), None).expect("legal");
        assert_near(q, wanted);
        assert_eq!(open, None);
    }
    // STAT wants A below zero, TU above
    let Err(NoStance::PostureRefused { axis: b'A', value }) = ask(&declared, Some(1), Some(0b10000)) else {
        panic!("STAT and TU contradict each other")
    };
    assert!((deg(value) - 30.0).abs() < 1e-9);
    // A cannot go below -20 deg
    let short = machine(&c, &A_TABLE.replace("[-120", "[-20"), control);
    assert!(matches!(
        ask(&short, None, Some(0b01000)),
        Err(NoStance::PostureRefused { .. })
    ));
    // an axis that turns without end takes the shortest way whatever its bit says
    let endless = machine(C_TABLE, A_TABLE, control);
    assert_near(ask(&endless, None, Some(0b00000)).expect("legal").0, [-90.0, 30.0]);
    // nobody says which bits are meant
    let silent = machine(&c, A_TABLE, "family = \"sinumerik-840d\"");
    assert_eq!(
        ask(&silent, None, Some(0)).expect("legal").1,
        Some(OpenCause::WordsNotDeclared)
    );
    // one posture is left, but C has two turns for it
    let one = machine(&c, &A_TABLE.replace("[-120", "[-20"), "family = \"sinumerik-840d\"");
    assert_eq!(
        ask(&one, None, Some(0)).expect("legal").1,
        Some(OpenCause::WordsNotDeclared)
    );
}

#[test]
fn solutions_by_number_are_what_the_machine_file_says() {
    let said = "family = \"fanuc-30i\"\nposture_words = { solutions = { 1 = \"A+\", 2 = \"A-\" } }";
    for (control, number, wanted, cause) in [
        (said, 1, [90.0, 30.0], None),
        (said, 2, [-90.0, -30.0], None),
        (
            "family = \"fanuc-30i\"",
            1,
            [90.0, 30.0],
            Some(OpenCause::WordsNotDeclared),
        ),
    ] {
        let machine = machine(C_TABLE, A_TABLE, control);
        let axis = crate::tool_axis_at(&machine, [rad(90.0), rad(30.0)]);
        let before = Before {
            wish: Posture::Numbered(number),
            ..from(&machine, [rad(10.0), rad(5.0)])
        };
        let found = choose(&machine, &axis, &before).expect("legal");
        assert_near(found.q.map(deg), wanted);
        assert_eq!(found.open.map(|open| open.cause), cause);
    }
}

#[test]
fn words_for_postures_are_checked() {
    for (control, wrong) in [
        ("posture_words = { turn = { X = 3 } }", "X"),
        ("posture_words = { turn = { A = 16 } }", "16"),
        ("posture_words = { turn = { A = 0.5 } }", "0.5"),
        ("posture_words = { solutions = { one = \"A+\" } }", "number"),
        ("posture_words = { solutions = { 1 = \"A\" } }", "as \"A+\""),
        (
            "posture_words = { status = { bit = 0, axis = \"A\", set = \"down\" } }",
            "negative, positive",
        ),
        ("branch = { rule = \"fanuc\", seq = \"+\" }", "heidenhain"),
    ] {
        let text = format!(
            "schema = \"ncmachine/1\"\naxis = [{{{C_TABLE}}},{{{A_TABLE}}},{{letter=\"X\",sign=1,limits=[-9,9]}},{{letter=\"Y\",side=\"head\",sign=1,limits=[-9,9]}},{{letter=\"Z\",side=\"head\",sign=1,limits=[-9,9]}}]\n[control]\n{control}\n"
        );
        let error = load("test", &text).expect_err(control);
        assert!(
            error.message.contains(wrong) && error.span.is_some(),
            "{control}: {error}"
        );
    }
}
