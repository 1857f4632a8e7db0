//! Numbers that are data, jumps in odd places, and texts that may name a block.
use crate::support::{dialect, program};
use trunnion_interp::Setup;
use trunnion_layout::{Numbers, Renumbered, block_references, renumber};

fn new(text: &str, name: &str) -> Renumbered {
    let dialect = dialect(name);
    let numbers = Numbers { start: 100, step: 10 };
    renumber(&program(text.as_bytes(), dialect), dialect, &Setup::default(), numbers)
}

fn changed(text: &str, name: &str) -> String {
    match new(text, name) {
        Renumbered::Changed { text, .. } => String::from_utf8(text).expect("UTF-8"),
        other => panic!("{text:?}: {other:?}"),
    }
}

/// The reason, and the text at its place.
fn refused(text: &str, name: &str) -> (String, String) {
    match new(text, name) {
        Renumbered::Refused(obstacle) => (obstacle.why, text[obstacle.range.as_usize()].to_owned()),
        other => panic!("{text:?}: {other:?}"),
    }
}

#[test]
fn parameters_between_g10_and_g11_are_no_blocks() {
    for entry in ["L50", "L51", "L52"] {
        let text = format!("N5 G10 {entry}\nN1815 P1 R5.\nN1816 R6.\nG11\nN20 G1 X5. F100.\nM30\n");
        assert_eq!(
            changed(&text, "fanuc-30i"),
            format!("N100 G10 {entry}\nN1815 P1 R5.\nN1816 R6.\nG11\nN110 G1 X5. F100.\nM30\n")
        );
    }
    // without G11 they go on to the end of the program, and not into the next one
    assert_eq!(
        changed("O1\nN5 G10 L52\nN1815 R5.\nM30\nO2\nN7 X1.\nM99\n", "fanuc-30i"),
        "O1\nN100 G10 L52\nN1815 R5.\nM30\nO2\nN100 X1.\nM99\n"
    );
    // an offset is written in one block
    assert_eq!(
        changed("N5 G10 L2 P1 X5.\nN7 G1 X5. F9.\nM30\n", "haas-ngc"),
        "N100 G10 L2 P1 X5.\nN110 G1 X5. F9.\nM30\n"
    );
    // another table of data
    assert_eq!(
        changed("N5 G10 L3 P1\nN7 T1\nG11\nN9 X1.\nM30\n", "fanuc-30i"),
        "N100 G10 L3 P1\nN7 T1\nG11\nN110 X1.\nM30\n"
    );
}

#[test]
fn a_jump_to_a_number_of_data_is_refused() {
    let (why, place) = refused(
        "G10 L52\nN1815 R5.\nG11\nN20 G1 X5. F9.\nIF[#1EQ1]GOTO1815\nM30\n",
        "fanuc-30i",
    );
    assert!(why.contains("N1815 is a number of data"), "{why}");
    assert_eq!(place, "1815");
    // N110 would be there twice
    let (why, _) = refused(
        "G10 L52\nN100 R5.\nG11\nN20 G1 X5. F9.\nIF[#1EQ1]GOTO20\nM30\n",
        "fanuc-30i",
    );
    assert!(why.contains("would not refer to the same blocks"), "{why}");
}

#[test]
fn jumps_on_an_input_and_contours_of_mills_follow() {
    assert_eq!(
        changed("N5 X1.\nN7 M96 P30 Q8\nN30 X2.\nM30\n", "haas-ngc"),
        "N100 X1.\nN110 M96 P120 Q8\nN120 X2.\nM30\n"
    );
    assert_eq!(
        changed(
            "G71.7 P25 Q35 U.2 F.1\nN25 X1.\nN35 X2.\nG70.7 P25 Q35\nM30\n",
            "fanuc-30i"
        ),
        "G71.7 P100 Q110 U.2 F.1\nN100 X1.\nN110 X2.\nG70.7 P100 Q110\nM30\n"
    );
}

#[test]
fn every_destination_of_case_follows() {
    for goto in ["GOTO", "GOTOF", "GOTOC"] {
        let case = |a: u32, b: u32, c: u32, d: u32| {
            format!("CASE R1 OF 1 {goto} N{a} 2 {goto} N{b} 7 {goto} {c} DEFAULT {goto} N{d}")
        };
        let rest = |a: u32, b: u32, c: u32, d: u32| format!("N{a} G1 X1 F9\nN{b} X2\nN{c} X3\nN{d} X4\nM30\n");
        let text = |first: u32, n: [u32; 4]| {
            format!(
                "N{first} {}\n{}",
                case(n[0], n[1], n[2], n[3]),
                rest(n[0], n[1], n[2], n[3])
            )
        };
        assert_eq!(
            changed(&text(15, [25, 35, 45, 55]), "sinumerik-840d"),
            text(100, [110, 120, 130, 140])
        );
    }
    assert_eq!(
        changed("N5 G1 X1 F9\nIF R1>5 GOTOB 5\nREPEATB N5 P=2\nM30\n", "sinumerik-840d"),
        "N100 G1 X1 F9\nIF R1>5 GOTOB 100\nREPEATB N100 P=2\nM30\n"
    );
}

#[test]
fn texts_that_may_name_a_block_are_refused_at_their_place() {
    for (block, place) in [
        ("CYCLE95(\"N25:N35\",1)", "\"N25:N35\""),
        ("CYCLE62(\"\",2,\"N25\",\"N35\")", "\"N25\""),
        ("EXECSTRING(\"GOTOF N35\")", "\"GOTOF N35\""),
        ("EXECSTRING(\"GOTOF 35\")", "\"GOTOF 35\""),
        ("RET(\"N35\")", "\"N35\""),
        ("RET(35)", "35"),
        ("R1=5 CALL \"N35\"", "\"N35\""),
    ] {
        let text = format!("N25 G1 X1 F9\nN35 X2\n{block}\nM30\n");
        let (why, found) = refused(&text, "sinumerik-840d");
        assert!(why.contains("may"), "{why}");
        assert_eq!(found, place);
    }
    let (why, _) = refused(
        "DEF STRING[9] S1\nN25 X1\nS1=\"N\"<<R1\nGOTOF S1\nM30\n",
        "sinumerik-840d",
    );
    assert!(why.contains("may name a block"), "{why}");
    let (why, _) = refused(
        "N25 X1\nCASE R1 OF 1 GOTOF \"N\"<<R2 DEFAULT GOTOF N25\nM30\n",
        "sinumerik-840d",
    );
    assert!(why.contains("computed"), "{why}");
    let (why, place) = refused("N0025 G0 X1\nG85 N0025\nM2\n", "okuma-osp");
    assert!(why.contains("N0123 is not N123"), "{why}");
    assert_eq!(place, "N0025");
    let (why, place) = refused("N20 X1.\nG150 P20 X1. Y1.\nM30\n", "haas-ngc");
    assert!(why.contains("may name block N20"), "{why}");
    assert_eq!(place, "P20");
}

#[test]
fn messages_tools_and_numbers_of_other_files_are_no_obstacle() {
    assert_eq!(
        changed(
            "N25 X1\nMSG(\"N25 is next\")\nT=\"N25\"\nCYCLE95(\"N70:N80\")\nM30\n",
            "sinumerik-840d"
        ),
        "N100 X1\nMSG(\"N25 is next\")\nT=\"N25\"\nCYCLE95(\"N70:N80\")\nM30\n"
    );
    // a number that only exists afterwards
    assert_eq!(
        changed("N20 X1.\nM130 P100\nG150 P100 X1.\nM30\n", "haas-ngc"),
        "N100 X1.\nM130 P100\nG150 P100 X1.\nM30\n"
    );
    let dialect = dialect("haas-ngc");
    let found = block_references(&program(b"N20 X1.\nM98 P20\nM30\n", dialect), dialect);
    assert!(found.unread.is_empty(), "{:?}", found.unread);
}
