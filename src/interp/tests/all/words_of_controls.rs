//! Words of real controls that are not modelled: what is known of the motions after them, and what is said.
use crate::support::{faults, lines};

const SINUMERIK: &str = "G17 G90 G94 G71 G54\nG0 X0 Y0 Z5\nF100\n";
const KLARTEXT: &str = "BEGIN PGM A MM\nTOOL CALL 1 Z S1000\nL X+0 Y+0 Z+5 C+0 R0 F100\n";

/// The motions after the head, and the faults as one text.
fn after(dialect: &str, head: &str, words: &str) -> (Vec<String>, String) {
    let source = format!("{head}{words}\n");
    let before = lines(dialect, head).len();
    let motions = lines(dialect, &source).split_off(before);
    let of_head = faults(dialect, head);
    let said: Vec<String> = faults(dialect, &source);
    let said: Vec<&str> = said
        .iter()
        .map(String::as_str)
        .filter(|line| !of_head.iter().any(|told| told == line))
        .collect();
    (motions, said.join("\n"))
}

/// Words; the motions after them; what is said: empty for nothing.
type Row = (&'static str, &'static [&'static str], &'static str);

fn check(dialect: &str, head: &str, rows: &[Row]) {
    for (words, motions, told) in rows {
        let (found, said) = after(dialect, head, words);
        assert_eq!(&found, motions, "{dialect}: {words}: {said}");
        let fits = if told.is_empty() {
            said.is_empty()
        } else {
            said.contains(told)
        };
        assert!(fits, "{dialect}: {words}: {said}");
    }
}

#[test]
fn a_code_with_a_value_is_no_variable() {
    let rows: &[Row] = &[
        ("TCARR=1\nG1 X30 Z1", &["L - F100"], "TCARR"),
        ("TOFFL=2\nG1 X30 Z1", &["L - F100"], "TOFFL"),
        ("TOFF[Z]=2\nG1 X30 Z1", &["L - F100"], "TOFF"),
        ("TRAORI=1\nG1 X30 Z1", &["L - F100"], "TRAORI=1"),
        // they leave coordinates as they are
        ("ADIS=0.5\nG1 X30 Z1", &["L X30 Y0 Z1 F100"], ""),
        ("G642 CTOL=0.5\nG1 X30 Z1", &["L X30 Y0 Z1 F100"], ""),
    ];
    check("sinumerik-840d", SINUMERIK, rows);
    // variables of the program
    let rows: &[Row] = &[
        ("TOFFL=3\nG1 X=TOFFL Z1", &["L X3 Y0 Z1 F100"], ""),
        ("WIDTH=3\nG1 X=WIDTH Z1", &["L X3 Y0 Z1 F100"], ""),
    ];
    check("sinumerik-840d", &format!("DEF REAL TOFFL, WIDTH\n{SINUMERIK}"), rows);
}

#[test]
fn another_feed_than_f() {
    let rows: &[Row] = &[
        ("G1 X30 FB=50", &["L X30 Y0 Z5"], "FB"),
        ("G1 X30 F200 FB=50", &["L X30 Y0 Z5"], "FB"),
        ("G1 X30 FB=50 F200", &["L X30 Y0 Z5"], "FB"),
        ("FZ=0.1\nG1 X30\nF200\nX40", &["L X30 Y0 Z5", "L X40 Y0 Z5 F200"], "FZ"),
        ("FD=10\nG1 X30", &["L X30 Y0 Z5"], "FD"),
        ("FA[X]=10\nG1 X30", &["L X30 Y0 Z5 F100"], ""),
    ];
    check("sinumerik-840d", SINUMERIK, rows);
}

#[test]
fn words_that_change_where_axes_are() {
    let rows: &[Row] = &[
        ("PRESETON(X,0)\nG1 X30 Y1 Z1", &["L - F100"], "PRESETON"),
        ("GEOAX(1,U)\nG1 X30 Y1 Z1", &["L - F100"], "GEOAX"),
        ("TRAILON(Y,X,1)\nG1 X30 Y1 Z1", &["L - F100"], "TRAILON"),
        ("TANG(C,X,Y,1)\nTANGON(C,0)\nG1 X30 C1", &["L - F100"], "TANGON"),
        ("DIAMONA[X]\nG1 X30 Y1 Z1", &["L - F100"], "DIAMONA"),
        (
            "TOWWCS\nG1 X30 Y1 Z1\nTOWSTD\nG1 X1 Y1 Z1",
            &["L - F100", "L X1 Y1 Z1 F100"],
            "TOWWCS",
        ),
        // the contour is read, and does not move
        (
            "CTABDEF(Y,X,1,0)\nX0 Y0\nX1 Y1\nCTABEND\nG1 X1 Y1 Z1",
            &["R -", "R -", "L X1 Y1 Z1 F100"],
            "CTABDEF",
        ),
    ];
    check("sinumerik-840d", SINUMERIK, rows);
}

#[test]
fn words_that_are_known_and_move_nothing() {
    let plain: &[&str] = &["L X30 Y0 Z5 F100"];
    let rows: &[Row] = &[
        ("SETINT(1) PRIO=1 LIFTFAST ALF=3\nG1 X30", plain, "SETINT"),
        ("POLF[Z]=100\nPOLFMASK(Z)\nG1 X30", plain, "POLF"),
        ("COUPON(S2,S1)\nG1 X30", plain, "COUPON"),
        ("ORIC\nG1 X30", plain, ""),
        ("DRFOF\nG1 X30", plain, ""),
        ("SPCON\nG1 X30", plain, ""),
    ];
    check("sinumerik-840d", SINUMERIK, rows);
}

#[test]
fn klartext_cycles_that_may_act_where_they_are_defined() {
    let rows: &[Row] = &[
        (
            "CYCL DEF 800 ADJUST XZ SYSTEM Q497=+0\nL X+3 Y+4 Z+1",
            &["L - F100"],
            "cycle 800",
        ),
        ("CYCL DEF 392 ATC Q240=+3\nL X+3 Y+4 Z+1", &["L - F100"], "cycle 392"),
        (
            "CYCL DEF 251 POCKET Q218=+3\nL X+3 Y+4 Z+1",
            &["L X3 Y4 Z1 C0 F100"],
            "",
        ),
        (
            "CYCL DEF 32.0 TOLERANCE\nCYCL DEF 32.1 T0.05\nL X+3 Y+4 Z+1",
            &["L X3 Y4 Z1 C0 F100"],
            "",
        ),
    ];
    check("heidenhain-klartext", KLARTEXT, rows);
}

#[test]
fn klartext_words_that_change_what_coordinates_mean() {
    let rows: &[Row] = &[
        ("FUNCTION PARAXMODE X Y W\nL X+3 Y+4 Z+1", &["L C0 F100"], "PARAXMODE"),
        ("FUNCTION CORRDATA TCS #1\nL X+3 Y+4 Z+1", &["L C0 F100"], "CORRDATA"),
        (
            "FUNCTION PARAXCOMP DISPLAY W\nL X+3",
            &["L X3 Y0 Z5 C0 F100"],
            "PARAXCOMP",
        ),
        (
            "FUNCTION FEED DWELL D-TIME0.5 F-TIME5\nL X+3",
            &["L X3 Y0 Z5 C0 F100"],
            "FEED DWELL",
        ),
        ("FN 25: PRESET = X/+5/+0\nL X+3 Y+4 Z+1", &["L C0 F100"], "FN 25"),
        ("FN 17: SYSWRITE ID503 NR1 = +3\nL X+3 Y+4 Z+1", &["L C0 F100"], "FN 17"),
        ("Q20=+5\nFN 23: Q20 = CDATA Q30\nL X+Q20", &["L Y0 Z5 C0 F100"], "FN 23"),
        (
            "SPL X+10 Y+3 K3X+1 K2X+2 K1X+3\nL X+3",
            &["U -", "L X3 F100"],
            "SPL: a spline",
        ),
        ("GLOBAL DEF 100 GENERAL ~\n Q200=2\nL X+3", &["L X3 Y0 Z5 C0 F100"], ""),
    ];
    check("heidenhain-klartext", KLARTEXT, rows);
}

#[test]
fn klartext_letters_that_are_those_of_an_m_code() {
    let rows: &[Row] = &[
        (
            "L X+3 M138 A C",
            &["L X3 Y0 Z5 C0 F100"],
            "M138: which axes tilting turns",
        ),
        ("L X+3 M94 C", &["L X3 Y0 Z5 F100"], "M94"),
        ("L X+3 M112 T0.01 A10", &["L X3 Y0 Z5 C0 F100"], ""),
    ];
    for (words, _, told) in rows {
        assert!(
            !after("heidenhain-klartext", KLARTEXT, words).1.contains("MissingWord"),
            "{words}: {told}"
        );
    }
    check("heidenhain-klartext", KLARTEXT, rows);
}

#[test]
fn polar_interpolation_by_its_other_numbers() {
    let head = "G21 G17 G90 G94 G54\nG0 X0. Y0. Z5.\nF100.\n";
    let rows: &[Row] = &[(
        "G112\nG1 X3. C5.\nG113\nG1 X1. Y1. Z1.",
        &["L - F100", "L X1 Y1 Z1 F100"],
        "G112",
    )];
    check("fanuc-30i", head, rows);
    // on a mill of Haas they are no work offsets for certain, and nothing ends them
    let rows: &[Row] = &[
        (
            "G112\nG1 X20. Y10.\nG113\nG55 X1. Y1. Z1.",
            &["L - F100", "L - F100"],
            "G112",
        ),
        ("G113\nG1 X20. Y10.", &["L - F100"], "G113"),
    ];
    check("haas-ngc", head, rows);
}

#[test]
fn a_plane_that_is_not_known_says_why() {
    let head = "G21 G17 G90 G94 G54\nG0 X0. Y0. Z5. A0. C0.\nF100.\n";
    let rows: &[Row] = &[
        (
            "G68.2 P4 X0. Y0. Z0. I30. J20. K0.\nG1 X3. Y1. Z1.",
            &["L - F100"],
            "how the angles of P4 turn",
        ),
        (
            "G68.2 P1 X0. Y0. Z0. I30. J20. K0.\nG1 X3. Y1. Z1.",
            &["L - F100"],
            "declare roll_pitch_yaw",
        ),
        (
            "G68.2 X0. Y0. Z0. I30. J20. K0. R5.\nG1 X3. Y1. Z1.",
            &["L - F100"],
            "how R turns the plane",
        ),
    ];
    check("fanuc-30i", head, rows);
}
