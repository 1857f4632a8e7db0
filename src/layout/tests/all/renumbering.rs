//! New block numbers: what follows them, and what prevents them.
use crate::support::{dialect, program};
use trunnion_interp::Setup;
use trunnion_layout::{Numbers, Renumbered, renumber};

fn new(text: &str, name: &str, start: u32, step: u32) -> Renumbered {
    let dialect = dialect(name);
    renumber(
        &program(text.as_bytes(), dialect),
        dialect,
        &Setup::default(),
        Numbers { start, step },
    )
}

fn changed(text: &str, name: &str) -> String {
    match new(text, name, 100, 10) {
        Renumbered::Changed { text, .. } => String::from_utf8(text).expect("UTF-8"),
        other => panic!("{other:?}"),
    }
}

fn refused(text: &str, name: &str) -> String {
    match new(text, name, 100, 10) {
        Renumbered::Refused(obstacle) => obstacle.why,
        other => panic!("{other:?}"),
    }
}

#[test]
fn jumps_follow_their_blocks() {
    assert_eq!(
        changed(
            "O1\nN1 #1=0\nN2 X1\nIF[#1GT5]GOTO 9\n/N5 GOTO2\nX3 (N2 stays)\nN9 M30\n",
            "fanuc-30i"
        ),
        "O1\nN100 #1=0\nN110 X1\nIF[#1GT5]GOTO 130\n/N120 GOTO110\nX3 (N2 stays)\nN130 M30\n"
    );
}

#[test]
fn returns_and_contours_follow() {
    assert_eq!(
        changed(
            "O1\nN5 M98 P1000\nN7 X1\nN8 M30\nO1000\nN5 G1 X2 F1\nN6 M99 P7\n",
            "fanuc-30i"
        ),
        "O1\nN100 M98 P1000\nN110 X1\nN120 M30\nO1000\nN100 G1 X2 F1\nN110 M99 P110\n"
    );
    assert_eq!(
        changed("O1\nN1 X1\nN2 M99 P1\n", "fanuc-30i"),
        "O1\nN100 X1\nN110 M99 P100\n"
    );
    assert_eq!(
        changed(
            "N1 G71 P2 Q3 U.2 W.1 D2 F.2\nN2 G0 X1\nN3 G1 Z-5\nN4 G70 P2 Q3\nN5 G73 X1 Z-9 R2 P2 Q3 F1\n",
            "iso-6983"
        ),
        "N100 G71 P110 Q120 U.2 W.1 D2 F.2\nN110 G0 X1\nN120 G1 Z-5\nN130 G70 P110 Q120\nN140 G73 X1 Z-9 R2 P2 Q3 F1\n"
    );
    assert_eq!(
        changed("N1 M97 P3\nN2 M30\nN3 X1\nM99\n", "iso-6983"),
        "N100 M97 P120\nN110 M30\nN120 X1\nM99\n"
    );
}

#[test]
fn sinumerik_labels_stay_and_numbers_follow() {
    assert_eq!(
        changed(
            "N1 G0 X1\nN2 IF R1>5 GOTOF N4\nN3 GOTOB N1\nN4 GOTOF Ende\nN5 Ende: M30\n",
            "sinumerik-840d"
        ),
        "N100 G0 X1\nN110 IF R1>5 GOTOF N130\nN120 GOTOB N100\nN130 GOTOF Ende\nN140 Ende: M30\n"
    );
}

#[test]
fn zeros_in_front_and_programs_of_one_file() {
    assert_eq!(
        changed("O1\nN0005X1\nN0006X2\nO2\nN0005X1\n", "fanuc-30i"),
        "O1\nN0100X1\nN0110X2\nO2\nN0100X1\n"
    );
    assert_eq!(changed("n 1 x1\nn2.5 x2\n", "linuxcnc"), "n 100 x1\nn110 x2\n");
}

#[test]
fn a_number_with_many_zeros_gets_no_more_digits_than_the_highest_one() {
    let zeros = "0".repeat(100_000);
    for (name, first) in [
        ("fanuc-30i", "N00000100"),
        ("okuma-osp", "N0100"),
        ("linuxcnc", "N00100"),
    ] {
        let text = format!("N{zeros} G1 X1\nN2 X2\n");
        if let Renumbered::Changed { text, .. } = new(&text, name, 100, 10) {
            let text = String::from_utf8(text).expect("UTF-8");
            assert!(text.starts_with(&format!("{first} ")), "{name}: {}", &text[..20]);
        }
    }
    assert_eq!(
        changed("N000000000005 X1\nN6 X2\n", "fanuc-30i"),
        "N00000100 X1\nN00000110 X2\n"
    );
}

#[test]
fn a_program_that_is_called_twice_by_one_returns_there() {
    assert_eq!(
        changed("O1\nN1 M98 P2\nM98 P2\nN3 M30\nO2\nM99 P3\n", "fanuc-30i"),
        "O1\nN100 M98 P2\nM98 P2\nN110 M30\nO2\nM99 P110\n"
    );
    let two = "O1\nM98 P2\nN3 M30\nO3\nM98 P2\nN3 M30\nO2\nM99 P3\n";
    assert!(refused(two, "fanuc-30i").contains("several programs call this one"));
}

#[test]
fn what_is_not_certain_is_refused_with_its_reason() {
    for (text, reason) in [
        ("N1 X1\nGOTO#1\n", "computed"),
        ("N1 X1\nGOTO[#1+5]\n", "computed"),
        ("N1 X1\nM99 P#3\n", "computed"),
        ("N1 X1\nN1 X2\nGOTO1\n", "more than once"),
        ("N1 X1\nGOTO7\n", "block N7 does not exist"),
        ("N1 X1\n#1=#4114\n", "`#4114` reads a block number"),
        (
            "O1\nN1 M98 P3\nO2\nN1 M98 P3\nO3\nN5 M99 P1\n",
            "several programs call this one",
        ),
        ("O1\nN2 M98 P3\nO3\nN5 M99 P1\n", "no program of this file"),
        ("N1 X1\nN2 M98 P5 H1\n", "may name a block"),
    ] {
        let why = refused(text, "fanuc-30i");
        assert!(why.contains(reason), "{text:?}: {why}");
    }
    assert!(refused("N1 X1\nN2 GOTOF \"N\"<<R1\n", "sinumerik-840d").contains("computed"));
    assert!(refused("GOTO/1,2,3\n", "apt").contains("no block numbers"));
    assert_eq!(new("X1\nX2\n", "fanuc-30i", 10, 10), Renumbered::NoNumbers);
    assert!(matches!(new("N1\nN2\n", "linuxcnc", 99_999, 1), Renumbered::Refused(_)));
}

#[test]
fn a_program_that_calls_a_missing_one_keeps_its_numbers() {
    let found = new("O1\nN1 M98 P2000\nN2 GOTO1\n", "fanuc-30i", 10, 10);
    let Renumbered::Differs(difference) = found else {
        panic!("{found:?}");
    };
    assert!(difference.what.contains("O2000 is missing"), "{}", difference.what);
}

#[test]
fn contours_of_every_lathe_system_follow() {
    let a = "N1 G71 U2. R1.\nN2 G71 P3 Q4 U.4 W.1 F.2\nN3 G0 X20.\nN4 G1 Z-5.\nN5 G70 P3 Q4\nN6 G75 X10. P3 Q4 F.1\nN7 M30\n";
    assert_eq!(
        changed(a, "fanuc-30i-lathe-a"),
        "N100 G71 U2. R1.\nN110 G71 P120 Q130 U.4 W.1 F.2\nN120 G0 X20.\nN130 G1 Z-5.\nN140 G70 P120 Q130\nN150 G75 X10. P3 Q4 F.1\nN160 M30\n"
    );
    // in system C they are G73 and G72, and G75 is what G73 is in A
    let c = "N1 G73 P3 Q4 U.4 W.1 D2. F.2\nN3 G0 X20.\nN4 G1 Z-5.\nN5 G72 P3 Q4\nN6 G75 P3 Q4 R3\nN7 M30\n";
    assert_eq!(
        changed(c, "fanuc-30i-lathe-c"),
        "N100 G73 P110 Q120 U.4 W.1 D2. F.2\nN110 G0 X20.\nN120 G1 Z-5.\nN130 G72 P110 Q120\nN140 G75 P110 Q120 R3\nN150 M30\n"
    );
}

#[test]
fn calls_that_name_a_block_of_another_program_stand_in_the_way() {
    let why = refused("O1\nN1 M98 P1000 Q5\nN2 M30\nO1000\nN5 X1.\nN6 M99\n", "fanuc-30i");
    assert!(why.contains("Q5") && why.contains("M98"), "{why}");
}

#[test]
fn names_of_osp_are_text() {
    assert_eq!(
        changed("N0005 G1 X1 F9\nNA X2\nN7 X3\nM2\n", "okuma-osp"),
        "N0100 G1 X1 F9\nNA X2\nN0110 X3\nM2\n"
    );
    assert!(refused("V1=1\nN5 G1 X1 F9\nIF [V1 EQ 2] N5\nM2\n", "okuma-osp").contains("N0123 is not N123"));
}
